// The pipelines of a frame, made once for a device: one a pass and stage choice.
#pragma once

#include <map>

#include "gpu/pipeline.h"
#include "shadow/stages.h"

namespace sundial {

struct FramePipelines {
  explicit FramePipelines(const Device&);

  BindingLayout layout;
  Pipeline gbuffer, gbufferMasked, samples;
  Pipeline analyzeBounds;
  std::map<Volume, Pipeline> planSingle;
  Pipeline cullTest, cullWrite;
  Pipeline storeDepth, storeDepthMasked;
  std::map<Lookup, Pipeline> resolve;
  Pipeline answers;
  Pipeline shade, shadePlain;  // plain: a scene without textures and vertex colours
};

}  // namespace sundial
