// Culling on the host, for plans that it has read back: the same draws in the same order as cull_test.comp
// and cull_write.comp give.
#pragma once

#include <span>
#include <vector>

#include "shadow/scene_buffers.h"
#include "shared/plan.h"

namespace sundial {

// A box across the axes of the world, relative to the frame's origin.
struct WorldBox {
  glm::vec3 centre{0}, extent{0};  // half of its sides
};
// Around each draw as cull_test.comp places it; draws that pad a bucket get none in particular.
std::vector<WorldBox> worldBoxes(const SceneBuffers&, const glm::dvec3& origin);

// One view after another: `commands` has drawCount() a view, each bucket's from where the bucket begins;
// `counts` has kBuckets a view. Instances are placed relative to `origin`. `drawsAll`: views aren't culled.
void cullOnHost(const SceneBuffers&, const glm::dvec3& origin, const shared::Plan&, bool drawsAll,
                std::span<shared::DrawCommand> commands, std::span<std::uint32_t> counts);

}  // namespace sundial
