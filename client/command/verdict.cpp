#include "command/verdict.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "command/failure.h"

namespace sundial::command {
namespace {

constexpr double kFactor = 3;     // that failing and curing lie apart
constexpr double kOfTwin = 1.25;  // times the twin's measure is as good as the twin's

bool isFinite(const v1::StabilityResult& result) {
  for (const double value : {result.flip_rate(), result.pop(), result.texel_jump(), result.wrong_rate(),
                             result.bleed(), result.drawn(), result.wrong_pixels()})
    if (!std::isfinite(value)) return false;
  for (const double jump : result.plan_jumps())
    if (!std::isfinite(jump)) return false;
  return true;
}

}  // namespace

double measureOf(const v1::StabilityResult& result, const std::string& measure) {
  if (measure == "flip_rate") return result.flip_rate();
  if (measure == "pop") return result.pop();
  if (measure == "texel_jump") return result.texel_jump();
  if (measure == "wrong_rate") return result.wrong_rate();
  if (measure == "bleed") return result.bleed();
  if (measure == "drawn") return result.drawn();
  if (measure == "wrong_pixels") return result.wrong_pixels();
  throw failure(fmt::format("the server's case has a measure '{}', newer than this command", measure));
}

v1::CaseVerdict judge(const v1::StabilityCase& row,
                      const google::protobuf::RepeatedPtrField<v1::StabilityResult>& results,
                      const google::protobuf::RepeatedPtrField<v1::StabilityResult>& twin) {
  v1::CaseVerdict verdict;
  verdict.set_measure(row.measure());
  for (const v1::StabilityResult& result : results) {
    if (isFinite(result)) continue;
    verdict.set_why(fmt::format("{} gives what is no number", result.method()));
    return verdict;
  }
  if (row.tells_apart()) {
    if (results.size() < 2) throw failure("the server's case has no methods to tell apart");
    const double fails = measureOf(results[0], row.measure()), cures = measureOf(results[1], row.measure());
    if (cures > 0) verdict.set_factor(fails / cures);
    verdict.set_good(fails >= row.fails_above() && fails >= kFactor * cures);
    verdict.set_why(fmt::format("{} {:.6f} of {}, {:.6f} of {}", row.measure(), fails, results[0].method(),
                                cures, results[1].method()));
    return verdict;
  }
  verdict.set_good(true);
  double worst = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < results.size(); ++i) {
    const double near = i < twin.size() ? measureOf(twin[i], row.measure()) : 0;
    const double beyond = measureOf(results[i], row.measure()) - kOfTwin * near;
    if (beyond > row.at_most()) verdict.set_good(false);
    if (beyond <= worst) continue;
    worst = beyond;
    verdict.set_why(fmt::format("{} {:.6f} of {}", row.measure(), measureOf(results[i], row.measure()),
                                results[i].method()));
    if (row.has_twin()) verdict.mutable_why()->append(fmt::format(", {:.6f} of its twin", near));
  }
  return verdict;
}

}  // namespace sundial::command
