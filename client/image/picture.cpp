#include "image/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/class_tint.h"
#include "image/view_colour.h"

namespace sundial::image {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * (value > 0 ? std::min(value, 1.0f) : 0)));  // NaN: 0
}

// Neighbouring numbers get colours far apart. (The finaliser of MurmurHash3.)
Rgb hashed(std::uint32_t value) {
  value ^= value >> 16;
  value *= 0x85ebca6b;
  value ^= value >> 13;
  value *= 0xc2b2ae35;
  value ^= value >> 16;
  const auto channel = [&](int shift) {
    return static_cast<std::uint8_t>(64 + (value >> shift & 0xff) * 3 / 4);
  };
  return {channel(0), channel(8), channel(16)};
}

void put(Picture& picture, Rgb colour) {
  picture.pixels.insert(picture.pixels.end(), {colour.r, colour.g, colour.b});
}

}  // namespace

template <class T>
std::vector<T> numbersOf(const client::Image& image) {
  std::vector<T> numbers(image.bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), image.bytes.data(), numbers.size() * sizeof(T));
  return numbers;
}
template std::vector<float> numbersOf<float>(const client::Image&);
template std::vector<std::uint32_t> numbersOf<std::uint32_t>(const client::Image&);

Picture toPicture(const client::Image& image) {
  Picture picture{image.width, image.height, 3, {}};
  picture.pixels.reserve(std::size_t{3} * image.width * image.height);
  switch (image.aov) {
    case v1::COLOUR:
      for (std::size_t i = 0; i + 4 <= image.bytes.size(); i += 4)
        picture.pixels.insert(picture.pixels.end(), &image.bytes[i], &image.bytes[i] + 3);
      break;
    case v1::VISIBILITY:
    case v1::REFERENCE:
      picture.channels = 1;
      for (const float value : numbersOf<float>(image)) picture.pixels.push_back(toByte(value));
      break;
    case v1::NORMAL:
      for (const float value : numbersOf<float>(image)) picture.pixels.push_back(toByte(0.5f * value + 0.5f));
      break;
    case v1::POSITION:
      for (const float value : numbersOf<float>(image))
        picture.pixels.push_back(toByte(value - std::floor(value)));
      break;
    case v1::ID: {
      const auto ids = numbersOf<std::uint32_t>(image);
      for (std::size_t i = 0; i + 2 <= ids.size(); i += 2)
        put(picture, ids[i] == kNone ? Rgb{0, 0, 0} : hashed(ids[i] * 0x9e3779b1 + ids[i + 1]));
      break;
    }
    case v1::VIEW:
      for (const std::uint32_t view : numbersOf<std::uint32_t>(image))
        put(picture, view == kNone ? Rgb{0, 0, 0} : viewColour(view));
      break;
    case v1::CLASS:
      for (const std::uint32_t found : numbersOf<std::uint32_t>(image))
        put(picture, found == kNone ? Rgb{0, 0, 0} : classColour(found));
      break;
    default:
      break;
  }
  return picture;
}

}  // namespace sundial::image
