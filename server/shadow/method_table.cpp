// The rows. Adding a method is adding one here.
#include <array>

#include "shadow/method.h"

namespace sundial {

std::span<const MethodRow> methodTable() {
  static const std::array rows = {
      MethodRow{"sm", "Shadow map of the whole scene", Technique::shadowMap,
                Stages{Volume::scene, Partition::single, Warp::none, Focus::loose, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Williams 1978]; the baseline of every ratio"},
      MethodRow{"dv", "Desired view: a map around what the camera sees", Technique::shadowMap,
                Stages{Volume::samples, Partition::single, Warp::none, Focus::aabb, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[NOTW] section 3.2, [Rosen 2012]"},
      MethodRow{"ray-traced", "A shadow ray a pixel: the reference, timed like a method",
                Technique::rayTraced, std::nullopt, "[Whitted 1980], by Embree"},
  };
  return rows;
}

}  // namespace sundial
