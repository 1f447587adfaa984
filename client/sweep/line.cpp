#include "sweep/line.h"

#include "sundial/method_choice.h"
#include "sundial/status_name.h"

namespace sundial::sweep {
namespace {

v1::SweepLine begun(const Case& one) {
  v1::SweepLine line;
  line.set_case_(one.id);
  line.set_scene(one.scene);
  line.set_view_name(one.viewName);
  line.set_light_name(one.lightName);
  line.add_size(one.request.width());
  line.add_size(one.request.height());
  line.set_baseline(client::methodLabel(one.request.baseline()));
  line.set_method(one.request.methods(0).name());
  if (!one.along) return line;
  v1::SweepMotion& motion = *line.mutable_motion();
  motion.set_path_name(one.pathName);
  motion.set_light_path_name(one.lightPathName);
  motion.set_frames(one.along->frames());
  motion.set_points(one.along->points());
  motion.set_seed(static_cast<std::uint32_t>(one.along->seed()));
  return line;
}

v1::SweepStability steadiness(const v1::StabilityResult& result) {
  v1::SweepStability stability;
  stability.set_flip_rate(result.flip_rate());
  stability.set_pop(result.pop());
  stability.set_texel_jump(result.texel_jump());
  stability.set_wrong_rate(result.wrong_rate());
  stability.set_points(result.points());
  stability.set_pairs(result.pairs());
  stability.set_frames(static_cast<std::uint32_t>(result.flips_per_frame_size()));
  return stability;
}

}  // namespace

v1::SweepLine makeLine(const Case& one, const client::Rendering& rendering,
                       const std::optional<client::Stability>& along) {
  const v1::Result& result = rendering.methods.front().result;
  v1::SweepLine line = begun(one);
  *line.mutable_view() = rendering.accepted.view();
  *line.mutable_light() = rendering.accepted.light();
  line.set_device(rendering.accepted.device());
  line.set_driver(rendering.accepted.driver());
  line.set_repetitions(result.repetitions());
  *line.mutable_parameters() = result.parameters();
  line.set_frame_ms(result.frame_ms());
  *line.mutable_frame_quartiles() = result.frame_quartiles();
  line.set_ratio_to_baseline(result.ratio_to_baseline());
  *line.mutable_ratio_quartiles() = result.ratio_quartiles();
  *line.mutable_measures() = result.measures();
  line.mutable_measures()->mutable_edge_error_px();  // there in every line, so that every key is
  line.mutable_measures()->mutable_texel_px();
  *line.mutable_passes() = result.passes();
  *line.mutable_plan() = rendering.methods.front().plan;
  if (along) *line.mutable_stability() = steadiness(along->methods.front().result);
  return line;
}

v1::SweepLine makeLine(const Case& one, const client::Error& error) {
  v1::SweepLine line = begun(one);
  if (one.request.has_view()) *line.mutable_view() = one.request.view();
  if (one.request.has_light()) *line.mutable_light() = one.request.light();
  *line.mutable_parameters() = one.request.methods(0).parameters();
  line.mutable_error()->set_code(statusName(error.code));
  line.mutable_error()->set_message(error.message);
  return line;
}

}  // namespace sundial::sweep
