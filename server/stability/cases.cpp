#include "stability/cases.h"

#include <array>

namespace sundial {

std::span<const StabilityCase> stabilityCases() {
  static constexpr std::array kRows = {
      StabilityCase{.name = "sm-close-up",
                    .sentence = "One map of the whole scene, seen from near: its texels cover many pixels.",
                    .scene = "builtin:grid?n=40",
                    .view = "shadows",
                    .light = "sun",
                    .methods = "sm,texels=512 dv,texels=512",
                    .measure = "wrong_rate",
                    .failsAbove = 0.01},
      StabilityCase{
          .name = "sm-grazing",
          .sentence = "Light grazes the ground: a texel of a far-away map becomes a long streak on it.",
          .scene = "builtin:grid?n=40",
          .view = "shadows",
          .light = "low",
          .methods = "sm,texels=512 dv,texels=512",
          .measure = "wrong_rate",
          .failsAbove = 0.01},
      StabilityCase{.name = "dv-turn",
                    .sentence =
                        "The camera turns from a wall to open space within two frames: the map around "
                        "what it sees jumps in size, and edges pop.",
                    .scene = "builtin:atrium",
                    .path = "turn",
                    .light = "sun",
                    .methods = "dv,texels=512 sm,texels=512",
                    .measure = "pop",
                    .failsAbove = 0.005},
      StabilityCase{.name = "dv-pan",
                    .sentence = "A slow pan: the map around what the camera sees changes a little in every "
                                "frame, and edges shimmer.",
                    .scene = "builtin:atrium",
                    .path = "pan",
                    .light = "sun",
                    .methods = "dv,texels=1024 sm,texels=1024",
                    .measure = "flip_rate",
                    .failsAbove = 0.0005},
      StabilityCase{.name = "pssm-uniform",
                    .sentence =
                        "A mixture of cuts that suits a view from afar, used close up: the nearest partition "
                        "is a quarter of the scene's depth.",
                    .scene = "builtin:grid?n=40",
                    .view = "shadows",
                    .light = "sun",
                    .methods = "pssm,lambda=0,texels=512 sdsm-log,texels=512",
                    .measure = "wrong_rate",
                    .failsAbove = 0.003},
      StabilityCase{.name = "csm-nothing-near",
                    .sentence =
                        "Cascades cut by hand for a walk, seen from above: the near ones are empty, and the "
                        "last ends before what is seen.",
                    .scene = "builtin:trees",
                    .view = "above",
                    .light = "sun",
                    .methods = "csm,splits=4:12:120,texels=512 sdsm-log,texels=512",
                    .measure = "wrong_rate",
                    .failsAbove = 0.05},
      StabilityCase{.name = "sdsm-pan",
                    .sentence = "A slow pan: every frame's samples lie a little otherwise, so every frame's "
                                "partitions do, and edges shimmer.",
                    .scene = "builtin:atrium",
                    .path = "pan",
                    .light = "sun",
                    .methods = "sdsm-log,texels=512 sdsm-snapped,texels=512",
                    .measure = "flip_rate",
                    .failsAbove = 0.001},
      StabilityCase{.name = "sdsm-near-leaf",
                    .sentence = "A leaf comes near the camera: the range of depth begins with it, and all "
                                "partitions move.",
                    .scene = "builtin:city",
                    .path = "near-leaf",
                    .light = "sun",
                    .methods = "sdsm-log,texels=512 sdsm-snapped,texels=512",
                    .measure = "flip_rate",
                    .failsAbove = 0.001,
                    .frames = 12},
      StabilityCase{
          .name = "sdsm-kmeans-swap",
          .sentence = "Clusters of depth change places while the camera turns: a partition's texels grow or "
                      "shrink many times over from one frame to the next.",
          .scene = "builtin:city",
          .path = "near-leaf",
          .light = "sun",
          .methods = "sdsm-kmeans,texels=512 sdsm-log,texels=512",
          .measure = "texel_jump",
          .failsAbove = 1,
          .frames = 12},
      StabilityCase{.name = "iasm-cut",
                    .sentence =
                        "The camera cuts from a wall to open space; tiles planned from what the frame before "
                        "saw lie flagged as empty where shadows are now.",
                    .scene = "builtin:atrium",
                    .path = "turn",
                    .light = "sun",
                    .methods = "iasm-delayed iasm",
                    .measure = "pop",
                    .failsAbove = 0.02},
      StabilityCase{
          .name = "iasm-corner",
          .sentence = "The camera looks over the corner where four tiles meet, and only one of them can "
                      "have the largest size; with the square turned, it looks along the middle of tiles.",
          .scene = "builtin:grid?n=40",
          .view = "telephoto",
          .light = "sun",
          .methods =
              "iasm,extent=40,tile_sizes=512:32:32:32:32:32:32:32:32:32:32:32:32:32:32:32 "
              "iasm,extent=40,placement=column,tile_sizes=512:32:32:32:32:32:32:32:32:32:32:32:32:32:32:32",
          .measure = "wrong_rate",
          .failsAbove = 0.01},
      StabilityCase{.name = "iasm-scene-wide",
                    .sentence = "One mesh spans the scene: where meshes are culled whole, every tile draws "
                                "everything; its clusters are in few tiles each.",
                    .scene = "builtin:village",
                    .view = "main",
                    .light = "sun",
                    .methods = "iasm,cull=none iasm",
                    .measure = "drawn",
                    .failsAbove = 8},
      StabilityCase{.name = "evsm-overlap",
                    .sentence =
                        "Casters overlap with gaps of depth between them: what is farther is lit through "
                        "the nearer one's edges, unless small lights count as none.",
                    .scene = "builtin:grid?n=40",
                    .view = "shadows",
                    .light = "low",
                    .methods = "evsm,bleed_reduction=0 evsm,bleed_reduction=0.6",
                    .measure = "bleed",
                    .failsAbove = 0.02},
      StabilityCase{
          .name = "spsm-fusion",
          .sentence =
              "Gaps between occluders, like those between leaves, are narrower than a texel: every texel "
              "about them holds an occluder, and their shadows fuse. Smaller texels cure it.",
          .scene = "builtin:knot",
          .view = "shadow",
          .light = "sun",
          .methods = "spsm,texels=512 spsm,texels=2048",
          .measure = "wrong_rate",
          .failsAbove = 0.01},
      StabilityCase{
          .name = "spsm-holes",
          .sentence = "Where texels hold other triangles than the one that casts a shadow here, its edge has "
                      "holes; rebuilding the edge closes them.",
          .scene = "builtin:knot",
          .view = "shadow",
          .light = "sun",
          .methods = "spsm,texels=1024,recovery=off spsm,texels=1024",
          .measure = "wrong_rate",
          .failsAbove = 0.02},
      StabilityCase{
          .name = "rgsm-dense",
          .sentence =
              "A densely tessellated caster has more triangles than the map has texels: those that no "
              "texel holds cast no shadow, however many neighbours are asked.",
          .scene = "builtin:knot",
          .view = "shadow",
          .light = "sun",
          .methods = "rgsm,texels=1024,kernel=5 spsm,texels=1024",
          .measure = "wrong_rate",
          .failsAbove = 0.02},
      StabilityCase{.name = "far-from-origin",
                    .sentence =
                        "The scene lies 140 km from the origin, where single precision is 16 mm coarse: "
                        "errors are as small as near the origin.",
                    .scene = "builtin:grid?offset_km=100",
                    .path = "orbit",
                    .light = "sun",
                    .methods = "sm dv ray-traced",
                    .measure = "wrong_rate",
                    .atMost = 0.001,
                    .twinScene = "builtin:grid",
                    .frames = 8},
      StabilityCase{.name = "light-at-horizon",
                    .sentence = "The sun stands 1 degree above the horizon: shadows are 57 times as long as "
                                "what casts them is high.",
                    .scene = "builtin:grid?n=40",
                    .view = "main",
                    .light = "horizon",
                    .methods = "sm dv ray-traced",
                    .measure = "wrong_rate",
                    .atMost = 0.02},
      StabilityCase{.name = "no-receiver",
                    .sentence = "The camera looks at the sky: there is nothing that a map could be made for.",
                    .scene = "builtin:grid",
                    .view = "sky",
                    .light = "sun",
                    .methods = "sm dv ray-traced",
                    .measure = "wrong_rate",
                    .atMost = 0},
      StabilityCase{.name = "caster-behind-near",
                    .sentence =
                        "Only shadows are in view; what casts them lies before the near plane of a map "
                        "around what the camera sees, and must cast all the same.",
                    .scene = "builtin:grid",
                    .view = "shadows",
                    .light = "sun",
                    .methods = "dv sm ray-traced",
                    .measure = "wrong_rate",
                    .atMost = 0.01},
      StabilityCase{.name = "empty-scene",
                    .sentence = "A scene without a triangle.",
                    .scene = "builtin:grid?n=0&ground=0",
                    .path = "orbit",
                    .light = "sun",
                    .methods = "sm dv ray-traced",
                    .measure = "wrong_rate",
                    .atMost = 0,
                    .frames = 4},
  };
  return kRows;
}

}  // namespace sundial
