#include "shadow/cube_faces.h"

#include <algorithm>

#include "shadow/box_clip.h"

namespace sundial {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

namespace {

// How wide a map is at most, of a face that is 1 wide: plan_cube.comp's border, which is half of the map at
// most.
double reachOf(const shared::FrameConstants& c, const Method& method) {
  if (method.stages->resolution != Resolution::fixed) return 2;
  const double side = std::min(c.settings.mapSize.x, c.settings.mapSize.y);
  const double border = std::min(1.0 + double{c.settings.rimTexels}, side / 4);
  return side / (side - 2 * border);
}

}  // namespace

void fitFaces(shared::FrameConstants& c, const Method& method, std::span<const WorldBox> boxes) {
  for (std::uint32_t face = 0; face < shared::kCubeFaces; ++face) {
    const dmat4 faceFromWorld(shared::faceFromWorld(face, {1, 0}, c.lightFromWorld));
    const Planes wide = pyramidOf(faceFromWorld, reachOf(c, method), c.nearDistance);
    dvec3 low(1e300), high(-1e300);
    for (const WorldBox& box : boxes)
      eachCornerWithin(box, wide, [&](const dvec3& corner) {
        const dvec4 light = faceFromWorld * dvec4(corner, 1);
        low = glm::min(low, dvec3(light) / light.w);
        high = glm::max(high, dvec3(light) / light.w);
      });
    const glm::dvec2 left = glm::max(glm::dvec2(low), -1.0), right = glm::min(glm::dvec2(high), 1.0);
    const bool empty = left.x > right.x || left.y > right.y;
    c.faceTurn[face] = {1, 0};
    c.lsFaceMin[face] = empty ? glm::vec3(1) : glm::vec3(left, low.z);
    c.lsFaceMax[face] = empty ? glm::vec3(-1) : glm::vec3(right, high.z);
  }
}

}  // namespace sundial
