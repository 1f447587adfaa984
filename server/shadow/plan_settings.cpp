#include "shadow/plan_settings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sundial {

namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

dvec3 forwardOf(const shared::FrameConstants& c) {
  return {c.clipFromWorld[0].w, c.clipFromWorld[1].w, c.clipFromWorld[2].w};
}

// Turned about the light so that the camera's axis lies along x; not at all where light and view are parallel.
void alignWithCamera(shared::FrameConstants& c) {
  const dvec2 along(dmat4(c.lightFromWorld) * dvec4(forwardOf(c), 0));
  if (glm::length(along) < 1e-4) return;
  const dvec2 x = glm::normalize(along), y(-x.y, x.x);
  const dmat4 light(c.lightFromWorld);
  for (int column = 0; column < 4; ++column) {
    c.lightFromWorld[column].x = static_cast<float>(glm::dot(x, dvec2(light[column])));
    c.lightFromWorld[column].y = static_cast<float>(glm::dot(y, dvec2(light[column])));
  }
  // The box around the turned box.
  if (c.lsBoundsMin.x > c.lsBoundsMax.x) return;
  const dvec2 centre = 0.5 * (dvec2(c.lsBoundsMin) + dvec2(c.lsBoundsMax));
  const dvec2 half = 0.5 * (dvec2(c.lsBoundsMax) - dvec2(c.lsBoundsMin));
  const dvec2 turned(glm::dot(x, centre), glm::dot(y, centre));
  const dvec2 reach(glm::dot(glm::abs(x), half), glm::dot(glm::abs(y), half));
  c.lsBoundsMin = {turned - reach, c.lsBoundsMin.z};
  c.lsBoundsMax = {turned + reach, c.lsBoundsMax.z};
}

// World coordinates of the origin along the axes of light space, modulo the snapping grids' period: in double
// precision here, so that nothing depends on how far away the world's zero is.
glm::vec2 originOnGrid(const shared::FrameConstants& c, const dvec3& origin) {
  if (c.lightKind != shared::kLightDirectional) return glm::vec2(0);
  const dvec2 at(dmat4(c.lightFromWorld) * dvec4(origin, 0));
  constexpr double kPeriod = shared::kSnapPeriod;
  return glm::vec2(at - kPeriod * glm::floor(at / kPeriod));
}

// [Alecu 2014, section 3.3]: the camera stands on the circle inscribed in the square and looks in.
struct Square {
  dvec2 low{0};
  double side = 1;
};

// The smallest square that holds what the camera could see of the scene: the corners of its frustum at the scene's
// farthest depth, as far as the scene reaches; never more than twice the scene.
Square squareOf(const shared::FrameConstants& c, std::optional<double> extent) {
  const dvec2 low(c.lsBoundsMin), high(c.lsBoundsMax);
  if (low.x > high.x) return {};
  const dvec2 size = high - low;
  const double most = 2 * std::max(glm::length(size), 1e-3);
  const dmat4 light(c.lightFromWorld);
  const dvec4 eye = light * dvec4(c.wsEye, 1);
  // In front of a spot there is no plane to stand on: its whole cone is cut.
  if (c.lightKind != shared::kLightDirectional || eye.w <= 0) {
    const double side = extent.value_or(std::max(size.x, size.y));
    return {0.5 * (low + high) - 0.5 * side, side};
  }
  const dvec2 along(light * dvec4(forwardOf(c), 0));
  const dvec2 direction = glm::length(along) < 1e-4 ? dvec2(0) : glm::normalize(along);
  double side = 1e-3;
  if (extent) {
    side = *extent;
  } else {
    for (int corner = 0; corner < 4; ++corner) {
      const dvec3 ray = dvec3(c.wsRayTopLeft) +
                        double(corner & 1) * double(c.imageSize.x) * dvec3(c.wsRayPerPixelX) +
                        double(corner >> 1) * double(c.imageSize.y) * dvec3(c.wsRayPerPixelY);
      const dvec2 seen(light * dvec4(dvec3(c.wsEye) + double{c.sceneDepth} * ray, 1));
      const dvec2 offset = glm::clamp(seen, low, high) - dvec2(eye);
      for (int axis = 0; axis < 2; ++axis) {
        const double room = 1 + std::copysign(direction[axis], direction[axis] * offset[axis]);
        side = std::max(side, 2 * std::abs(offset[axis]) / std::max(room, 1e-6));
      }
    }
    side = std::min(side, most);
  }
  return {dvec2(eye) + 0.5 * side * direction - 0.5 * side, side};
}

}  // namespace

std::uint32_t shadowViewsOf(const Method& method) {
  if (!method.stages) return 0;
  if (method.stages->partition == Partition::tiles)
    return static_cast<std::uint32_t>(method.settings.tileSizes.size());
  return method.settings.partitions;
}

std::uint32_t mapColumnsOf(const Method& method) {
  return static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(shadowViewsOf(method)))));
}

void settle(shared::FrameConstants& c, const Method& method, const dvec3& origin) {
  const Method::Settings& from = method.settings;
  shared::PlanSettings& to = c.settings;
  to.mapSize = {from.width, from.height};
  to.partitions = from.partitions;
  to.mapColumns = mapColumnsOf(method);
  c.storeSize = to.mapSize;
  if (!method.stages) return;
  const Stages& stages = *method.stages;

  if (stages.focus == Focus::aligned) alignWithCamera(c);
  to.lsOriginOnGrid = originOnGrid(c, origin);
  to.depthFar = c.sceneDepth;
  to.depthNear = c.nearDistance;
  if (stages.volume == Volume::frustum)
    to.depthNear = static_cast<float>(
        std::min(from.near.value_or(std::max(1e-3 * c.sceneDepth, double{c.nearDistance})), 0.999 * c.sceneDepth));
  to.lambda = static_cast<float>(from.lambda);
  to.blend = static_cast<float>(from.blend);
  for (std::uint32_t i = 0; i < from.partitions && i < shared::kMaxPartitions; ++i)
    to.splits[i] = from.splits.empty()
                       ? static_cast<float>(c.sceneDepth * std::pow((i + 1.0) / from.partitions, 3))
                       : static_cast<float>(from.splits[i]);

  const std::uint32_t views = shadowViewsOf(method);
  if (stages.storage == Storage::linear)
    c.storeSize = {from.width * from.height * views, 1};
  else
    c.storeSize = to.mapSize * glm::uvec2(to.mapColumns, (views + to.mapColumns - 1) / to.mapColumns);
  if (stages.partition != Partition::tiles) return;
  to.tilesPerSide = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(views))));
  std::ranges::copy(from.tileSizes, to.tileTexels);
  std::uint32_t texels = 0;
  for (const unsigned side : from.tileSizes) texels += side * side;
  c.storeSize = {texels, 1};
  const Square square = squareOf(c, from.extent);
  to.lsSquareMin = square.low;
  to.lsSquareSide = static_cast<float>(square.side);
  to.importanceGain = static_cast<float>(from.importanceGain);
  to.importanceRange = static_cast<float>(from.importanceRange.value_or(0.25 * square.side));
  // As fine as sums of all pixels allow in 32 bits.
  const double pixels = double(c.imageSize.x) * c.imageSize.y;
  to.importanceUnit = static_cast<float>(std::clamp(std::floor(4e9 / (pixels * (1 + from.importanceGain)) - 1), 1.0, 256.0));
}

}  // namespace sundial
