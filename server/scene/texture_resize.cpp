#include "scene/texture_resize.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sundial {

namespace {

// Colours of fully transparent texels still count a little: a lookup may interpolate towards them.
constexpr float kAlphaFloor = 1.0f / 4096;

float linearFromSrgb(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }
float srgbFromLinear(float l) {
  return l <= 0.0031308f ? l * 12.92f : 1.055f * std::pow(l, 1 / 2.4f) - 0.055f;
}

struct Tap {
  unsigned first = 0;
  std::vector<float> weights;  // sum to 1
};

// Which texels of a row of `from` make each of `to` texels.
std::vector<Tap> taps(unsigned from, unsigned to) {
  const float scale = static_cast<float>(from) / static_cast<float>(to);
  const float radius = std::max(scale, 1.0f);
  std::vector<Tap> result(to);
  for (unsigned i = 0; i < to; ++i) {
    const float centre = (static_cast<float>(i) + 0.5f) * scale - 0.5f;
    const int lo = std::max(static_cast<int>(std::ceil(centre - radius)), 0);
    const int hi = std::min(static_cast<int>(std::floor(centre + radius)), static_cast<int>(from) - 1);
    float sum = 0;
    for (int k = lo; k <= hi; ++k) {
      const float weight = std::max(1 - std::abs(static_cast<float>(k) - centre) / radius, 0.0f);
      result[i].weights.push_back(weight);
      sum += weight;
    }
    result[i].first = static_cast<unsigned>(lo);
    for (float& weight : result[i].weights) weight /= sum;
  }
  return result;
}

}  // namespace

Texture resizeTexture(const Texture& from, glm::uvec2 size) {
  if (from.size == size) return from;

  std::array<float, 256> linear;
  for (std::size_t i = 0; i < 256; ++i) linear[i] = linearFromSrgb(static_cast<float>(i) / 255);

  // Rows first, into colours multiplied by their weight.
  const std::vector<Tap> across = taps(from.size.x, size.x), down = taps(from.size.y, size.y);
  std::vector<glm::vec4> rows(static_cast<std::size_t>(size.x) * from.size.y);
  for (unsigned y = 0; y < from.size.y; ++y) {
    const glm::u8vec4* row = &from.texels[static_cast<std::size_t>(y) * from.size.x];
    for (unsigned x = 0; x < size.x; ++x) {
      glm::vec4 sum(0);
      for (std::size_t k = 0; k < across[x].weights.size(); ++k) {
        const glm::u8vec4 texel = row[across[x].first + k];
        const float weight = std::max(static_cast<float>(texel.a) / 255, kAlphaFloor);
        sum += across[x].weights[k] *
               glm::vec4(glm::vec3(linear[texel.r], linear[texel.g], linear[texel.b]) * weight, weight);
      }
      rows[static_cast<std::size_t>(y) * size.x + x] = sum;
    }
  }

  Texture to{size, std::vector<glm::u8vec4>(static_cast<std::size_t>(size.x) * size.y)};
  for (unsigned y = 0; y < size.y; ++y) {
    for (unsigned x = 0; x < size.x; ++x) {
      glm::vec4 sum(0);
      for (std::size_t k = 0; k < down[y].weights.size(); ++k)
        sum += down[y].weights[k] * rows[(down[y].first + k) * size.x + x];
      const auto byte = [](float v) {
        return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f);
      };
      const float alpha = sum.a <= kAlphaFloor * 1.5f ? 0 : sum.a;
      to.texels[static_cast<std::size_t>(y) * size.x + x] = {
          byte(srgbFromLinear(sum.r / sum.a)), byte(srgbFromLinear(sum.g / sum.a)),
          byte(srgbFromLinear(sum.b / sum.a)), byte(alpha)};
    }
  }
  return to;
}

}  // namespace sundial
