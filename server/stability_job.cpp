#include "stability_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shadow/camera.h"
#include "shadow/frame.h"
#include "shadow/frame_runner.h"
#include "shadow/method_in_light.h"
#include "stability/flips.h"
#include "stability/pixels.h"
#include "stability/point_target.h"
#include "stability/points.h"

namespace sundial {

namespace {

// Frames that points are chosen from: enough to see what the path sees.
constexpr unsigned kChoosingFrames = 32;

bool hasMap(const Method& method) { return method.stages.has_value(); }

// What all methods of a job share: the path's frames, as the device sees them, and the points.
class Stage {
 public:
  Stage(const JobContext& context, const StabilityJob& job) : context_(context), job_(job) {
    if (!context.scene.reference) context.scene.reference = std::make_unique<Reference>(context.scene.scene);
  }

  unsigned frames() const { return static_cast<unsigned>(job_.views.size()); }
  std::span<const SurfacePoint> points() const { return points_; }

  // Frame `f`; the scene is placed for it, and stays so until the next call.
  FrameView enter(unsigned f) const {
    const Scene& scene = *context_.scene.scene;
    const glm::dvec3 origin = frameOrigin(scene, job_.views[f]);
    context_.scene.buffers.moveTo(context_.device, origin);
    return {.device = context_.device,
            .pipelines = context_.pipelines,
            .scene = context_.scene.buffers,
            .target = context_.target,
            .reference = context_.scene.reference.get(),
            .edges = nullptr,
            .light = job_.lights[f],
            .origin = origin,
            .constants = frameConstants(scene, job_.views[f], job_.lights[f], job_.size, origin)};
  }

  PointsInFrame pointsIn(unsigned f, const FrameView& view) const {
    return look(points_, *view.reference, job_.views[f], view.light, view.origin, view.constants);
  }

  // From frames spread evenly over the path, its ends among them.
  Result<void> choosePoints(const Interrupt& interrupt) {
    PointChooser chooser(job_.points, job_.seed);
    const unsigned choosing = std::min(kChoosingFrames, frames());
    std::optional<Frame> frame;
    for (unsigned i = 0; i < choosing; ++i) {
      const unsigned f = choosing == 1 ? 0 : i * (frames() - 1) / (choosing - 1);
      const FrameView view = enter(f);
      if (frame) {
        frame->look(view);
      } else {
        frame.emplace(view, job_.methods.front());
      }
      std::vector<Pass> passes = frame->passes();
      std::erase_if(passes, [](const Pass& pass) { return pass.name != "gbuffer"; });
      if (auto run = runFrame(context_.device, passes, interrupt); !run) return std::unexpected(run.error());
      chooser.add(f, samplesIn(context_.device, context_.target), view.constants, view.origin);
    }
    points_ = chooser.take(*context_.scene.scene);
    return {};
  }

 private:
  const JobContext& context_;
  const StabilityJob& job_;
  std::vector<SurfacePoint> points_;
};

// The largest |log2| of a view's texel size now to its size before; views that hold nothing don't count.
double texelJump(const shared::Plan& before, const shared::Plan& now) {
  double jump = 0;
  for (std::uint32_t v = 0; v < std::min(before.viewCount, now.viewCount); ++v) {
    if (before.views[v].empty || now.views[v].empty) continue;
    const auto size = [&](const shared::Plan& plan) {
      return static_cast<double>(std::max(plan.views[v].texelSize.x, plan.views[v].texelSize.y));
    };
    jump = std::max(jump, std::abs(std::log2(size(now) / size(before))));
  }
  return jump;
}

// The frames that become pictures: the path is cut into as many stretches, and each is shown where most
// flips.
class Highlights {
 public:
  struct Pick {
    unsigned frame = 0;
    std::vector<std::uint32_t> flipped;
  };

  Highlights(unsigned pictures, unsigned frames) : frames_(frames), picks_(std::min(pictures, frames)) {}
  void consider(unsigned frame, const std::vector<std::uint32_t>& flipped) {
    if (picks_.empty()) return;
    const auto stretch = std::size_t{frame} * picks_.size() / frames_;
    Pick& pick = picks_[stretch];
    if (stretch != current_ || flipped.size() > pick.flipped.size()) pick = {frame, flipped};
    current_ = stretch;
  }
  const std::vector<Pick>& picks() const { return picks_; }

