// The table of methods. A method is a row: a name, a choice for each stage, its parameters, its source.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "result.h"
#include "shadow/stages.h"

namespace sundial {

// What a user may set on a row. Sizes ("2048" or "1024x512"), numbers and each number of a list ("4:12:40")
// carry a range; stage choices list their values.
struct Parameter {
  enum class Kind { number, integer, size, list, choice };
  std::string_view name;
  Kind kind;
  std::string_view unit;          // "texels", "m", "1", ...
  double min = 0, max = 0;        // of a number, of each side of a size, of each number of a list
  std::string_view defaultValue;  // as a user would write it
  std::string_view description;
  std::vector<std::string_view> choices = {};
};

enum class Technique { shadowMap, rayTraced, shadowVolumes };

struct MethodRow {
  std::string_view name;
  std::string_view title;
  Technique technique;
  std::optional<Stages> stages;                                // none for methods without a map
  std::string_view source;                                     // paper and section
  std::map<std::string_view, std::string_view> defaults = {};  // of parameters, where they are the row's own
};

// Who knows the plan, and when: the device alone; the host too, which waits for it, culls and submits what is
// left; or all use what the samples of the frame before said.
enum class PlanTiming { gpu, readback, delayed };
// Where the square of volume=inscribed lies: the camera on the circle inscribed in it, as the paper has it;
// or turned so that the camera looks along the middle of a column of tiles.
enum class Placement { circle, column };
// Where a rectilinear warp's importance is found: in what the camera sees, in what the light sees, or in what
// the camera sees of the light's edges too.
enum class Analysis { backward, forward, hybrid };
// Who draws depth maps: raster_choice.h.
enum class Raster { automatic, pipeline, compute };
// Which partition answers: the one made for the sample's depth, or the tightest that contains it.
enum class Choose { depth, tightest };
// What becomes of samples that no triangle of the map decides: they are lit; the shadow's edge is rebuilt
// from triangles' outlines, as the paper has it; or the mesh is followed from those triangles to the sample.
enum class Recovery { off, edges, walk };

// A row with its parameters settled: what a frame is rendered with. Made by chooseMethod() alone.
struct Method {
  const MethodRow* row = nullptr;
  std::map<std::string, std::string> parameters;  // every parameter of the row, as text, defaults filled in
  std::map<std::string, std::string> wanted;      // of them what was asked for
  std::optional<Stages> stages;
  struct Settings {
    bool cull = true;                      // clusters, for each shadow view
    unsigned width = 2048, height = 2048;  // texels of every map
    std::optional<double> window;          // of a warp, texels; none: a share of the map's side
    double even = 1;                       // share of a warp's texels, in (0, 1]
    double power = 1;                      // of importance, that a warp's texels follow
    Analysis analysis = Analysis::backward;
    std::vector<double> weights;  // warp=rectilinear: in the order of shared/plan.h
    double percentile = 0;        // resolution=estimated, of the pixels' sizes, in [0, 50]
    double finest = 0;            // the smallest texel over one of a map of the whole scene, in [0, 1]
    PlanTiming plan = PlanTiming::gpu;
    Raster raster = Raster::automatic;
    unsigned partitions = 1;     // along the camera's depth
    std::vector<double> splits;  // partition=manual: where each ends, metres; none: by a rule
    double lambda = 0.5;         // partition=practical
    std::optional<double> near;  // metres; none: by a rule
    Choose choose = Choose::tightest;
    double blend = 0;              // share of a partition's depth
    std::optional<double> extent;  // volume=inscribed: side of the square, metres; none: by a rule
    Placement placement = Placement::circle;
    std::vector<unsigned> tileSizes;        // texels a side; as many as tiles
    double importanceGain = 0;              // m and k of [Alecu 2014, equation 3.1]
    std::optional<double> importanceRange;  // metres; none: by a rule
    double biasTexels = 0;                  // towards the light, texels of the map at the receiver
    std::optional<double> biasWorld;       // towards the light, metres; none: a share of the scene's diagonal
    unsigned kernel = 3;                   // pcf, rgsm and spsm, texels a side
    Recovery recovery = Recovery::walk;    // spsm
    unsigned positions = 1;                // spsm: in an uncertain pixel
    std::vector<double> exponents;         // storage=moments: positive and negative
    double blur = 0;                       // metres
    double bleedReduction = 0;             // in [0, 1)
    std::optional<double> leastDeviation;  // metres; none: a share of the scene's depth
    double anisotropy = 1;                 // texels of a footprint's longer side
  } settings;
  std::string label() const;  // "sm,texels=1024": the name and what differs from the defaults
};

// Whether its lookup follows meshes from triangle to triangle.
inline bool walksSurfaces(const Method& m) {
  return m.stages && m.stages->lookup == Lookup::spsm && m.settings.recovery == Recovery::walk;
}

std::span<const MethodRow> methodTable();
// With those that only other choices at a stage read: descriptions say which.
std::vector<Parameter> parametersOf(const MethodRow&);

// "sm" with {"texels": "1024", "lookup": "pcf"}. Errors: notFound for a method, naming those that exist;
// invalidArgument for a parameter, a value or a combination, naming the range or the reason.
Result<Method> chooseMethod(std::string_view name, const std::map<std::string, std::string>& wanted);

// "NAME[,key=value]..." as the command line writes it.
Result<Method> parseMethod(std::string_view text);

}  // namespace sundial
