// Fixed points on the scene's surfaces: chosen from what a path sees, then looked at frame by frame.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <queue>
#include <span>
#include <vector>

#include "reference/reference.h"
#include "scene/scene.h"
#include "shared/frame.h"
#include "stability/flips.h"

namespace sundial {

struct SurfacePoint {
  glm::dvec3 position{0};  // world, metres
  glm::vec3 normal{0};     // geometric, unit, on the side from which it was chosen
  std::uint32_t instance = 0, triangle = 0;
  bool oneSided = false;  // not there for a camera behind it
};

// Chooses points from the view samples of some frames, so that each is chosen with a probability in
// proportion to the area that its pixel covers on the surface: a weighted reservoir [Efraimidis and Spirakis
// 2006]. What is in sight for longer is chosen more often. Depends on nothing but seed, samples and the
// frames' numbers.
class PointChooser {
 public:
  PointChooser(unsigned count, std::uint64_t seed) : count_(count), seed_(seed) {}
  // All samples of a frame, with the constants that it was rendered with.
  void add(unsigned frame, std::span<const shared::ViewSample>, const shared::FrameConstants&,
           const glm::dvec3& origin);
  // At most `count` points, by frame and pixel.
  std::vector<SurfacePoint> take(const Scene&);

 private:
  struct Candidate {
    double key;
    std::uint64_t order;  // frame and pixel
    SurfacePoint point;
    bool operator<(const Candidate& other) const {
      return key != other.key ? key < other.key : order < other.order;
    }
  };
  unsigned count_;
  std::uint64_t seed_;
  std::priority_queue<Candidate> candidates_;  // the smallest keys; the largest of them on top
};

// The points as view samples of one frame: relative to its origin, normals towards its camera. Where a point
// can't be there for the camera, its sample is none (kNoInstance).
struct PointsInFrame {
  std::vector<shared::ViewSample> samples;
  std::vector<PointState> states;  // seen, back and the truth; not yet what a method says
};
PointsInFrame look(std::span<const SurfacePoint>, const Reference&, const View&, const Light&,
                   const glm::dvec3& origin, const shared::FrameConstants&);

// Where a sample lies in the frame's image, pixels from the top left corner; meaningless behind the camera.
glm::vec2 pixelOf(const shared::ViewSample&, const shared::FrameConstants&);

}  // namespace sundial
