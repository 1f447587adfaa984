#include <algorithm>

#include "service/convert.h"

namespace sundial {

namespace {

void set(const glm::dvec3& v, v1::Vec3* out) {
  out->set_x(v.x);
  out->set_y(v.y);
  out->set_z(v.z);
}

void toProto(const Measures& in, const MethodResult& result, v1::Measures* out) {
  out->set_pixel_match(in.pixelMatch);
  out->set_false_lit(in.falseLit);
  out->set_false_shadow(in.falseShadow);
  out->set_mean_abs_error(in.meanAbsError);
  out->mutable_edge_error_px()->set_p50(in.edgeErrorPx.p50);
  out->mutable_edge_error_px()->set_p95(in.edgeErrorPx.p95);
  out->mutable_edge_error_px()->set_max(in.edgeErrorPx.max);
  out->set_interior_error(in.interiorError);
  out->mutable_texel_px()->set_p50(in.texelPx.p50);
  out->mutable_texel_px()->set_p95(in.texelPx.p95);
  out->set_utilisation(in.utilisation);
  out->set_store_bytes(static_cast<double>(result.storeBytes));
  out->set_total_bytes(static_cast<double>(result.totalBytes));
  out->set_allocated_bytes(static_cast<double>(result.allocatedBytes));
}

const char* kindName(Parameter::Kind kind) {
  switch (kind) {
    case Parameter::Kind::number:
      return "number";
    case Parameter::Kind::integer:
      return "integer";
    case Parameter::Kind::size:
      return "size";
    case Parameter::Kind::list:
      return "list";
    case Parameter::Kind::choice:
      return "choice";
  }
  return "";
}

}  // namespace

void toProto(const View& in, v1::View* out) {
  set(in.eye, out->mutable_eye());
  set(in.target, out->mutable_target());
  set(in.up, out->mutable_up());
  out->set_vertical_fov_degrees(in.verticalFovDegrees);
}

void toProto(const Light& in, v1::Light* out) {
  switch (in.kind) {
    case LightKind::directional:
      set(in.direction, out->mutable_sun()->mutable_direction());
      break;
    case LightKind::spot:
      set(in.position, out->mutable_spot()->mutable_eye());
      set(in.position + in.direction, out->mutable_spot()->mutable_target());
      out->mutable_spot()->set_cone_degrees(in.coneDegrees);
      break;
    case LightKind::point:
      set(in.position, out->mutable_point()->mutable_position());
      break;
  }
}

void toProto(const std::vector<PlanView>& in, v1::Plan* out) {
  for (const PlanView& view : in) {
    v1::PlanView* to = out->add_views();
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) to->add_shadow_from_world(view.shadowFromWorld[column][row]);
    }
    for (const auto& pair : {view.gpu.rectOffset, view.gpu.rectSize}) {
      to->add_rect(pair.x);
      to->add_rect(pair.y);
    }
    to->set_near(view.gpu.nearDistance);
    to->set_far(view.gpu.farDistance);
    to->set_texel_size(std::max(view.gpu.texelSize.x, view.gpu.texelSize.y));
    to->set_sample_count(view.gpu.sampleCount);
    to->set_importance(view.gpu.importance);
    to->set_empty(view.gpu.empty != 0);
    to->set_depth_begin(view.gpu.depthBegin);
    to->set_depth_end(view.gpu.depthEnd);
    if (view.tile) {
      to->add_tile(view.tile->x);
      to->add_tile(view.tile->y);
    }
    to->set_linear_offset(view.gpu.linearOffset);
  }
}

void toProto(const MethodResult& in, v1::Result* out) {
  out->set_method(in.method.row->name.data(), in.method.row->name.size());
  for (const auto& [name, value] : in.method.parameters) (*out->mutable_parameters())[name] = value;
  out->set_frame_ms(in.frameMs.median);
  out->add_frame_quartiles(in.frameMs.lower);
  out->add_frame_quartiles(in.frameMs.upper);
  if (in.ratio) {
    out->set_ratio_to_baseline(in.ratio->median);
    out->add_ratio_quartiles(in.ratio->lower);
    out->add_ratio_quartiles(in.ratio->upper);
  }
  if (in.measures) toProto(*in.measures, in, out->mutable_measures());
  for (const PassTiming& pass : in.passes) {
    v1::Pass* to = out->add_passes();
    to->set_name(pass.name);
    to->set_gpu_ms(pass.gpuMs.median);
    to->add_quartiles(pass.gpuMs.lower);
    to->add_quartiles(pass.gpuMs.upper);
    for (const Work& work : pass.work) (*to->mutable_work())[work.name] = work.count;
  }
  toProto(in.plan, out->mutable_plan());
  out->set_repetitions(in.repetitions);
}

void toProto(const MethodRow& in, v1::Method* out) {
  out->set_name(std::string(in.name));
  out->set_title(std::string(in.title));
  out->set_source(std::string(in.source));
  if (in.stages) {
    for (const std::string_view stage : stageNames()) {
      (*out->mutable_stages())[std::string(stage)] = stageChoice(*in.stages, stage);
    }
  }
  for (const Parameter& parameter : parametersOf(in)) {
    v1::Parameter* to = out->add_parameters();
    to->set_name(std::string(parameter.name));
    to->set_kind(kindName(parameter.kind));
    to->set_unit(std::string(parameter.unit));
    to->set_min(parameter.min);
    to->set_max(parameter.max);
    to->set_default_value(std::string(parameter.defaultValue));
    to->set_description(std::string(parameter.description));
    for (const std::string_view choice : parameter.choices) to->add_choices(std::string(choice));
  }
}

void toProto(const LoadedScene& in, v1::SceneInfo* out) {
  const Scene& scene = *in.scene;
  out->set_reference(in.reference);
  out->set_digest(in.digest);
  out->set_loaded(true);
  out->set_triangles(scene.indices.size() / 3);
  out->set_instanced_triangles(scene.instancedTriangles());
  out->set_degenerate_triangles(scene.degenerateTriangles);
  out->set_meshes(static_cast<std::uint32_t>(scene.meshes.size()));
  out->set_instances(static_cast<std::uint32_t>(scene.instances.size()));
  out->set_clusters(static_cast<std::uint32_t>(scene.clusters.size()));
  out->set_bytes(scene.bytes());
  set(scene.bounds.min, out->mutable_bounds_min());
  set(scene.bounds.max, out->mutable_bounds_max());
  for (const NamedView& view : scene.views) out->add_views(view.name);
  for (const NamedLight& light : scene.lights) out->add_lights(light.name);
  for (const NamedPath& path : scene.paths) out->add_paths(path.name);
  for (const NamedLightPath& path : scene.lightPaths) out->add_light_paths(path.name);
}

void toProto(const SceneListing& in, v1::SceneInfo* out) {
  if (in.loaded) toProto(*in.loaded, out);
  out->set_reference(in.reference);
  out->set_description(in.description);
}

v1::Aov toProto(Aov aov) {
  switch (aov) {
    case Aov::colour:
      return v1::COLOUR;
    case Aov::visibility:
      return v1::VISIBILITY;
    case Aov::reference:
      return v1::REFERENCE;
    case Aov::position:
      return v1::POSITION;
    case Aov::normal:
      return v1::NORMAL;
    case Aov::id:
      return v1::ID;
    case Aov::view:
      return v1::VIEW;
    case Aov::lookupClass:
      return v1::CLASS;
  }
  return v1::AOV_UNSPECIFIED;
}

}  // namespace sundial
