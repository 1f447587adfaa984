// Between the contract's messages and the core's structs. What comes from outside is checked here; every
// error names the field, its value and the range.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer.h"
#include "result.h"
#include "scene_store.h"
#include "stability/cases.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial {

struct RequestLimits {
  std::uint32_t imageSide = 8192;            // pixels
  std::uint64_t outputBytes = 512ull << 20;  // image data of one rendering
};
inline constexpr int kMaxMethods = 16;
inline constexpr std::uint32_t kMaxRepetitions = 100;
inline constexpr std::uint32_t kMaxNameLength = 4096;  // bytes of any name in a request

// A RenderRequest, checked as far as it can be without its scene.
struct RenderSpec {
  std::string scene;
  std::optional<View> view;  // or viewName, or neither: the scene's default
  std::optional<std::string> viewName;
  std::optional<Light> light;
  std::optional<std::string> lightName;
  RenderJob job;  // all but scene, view and light
  std::uint64_t outputBytes = 0;
};

// Errors: invalidArgument, notFound for a method, resourceExhausted over limits.outputBytes.
Result<RenderSpec> fromProto(const v1::RenderRequest&, const RequestLimits&);

// Completes the job. Errors: notFound for a view or light, naming those that the scene has.
Result<RenderJob> withScene(RenderSpec, std::shared_ptr<const Scene>);

Result<View> fromProto(const v1::View&, const std::string& field);
Result<Light> fromProto(const v1::Light&, const std::string& field);

void toProto(const View&, v1::View*);
void toProto(const Light&, v1::Light*);
void toProto(const std::vector<PlanView>&, v1::Plan*);
void toProto(const MethodResult&, v1::Result*);
void toProto(const MethodRow&, v1::Method*);
void toProto(const SceneListing&, v1::SceneInfo*);
void toProto(const LoadedScene&, v1::SceneInfo*);
void toProto(const StabilityCase&, v1::StabilityCase*);
v1::Aov toProto(Aov);

}  // namespace sundial
