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

// Light space before division, from world space relative to the frame's origin, and the scene's box after it.
struct LightSpace {
  dmat4 lightFromWorld;
  Bounds bounds;
};

// Calls `each` with light space coordinates of points around all that the scene holds.
template <class Function>
void eachCorner(const Scene& scene, const dmat4& lightFromWorld, const dvec3& origin, Function each) {
  for (const Instance& instance : scene.instances) {
    dmat4 relative = instance.worldFromMesh;
    relative[3] -= dvec4(origin, 0);
    const dmat4 lightFromMesh = lightFromWorld * relative;
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t i = mesh.firstCluster; i < mesh.firstCluster + mesh.clusterCount; ++i)
      for (const dvec3& corner :
           corners({dvec3(scene.clusters[i].boundsMin), dvec3(scene.clusters[i].boundsMax)}))
        each(lightFromMesh * dvec4(corner, 1));
  }
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Any two axes across the light do; these lie along the world axis that gives the scene the smallest box,
// because what is built tends to follow an axis.
LightSpace directionalSpace(const Scene& scene, const dvec3& along, const dvec3& origin) {
  std::optional<LightSpace> best;
  double bestArea = kInfinity;
  for (const dvec3& up : {dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(1, 0, 0)}) {
    if (std::abs(glm::dot(up, along)) > 0.999) continue;
    const Basis axes = basisOf(along, up);
    LightSpace space{fromRows(dvec4(axes.right, 0), dvec4(axes.up, 0), dvec4(-along, 0), {0, 0, 0, 1}),
                     {dvec3(kInfinity), dvec3(-kInfinity)}};
    eachCorner(scene, space.lightFromWorld, origin, [&](const dvec4& p) {
      space.bounds.min = glm::min(space.bounds.min, dvec3(p));
      space.bounds.max = glm::max(space.bounds.max, dvec3(p));
    });
    const dvec3 extent = space.bounds.max - space.bounds.min;
    const double area = extent.x * extent.y;
    // Clearly smaller: equal areas differ by rounding, which mustn't turn the map when the origin moves.
    if (best && !(area < 0.999 * bestArea)) continue;
    bestArea = area;
    best = space;
  }
  return *best;
}

// Of a light at a place, about an axis.
dmat4 placedSpace(const dvec3& from, const dvec3& along) {
  const Basis axes = basisOf(along, std::abs(along.y) < 0.999 ? dvec3(0, 1, 0) : dvec3(0, 0, -1));
  return fromRows(dvec4(axes.right, -glm::dot(axes.right, from)), dvec4(axes.up, -glm::dot(axes.up, from)),
                  {0, 0, 0, 1}, dvec4(along, -glm::dot(along, from)));
}

LightSpace spotSpace(const Scene& scene, const Light& light, const dvec3& along, const dvec3& origin) {
  LightSpace space{placedSpace(light.position - origin, along), {dvec3(kInfinity), dvec3(-kInfinity)}};
  bool behind = false;
  eachCorner(scene, space.lightFromWorld, origin, [&](const dvec4& p) {
    behind = behind || p.w <= 0;
    if (p.w <= 0) return;
    space.bounds.min = glm::min(space.bounds.min, dvec3(p) / p.w);
    space.bounds.max = glm::max(space.bounds.max, dvec3(p) / p.w);
  });
  // What lies beside or behind the light has no bounded projection: the cone bounds it instead.
  const double tanHalf = std::tan(glm::radians(light.coneDegrees) / 2);
  const dvec3 coneMin(-tanHalf, -tanHalf, 0), coneMax(tanHalf, tanHalf, 1 / nearDistance(scene));
  if (behind) space.bounds = {dvec3(coneMin.x, coneMin.y, space.bounds.min.z), coneMax};
  space.bounds.min = glm::max(space.bounds.min, coneMin);
  space.bounds.max = glm::min(space.bounds.max, coneMax);
  return space;
}

// A point light's axis, about which its light space lies: any would do.
dvec3 axisOf(const Light& light) {
  return light.kind == LightKind::point ? dvec3(0, -1, 0) : glm::normalize(light.direction);
}

LightSpace lightSpace(const Scene& scene, const Light& light, const dvec3& origin) {
  switch (light.kind) {
    case LightKind::directional:
      return directionalSpace(scene, axisOf(light), origin);
    case LightKind::spot:
      return spotSpace(scene, light, axisOf(light), origin);
    case LightKind::point:
      break;  // a box of its own has each of the cube's faces
  }
  return {placedSpace(light.position - origin, axisOf(light)), {dvec3(1), dvec3(-1)}};
}

std::uint32_t sharedKind(LightKind kind) {
  switch (kind) {
    case LightKind::directional:
      return shared::kLightDirectional;
    case LightKind::spot:
      return shared::kLightSpot;
    case LightKind::point:
      break;
  }
  return shared::kLightPoint;
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

  const LightSpace space = lightSpace(scene, light, origin);
  c.lightFromWorld = glm::mat4(space.lightFromWorld);
  c.lightKind = sharedKind(light.kind);
  c.lightCosCone = static_cast<float>(std::cos(glm::radians(light.coneDegrees) / 2));
  c.wsLightDirection = axisOf(light);
  c.wsLightPosition = light.kind == LightKind::directional ? dvec3(0) : light.position - origin;
  c.lsBoundsMin = space.bounds.min;
  c.lsBoundsMax = space.bounds.max;
  double farthest = 2 * nearZ;
  for (const dvec3& corner : corners(scene.bounds))
    farthest = std::max(farthest, glm::dot(forward, corner - view.eye));
  c.sceneDepth = static_cast<float>(farthest);
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
  if (light.kind != LightKind::point && !hasDirection(light.direction))
    return "light: direction must have a length in [1e-150, 1e150]";
  if (light.kind == LightKind::spot && !(light.coneDegrees > 0 && light.coneDegrees <= 170))
    return fmt::format("light: cone {} is outside (0, 170] degrees", light.coneDegrees);
  return std::nullopt;
}

}  // namespace sundial
