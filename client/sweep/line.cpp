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
  return line;
}

}  // namespace

v1::SweepLine makeLine(const Case& one, const client::Rendering& rendering) {
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
