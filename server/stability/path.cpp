#include "stability/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shadow/camera.h"

namespace sundial {

namespace {

// Between which keys a frame lies, and how far from the first of the two.
struct Place {
  std::size_t first, second;
  double share;
};

Place placeOf(unsigned frame, unsigned frames, std::size_t keys) {
  if (keys == 1 || frames == 1) return {0, 0, 0};
  const double along = static_cast<double>(frame) * static_cast<double>(keys - 1) / (frames - 1);
  const auto first = std::min(static_cast<std::size_t>(along), keys - 2);
  return {first, first + 1, along - static_cast<double>(first)};
}

// Exact at both ends, so that a still path is still.
template <class T>
T between(const T& a, const T& b, double share) {
  return share == 0 ? a : share == 1 ? b : a + (b - a) * share;
}

}  // namespace

Result<std::vector<View>> viewsAlong(std::span<const View> keys, unsigned frames) {
  if (keys.empty()) return invalid("path: it has no key: give it one or more");
  std::vector<View> views;
  for (unsigned frame = 0; frame < frames; ++frame) {
    const Place place = placeOf(frame, frames, keys.size());
    const View &a = keys[place.first], &b = keys[place.second];
    views.push_back({.eye = between(a.eye, b.eye, place.share),
                     .target = between(a.target, b.target, place.share),
                     .up = between(a.up, b.up, place.share),
                     .verticalFovDegrees = between(a.verticalFovDegrees, b.verticalFovDegrees, place.share)});
    if (const auto why = whyInvalid(views.back()))
      return invalid(
          fmt::format("path: between its keys {} and {} the view can't be one ({}): add a key there",
                      place.first, place.second, *why));
  }
  return views;
}

Result<std::vector<Light>> lightsAlong(std::span<const Light> keys, unsigned frames) {
  if (keys.empty()) return invalid("light path: it has no key: give it one or more");
  std::vector<Light> lights;
  for (unsigned frame = 0; frame < frames; ++frame) {
    const Place place = placeOf(frame, frames, keys.size());
    const Light &a = keys[place.first], &b = keys[place.second];
    if (a.kind != b.kind)
      return invalid(fmt::format("light path: its keys {} and {} are lights of different kinds: use one kind",
                                 place.first, place.second));
    Light light = a;
    light.position = between(a.position, b.position, place.share);
    light.coneDegrees = between(a.coneDegrees, b.coneDegrees, place.share);
    light.direction = between(a.direction, b.direction, place.share);
    if (a.kind != LightKind::point && !(glm::length(light.direction) > 1e-6))
      return invalid(
          fmt::format("light path: its keys {} and {} shine in opposite directions: add a key between them",
                      place.first, place.second));
    if (place.share != 0 && place.share != 1 && a.direction != b.direction)
      light.direction = glm::normalize(light.direction);
    if (const auto why = whyInvalid(light)) return invalid("light path: " + *why);
    lights.push_back(light);
  }
  return lights;
}

}  // namespace sundial
