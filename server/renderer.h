// Renders jobs: one view of one scene by one or more methods, with images, timings and measures; or a path
// through it, with what flips on the way (stability/stability.h). The one door
// between the service (or the benchmark) and everything that draws. Knows neither gRPC nor protobuf.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "gpu/device_info.h"
#include "interrupt.h"
#include "measure/measures.h"
#include "result.h"
#include "scene/scene.h"
#include "shadow/method.h"
#include "shared/plan.h"
#include "stability/stability.h"
#include "work.h"

namespace sundial {

// Images that a job can ask for. Rows from the top, no padding; formats as in Image::Format.
enum class Aov {
  colour,       // rgba8, sRGB, A = 255 where there is geometry
  visibility,   // r32f, S in [0, 1]
  reference,    // r32f, R
  position,     // rgb32f, world, metres
  normal,       // rgb32f, geometric, facing the camera
  id,           // rg32u: instance, triangle (its index in its mesh of the source file); 0xffffffff: none
  view,         // r32u: index of the shadow view that answered; 0xffffffff: none
  lookupClass,  // r32u: what lookup=spsm answered from, shared/choices.h: kAnswer...; 0xffffffff: another
                // lookup
};
inline constexpr std::size_t kAovCount = 8;

struct Image {
  enum class Format { rgba8, r32f, rgb32f, r32u, rg32u };
  Aov aov;
  Format format;
  glm::uvec2 size{0};
  std::vector<std::byte> bytes;  // size.x * size.y * bytesPerPixel(format), little-endian
};
std::size_t bytesPerPixel(Image::Format);
std::string_view aovName(Aov);

struct RenderJob {
  std::shared_ptr<const Scene> scene;
  View view;
  Light light;
  glm::uvec2 size{1024, 1024};     // pixels, each side in [1, 8192]
  std::vector<Method> methods;     // at least one
  std::optional<Method> baseline;  // timed in turn with every method, run by run
  unsigned repetitions = 0;        // timed frames of each method after a warm-up; 0: one frame, not warmed up
  unsigned maxRepetitions = 0;  // more are timed, up to so many, while the quartiles of the ratio (without a
  double quartileTarget = 0;  // baseline: of the frame time) are farther apart than this share of its median
  std::vector<Aov> images;    // for every method
  bool measures = false;      // traces the reference once and measures every method against it
};

struct Quartiles {
  double lower = 0, median = 0, upper = 0;
};

struct PassTiming {
  std::string name;  // gbuffer, analyze, plan, cull, store, resolve, shade; trace
  Quartiles gpuMs;   // between device timestamps; host time for passes on the host
  std::vector<Work> work;
};

// One view of the plan, in the world's own coordinates.
struct PlanView {
  glm::dmat4 shadowFromWorld{1};
  shared::ShadowView gpu;
  std::optional<glm::uvec2> tile;  // column, row from the least x and y of light space; partition=tiles
};

struct MethodResult {
  Method method;
  unsigned repetitions = 0;        // timed frames
  Quartiles frameMs;               // the clock around submit and fence
  std::optional<Quartiles> ratio;  // frame time over the baseline's, pair by pair
  std::optional<Measures> measures;
  std::uint64_t storeBytes = 0, totalBytes = 0, allocatedBytes = 0;
  std::vector<PassTiming> passes;
  std::vector<PlanView> plan;
};

// Receives what a job makes, in this order, per method: the plan, the images, the result. Called on the
// rendering thread; may keep what it is given, must not block on a client.
class JobSink {
 public:
  virtual ~JobSink() = default;
  virtual void onPlan(std::size_t method, const std::vector<PlanView>&) = 0;
  virtual void onImage(std::size_t method, Image) = 0;
  virtual void onResult(std::size_t method, MethodResult) = 0;
};

// Owns a device. All calls from one thread; the class may be created on another.
class Renderer {
 public:
  // `wanted`: empty (the first GPU, or else a CPU driver), an index, or a part of a name.
  // Errors: notFound lists the devices that there are; failedPrecondition names the feature that one lacks.
  static Result<std::unique_ptr<Renderer>> create(std::string_view wanted, bool validation);
  static Result<std::vector<DeviceInfo>> devices();

  virtual ~Renderer() = default;
  virtual const DeviceInfo& device() const = 0;

  // Errors: invalidArgument (size, view, light), cancelled, deadlineExceeded, resourceExhausted (memory).
  virtual Result<void> run(const RenderJob&, const Interrupt&, JobSink&) = 0;

  // The same errors; those of the path name the frame.
  virtual Result<void> runStability(const StabilityJob&, const Interrupt&, StabilitySink&) = 0;

  // Messages of the validation layer so far (0 without it).
  virtual std::uint64_t validationMessages() const = 0;
};

}  // namespace sundial