 private:
  unsigned frames_;
  std::vector<Pick> picks_;
  std::size_t current_ = static_cast<std::size_t>(-1);
};

// One method along the path.
class MethodRun {
 public:
  MethodRun(const JobContext& context, const Stage& stage, PointTarget& target, const Method& method,
            bool pixels)
      : context_(context),
        stage_(stage),
        target_(target),
        method_(method),
        pixels_(pixels),
        frame_(stage.enter(0), method) {}

  enum class Extent { maps, picture };

  struct Seen {
    std::vector<PointState> states;  // of all points
    std::uint64_t dark = 0;          // as in StabilityFrame
    double bleed = 0, drawn = 0;
    PixelCount pixels;
  };

  // Frames in order, because a method may remember the one before.
  Result<Seen> see(unsigned f, const Interrupt& interrupt, Extent extent = Extent::maps) {
    const FrameView view = stage_.enter(f);
    frame_.look(view);
    PointsInFrame points = stage_.pointsIn(f, view);
    std::vector<Pass> passes = frame_.passes();
    // Without a map the points are asked directly.
    if (extent == Extent::maps)
      std::erase_if(passes, [&](const Pass& pass) {
        return pass.name == "shade" || (!pixels_ && (!hasMap(method_) || pass.name == "resolve"));
      });
    Seen seen;
    if (passes.empty()) {
      if (auto error = interrupt.raised()) return std::unexpected(*error);
    } else if (auto run = runFrame(context_.device, passes, interrupt); run) {
      seen.drawn = scenesDrawn(passes, run->work);
    } else {
      return std::unexpected(run.error());
    }
    if (pixels_)
      seen.pixels = countPixels(context_.device, context_.target, *view.reference, view.light, view.origin);
    const std::vector<float> visibility = ask(points.samples, view);
    for (std::size_t i = 0; i < visibility.size(); ++i) {
      PointState& state = points.states[i];
      if (visibility[i] >= 0.5f) state |= kPointLit;
      if (!(state & kPointSeen) || state & kPointTruthLit) continue;
      ++seen.dark;
      seen.bleed += visibility[i];
    }
    seen.states = std::move(points.states);
    return seen;
  }

  // Of the frame that see() was called for last.
  shared::Plan plan() const { return frame_.downloadPlan(); }

  Result<StabilityPicture> picture(const Highlights::Pick& pick, const Interrupt& interrupt) {
    if (pick.frame > 0)
      if (auto before = see(pick.frame - 1, interrupt); !before) return std::unexpected(before.error());
    auto now = see(pick.frame, interrupt, Extent::picture);
    if (!now) return std::unexpected(now.error());
    StabilityPicture picture{.frame = pick.frame,
                             .size = context_.target.size(),
                             .colour = downloaded(context_.device, context_.target.colour, 4),
                             .flipped = {}};
    const FrameView view = stage_.enter(pick.frame);
    const PointsInFrame points = stage_.pointsIn(pick.frame, view);
    for (const std::uint32_t i : pick.flipped)
      picture.flipped.push_back(
          {pixelOf(points.samples[i], view.constants), (now->states[i] & kPointLit) != 0});
    return picture;
  }

 private:
  // The triangles of the store pass over the scene's.
  double scenesDrawn(const std::vector<Pass>& passes, const std::vector<std::vector<Work>>& work) const {
    const auto triangles = static_cast<double>(context_.scene.scene->instancedTriangles());
    for (std::size_t i = 0; i < passes.size(); ++i) {
      if (passes[i].name != "store" || triangles == 0) continue;
      const auto drawn = std::ranges::find(work[i], "primitives", &Work::name);
      if (drawn != work[i].end()) return drawn->count / triangles;
    }
    return 0;
  }

  std::vector<float> ask(std::span<const shared::ViewSample> samples, const FrameView& view) const {
    if (!hasMap(method_)) {
      std::vector<float> visibility(samples.size());
      view.reference->trace(samples, view.light, view.origin, visibility);
      return visibility;
    }
    target_.set(samples);
    const BindingSet bindings = frame_.bindingsAt(target_.target());
    context_.device.submit([&](VkCommandBuffer command) {
      target_.recordUpload(command);
      frame_.recordLookup(command, target_.target(), bindings);
    });
    return target_.visibility(context_.device);
  }

