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

// What a user may set on a row. Sizes ("2048" or "1024x512") and numbers carry a range; stage choices list
// their values.
struct Parameter {
  enum class Kind { number, integer, size, choice };
  std::string_view name;
  Kind kind;
  std::string_view unit;          // "texels", "m", "1", ...
  double min = 0, max = 0;        // of a number, or of each side of a size
  std::string_view defaultValue;  // as a user would write it
  std::string_view description;
  std::vector<std::string_view> choices = {};
};

enum class Technique { shadowMap, rayTraced };

struct MethodRow {
  std::string_view name;
  std::string_view title;
  Technique technique;
  std::optional<Stages> stages;  // none for methods without a map
  std::string_view source;       // paper and section
};

// A row with its parameters settled: what a frame is rendered with. Made by chooseMethod() alone.
struct Method {
  const MethodRow* row = nullptr;
  std::map<std::string, std::string> parameters;  // every parameter of the row, as text, defaults filled in
  std::optional<Stages> stages;
  struct Settings {
    unsigned width = 2048, height = 2048;  // texels of every map
    double biasTexels = 0;                 // towards the light, texels of the map at the receiver
    std::optional<double> biasWorld;       // towards the light, metres; none: a share of the scene's diagonal
    unsigned kernel = 3;                   // pcf, texels a side
  } settings;
  std::string label() const;  // "sm,texels=1024": the name and what differs from the defaults
};

std::span<const MethodRow> methodTable();
std::vector<Parameter> parametersOf(const MethodRow&);

// "sm" with {"texels": "1024", "lookup": "pcf"}. Errors: notFound for a method, naming those that exist;
// invalidArgument for a parameter, a value or a combination, naming the range or the reason.
Result<Method> chooseMethod(std::string_view name, const std::map<std::string, std::string>& wanted);

// "NAME[,key=value]..." as the command line writes it.
Result<Method> parseMethod(std::string_view text);

}  // namespace sundial
