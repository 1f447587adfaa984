#include "chart/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "chart/front.h"

namespace sundial::chart {
namespace {

// Quoted where the format wants it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

// The first field is never empty.
std::string row(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& text : fields) {
    if (!line.empty()) line += ',';
    line += field(text);
  }
  line += "\r\n";
  return line;
}

std::set<std::string> onFront(const std::vector<Case>& cases) {
  std::map<std::string, std::vector<const Case*>> configurations;
  for (const Case& one : cases)
    if (!one.failed) configurations[one.configuration()].push_back(&one);
  std::set<std::string> ids;
  for (const auto& [name, members] : configurations) {
    std::vector<Cost> costs;
    for (const Case* one : members) costs.push_back({one->ratio.median, one->measures.wrong()});
    for (const std::size_t index : paretoFront(costs)) ids.insert(members[index]->id);
  }
  return ids;
}

// The columns of a case that didn't fail, with their names.
std::vector<std::pair<const char*, double>> numbers(const Case& one) {
  const Measures& m = one.measures;
  return {{"frame_ms", one.frameMs.median},
          {"frame_ms_lower", one.frameMs.lower},
          {"frame_ms_upper", one.frameMs.upper},
          {"ratio_to_baseline", one.ratio.median},
          {"ratio_lower", one.ratio.lower},
          {"ratio_upper", one.ratio.upper},
          {"wrong", m.wrong()},
          {"pixel_match", m.pixelMatch},
          {"false_lit", m.falseLit},
          {"false_shadow", m.falseShadow},
          {"mean_abs_error", m.meanAbsError},
          {"interior_error", m.interiorError},
          {"edge_error_px.p50", m.edgeP50},
          {"edge_error_px.p95", m.edgeP95},
          {"edge_error_px.max", m.edgeMax},
          {"texel_px.p50", m.texelP50},
          {"texel_px.p95", m.texelP95},
          {"utilisation", m.utilisation},
          {"store_bytes", m.storeBytes},
          {"total_bytes", m.totalBytes},
          {"allocated_bytes", m.allocatedBytes},
          {"plan_views", static_cast<double>(one.planViews)}};
}

// Those of a case in which something moves.
std::vector<std::pair<const char*, double>> steadiness(const Stability& s) {
  return {{"flip_rate", s.flipRate},     {"pop", s.pop},       {"texel_jump", s.texelJump},
          {"points_wrong", s.wrongRate}, {"points", s.points}, {"frames", s.frames}};
}

}  // namespace

std::string csvOf(const std::vector<Case>& cases) {
  std::set<std::string> parameters, passes;
  for (const Case& one : cases) {
    for (const auto& [key, value] : one.parameters) parameters.insert(key);
    for (const Pass& pass : one.passes) passes.insert(pass.name);
  }
  std::vector<std::string> header{"case",   "scene",  "view",     "light",       "width",  "height",
                                  "device", "driver", "baseline", "repetitions", "method", "label"};
  for (const std::string& key : parameters) header.push_back(fmt::format("parameter.{}", key));
  const auto numberNames = numbers({});
  for (const auto& [name, value] : numberNames) header.emplace_back(name);
  for (const auto& [name, value] : steadiness({})) header.emplace_back(name);
  header.emplace_back("on_front");
  for (const std::string& name : passes) header.push_back(fmt::format("pass.{}.ms", name));
  header.insert(header.end(), {"error_code", "error_message"});

  std::string csv = row(header);
  const std::set<std::string> front = onFront(cases);
  for (const Case& one : cases) {
    std::vector<std::string> fields{one.id,
                                    one.scene,
                                    one.view,
                                    one.light,
                                    std::to_string(one.size[0]),
                                    std::to_string(one.size[1]),
                                    one.device,
                                    one.driver,
                                    one.baseline,
                                    std::to_string(one.repetitions),
                                    one.method,
                                    one.label};
    for (const std::string& key : parameters) {
      const auto found = one.parameters.find(key);
      fields.push_back(found == one.parameters.end() ? "" : found->second);
    }
    for (const auto& [name, value] : numbers(one))
      fields.push_back(one.failed ? "" : fmt::format("{}", value));
    for (const auto& [name, value] : steadiness(one.stability.value_or(Stability{})))
      fields.push_back(one.stability ? fmt::format("{}", value) : "");
    fields.emplace_back(one.failed ? "" : front.contains(one.id) ? "1" : "0");
    for (const std::string& name : passes) {
      const auto pass = std::ranges::find(one.passes, name, &Pass::name);
      fields.push_back(pass == one.passes.end() ? "" : fmt::format("{}", pass->ms.median));
    }
    fields.push_back(one.failed ? one.failed->code : "");
    fields.push_back(one.failed ? one.failed->message : "");
    csv += row(fields);
  }
  return csv;
}

}  // namespace sundial::chart
