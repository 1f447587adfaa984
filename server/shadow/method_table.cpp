// The rows. Adding a method is adding one here.
#include <vector>

#include "shadow/method.h"

namespace sundial {

namespace {

// 6,842,368 bytes, about as many as the paper's sixteen. Smaller tiles follow more closely where samples lie.
constexpr std::string_view kSixtyFourTiles =
    "512:512:320:320:320:320:256:256:256:256:256:256:"
    "128:128:128:128:128:128:128:128:128:128:128:128:128:128:128:128:128:"
    "64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:64:"
    "16:16:16:16:16:16:16:16:16:16";

}  // namespace

std::span<const MethodRow> methodTable() {
  static const std::vector<MethodRow> rows = {
      MethodRow{"sm", "Shadow map of the whole scene", Technique::shadowMap,
                Stages{Volume::scene, Partition::single, Warp::none, Focus::loose, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Williams 1978]; the baseline of every ratio"},
      MethodRow{"dv", "Desired view: a map around what the camera sees", Technique::shadowMap,
                Stages{Volume::samples, Partition::single, Warp::none, Focus::aabb, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[NOTW] section 3.2, [Rosen 2012]"},
      MethodRow{"id", "Shadow map of depths and triangles, asked in full precision", Technique::shadowMap,
                Stages{Volume::scene, Partition::single, Warp::none, Focus::loose, Resolution::fixed,
                       Storage::depthId, Lookup::exact3x3},
                "between [Williams 1978] and [Lecocq 2014]; no silhouette is recovered"},
      MethodRow{"ferko",
                "Resolution estimation: as many texels as the pixels ask for",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::single, Warp::none, Focus::aabb, Resolution::estimated,
                       Storage::depth, Lookup::hard},
                "[Ferko 2013] section 3",
                {{"texels", "4096"}}},
      MethodRow{"csm",
                "Cascades: the camera's depth cut by hand",
                Technique::shadowMap,
                Stages{Volume::frustum, Partition::manual, Warp::none, Focus::loose, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Engel 2006], as [Alecu 2014] section 4.2 compares them",
                {{"texels", "1024"}}},
      MethodRow{"pssm",
                "Parallel splits: uniform and logarithmic cuts, mixed",
                Technique::shadowMap,
                Stages{Volume::frustum, Partition::practical, Warp::none, Focus::loose, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Zhang et al. 2006]",
                {{"texels", "1024"}}},
      MethodRow{"sdsm-log",
                "Sample distribution: logarithmic cuts between the samples' nearest and farthest",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::log, Warp::none, Focus::aligned, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Lauritzen et al. 2011] sections 3.1 and 3.3",
                {{"texels", "1024"}}},
      MethodRow{"sdsm-log-id",
                "Sample distribution of depths and triangles, asked in full precision",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::log, Warp::none, Focus::aligned, Resolution::fixed,
                       Storage::depthId, Lookup::exact3x3},
                "[Lauritzen et al. 2011] section 3.1, with the lookup of id",
                {{"texels", "1024"}}},
      MethodRow{"sdsm-adaptive",
                "Sample distribution: logarithmic cuts that skip the histogram's gaps",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::adaptive, Warp::none, Focus::aligned, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Lauritzen et al. 2011] section 3.2",
                {{"texels", "1024"}}},
      MethodRow{"sdsm-kmeans",
                "Sample distribution: a partition a cluster of depths",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::kmeans, Warp::none, Focus::aligned, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Lauritzen et al. 2011] section 3.2",
                {{"texels", "1024"}}},
      MethodRow{"sdsm-snapped",
                "Sample distribution on a grid of the world: steady while the camera moves",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::log, Warp::none, Focus::snapped, Resolution::fixed,
                       Storage::depth, Lookup::hard},
                "[Lauritzen et al. 2011] section 5.3",
                {{"texels", "1024"}, {"choose", "depth"}}},
      MethodRow{"evsm", "Exponential variance shadow map of the whole scene", Technique::shadowMap,
                Stages{Volume::scene, Partition::single, Warp::none, Focus::loose, Resolution::fixed,
                       Storage::moments, Lookup::evsm},
                "[Lauritzen and McCool 2008]"},
      MethodRow{"sdsm-evsm",
                "Sample distribution, filtered: logarithmic cuts of exponential variance maps",
                Technique::shadowMap,
                Stages{Volume::samples, Partition::log, Warp::none, Focus::aligned, Resolution::fixed,
                       Storage::moments, Lookup::evsm},
                "[Lauritzen et al. 2011] section 4",
                {{"texels", "1024"}}},
      MethodRow{"iasm-forward", "Irregular adaptive tiles, near and far from the casters' bounds",
                Technique::shadowMap,
                Stages{Volume::inscribed, Partition::tiles, Warp::none, Focus::loose, Resolution::ranked,
                       Storage::linear, Lookup::hard},
                "[Alecu 2014] section 3, the forward renderer"},
      MethodRow{"iasm", "Irregular adaptive tiles, near and far from the view samples", Technique::shadowMap,
                Stages{Volume::inscribed, Partition::tiles, Warp::none, Focus::depth, Resolution::ranked,
                       Storage::linear, Lookup::hard},
                "[Alecu 2014] section 3, the deferred renderer"},
      MethodRow{"iasm-fitted",
                "Irregular adaptive tiles, more of them, each as large as its view samples",
                Technique::shadowMap,
                Stages{Volume::inscribed, Partition::tiles, Warp::none, Focus::aabb, Resolution::ranked,
                       Storage::linear, Lookup::hard},
                "[Alecu 2014] section 5, what its discussion asks for",
                {{"tile_sizes", kSixtyFourTiles}}},
      MethodRow{"iasm-delayed",
                "Irregular adaptive tiles, ranked by what the frame before saw",
                Technique::shadowMap,
                Stages{Volume::inscribed, Partition::tiles, Warp::none, Focus::depth, Resolution::ranked,
                       Storage::linear, Lookup::hard},
                "[Alecu 2014] section 4.3",
                {{"plan", "delayed"}}},
      MethodRow{
          "shadow-volumes", "Shadow volumes, counted behind each pixel's sample: exact, without a map",
          Technique::shadowVolumes, std::nullopt,
          "[Everitt and Kilgard 2002], [Aldridge and Woods 2004]; what the papers hold themselves against"},
      MethodRow{"ray-traced", "A shadow ray a pixel: the reference, timed like a method",
                Technique::rayTraced, std::nullopt, "[Whitted 1980], by Embree"},
  };
  return rows;
}

}  // namespace sundial
