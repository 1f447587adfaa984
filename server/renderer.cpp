// The renderer: what a device keeps between jobs, and a job from its scene to its results.
#include "renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>

#include "job.h"
#include "stability_job.h"

namespace sundial {

namespace {

class VulkanRenderer final : public Renderer {
 public:
  explicit VulkanRenderer(std::unique_ptr<Device> device)
      : device_(std::move(device)), pipelines_(*device_) {}

  const DeviceInfo& device() const override { return device_->info(); }
  std::uint64_t validationMessages() const override { return device_->validationMessages(); }

  Result<void> run(const RenderJob& job, const Interrupt& interrupt, JobSink& sink) override {
    return guarded(job, interrupt,
                   [&](const JobContext& context) { return runJob(context, job, interrupt, sink); });
  }

  Result<void> runStability(const StabilityJob& job, const Interrupt& interrupt,
                            StabilitySink& sink) override {
    return guarded(job, interrupt,
                   [&](const JobContext& context) { return runStabilityJob(context, job, interrupt, sink); });
  }

 private:
  template <class Job, class Function>
  Result<void> guarded(const Job& job, const Interrupt& interrupt, Function run) {
    try {
      if (auto why = whyInvalid(job, *device_)) return invalid(*why);
      if (auto error = interrupt.raised()) return std::unexpected(*error);
      if (!target_ || target_->size() != job.size) {
        target_.reset();
        target_.emplace(*device_, job.size);
      }
      return run(JobContext{*device_, pipelines_, *target_, resident(job.scene)});
    } catch (const GpuError& error) {
      if (error.result == VK_ERROR_OUT_OF_DEVICE_MEMORY || error.result == VK_ERROR_OUT_OF_HOST_MEMORY) {
        target_.reset();
        scenes_.clear();
        return fail(
            ErrorCode::resourceExhausted,
            fmt::format("the device has no memory for this rendering ({}): ask for fewer pixels or texels",
                        error.what()));
      }
      return fail(ErrorCode::unavailable,
                  fmt::format("the device failed: {}: try again or elsewhere", error.what()));
    }
  }

  // What the device holds of a scene goes when the last owner outside lets go of the scene, at the next job.
  ResidentScene& resident(const std::shared_ptr<const Scene>& scene) {
    scenes_.remove_if([](const ResidentScene& r) { return r.owner.expired(); });
    const auto found =
        std::ranges::find_if(scenes_, [&](const ResidentScene& r) { return r.owner.lock() == scene; });
    if (found != scenes_.end()) return *found;
    // An owner of nothing: the cache must not keep the scene alive.
    const std::shared_ptr<const Scene> borrowed(std::shared_ptr<void>(), scene.get());
    return scenes_.emplace_back(scene, borrowed, SceneBuffers(*device_, borrowed));
  }

  std::unique_ptr<Device> device_;
  FramePipelines pipelines_;
  std::optional<ViewTarget> target_;
  std::list<ResidentScene> scenes_;
};

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(std::string_view wanted, bool validation) {
  auto device = Device::create(wanted, validation);
  if (!device) return std::unexpected(device.error());
  return std::make_unique<VulkanRenderer>(std::move(*device));
}

Result<std::vector<DeviceInfo>> Renderer::devices() { return Device::list(); }

std::size_t bytesPerPixel(Image::Format format) {
  switch (format) {
    case Image::Format::rgba8:
    case Image::Format::r32f:
    case Image::Format::r32u:
      return 4;
    case Image::Format::rg32u:
      return 8;
    case Image::Format::rgb32f:
      return 12;
  }
  return 0;
}

std::string_view aovName(Aov aov) {
  static constexpr std::string_view kNames[kAovCount] = {"colour", "visibility", "reference", "position",
                                                         "normal", "id",         "view",      "class"};
  return kNames[static_cast<std::size_t>(aov)];
}

}  // namespace sundial