  const JobContext& context_;
  const Stage& stage_;
  PointTarget& target_;
  const Method& method_;
  bool pixels_;
  Frame frame_;
};

Result<void> runMethod(const JobContext& context, const Stage& stage, PointTarget& target,
                       const StabilityJob& job, std::size_t index, const Interrupt& interrupt,
                       StabilitySink& sink) {
  MethodRun run(context, stage, target, job.methods[index], job.pixels);
  FlipCounter counter;
  Highlights highlights(job.pictures, stage.frames());
  std::vector<StabilityFrame> frames;
  shared::Plan before{};
  for (unsigned f = 0; f < stage.frames(); ++f) {
    const auto seen = run.see(f, interrupt);
    if (!seen) return std::unexpected(seen.error());
    StabilityFrame frame = counter.add(seen->states);
    frame.dark = seen->dark;
    frame.bleed = seen->bleed;
    frame.drawn = seen->drawn;
    frame.pixels = seen->pixels.seen;
    frame.wrongPixels = seen->pixels.wrong;
    const shared::Plan plan = run.plan();
    frame.texelJump = texelJump(before, plan);
    before = plan;
    highlights.consider(f, counter.flipped());
    frames.push_back(frame);
    sink.onFrame(index, frame);
  }
  for (const Highlights::Pick& pick : highlights.picks()) {
    auto picture = run.picture(pick, interrupt);
    if (!picture) return std::unexpected(picture.error());
    sink.onPicture(index, std::move(*picture));
  }
  StabilityResult result = summed(std::move(frames));
  result.method = job.methods[index];
  result.points = stage.points().size();
  sink.onStability(index, std::move(result));
  return {};
}

}  // namespace

std::optional<std::string> whyInvalid(const StabilityJob& job, const Device& device) {
  if (!job.scene) return "scene: none is given";
  for (const Method& method : job.methods)
    if (method.row->technique == Technique::shadowVolumes)
      return fmt::format(
          "method {}: volumes are counted along the rays of pixels, so points between them have no answer: "
          "use "
          "ray-traced, which says the same",
          method.label());
  if (job.views.empty() || job.views.size() > kMaxStabilityFrames)
    return fmt::format("frames: {}; must be in [1, {}]", job.views.size(), kMaxStabilityFrames);
  if (job.lights.size() != job.views.size())
    return fmt::format("lights: {} for {} frames; give one a frame", job.lights.size(), job.views.size());
  if (auto why = whyInvalid(job.size, job.methods, job.lights.front().kind, device)) return why;
  for (std::size_t f = 0; f < job.views.size(); ++f) {
    if (auto why = whyInvalid(job.views[f])) return fmt::format("frame {}: {}", f, *why);
    if (auto why = whyInvalid(job.lights[f])) return fmt::format("frame {}: {}", f, *why);
  }
  if (job.points < 1 || job.points > kMaxStabilityPoints)
    return fmt::format("points: {}; must be in [1, {}]", job.points, kMaxStabilityPoints);
  if (job.pictures > kMaxStabilityPictures)
    return fmt::format("pictures: {}; must be in [0, {}]", job.pictures, kMaxStabilityPictures);
  return std::nullopt;
}

Result<void> runStabilityJob(const JobContext& context, const StabilityJob& job, const Interrupt& interrupt,
                             StabilitySink& sink) {
  StabilityJob unit = job;
  for (Light& light : unit.lights) light.direction = glm::normalize(light.direction);
  for (Method& method : unit.methods) method = methodInLight(method, unit.lights.front().kind).value();
  Stage stage(context, unit);
  if (auto chosen = stage.choosePoints(interrupt); !chosen) return chosen;
  PointTarget target(context.device, unit.points);
  for (std::size_t i = 0; i < unit.methods.size(); ++i)
    if (auto done = runMethod(context, stage, target, unit, i, interrupt, sink); !done) return done;
  return {};
}

}  // namespace sundial
