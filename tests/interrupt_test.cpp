// A call that is cancelled or late stops between two passes: no pass begins after it, and the next job is
// served.
#include <chrono>

#include "shadow/camera.h"
#include "shadow/frame_runner.h"
#include "shadow/shadow_volumes.h"
#include "support/device_test.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

using Clock = std::chrono::steady_clock;

// Passes on a device of their own, one frame of a method among them.
class Interrupted : public DeviceTest<> {
 protected:
  std::vector<std::string> began;

  Pass onHost(std::string_view name, const std::function<void()>& work = {}) {
    return {.name = name, .record = {}, .host = [this, name, work] {
              began.emplace_back(name);
              if (work) work();
            }};
  }
  Pass onDevice(std::string_view name) {
    return {.name = name, .record = [this, name](VkCommandBuffer) { began.emplace_back(name); }, .host = {}};
  }
  void expectInterrupted(const Result<FrameTiming>& timing, ErrorCode code) {
    ASSERT_FALSE(timing);
    EXPECT_EQ(timing.error().code, code);
    EXPECT_FALSE(timing.error().message.empty());
  }
};

using Names = std::vector<std::string>;

TEST_F(Interrupted, AStopRequestedInAPassEndsTheFrameBeforeTheNext) {
  std::stop_source source;
  const Interrupt interrupt{.stop = source.get_token()};
  expectInterrupted(runFrame(device(),
                             {onDevice("first"), onHost("second", [&] { source.request_stop(); }),
                              onHost("third"), onDevice("fourth")},
                             interrupt),
                    ErrorCode::cancelled);
  EXPECT_EQ(began, (Names{"first", "second"}));
}

TEST_F(Interrupted, NoPassOnTheDeviceIsRecordedAfterAStop) {
  std::stop_source source;
  const Interrupt interrupt{.stop = source.get_token()};
  expectInterrupted(
      runFrame(device(), {onHost("first", [&] { source.request_stop(); }), onDevice("second")}, interrupt),
      ErrorCode::cancelled);
  EXPECT_EQ(began, Names{"first"});
}

TEST_F(Interrupted, ADeadlineThatPassesInAPassEndsTheFrameBeforeTheNext) {
  Interrupt interrupt;
  expectInterrupted(runFrame(device(),
                             {onDevice("first"), onHost("second", [&] { interrupt.deadline = Clock::now(); }),
                              onDevice("third")},
                             interrupt),
                    ErrorCode::deadlineExceeded);
  EXPECT_EQ(began, (Names{"first", "second"}));
}

TEST_F(Interrupted, NothingBeginsOnceTheStopOrTheDeadlineIsThere) {
  std::stop_source source;
  source.request_stop();
  expectInterrupted(runFrame(device(), {onDevice("first")}, {.stop = source.get_token()}),
                    ErrorCode::cancelled);
  expectInterrupted(runFrame(device(), {onHost("first")}, {.stop = {}, .deadline = Clock::now()}),
                    ErrorCode::deadlineExceeded);
  EXPECT_EQ(began, Names{});
}

TEST_F(Interrupted, WithoutAnInterruptEveryPassRunsInOrder) {
  const auto timing =
      runFrame(device(), {onDevice("first"), onHost("second"), onDevice("third"), onDevice("fourth")}, {});
  ASSERT_TRUE(timing);
  EXPECT_EQ(began, (Names{"first", "second", "third", "fourth"}));
  EXPECT_EQ(timing->passMs.size(), 4u);
}

