// The results of sweeps: one JSON object a line, as `sundial sweep` appends them.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sundial::chart {

// A median and its quartiles; where none were measured they are the median.
struct Spread {
  double median = 0, lower = 0, upper = 0;
};

struct Pass {
  std::string name;
  Spread ms;
  std::map<std::string, double> work;
};

// DESIGN section 3. Shares are in [0, 1], distances in pixels.
struct Measures {
  double pixelMatch = 0, falseLit = 0, falseShadow = 0, meanAbsError = 0, interiorError = 0;
  double edgeP50 = 0, edgeP95 = 0, edgeMax = 0, texelP50 = 0, texelP95 = 0, utilisation = 0;
  double storeBytes = 0, totalBytes = 0, allocatedBytes = 0;

  double wrong() const;  // 1 - pixelMatch, without the dust of the subtraction
};

// DESIGN section 3, along a path.
struct Stability {
  double flipRate = 0, pop = 0, texelJump = 0, wrongRate = 0, points = 0, frames = 0;
};

struct Failed {
  std::string code, message;
};

struct Case {
  // View and light by name or place; "along NAME" where they move.
  std::string id, scene, view, light, device, driver, baseline, method;
  std::array<unsigned, 2> size{};  // pixels
  unsigned repetitions = 0;
  std::map<std::string, std::string> parameters;
  std::string label;  // the method, and those of its parameters that differ among the cases
  Spread frameMs, ratio;
  Measures measures;
  std::vector<Pass> passes;
  std::size_t planViews = 0;
  std::optional<Stability> stability;                   // where something moves
  std::map<std::string, std::filesystem::path> images;  // "picture", "error", "plan"
  std::optional<Failed> failed;                         // then there are no measures

  std::string sizeText() const;       // "640x360"
  std::string configuration() const;  // scene, view, light and size: what methods are compared in
};

struct Results {
  std::vector<Case> cases;           // by scene, view, light, size and method; of two of one id the last
  std::vector<std::string> remarks;  // for a person: what was ignored
};

// Throws std::runtime_error with one line that names the file, and the line in it, that isn't such a result.
// A last line without its end is ignored: its writer was stopped.
Results readResults(const std::vector<std::filesystem::path>& files);

// "method,key=value,...", of the parameters that take several values among the method's cases.
void labelCases(std::vector<Case>&);

}  // namespace sundial::chart
