// One job, step by step: frames timed in turn with the baseline, images, measures.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "reference/reference.h"
#include "renderer.h"
#include "shadow/frame_pipelines.h"
#include "shadow/scene_buffers.h"
#include "shadow/shadow_volumes.h"
#include "shadow/view_target.h"

namespace sundial {

// What a device holds of a scene.
struct ResidentScene {
  std::weak_ptr<const Scene> owner;
  std::shared_ptr<const Scene> scene;  // owns nothing
  SceneBuffers buffers;
  std::unique_ptr<Reference> reference = nullptr;  // built when first asked for
  std::unique_ptr<EdgeBuffers> edges = nullptr;    // too
};

struct JobContext {
  const Device& device;
  FramePipelines& pipelines;
  const ViewTarget& target;  // of the job's size
  ResidentScene& scene;
};

std::optional<std::string> whyInvalid(const RenderJob&, const Device&);
// What every kind of job has.
std::optional<std::string> whyInvalid(glm::uvec2 size, const std::vector<Method>&, LightKind, const Device&);

// Errors and exceptions as Renderer::run.
Result<void> runJob(const JobContext&, const RenderJob&, const Interrupt&, JobSink&);

}  // namespace sundial
