// The truth: one shadow ray per view sample, traced by Embree on the CPU (DESIGN section 3).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "scene/scene.h"
#include "shared/frame.h"

namespace sundial {

// A scene's acceleration structure. Built once, then usable from one thread at a time; tracing itself uses
// all threads that TBB has. Keeps a reference to the scene. Throws std::runtime_error where Embree fails.
class Reference {
 public:
  explicit Reference(std::shared_ptr<const Scene>);
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  // Traces a ray from each sample towards the light and writes 1 (lit) or 0 into `visibility`, of the same
  // size; 0 where there is no geometry or the sample doesn't face the light (facesLight below).
  // `origin`: what the samples' positions are relative to, world space.
  // `width`: of the image whose rows the samples are, which makes the rays of a packet neighbours; 0 if there
  // is no image.
  // A ray ignores the receiver's own triangle and triangles coincident with it, and hits nearer than
  // 2e-5 of the scene's diagonal; it passes through holes of alpha-tested materials. Triangles cast from both
  // sides. The result doesn't depend on the number of threads.
  void trace(std::span<const shared::ViewSample> samples, const Light&, const glm::dvec3& origin,
             std::span<float> visibility, std::uint32_t width = 0) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Whether a sample's visible side can receive light at all: its normal, which faces the camera, points
// against the light, and for a spot it lies inside the cone. The same arithmetic as the shaders'
// facesLight(); false where there is no geometry or where a number isn't one.
bool facesLight(const shared::ViewSample&, const Light&, const glm::dvec3& origin);

// The same for many samples: 1 or 0 into `faces`, of the same size.
void facesLight(std::span<const shared::ViewSample>, const Light&, const glm::dvec3& origin,
                std::span<std::uint8_t> faces);

}  // namespace sundial
