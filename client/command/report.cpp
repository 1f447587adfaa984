#include "command/report.h"

#include "sundial/method_choice.h"

namespace sundial::command {

v1::Report makeReport(const std::string& scene, const v1::RenderRequest& request,
                      const client::Rendering& rendering, const v1::ServerInfo& server) {
  v1::Report report;
  report.set_scene(scene);
  *report.mutable_view() = rendering.accepted.view();
  *report.mutable_light() = rendering.accepted.light();
  report.add_size(request.width());
  report.add_size(request.height());
  report.set_device(server.device());
  report.set_driver(server.driver());
  if (request.has_baseline()) report.set_baseline(client::methodLabel(request.baseline()));
  for (const client::MethodRendering& method : rendering.methods) {
    v1::Result& result = *report.add_results();
    result = method.result;
    result.mutable_measures()->mutable_edge_error_px();
    result.mutable_measures()->mutable_texel_px();
    *result.mutable_plan() = method.plan;
  }
  return report;
}

}  // namespace sundial::command
