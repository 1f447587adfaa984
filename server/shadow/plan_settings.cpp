#include "shadow/plan_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shadow/moment_store.h"
#include "shadow/raster_choice.h"
#include "shadow/warp_maps.h"

namespace sundial {

namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

dvec3 forwardOf(const shared::FrameConstants& c) {
  return {c.clipFromWorld[0].w, c.clipFromWorld[1].w, c.clipFromWorld[2].w};
}

// Turned about the light so that the camera's axis lies along x; not at all where light and view are
// parallel.
void alignWithCamera(shared::FrameConstants& c) {
  const dvec2 along(dmat4(c.lightFromWorld) * dvec4(forwardOf(c), 0));
  if (glm::length(along) < 1e-4) return;
  turnLightSpace(c, glm::normalize(along));
}

// World coordinates of the origin along the axes of light space, modulo the snapping grids' period: in double
// precision here, so that nothing depends on how far away the world's zero is.
glm::vec2 originOnGrid(const shared::FrameConstants& c, const dvec3& origin) {
  if (c.lightKind != shared::kLightDirectional) return glm::vec2(0);
  const dvec2 at(dmat4(c.lightFromWorld) * dvec4(origin, 0));
  constexpr double kPeriod = shared::kSnapPeriod;
  return glm::vec2(at - kPeriod * glm::floor(at / kPeriod));
}

// How many texels beside its own a lookup looks at.
unsigned lookupReach(const Method& method) {
  switch (method.stages->lookup) {
    case Lookup::hard:
      return 0;
    case Lookup::pcf:
      return (method.settings.kernel + 1) / 2;
    case Lookup::exact3x3:
    case Lookup::evsm:
      return 1;
    case Lookup::rgsm:
    case Lookup::spsm:
      break;
  }
  return std::max(1u, method.settings.kernel / 2);
}

// How far the square reaches from the camera in the plane of light space, in shares of its side.
struct Reach {
  dvec2 before, behind;  // towards greater and towards smaller coordinates
};

Reach reachOf(const Method::Settings& settings, const dvec2& direction) {
  if (settings.placement == Placement::circle) return {0.5 * (1.0 + direction), 0.5 * (1.0 - direction)};
  // Light space is turned: the camera looks along x from the middle of a tile's edge.
  const double tiles = std::round(std::sqrt(static_cast<double>(settings.tileSizes.size())));
  const double aside = std::fmod(tiles, 2) == 0 ? 0.5 / tiles : 0;
  return {{1, 0.5 + aside}, {0, 0.5 - aside}};
}

// [Alecu 2014, section 3.3]: the camera stands on the circle inscribed in the square and looks in. At most
// twice as large as the scene.
void settleSquare(shared::FrameConstants& c, const Method::Settings& from) {
  const dvec2 low(c.lsBoundsMin), high(c.lsBoundsMax), size = high - low;
  const bool empty = low.x > high.x;
  dvec2 eye = 0.5 * (low + high);
  Reach reach{dvec2(0.5), dvec2(0.5)};
  // Before a spot there is no plane to stand on: the square is about the middle of its cone.
  if (c.lightKind == shared::kLightDirectional) {
    const dmat4 light(c.lightFromWorld);
    const dvec2 along(light * dvec4(forwardOf(c), 0));
    eye = dvec2(light * dvec4(c.wsEye, 1));
    reach = reachOf(from, glm::length(along) < 1e-4 ? dvec2(0) : glm::normalize(along));
  }
  c.settings.lsSquareEye = empty ? dvec2(0) : eye;
  c.settings.squareBefore = reach.before;
  c.settings.squareBehind = reach.behind;
  c.settings.lsSquareSide = static_cast<float>(from.extent.value_or(0));
  c.settings.lsSquareSideAtMost = static_cast<float>(empty ? 1 : 2 * std::max(glm::length(size), 1e-3));
  c.settings.importanceRange = static_cast<float>(from.importanceRange.value_or(0));
}

}  // namespace

glm::mat4 turnedAbout(const glm::mat4& lightFromWorld, const dvec2& axis) {
  const dvec2 &x = axis, y(-x.y, x.x);
  const dmat4 light(lightFromWorld);
  glm::mat4 turned = lightFromWorld;
  for (int column = 0; column < 4; ++column) {
    turned[column].x = static_cast<float>(glm::dot(x, dvec2(light[column])));
    turned[column].y = static_cast<float>(glm::dot(y, dvec2(light[column])));
  }
  return turned;
}

void turnLightSpace(shared::FrameConstants& c, const dvec2& axis) {
  const dvec2 &x = axis, y(-x.y, x.x);
  c.lightFromWorld = turnedAbout(c.lightFromWorld, axis);
  // The box around the turned box.
  if (c.lsBoundsMin.x > c.lsBoundsMax.x) return;
  const dvec2 centre = 0.5 * (dvec2(c.lsBoundsMin) + dvec2(c.lsBoundsMax));
  const dvec2 half = 0.5 * (dvec2(c.lsBoundsMax) - dvec2(c.lsBoundsMin));
  const dvec2 turned(glm::dot(x, centre), glm::dot(y, centre));
  const dvec2 reach(glm::dot(glm::abs(x), half), glm::dot(glm::abs(y), half));
  c.lsBoundsMin = {turned - reach, c.lsBoundsMin.z};
  c.lsBoundsMax = {turned + reach, c.lsBoundsMax.z};
}

