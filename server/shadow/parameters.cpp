#include "shadow/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "shadow/parameter_values.h"
#include "shared/plan.h"

namespace sundial {

namespace {

using Kind = Parameter::Kind;

constexpr std::string_view kFaceTexels = "1024";

// A parameter, the stages that read it, and what a value that isn't wrong sets.
struct Rule {
  Parameter parameter;
  bool (*readBy)(const Stages&);
  void (*take)(const std::string& text, Method::Settings&);
};

const std::vector<Rule>& rules() {
  constexpr auto always = [](const Stages&) { return true; };
  constexpr auto cuts = [](const Stages& s) { return cutsDepth(s.partition); };
  constexpr auto biased = [](const Stages& s) { return s.lookup != Lookup::evsm; };
  constexpr auto spsm = [](const Stages& s) { return s.lookup == Lookup::spsm; };
  constexpr auto moments = [](const Stages& s) { return s.storage == Storage::moments; };
  constexpr auto tiles = [](const Stages& s) { return s.partition == Partition::tiles; };
  static const std::vector<Rule> all = {
      {{.name = "texels",
        .kind = Kind::size,
        .unit = "texels",
        .min = 16,
        .max = 16384,
        .defaultValue = "2048",
        .description =
            "size of every map: a side, or WIDTHxHEIGHT; of partition=cube 1024 unless it is given; "
            "resolution=estimated: the most that it may be"},
       [](const Stages& s) { return s.partition != Partition::tiles; },
       [](const std::string& text, Method::Settings& s) {
         const auto [width, height] = sizeIn(text);
         s.width = width;
         s.height = height;
       }},
      {{.name = "percentile",
        .kind = Kind::number,
        .unit = "%",
        .min = 0,
        .max = 50,
        .defaultValue = "0",
        .description =
            "share of the pixels that may be smaller than a texel; 0: none, as the paper has it, so that one "
            "pixel of a grazing surface decides; with resolution=estimated"},
       [](const Stages& s) { return s.resolution == Resolution::estimated; },
       [](const std::string& text, Method::Settings& s) { s.percentile = numberIn(text); }},
      {{.name = "finest",
        .kind = Kind::number,
        .unit = "1",
        .min = 0,
        .max = 1,
        .defaultValue = "0",
        .description =
            "the smallest texel, over one of a map of the whole scene with as many texels; 1: nothing is "
            "finer "
            "than there, so that what a fitted map leaves out is saved; 0: as fine as the pixels ask; with "
            "resolution=estimated"},
       [](const Stages& s) {
         return s.resolution == Resolution::estimated && s.partition != Partition::tiles;
       },
       [](const std::string& text, Method::Settings& s) { s.finest = numberIn(text); }},
      {{.name = "window",
        .kind = Kind::number,
        .unit = "texels",
        .min = 1,
        .max = 32768,
        .defaultValue = kAuto,
        .description = "warp=rectilinear: over how many columns and rows importance is smoothed; auto: a "
                       "thirty-second of the map's side; non-orthogonal: how many neighbouring rows and "
                       "columns are counted together, the farther away the less; auto: a fifth",
        .choices = {kAuto}},
       [](const Stages& s) { return s.warp != Warp::none; },
       [](const std::string& text, Method::Settings& s) { s.window = unlessAuto(text); }},
      {{.name = "even",
        .kind = Kind::number,
        .unit = "1",
        .min = 0.01,
        .max = 1,
        .defaultValue = "0.1",
        .description = "share of a warp's texels that is spread evenly, whatever is important"},
       [](const Stages& s) { return s.warp != Warp::none; },
       [](const std::string& text, Method::Settings& s) { s.even = numberIn(text); }},
      {{.name = "power",
        .kind = Kind::number,
        .unit = "1",
        .min = 0.1,
        .max = 2,
        .defaultValue = "0.5",
        .description = "of importance, that the other texels of a warp follow; 1: in proportion to it, which "
                       "spreads samples evenly, as the papers have it; 0.5 or 0.6: fewest wrong pixels"},
       [](const Stages& s) { return s.warp != Warp::none; },
       [](const std::string& text, Method::Settings& s) { s.power = numberIn(text); }},
      {{.name = "analysis",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = "backward",
        .description =
            "where importance is looked for: backward: in what the camera sees; forward: in a map of what "
            "the light sees, drawn before; hybrid: in what the camera sees, which asks that map for shadows' "
            "edges; with warp=rectilinear",
        .choices = {"backward", "forward", "hybrid"}},
       [](const Stages& s) { return s.warp == Warp::rectilinear; },
       [](const std::string& text, Method::Settings& s) {
         s.analysis = text == "forward"  ? Analysis::forward
                      : text == "hybrid" ? Analysis::hybrid
                                         : Analysis::backward;
       }},
      {{.name = "weights",
        .kind = Kind::list,
        .unit = "1",
        .min = 0,
        .max = 1000,
        .defaultValue = "0:0:0:1:1",
        .description =
            "of what makes a place important: how near it is to the eye; how much it faces it; edges in the "
            "camera's depth; shadows' edges, which analysis=backward doesn't know; and how many texels its "
            "pixel asks for; with warp=rectilinear"},
       [](const Stages& s) { return s.warp == Warp::rectilinear; },
       [](const std::string& text, Method::Settings& s) { s.weights = listIn(text); }},
      {{.name = "bias_texels",
        .kind = Kind::number,
        .unit = "texels",
        .min = 0,
        .max = 100,
        .defaultValue = "2",
        .description = "how far a receiver moves towards the light, in texels of its map; half of it where "
                       "it looks into "
                       "the light"},
       biased,
       [](const std::string& text, Method::Settings& s) { s.biasTexels = numberIn(text); }},
      {{.name = "bias_world",
        .kind = Kind::number,
        .unit = "m",
        .min = 0,
        .max = 1e6,
        .defaultValue = kAuto,
        .description = "the same in metres, added; auto: 2e-5 of the scene's diagonal, as near as the "
                       "reference looks",
        .choices = {kAuto}},
       biased,
       [](const std::string& text, Method::Settings& s) { s.biasWorld = unlessAuto(text); }},
      {{.name = "plan",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = "gpu",
        .description =
            "gpu: planned, culled and drawn without the host; readback: the host waits for the plan and "
            "culls; delayed: planned from what the frame before saw",
        .choices = {"gpu", "readback", "delayed"}},
       always,
       [](const std::string& text, Method::Settings& s) {
         s.plan = text == "readback"  ? PlanTiming::readback
                  : text == "delayed" ? PlanTiming::delayed
                                      : PlanTiming::gpu;
       }},
      {{.name = "raster",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = kAuto,
        .description =
            "who draws the maps: the graphics pipeline, or the compute rasteriser; auto: the faster one, "
            "by a fixed rule",
        .choices = {"pipeline", "compute", kAuto}},
       [](const Stages& s) { return s.storage != Storage::moments; },
       [](const std::string& text, Method::Settings& s) {
         s.raster = text == "pipeline"  ? Raster::pipeline
                    : text == "compute" ? Raster::compute
                                        : Raster::automatic;
       }},
      {{.name = "cull",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = "clusters",
        .description =
            "clusters: each map draws those that reach it; none: each draws everything, as where one mesh "
            "spans the scene and meshes are culled whole",
        .choices = {"clusters", "none"}},
       always,
       [](const std::string& text, Method::Settings& s) { s.cull = text == "clusters"; }},
      {{.name = "partitions",
        .kind = Kind::integer,
        .unit = "1",
        .min = 1,
        .max = shared::kMaxPartitions,
        .defaultValue = "4",
        .description = "maps along the camera's depth; with a partition along it that isn't manual"},
       [](const Stages& s) { return cutsDepth(s.partition) && s.partition != Partition::manual; },
       [](const std::string& text, Method::Settings& s) { s.partitions = countIn(text); }},
      {{.name = "splits",
        .kind = Kind::list,
        .unit = "m",
        .min = 0.001,
        .max = 1e9,
        .defaultValue = kAuto,
        .description =
            "where each partition ends, 4:12:40; auto: three, at (i/3)^3 of the scene's farthest depth; "
            "with partition=manual",
        .choices = {kAuto}},
       [](const Stages& s) { return s.partition == Partition::manual; },
       [](const std::string& text, Method::Settings& s) {
         if (text != kAuto) s.splits = listIn(text);
         s.partitions = s.splits.empty() ? 3 : static_cast<unsigned>(s.splits.size());
       }},
      {{.name = "lambda",
        .kind = Kind::number,
        .unit = "1",
        .min = 0,
        .max = 1,
        .defaultValue = "0.5",
        .description = "1: logarithmic, 0: uniform; with partition=practical"},
       [](const Stages& s) { return s.partition == Partition::practical; },
       [](const std::string& text, Method::Settings& s) { s.lambda = numberIn(text); }},
      {{.name = "near",
        .kind = Kind::number,
        .unit = "m",
        .min = 1e-4,
        .max = 1e9,
        .defaultValue = kAuto,
        .description =
            "depth that the formulas of splits begin with; auto: a thousandth of the scene's farthest; "
            "with volume=frustum",
        .choices = {kAuto}},
       [](const Stages& s) { return s.volume == Volume::frustum && s.partition != Partition::manual; },
       [](const std::string& text, Method::Settings& s) { s.near = unlessAuto(text); }},
      {{.name = "choose",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = "tightest",
        .description =
            "which partition answers: the one of the sample's depth, or the tightest that contains it",
        .choices = {"depth", "tightest"}},
       cuts,
       [](const std::string& text, Method::Settings& s) {
         s.choose = text == "depth" ? Choose::depth : Choose::tightest;
       }},
      {{.name = "blend",
        .kind = Kind::number,
        .unit = "1",
        .min = 0,
        .max = 0.5,
        .defaultValue = "0",
        .description = "share of a partition's depth in which it fades into the next; with choose=depth"},
       cuts,
       [](const std::string& text, Method::Settings& s) { s.blend = numberIn(text); }},
      {{.name = "tile_sizes",
        .kind = Kind::list,
        .unit = "texels",
        .min = 8,
        .max = 4096,
        .defaultValue = "1024:512:512:256:128:128:128:128:64:64:32:32:16:16:16:16",
        .description =
            "a side of each tile, n x n of them; resolution=ranked: falling, the most important tile gets "
            "the first; listed: tile by tile, a row of light space after another; estimated: what tiles may "
            "have together, and the largest at most each"},
       tiles,
       [](const std::string& text, Method::Settings& s) {
         const std::vector<double> sides = listIn(text);
         s.tileSizes.assign(sides.begin(), sides.end());
       }},
      {{.name = "extent",
        .kind = Kind::number,
        .unit = "m",
        .min = 0.01,
        .max = 1e9,
        .defaultValue = kAuto,
        .description = "side of the square that the tiles cut; auto: what the camera sees of the scene",
        .choices = {kAuto}},
       tiles,
       [](const std::string& text, Method::Settings& s) { s.extent = unlessAuto(text); }},
      {{.name = "placement",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = "circle",
        .description =
            "circle: the camera stands on the circle inscribed in the square; column: the square is turned "
            "so that the camera looks along the middle of tiles, never at a corner of four",
        .choices = {"circle", "column"}},
       tiles,
       [](const std::string& text, Method::Settings& s) {
         s.placement = text == "column" ? Placement::column : Placement::circle;
       }},
      {{.name = "importance_gain",
        .kind = Kind::number,
        .unit = "1",
        .min = 0,
        .max = 1000,
        .defaultValue = "32",
        .description = "how much more a sample counts at the camera than far away: m"},
       tiles,
       [](const std::string& text, Method::Settings& s) { s.importanceGain = numberIn(text); }},
      {{.name = "importance_range",
        .kind = Kind::number,
        .unit = "m",
        .min = 0.01,
        .max = 1e9,
        .defaultValue = kAuto,
        .description = "depth at which that ends: k; auto: a quarter of the square's side",
        .choices = {kAuto}},
       tiles,
       [](const std::string& text, Method::Settings& s) { s.importanceRange = unlessAuto(text); }},
      {{.name = "kernel",
        .kind = Kind::integer,
        .unit = "texels",
        .min = 1,
        .max = 15,
        .defaultValue = "3",
        .description =
            "side of the filter's box; with lookup=pcf; of the square of texels whose triangles are "
            "tried, an odd number; with lookup=rgsm and lookup=spsm"},
       [](const Stages& s) { return s.lookup == Lookup::pcf || asksTriangles(s.lookup); },
       [](const std::string& text, Method::Settings& s) { s.kernel = countIn(text); }},
      {{.name = "recovery",
        .kind = Kind::choice,
        .unit = "",
        .defaultValue = "walk",
        .description =
            "of samples that no stored triangle decides; walk: the mesh is followed from those triangles to "
            "the sample; edges: the shadow's edge is rebuilt from their outlines, as the paper has it; off: "
            "they are lit; with lookup=spsm",
        .choices = {"walk", "edges", "off"}},
       spsm,
       [](const std::string& text, Method::Settings& s) {
         s.recovery = text == "walk" ? Recovery::walk : text == "edges" ? Recovery::edges : Recovery::off;
       }},
      {{.name = "positions",
        .kind = Kind::choice,
        .unit = "1",
        .defaultValue = "1",
        .description =
            "how many places of a pixel the rebuilt edge is asked for: 1 is the sample itself; with "
            "lookup=spsm and recovery=edges",
        .choices = {"1", "2", "4", "8"}},
       spsm,
       [](const std::string& text, Method::Settings& s) { s.positions = countIn(text); }},
      {{.name = "exponents",
        .kind = Kind::list,
        .unit = "1",
        .min = 0.1,
        .max = 42,
        .defaultValue = "40:5",
        .description = "of the two warps of depth, over half the depth of a map, which is a little more than "
                       "the scene's along the light; with storage=moments"},
       moments,
       [](const std::string& text, Method::Settings& s) { s.exponents = listIn(text); }},
      {{.name = "blur",
        .kind = Kind::number,
        .unit = "m",
        .min = 0,
        .max = 1000,
        .defaultValue = "0",
        .description =
            "over how much shadows' edges fade, across the light; for a spot light in the middle of the "
            "scene's depth; with storage=moments"},
       moments,
       [](const std::string& text, Method::Settings& s) { s.blur = numberIn(text); }},
      {{.name = "bleed_reduction",
        .kind = Kind::number,
        .unit = "1",
        .min = 0,
        .max = 0.99,
        .defaultValue = "0.2",
        .description = "lights up to this share count as none, the rest are stretched; with storage=moments"},
       moments,
       [](const std::string& text, Method::Settings& s) { s.bleedReduction = numberIn(text); }},
      {{.name = "least_deviation",
        .kind = Kind::number,
        .unit = "m",
        .min = 1e-9,
        .max = 1000,
        .defaultValue = kAuto,
        .description = "of depth, below which it is taken for rounding; auto: 2e-5 of the scene's extent; "
                       "with storage=moments",
        .choices = {kAuto}},
       moments,
       [](const std::string& text, Method::Settings& s) { s.leastDeviation = unlessAuto(text); }},
      {{.name = "anisotropy",
        .kind = Kind::number,
        .unit = "texels",
        .min = 1,
        .max = 16,
        .defaultValue = "16",
        .description = "the most that are read along a pixel's footprint; with storage=moments"},
       moments,
       [](const std::string& text, Method::Settings& s) { s.anisotropy = numberIn(text); }},
  };
  return all;
}

}  // namespace

std::vector<Parameter> parametersFor(const MethodRow& row, const std::optional<Stages>& stages) {
  std::vector<Parameter> list;
  if (!stages) return list;
  for (const Rule& rule : rules())
    if (rule.readBy(*stages)) list.push_back(rule.parameter);
  for (Parameter& p : list)
    if (const auto own = row.defaults.find(p.name); own != row.defaults.end()) p.defaultValue = own->second;
  // Six faces of half the side are one and a half maps.
  if (stages->partition == Partition::cube)
    if (const auto texels = std::ranges::find(list, "texels", &Parameter::name); texels != list.end())
      texels->defaultValue = kFaceTexels;
  for (const std::string_view stage : stageNames())
    if (stageChoices(stage).size() > 1)
      list.push_back({.name = stage,
                      .kind = Kind::choice,
                      .unit = "",
                      .defaultValue = stageChoice(*row.stages, stage),
                      .description = "another choice at this stage",
                      .choices = stageChoices(stage)});
  return list;
}

std::optional<Parameter> knownParameter(std::string_view name) {
  for (const Rule& rule : rules())
    if (rule.parameter.name == name) return rule.parameter;
  return std::nullopt;
}

Method::Settings settingsFrom(const std::map<std::string, std::string>& parameters, const Stages& stages) {
  Method::Settings settings;
  for (const Rule& rule : rules())
    if (const auto found = parameters.find(std::string(rule.parameter.name)); found != parameters.end())
      rule.take(found->second, settings);
  // Variance does what bias does.
  if (stages.lookup == Lookup::evsm) settings.biasWorld = 0;
  return settings;
}

std::optional<std::string> whyInconsistent(const Stages& stages, const Method::Settings& settings) {
  if (settings.splits.size() > shared::kMaxPartitions)
    return fmt::format("splits: {} partitions; at most {}", settings.splits.size(), shared::kMaxPartitions);
  if (std::ranges::adjacent_find(settings.splits, std::greater_equal()) != settings.splits.end())
    return "splits: each must lie behind the one before: 4:12:40";
  if (settings.blend > 0 && settings.choose != Choose::depth)
    return "blend fades one range of depth into the next: use choose=depth with it";
  if (settings.plan == PlanTiming::delayed &&
      (stages.volume == Volume::scene || stages.volume == Volume::frustum))
    return "plan=delayed uses what the samples of the frame before said, and this plan asks none: use "
           "plan=gpu";
  if (asksTriangles(stages.lookup) && settings.kernel % 2 == 0)
    return fmt::format("kernel: {} texels have no middle one: give an odd number", settings.kernel);
  if (stages.warp == Warp::rectilinear) {
    std::vector<double> weights = settings.weights;
    if (weights.size() != shared::kImportanceFunctions)
      return fmt::format(
          "weights: {} of them; give five, of nearness, facing, edges, shadows' edges and density: 0:0:0:1:1",
          weights.size());
    // What this analysis doesn't see.
    weights[settings.analysis == Analysis::forward ? shared::kEdges : shared::kShadowEdges] *=
        settings.analysis == Analysis::hybrid;
    if (std::ranges::max(weights) <= 0)
      return "weights: nothing that this analysis sees is important: give it a weight: 0:0:0:1:1";
  }
  if (stages.storage == Storage::moments && settings.exponents.size() != 2)
    return fmt::format("exponents: {} of them; give the positive and the negative one: 40:5",
                       settings.exponents.size());
  if ((stages.storage == Storage::linear || keepsIds(stages.storage)) && settings.raster == Raster::pipeline)
    return "maps in one linear buffer are drawn by compute, because the pipeline draws into images: use "
           "raster=compute";
  if (stages.partition == Partition::tiles) {
    const std::size_t tiles = settings.tileSizes.size();
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(tiles))));
    if (side * side != tiles || tiles > shared::kMaxShadowViews)
      return fmt::format("tile_sizes: {} of them; give n x n, at most {}", tiles, shared::kMaxShadowViews);
    if (stages.resolution == Resolution::ranked &&
        !std::ranges::is_sorted(settings.tileSizes, std::greater()))
      return "tile_sizes: resolution=ranked gives the first to the most important tile: begin with the "
             "largest";
  }
  return std::nullopt;
}

}  // namespace sundial