// Between every two passes of real frames, of a method with a map and of one that traces.
TEST_F(Interrupted, EveryMethodsFrameStopsAfterAnyOfItsPassesAndRunsAgainWhole) {
  const auto scene = builtin("grid");
  FramePipelines pipelines(device());
  const glm::uvec2 size(64, 64);
  const ViewTarget target(device(), size);
  SceneBuffers buffers(device(), scene);
  const Reference reference(scene);
  const EdgeBuffers edges(device(), buffers);
  const View eye = viewOf(*scene, "main");
  const Light light = lightOf(*scene, "sun");
  const glm::dvec3 origin = frameOrigin(*scene, eye);
  buffers.moveTo(device(), origin);
  const FrameView view{.device = device(),
                       .pipelines = pipelines,
                       .scene = buffers,
                       .target = target,
                       .reference = &reference,
                       .edges = &edges,
                       .light = light,
                       .origin = origin,
                       .constants = frameConstants(*scene, eye, light, size, origin)};
  for (const MethodRow& row : methodTable()) {
    SCOPED_TRACE(row.name);
    Frame frame(view, method(row.name));
    const std::size_t count = frame.passes().size();
    ASSERT_TRUE(runFrame(device(), frame.passes(), {}));
    const auto whole = downloaded(device(), target.visibility, 4);
    for (std::size_t last = 0; last + 1 < count; ++last) {  // after the last one the frame is done
      std::stop_source source;
      std::vector<Pass> passes = frame.passes();
      began.clear();
      for (Pass& pass : passes) {
        if (pass.record)
          pass.record = [this, inner = pass.record, name = pass.name](VkCommandBuffer command) {
            began.emplace_back(name);
            inner(command);
          };
        if (pass.host)
          pass.host = [this, inner = pass.host, name = pass.name] {
            began.emplace_back(name);
            inner();
          };
      }
      passes.insert(passes.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                    {.name = "stop", .record = {}, .host = [&] { source.request_stop(); }});
      expectInterrupted(runFrame(device(), passes, {.stop = source.get_token()}), ErrorCode::cancelled);
      EXPECT_EQ(began.size(), last + 1);
      EXPECT_EQ(began.back(), frame.passes()[last].name);
    }
    ASSERT_TRUE(runFrame(device(), frame.passes(), {}));
    EXPECT_TRUE(downloaded(device(), target.visibility, 4) == whole);
  }
}

class InterruptedJob : public RendererTest {
 protected:
  static RenderJob job() {
    static const auto scene = builtin("grid");
    return jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {64, 64},
                 {"sm,texels=64", "dv,texels=64", "ray-traced"}, {Aov::visibility}, true);
  }
};

// Requests a stop when the plan of the second method arrives.
struct StopsAtItsSecondPlan : Collector {
  std::stop_source source;
  void onPlan(std::size_t method, const std::vector<PlanView>& plan) override {
    Collector::onPlan(method, plan);
    if (method == 1) source.request_stop();
  }
};

TEST_F(InterruptedJob, EndsBeforeTheNextMethodAndTheNextJobIsServed) {
  const auto expected = render(job());
  StopsAtItsSecondPlan sink;
  const Result<void> done = renderer().run(job(), {.stop = sink.source.get_token()}, sink);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  EXPECT_EQ(sink.renderings.size(), 2u) << "the third method never began";
  const auto after = render(job());
  ASSERT_EQ(after.size(), expected.size());
  for (std::size_t m = 0; m < after.size(); ++m)
    EXPECT_TRUE(after[m].images.at(Aov::visibility).bytes == expected[m].images.at(Aov::visibility).bytes);
}

// All of them would take an hour.
TEST_F(InterruptedJob, OfAMillionFramesEndsAtItsDeadline) {
  RenderJob many = job();
  many.repetitions = 1'000'000;
  many.baseline = method("sm,texels=64");
  Collector sink;
  const auto late =
      renderer().run(many, {.stop = {}, .deadline = Clock::now() + std::chrono::milliseconds(30)}, sink);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::deadlineExceeded);
  EXPECT_TRUE(sink.renderings.empty());
  EXPECT_EQ(render(job()).size(), 3u);
}

TEST_F(InterruptedJob, NeverBeginsOnceItIsCancelledOrLate) {
  Collector sink;
  std::stop_source source;
  source.request_stop();
  const auto cancelled = renderer().run(job(), {.stop = source.get_token()}, sink);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
  const auto late = renderer().run(job(), {.stop = {}, .deadline = Clock::now()}, sink);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::deadlineExceeded);
  EXPECT_TRUE(sink.renderings.empty());
  EXPECT_EQ(render(job()).size(), 3u);
}

}  // namespace
}  // namespace sundial::test
