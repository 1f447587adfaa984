// How stable shadows are while the camera or the light moves: what is asked for, and what comes of it
// (DESIGN section 3, flip_rate and pop).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "scene/scene.h"
#include "shadow/method.h"

namespace sundial {

inline constexpr unsigned kMaxStabilityFrames = 2000;
inline constexpr unsigned kMaxStabilityPoints = 65536;
inline constexpr unsigned kMaxStabilityPictures = 64;

// Fixed points on the scene's surfaces are asked in every frame of a path how lit they are.
struct StabilityJob {
  std::shared_ptr<const Scene> scene;
  std::vector<View> views;    // one a frame; [1, kMaxStabilityFrames]
  std::vector<Light> lights;  // as many, all of one kind
  glm::uvec2 size{512, 512};  // pixels of the frames, whose view samples the methods plan with
  std::vector<Method> methods;
  unsigned points = 4096;  // [1, kMaxStabilityPoints]
  std::uint64_t seed = 1;  // of the points' choice
  unsigned pictures = 0;   // of every method, [0, kMaxStabilityPictures]; at most one a frame
  bool pixels = false;     // whether every frame's pixels are held against the truth, too
};

// One frame held against the frame before; of the first, only `frame` and `wrong` mean something.
struct StabilityFrame {
  unsigned frame = 0;
  std::uint64_t pairs = 0;  // points seen in both frames, from the same side
  std::uint64_t flips = 0;  // of them: the method's answer changed and the truth didn't
  std::uint64_t seen = 0;   // points seen in this frame
  std::uint64_t wrong = 0;  // of them: the method's answer isn't the truth
  std::uint64_t dark = 0;   // of those seen: no light reaches them in truth
  double bleed = 0;         // the light that the method gives to them, summed
  double drawn = 0;         // triangles in all maps over the scene's
  double texelJump = 0;     // largest |log2| of a shadow view's texel size now to its size before
  // With StabilityJob::pixels:
  std::uint64_t pixels = 0;       // that show geometry
  std::uint64_t wrongPixels = 0;  // of them: the method's answer isn't the truth
};

// A frame as it is seen, and the points that flip in it.
struct StabilityPicture {
  unsigned frame = 0;
  glm::uvec2 size{0};
  std::vector<std::byte> colour;  // RGBA8, sRGB, row 0 first
  struct Mark {
    glm::vec2 pixel{0};  // from the top left corner
    bool lit = false;    // now; the other in the frame before
  };
  std::vector<Mark> flipped;
};

struct StabilityResult {
  Method method;
  std::uint64_t points = 0;  // that were chosen: fewer than asked for where the path sees less
  double flipRate = 0;       // all frames' flips / pairs; 0 without pairs, as the other rates
  double pop = 0;            // the largest share of pairs that flip in one frame
  double wrongRate = 0;      // all frames' wrong / seen
  double texelJump = 0;      // the largest of the frames'
  double bleed = 0;          // mean light where in truth is none
  double drawn = 0;          // mean of the frames'
  double wrongPixels = 0;    // all frames' wrongPixels / pixels
  std::vector<StabilityFrame> frames;
};

// Receives for each method its frames in order, its pictures in order, its result. Called on the rendering
// thread; may keep what it is given, must not block on a client.
class StabilitySink {
 public:
  virtual ~StabilitySink() = default;
  virtual void onFrame(std::size_t method, const StabilityFrame&) = 0;
  virtual void onPicture(std::size_t method, StabilityPicture) = 0;
  virtual void onStability(std::size_t method, StabilityResult) = 0;
};

}  // namespace sundial
