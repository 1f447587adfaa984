#include "shadow/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sundial {

namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

bool finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Whether it can be normalised: the square of its length is a number, and not zero.
bool hasDirection(const dvec3& v) {
  const double length = glm::length(v);
  return length >= 1e-150 && length <= 1e150;
}

dmat4 fromRows(const dvec4& r0, const dvec4& r1, const dvec4& r2, const dvec4& r3) {
  return glm::transpose(dmat4(r0, r1, r2, r3));
}

// Right and up of someone who looks along `forward`.
struct Basis {
  dvec3 right, up;
};
Basis basisOf(const dvec3& forward, const dvec3& wantedUp) {
  const dvec3 right = glm::normalize(glm::cross(forward, wantedUp));
  return {right, glm::cross(right, forward)};
}

std::array<dvec3, 8> corners(const Bounds& bounds) {
  std::array<dvec3, 8> out;
  for (int i = 0; i < 8; ++i)
    out[i] = {i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
              i & 4 ? bounds.max.z : bounds.min.z};
  return out;
}

// Depth 1 lies here; reversed depth keeps its resolution however near that is.
double nearDistance(const Scene& scene) {
  const double diagonal = scene.bounds.diagonal();
  return diagonal > 0 ? std::min(0.02, 1e-3 * diagonal) : 0.02;
}

// The box of every mesh instance in light space after division.
Bounds lightSpaceBounds(const Scene& scene, const dmat4& lightFromWorld, const dvec3& origin, bool spot,
                        double tanHalfCone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds box{dvec3(kInfinity), dvec3(-kInfinity)};
  bool behind = false;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const dvec3& corner : corners({dvec3(mesh.boundsMin), dvec3(mesh.boundsMax)})) {
      const dvec3 world = dvec3(instance.worldFromMesh * dvec4(corner, 1)) - origin;
      const dvec4 light = lightFromWorld * dvec4(world, 1);
      if (light.w <= 0) {
        behind = true;
        continue;
      }
      box.min = glm::min(box.min, dvec3(light) / light.w);
      box.max = glm::max(box.max, dvec3(light) / light.w);
    }
  }
  if (!spot) return box;
  // What lies beside or behind a spot light has no bounded projection: the cone bounds it instead.
  if (behind) {
    box.min = dvec3(-tanHalfCone, -tanHalfCone, box.min.z);
    box.max = dvec3(tanHalfCone, tanHalfCone, 1 / nearDistance(scene));
  }
  box.min = glm::max(box.min, dvec3(-tanHalfCone, -tanHalfCone, 0));
  box.max = glm::min(box.max, dvec3(tanHalfCone, tanHalfCone, 1 / nearDistance(scene)));
  return box;
}

}  // namespace

dvec3 frameOrigin(const Scene& scene, const View& view) {
  constexpr double kStep = 1024;
  const dvec3 centre = scene.bounds.centre();
  return centre + glm::round((view.eye - centre) / kStep) * kStep;
}

shared::FrameConstants frameConstants(const Scene& scene, const View& view, const Light& light,
                                      glm::uvec2 imageSize, const dvec3& origin) {
  shared::FrameConstants c{};
  const dvec3 eye = view.eye - origin;
  const dvec3 forward = glm::normalize(view.target - view.eye);
  const Basis camera = basisOf(forward, view.up);
  const double tanY = std::tan(glm::radians(view.verticalFovDegrees) / 2);
  const double tanX = tanY * imageSize.x / imageSize.y;
  const double nearZ = nearDistance(scene);
  const dvec3 clipX = camera.right / tanX, clipY = -camera.up / tanY;
  c.clipFromWorld =
      glm::mat4(fromRows(dvec4(clipX, -glm::dot(clipX, eye)), dvec4(clipY, -glm::dot(clipY, eye)),
                         dvec4(0, 0, 0, nearZ), dvec4(forward, -glm::dot(forward, eye))));
  c.wsEye = eye;
  c.nearDistance = static_cast<float>(nearZ);
  c.wsRayTopLeft = forward - tanX * camera.right + tanY * camera.up;
  c.wsRayPerPixelX = 2 * tanX / imageSize.x * camera.right;
  c.wsRayPerPixelY = -2 * tanY / imageSize.y * camera.up;
  c.imageSize = imageSize;

  const bool spot = light.kind == LightKind::spot;
  const dvec3 along = glm::normalize(light.direction);
  // Looking along the light, x is to the right and y up; any two axes do, but they must not flip near the
  // zenith.
  const Basis axes = basisOf(along, std::abs(along.y) < 0.999 ? dvec3(0, 1, 0) : dvec3(0, 0, -1));
  const dvec3 from = spot ? light.position - origin : dvec3(0);
  const dvec4 rowX(axes.right, -glm::dot(axes.right, from)), rowY(axes.up, -glm::dot(axes.up, from));
  const dmat4 lightFromWorld = spot ? fromRows(rowX, rowY, {0, 0, 0, 1}, dvec4(along, -glm::dot(along, from)))
                                    : fromRows(rowX, rowY, dvec4(-along, 0), {0, 0, 0, 1});
  const double halfCone = glm::radians(light.coneDegrees) / 2;
  c.lightFromWorld = glm::mat4(lightFromWorld);
  c.lightKind = spot ? shared::kLightSpot : shared::kLightDirectional;
  c.lightCosCone = static_cast<float>(std::cos(halfCone));
  c.wsLightDirection = along;
  c.wsLightPosition = from;
  const Bounds box = lightSpaceBounds(scene, lightFromWorld, origin, spot, std::tan(halfCone));
  c.lsBoundsMin = box.min;
  c.lsBoundsMax = box.max;
  return c;
}

std::optional<std::string> whyInvalid(const View& view) {
  if (!finite(view.eye) || !finite(view.target) || !finite(view.up))
    return "view: eye, target and up must be finite";
  if (!hasDirection(view.target - view.eye))
    return "view: target must differ from eye, and be within 1e150 m of it";
  if (!(view.verticalFovDegrees > 0 && view.verticalFovDegrees < 180))
    return fmt::format("view: fov {} is outside (0, 180) degrees", view.verticalFovDegrees);
  if (!hasDirection(view.up)) return "view: up must have a length in [1e-150, 1e150]";
  const dvec3 across = glm::cross(glm::normalize(view.target - view.eye), view.up);
  if (!(glm::length(across) > 1e-6 * glm::length(view.up)))
    return "view: up must not be parallel to target - eye";
  return std::nullopt;
}

std::optional<std::string> whyInvalid(const Light& light) {
  if (!finite(light.direction) || !finite(light.position))
    return "light: direction and position must be finite";
  if (light.kind == LightKind::point)
    return "light: point lights aren't rendered by any method yet: use --sun or --spot";
  if (!hasDirection(light.direction)) return "light: direction must have a length in [1e-150, 1e150]";
  if (light.kind == LightKind::spot && !(light.coneDegrees > 0 && light.coneDegrees <= 170))
    return fmt::format("light: cone {} is outside (0, 170] degrees", light.coneDegrees);
  return std::nullopt;
}

}  // namespace sundial
