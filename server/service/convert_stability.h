// The contract's stability messages and the core's structs (see convert.h).
#pragma once

#include "service/convert.h"
#include "stability/stability.h"

namespace sundial {

inline constexpr int kMaxPathKeys = 1000;

// A StabilityRequest, checked as far as it can be without its scene.
struct StabilitySpec {
  std::string scene;
  std::optional<std::string> pathName, lightPathName;  // or keys, or else a view that stands still
  std::vector<View> keys;
  std::vector<Light> lightKeys;
  std::optional<std::string> viewName, lightName;
  unsigned frames = 0;     // 0: the path's
  unsigned ownFrames = 0;  // of `keys`, or else of `lightKeys`; 0: none is given
  StabilityJob job;        // all but scene, views and lights
};

// Errors: invalidArgument, notFound for a method.
Result<StabilitySpec> fromProto(const v1::StabilityRequest&, const RequestLimits&);

// Completes the job. Errors: notFound for a path, view or light, naming those that the scene has;
// invalidArgument for a path that can't be followed; resourceExhausted over limits.outputBytes.
Result<StabilityJob> withScene(StabilitySpec, std::shared_ptr<const Scene>, const RequestLimits&);

std::uint64_t outputBytes(const StabilityJob&);  // of its pictures

void toProto(const StabilityPicture&, v1::PictureBegin*);
void toProto(const StabilityResult&, v1::StabilityResult*);

}  // namespace sundial
