#include "bench/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sundial::bench {

namespace {

using Json = nlohmann::ordered_json;

Json json(const glm::dvec3& v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

Json json(const View& view) {
  return {{"eye", json(view.eye)},
          {"target", json(view.target)},
          {"up", json(view.up)},
          {"vertical_fov_degrees", view.verticalFovDegrees}};
}

Json json(const Light& light) {
  switch (light.kind) {
    case LightKind::directional:
      return {{"sun", {{"direction", json(light.direction)}}}};
    case LightKind::spot:
      return {{"spot",
               {{"eye", json(light.position)},
                {"target", json(light.position + light.direction)},
                {"cone_degrees", light.coneDegrees}}}};
    case LightKind::point:
      return {{"point", {{"position", json(light.position)}}}};
  }
  return {};
}

Json quartiles(const Quartiles& q) { return {q.lower, q.upper}; }

Json json(const Measures& m, const MethodResult& result) {
  return {
      {"pixel_match", m.pixelMatch},
      {"false_lit", m.falseLit},
      {"false_shadow", m.falseShadow},
      {"mean_abs_error", m.meanAbsError},
      {"edge_error_px", {{"p50", m.edgeErrorPx.p50}, {"p95", m.edgeErrorPx.p95}, {"max", m.edgeErrorPx.max}}},
      {"interior_error", m.interiorError},
      {"texel_px", {{"p50", m.texelPx.p50}, {"p95", m.texelPx.p95}}},
      {"utilisation", m.utilisation},
      {"store_bytes", result.storeBytes},
      {"total_bytes", result.totalBytes},
      {"allocated_bytes", result.allocatedBytes}};
}

Json json(const PassTiming& pass) {
  Json work = Json::object();
  for (const Work& w : pass.work) work[w.name] = w.count;
  return {{"name", pass.name},
          {"gpu_ms", pass.gpuMs.median},
          {"quartiles", quartiles(pass.gpuMs)},
          {"work", std::move(work)}};
}

Json json(const PlanView& view) {
  const shared::ShadowView& gpu = view.gpu;
  Json matrix = Json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix.push_back(view.shadowFromWorld[column][row]);
  return {{"shadow_from_world", std::move(matrix)},
          {"rect", {gpu.rectOffset.x, gpu.rectOffset.y, gpu.rectSize.x, gpu.rectSize.y}},
          {"near", gpu.nearDistance},
          {"far", gpu.farDistance},
          {"texel_size", std::max(gpu.texelSize.x, gpu.texelSize.y)},
          {"sample_count", gpu.sampleCount},
          {"importance", gpu.importance},
          {"empty", gpu.empty != 0},
          {"depth_begin", gpu.depthBegin},
          {"depth_end", gpu.depthEnd},
          {"tile", view.tile ? Json{view.tile->x, view.tile->y} : Json::array()},
          {"linear_offset", gpu.linearOffset}};
}

template <class T>
Json list(const std::vector<T>& all) {
  Json out = Json::array();
  for (const T& one : all) out.push_back(json(one));
  return out;
}

}  // namespace

std::string toJson(const Case& of, const MethodResult& result) {
  Json line = {{"scene", of.scene},
               {"view", json(of.job.view)},
               {"light", json(of.job.light)},
               {"size", {of.job.size.x, of.job.size.y}},
               {"device", of.device.name},
               {"driver", of.device.driver},
               {"baseline", of.baseline},
               {"method", result.method.row->name},
               {"parameters", result.method.parameters},
               {"frame_ms", result.frameMs.median},
               {"frame_quartiles", quartiles(result.frameMs)}};
  if (result.ratio) {
    line["ratio_to_baseline"] = result.ratio->median;
    line["ratio_quartiles"] = quartiles(*result.ratio);
  }
  if (result.measures) line["measures"] = json(*result.measures, result);
  line["passes"] = list(result.passes);
  line["plan"] = {{"views", list(result.plan)}};
  return line.dump();
}

}  // namespace sundial::bench
