// A renderer without a device: deterministic images, and a gate before every pass, so that a test can hold a
// rendering in the middle without sleeping.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "renderer.h"
#include "stability/flips.h"

namespace sundial::test {

// Lets passes through, or holds them until told. Open at first.
class Gate {
 public:
  void close() {
    const std::lock_guard lock(mutex_);
    open_ = false;
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  // Lets one arrival through a closed gate.
  void letOneThrough() {
    const std::lock_guard lock(mutex_);
    ++passes_;
    changed_.notify_all();
  }
  // Blocks the rendering while the gate is closed.
  void arrive() {
    std::unique_lock lock(mutex_);
    ++arrived_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return open_ || passes_ > 0; });
    if (!open_) --passes_;
  }
  // Blocks the test until so many arrivals have happened since the gate was made.
  void awaitArrivals(unsigned count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return arrived_ >= count; });
  }
  unsigned arrived() {
    const std::lock_guard lock(mutex_);
    return arrived_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true;
  unsigned passes_ = 0, arrived_ = 0;
};

// Shared between the test and the renderer, which the server owns.
struct FakeState {
  static constexpr unsigned kPasses = 7;  // of every method
  Gate gate;                              // before every pass
  std::atomic<unsigned> passesRun = 0;
  std::atomic<unsigned> jobsBegun = 0, jobsDone = 0;
  std::mutex mutex;
  std::vector<glm::uvec2> sizes;  // of the jobs, in the order in which they were rendered

  std::vector<glm::uvec2> order() {
    const std::lock_guard lock(mutex);
    return sizes;
  }
};

inline Image::Format formatOf(Aov aov) {
  switch (aov) {
    case Aov::colour:
      return Image::Format::rgba8;
    case Aov::position:
    case Aov::normal:
      return Image::Format::rgb32f;
    case Aov::id:
      return Image::Format::rg32u;
    case Aov::view:
    case Aov::lookupClass:
      return Image::Format::r32u;
    default:
      return Image::Format::r32f;
  }
}

inline Image fakeImage(std::size_t method, Aov aov, glm::uvec2 size) {
  Image image{aov, formatOf(aov), size, {}};
  image.bytes.resize(std::size_t{size.x} * size.y * bytesPerPixel(image.format));
  std::uint32_t x = static_cast<std::uint32_t>(method * 31 + static_cast<unsigned>(aov) + 1);
  for (std::byte& byte : image.bytes) byte = static_cast<std::byte>((x = x * 1664525u + 1013904223u) >> 24);
  return image;
}

class FakeRenderer final : public Renderer {
 public:
  explicit FakeRenderer(std::shared_ptr<FakeState> state) : state_(std::move(state)) {}
  const DeviceInfo& device() const override { return info_; }
  std::uint64_t validationMessages() const override { return 0; }

  Result<void> run(const RenderJob& job, const Interrupt& interrupt, JobSink& sink) override {
    ++state_->jobsBegun;
    {
      const std::lock_guard lock(state_->mutex);
      state_->sizes.push_back(job.size);
    }
    for (std::size_t m = 0; m < job.methods.size(); ++m) {
      for (unsigned pass = 0; pass < FakeState::kPasses; ++pass) {
        state_->gate.arrive();
        if (auto raised = interrupt.raised()) return std::unexpected(std::move(*raised));
        ++state_->passesRun;
      }
      PlanView view;
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) view.shadowFromWorld[c][r] = 10 * r + c;  // reads as row, column
      }
      view.gpu = {};
      view.gpu.rectOffset = {1, 2};
      view.gpu.rectSize = {3, 4};
      view.gpu.texelSize = {0.5f, 0.25f};
      view.gpu.nearDistance = 1;
      view.gpu.farDistance = 9;
      view.gpu.depthBegin = 2;
      view.gpu.depthEnd = 5;
      view.gpu.linearOffset = 6;
      view.tile = glm::uvec2(7, 8);
      sink.onPlan(m, {view});
      for (const Aov aov : job.images) sink.onImage(m, fakeImage(m, aov, job.size));
      MethodResult result{.method = job.methods[m], .frameMs = {1, 2, 3}};
      if (job.baseline) result.ratio = {0.5, 1, 2};
      if (job.measures) result.measures.emplace();
      result.storeBytes = 11;
      result.totalBytes = 12;
      result.allocatedBytes = 13;
      result.passes = {{"store", {4, 5, 6}, {{"vertices", 7}}}};
      result.plan = {view};
      sink.onResult(m, std::move(result));
    }
    ++state_->jobsDone;
    return {};
  }

  // One gate a frame of each method; every second point of ten flips in the last frame.
  Result<void> runStability(const StabilityJob& job, const Interrupt& interrupt,
                            StabilitySink& sink) override {
    ++state_->jobsBegun;
    for (std::size_t m = 0; m < job.methods.size(); ++m) {
      std::vector<StabilityFrame> frames;
      for (unsigned f = 0; f < job.views.size(); ++f) {
        state_->gate.arrive();
        if (auto raised = interrupt.raised()) return std::unexpected(std::move(*raised));
        ++state_->passesRun;
        frames.push_back(
            {.frame = f, .pairs = f == 0 ? 0u : 10u, .flips = f + 1 == job.views.size() ? 5u : 0u});
        sink.onFrame(m, frames.back());
      }
      for (unsigned p = 0; p < std::min<std::size_t>(job.pictures, job.views.size()); ++p) {
        Image image = fakeImage(m, Aov::colour, job.size);
        sink.onPicture(
            m, {.frame = p, .size = job.size, .colour = std::move(image.bytes), .flipped = {{{1, 2}, true}}});
      }
      StabilityResult result = summed(std::move(frames));
      result.method = job.methods[m];
      result.points = 10;
      sink.onStability(m, std::move(result));
    }
    ++state_->jobsDone;
    return {};
  }

 private:
  std::shared_ptr<FakeState> state_;
  DeviceInfo info_{"fake", "fake driver"};
};

}  // namespace sundial::test
