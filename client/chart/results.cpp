#include "chart/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

namespace sundial::chart {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Why a line is no result: told with its place by the caller.
struct NoResult : std::runtime_error {
  using std::runtime_error::runtime_error;
};

const json& need(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw NoResult(fmt::format("it has no '{}'", key));
  return *found;
}

double number(const json& object, const char* key) {
  const json& value = need(object, key);
  if (!value.is_number()) throw NoResult(fmt::format("its '{}' is no number", key));
  return value.get<double>();
}

double numberOr(const json& object, const char* key, double otherwise) {
  return object.contains(key) ? number(object, key) : otherwise;
}

std::string textOf(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string text(const json& object, const char* key) {
  const json& value = need(object, key);
  if (!value.is_string()) throw NoResult(fmt::format("its '{}' is no text", key));
  return value.get<std::string>();
}

std::string textOr(const json& object, const char* key, const std::string& otherwise) {
  return object.contains(key) ? text(object, key) : otherwise;
}

const json& objectIn(const json& object, const char* key) {
  static const json kEmpty = json::object();
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return kEmpty;
  if (!found->is_object()) throw NoResult(fmt::format("its '{}' is no object", key));
  return *found;
}

const json& listIn(const json& object, const char* key) {
  static const json kEmpty = json::array();
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return kEmpty;
  if (!found->is_array()) throw NoResult(fmt::format("its '{}' is no list", key));
  return *found;
}

Spread spread(const json& object, const char* median, const char* quartiles) {
  const double middle = number(object, median);
  Spread result{middle, middle, middle};
  const json& pair = listIn(object, quartiles);
  if (pair.empty()) return result;
  if (pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number())
    throw NoResult(fmt::format("its '{}' are no pair of numbers", quartiles));
  result.lower = pair[0].get<double>();
  result.upper = pair[1].get<double>();
  return result;
}

// Of the first point or direction in a view or light: "eye 1.5, 2, -3".
std::string placeIn(const json& object) {
  for (const auto& [name, value] : object.items()) {
    if (!value.is_object()) continue;
    if (!value.contains("x")) return placeIn(value);
    return fmt::format("{} {:.4g}, {:.4g}, {:.4g}", name, numberOr(value, "x", 0), numberOr(value, "y", 0),
                       numberOr(value, "z", 0));
  }
  return "default";
}

// A view or light by its way or its name, or else by where it is.
std::string nameOr(const json& object, const char* name, const char* value, const char* path) {
  if (const std::string way = textOr(objectIn(object, "motion"), path, ""); !way.empty())
    return "along " + way;
  const std::string given = textOr(object, name, "");
  return given.empty() ? placeIn(objectIn(object, value)) : given;
}

Measures measuresOf(const json& object) {
  const json &edge = objectIn(object, "edge_error_px"), &texel = objectIn(object, "texel_px");
  return {.pixelMatch = number(object, "pixel_match"),
          .falseLit = number(object, "false_lit"),
          .falseShadow = number(object, "false_shadow"),
          .meanAbsError = number(object, "mean_abs_error"),
          .interiorError = number(object, "interior_error"),
          .edgeP50 = numberOr(edge, "p50", 0),
          .edgeP95 = numberOr(edge, "p95", 0),
          .edgeMax = numberOr(edge, "max", 0),
          .texelP50 = numberOr(texel, "p50", 0),
          .texelP95 = numberOr(texel, "p95", 0),
          .utilisation = numberOr(object, "utilisation", 0),
          .storeBytes = numberOr(object, "store_bytes", 0),
          .totalBytes = numberOr(object, "total_bytes", 0),
          .allocatedBytes = numberOr(object, "allocated_bytes", 0)};
}

Stability stabilityOf(const json& object) {
  return {.flipRate = number(object, "flip_rate"),
          .pop = numberOr(object, "pop", 0),
          .texelJump = numberOr(object, "texel_jump", 0),
          .wrongRate = numberOr(object, "wrong_rate", 0),
          .points = numberOr(object, "points", 0),
          .frames = numberOr(object, "frames", 0)};
}

Pass passOf(const json& object) {
  Pass pass{text(object, "name"), spread(object, "gpu_ms", "quartiles"), {}};
  for (const auto& [name, count] : objectIn(object, "work").items())
    if (count.is_number()) pass.work[name] = count.get<double>();
  return pass;
}

Case caseOf(const json& line, const fs::path& folder) {
  if (!line.is_object()) throw NoResult("it is no JSON object");
  Case result;
  result.id = text(line, "case");
  result.scene = text(line, "scene");
  result.method = text(line, "method");
  result.view = nameOr(line, "view_name", "view", "path_name");
  result.light = nameOr(line, "light_name", "light", "light_path_name");
  result.device = textOr(line, "device", "");
  result.driver = textOr(line, "driver", "");
  result.baseline = textOr(line, "baseline", "");
  result.repetitions = static_cast<unsigned>(numberOr(line, "repetitions", 0));
  const json& size = listIn(line, "size");
  if (size.size() != 2 || !size[0].is_number_unsigned() || !size[1].is_number_unsigned())
    throw NoResult("its 'size' is no pair of pixels");
  result.size = {size[0].get<unsigned>(), size[1].get<unsigned>()};
  for (const auto& [key, value] : objectIn(line, "parameters").items())
    result.parameters[key] = textOf(value);
  if (const json& error = objectIn(line, "error"); !error.empty()) {
    result.failed = Failed{error.contains("code") ? textOf(error["code"]) : "",
                           error.contains("message") ? textOf(error["message"]) : ""};
    return result;
  }
  need(line, "measures");
  result.measures = measuresOf(objectIn(line, "measures"));
  result.frameMs = spread(line, "frame_ms", "frame_quartiles");
  result.ratio = spread(line, "ratio_to_baseline", "ratio_quartiles");
  for (const json& pass : listIn(line, "passes")) result.passes.push_back(passOf(pass));
  result.planViews = listIn(objectIn(line, "plan"), "views").size();
  if (const json& stability = objectIn(line, "stability"); !stability.empty())
    result.stability = stabilityOf(stability);
  for (const auto& [name, file] : objectIn(line, "images").items())
    if (file.is_string() && !file.get<std::string>().empty())
      result.images[name] = folder / file.get<std::string>();
  return result;
}

struct Reader {
  Results results;
  std::unordered_map<std::string, std::size_t> places;  // of the cases, by id
  std::size_t repeated = 0;

  void add(Case one) {
    const auto [place, isNew] = places.try_emplace(one.id, results.cases.size());
    if (isNew)
      results.cases.push_back(std::move(one));
    else
      results.cases[place->second] = std::move(one), ++repeated;
  }

  void read(const fs::path& path) {
    std::ifstream file(path);
    if (!file || fs::is_directory(path))
      throw std::runtime_error(fmt::format("{} can't be read: {}; name the results of a sweep", path.string(),
                                           fs::is_directory(path) ? "it is a folder" : std::strerror(errno)));
    std::size_t count = 0, number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      const bool unended = file.eof();
      if (std::ranges::all_of(line, [](unsigned char c) { return std::isspace(c); })) continue;
      try {
        add(caseOf(json::parse(line), path.parent_path()));
        ++count;
      } catch (const json::parse_error&) {
        if (!unended || line.front() != '{') fail(path, number, "it is no JSON");
        results.remarks.push_back(
            fmt::format("{}:{}: ignored an unfinished last line; 'sundial sweep --resume' completes the file",
                        path.string(), number));
      } catch (const std::exception& why) {
        fail(path, number, why.what());
      }
    }
    if (count == 0) results.remarks.push_back(fmt::format("{} holds no result", path.string()));
  }

  [[noreturn]] static void fail(const fs::path& path, std::size_t line, std::string_view why) {
    throw std::runtime_error(
        fmt::format("{}:{}: this line is no result of a sweep: {}; name files that 'sundial sweep' wrote",
                    path.string(), line, why));
  }
};

}  // namespace

double Measures::wrong() const {
  const double share = 1 - pixelMatch;
  return std::abs(share) < 1e-12 ? 0 : share;
}

std::string Case::sizeText() const { return fmt::format("{}x{}", size[0], size[1]); }

std::string Case::configuration() const {
  return fmt::format("{}\n{}\n{}\n{}", scene, view, light, sizeText());
}

Results readResults(const std::vector<fs::path>& files) {
  Reader reader;
  for (const fs::path& file : files) reader.read(file);
  if (reader.repeated > 0)
    reader.results.remarks.push_back(
        fmt::format("{} lines repeat a case; the last of each counts", reader.repeated));
  labelCases(reader.results.cases);
  // Servers answer in any order; what is made of a sweep doesn't depend on it. Shorter labels have less
  // texels.
  std::ranges::stable_sort(reader.results.cases, {}, [](const Case& one) {
    return std::tuple(one.scene, one.view, one.light, one.size, one.method, one.label.size(), one.label,
                      one.id);
  });
  return std::move(reader.results);
}

}  // namespace sundial::chart