std::uint32_t shadowViewsOf(const Method& method) {
  if (!method.stages) return 0;
  if (method.stages->partition == Partition::tiles)
    return static_cast<std::uint32_t>(method.settings.tileSizes.size());
  if (method.stages->partition == Partition::cube) return shared::kCubeFaces;
  return method.settings.partitions;
}

bool asksNearness(const Method& method) {
  return method.stages->warp == Warp::rectilinear && method.settings.weights[shared::kNearness] > 0;
}

std::vector<glm::uvec2> mapSizesOf(const Method& method) {
  const Method::Settings& settings = method.settings;
  std::vector<glm::uvec2> sizes(shadowViewsOf(method), {settings.width, settings.height});
  if (method.stages && method.stages->partition == Partition::tiles)
    for (std::size_t view = 0; view < sizes.size(); ++view)
      sizes[view] = glm::uvec2(settings.tileSizes[view]);
  return sizes;
}

std::uint64_t texelsOf(const std::vector<glm::uvec2>& mapSizes) {
  std::uint64_t texels = 0;
  for (const glm::uvec2& size : mapSizes) texels += std::uint64_t{size.x} * size.y;
  return texels;
}

std::uint32_t mapColumnsOf(const Method& method) {
  return static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(shadowViewsOf(method)))));
}

void settle(shared::FrameConstants& c, const Method& method, const dvec3& origin) {
  const Method::Settings& from = method.settings;
  shared::PlanSettings& to = c.settings;
  to.mapSize = {from.width, from.height};
  to.drawsAll = from.cull ? 0 : 1;
  to.partitions = from.partitions;
  to.mapColumns = mapColumnsOf(method);
  c.storeSize = to.mapSize;
  if (!method.stages) return;
  const Stages& stages = *method.stages;

  const bool column = stages.partition == Partition::tiles && from.placement == Placement::column;
  if (stages.focus == Focus::aligned || column) alignWithCamera(c);
  to.lsOriginOnGrid = originOnGrid(c, origin);
  to.depthFar = c.sceneDepth;
  to.depthNear = c.nearDistance;
  if (stages.volume == Volume::frustum)
    to.depthNear = static_cast<float>(std::min(
        from.near.value_or(std::max(1e-3 * c.sceneDepth, double{c.nearDistance})), 0.999 * c.sceneDepth));
  to.lambda = static_cast<float>(from.lambda);
  to.blend = static_cast<float>(from.blend);
  for (std::uint32_t i = 0; i < from.partitions && i < shared::kMaxPartitions; ++i)
    to.splits[i] = from.splits.empty()
                       ? static_cast<float>(c.sceneDepth * std::pow((i + 1.0) / from.partitions, 3))
                       : static_cast<float>(from.splits[i]);

  if (stages.partition == Partition::cube) to.rimTexels = static_cast<float>(lookupReach(method));
  to.lsFar = std::numeric_limits<float>::max();
  if (stages.storage == Storage::moments) settleMoments(c, method);

  const std::uint32_t views = shadowViewsOf(method);
  if (isLinear(method))
    c.storeSize = {texelsOf(mapSizesOf(method)), 1};
  else
    c.storeSize = to.mapSize * glm::uvec2(to.mapColumns, (views + to.mapColumns - 1) / to.mapColumns);
  if (stages.partition == Partition::tiles) to.mapSize = glm::uvec2(std::ranges::max(from.tileSizes));
  const double side = std::max(from.width, from.height);
  to.warpWindow =
      static_cast<std::uint32_t>(from.window.value_or(side / (stages.warp == Warp::rectilinear ? 32 : 5)));
  to.warpEntries = static_cast<std::uint32_t>(warpSizesOf(stages.warp, to.mapSize).functions);
  to.warpEvenShare = static_cast<float>(from.even);
  to.warpPower = static_cast<float>(from.power);
  if (stages.warp == Warp::rectilinear) std::ranges::copy(from.weights, to.warpWeights);
  to.smallerShare = static_cast<float>(from.percentile / 100);
  to.finestTexel = static_cast<float>(from.finest);
  to.viewport = c.storeSize;
  if (stages.partition != Partition::tiles) return;
  to.tilesPerSide = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(views))));
  std::ranges::copy(from.tileSizes, to.tileTexels);
  settleSquare(c, from);
  to.importanceGain = static_cast<float>(from.importanceGain);
  // As fine as sums of all pixels allow in 32 bits; coarser than a unit where there are very many.
  const double pixels = double(c.imageSize.x) * c.imageSize.y;
  to.importanceUnit = static_cast<float>(std::min(4e9 / (pixels * (1 + from.importanceGain)), 256.0));
}

}  // namespace sundial
