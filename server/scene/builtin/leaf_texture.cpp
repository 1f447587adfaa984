#include "scene/builtin/leaf_texture.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "scene/builtin/random.h"

namespace sundial::builtin {

namespace {

constexpr unsigned kSide = 256;

// A leaf from `root` to `tip`; `width` is its widest, relative to its length. Coordinates are the texture's.
struct Leaf {
  glm::dvec2 root, tip;
  double width;
  double shade;  // 0 dark to 1 light
};

struct Paint {
  double coverage = 0;  // above 0 inside
  glm::dvec3 colour{0};
};

// How far inside the leaf a point is, in units of the leaf's length, and its colour there.
Paint paintLeaf(const Leaf& leaf, const glm::dvec2& p) {
  const glm::dvec2 axis = leaf.tip - leaf.root;
  const double length = glm::length(axis);
  const glm::dvec2 along = axis / length;
  const double t = glm::dot(p - leaf.root, along) / length;
  const double s = (along.x * (p.y - leaf.root.y) - along.y * (p.x - leaf.root.x)) / length;
  Paint paint{-1, glm::dvec3(0)};
  if (t < 0 || t > 1) return paint;
  // Widest below the middle, pointed at the tip, with a few teeth.
  const double outline = leaf.width * 2.6 * std::sqrt(t) * (1 - t) * (0.94 + 0.06 * cosTurns(9 * t));
  const double stalk = t < 0.25 ? 0.012 : 0;
  paint.coverage = std::max(outline, stalk) - std::abs(s);
  const double rib = std::clamp(1 - std::abs(s) / 0.02, 0.0, 1.0);
  const double veins = std::clamp(cosTurns(11 * (t - 0.8 * std::abs(s))) - 0.6, 0.0, 1.0);
  const glm::dvec3 base = glm::mix(glm::dvec3(0.16, 0.33, 0.08), glm::dvec3(0.42, 0.6, 0.18), leaf.shade);
  paint.colour = base * (0.85 + 0.3 * t) + glm::dvec3(0.16, 0.18, 0.06) * std::max(rib, 0.4 * veins);
  return paint;
}

Texture paint(std::span<const Leaf> leaves) {
  Texture texture{glm::uvec2(kSide), std::vector<glm::u8vec4>(kSide * kSide)};
  for (unsigned y = 0; y < kSide; ++y)
    for (unsigned x = 0; x < kSide; ++x) {
      const glm::dvec2 p((x + 0.5) / kSide, (y + 0.5) / kSide);
      // Later leaves lie on top. Outside, the colour of the nearest leaf, so that lookups don't bleed black.
      Paint best{-1e9, glm::dvec3(0)};
      for (const Leaf& leaf : leaves) {
        const Paint here = paintLeaf(leaf, p);
        if (here.coverage > 0 || here.coverage > best.coverage) best = here;
      }
      if (best.coverage <= -1) best.colour = glm::dvec3(0.25, 0.42, 0.12);
      // One texel's ramp puts the outline at an alpha of a half.
      const double alpha = std::clamp(best.coverage * kSide * 0.5 + 0.5, 0.0, 1.0);
      const glm::dvec3 c = glm::clamp(best.colour, 0.0, 1.0) * 255.0 + 0.5;
      texture.texels[y * kSide + x] = {static_cast<std::uint8_t>(c.r), static_cast<std::uint8_t>(c.g),
                                       static_cast<std::uint8_t>(c.b),
                                       static_cast<std::uint8_t>(alpha * 255 + 0.5)};
    }
  return texture;
}

}  // namespace

Texture leafTexture() {
  const Leaf leaf{{0.5, 0.0}, {0.5, 0.99}, 0.42, 0.5};
  return paint({&leaf, 1});
}

Texture twigTexture() {
  Random random(77);
  std::vector<Leaf> leaves;
  leaves.push_back({{0.5, 0.0}, {0.5, 0.95}, 0.012, 0.0});  // the twig itself
  for (int i = 0; i < 12; ++i) {
    const double height = 0.08 + 0.065 * i;
    const double side = i % 2 == 0 ? 1 : -1;
    const glm::dvec2 root(0.5, height);
    const double length = random.range(0.30, 0.38) * (1 - 0.35 * height);
    const double turn = random.range(0.06, 0.14);  // from level, upwards
    leaves.push_back(
        {root, root + length * glm::dvec2(side * cosTurns(turn), sinTurns(turn)), 0.36, random.unit()});
  }
  leaves.push_back({{0.5, 0.72}, {0.5, 0.99}, 0.36, 0.8});
  return paint(leaves);
}

std::uint32_t addLeafMaterial(SceneBuilder& builder, std::string name, Texture texture,
                              const glm::vec3& tint) {
  return builder.addMaterial({.name = std::move(name),
                              .gpu = {.baseColour = glm::vec4(tint, 1),
                                      .alphaCutoff = 0.5f,
                                      .texture = builder.addTexture(std::move(texture)),
                                      .wrapU = shared::kWrapClamp,
                                      .wrapV = shared::kWrapClamp},
                              .masked = true,
                              .doubleSided = true});
}

}  // namespace sundial::builtin
