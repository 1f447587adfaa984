// What flips and what doesn't, along paths, on the device.
#include <gtest/gtest.h>

#include <map>

#include "renderer.h"
#include "scene/load.h"
#include "stability/path.h"

namespace sundial {
namespace {

struct Collected final : StabilitySink {
  void onFrame(std::size_t, const StabilityFrame&) override { ++frames; }
  void onPicture(std::size_t method, StabilityPicture picture) override {
    pictures[method].push_back(std::move(picture));
  }
  void onStability(std::size_t method, StabilityResult result) override {
    EXPECT_EQ(method, results.size());
    results.push_back(std::move(result));
  }
  unsigned frames = 0;
  std::map<std::size_t, std::vector<StabilityPicture>> pictures;
  std::vector<StabilityResult> results;
};

class StabilityTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto made = Renderer::create("", true);
    ASSERT_TRUE(made) << made.error().message;
    renderer = std::move(*made);
    grid = std::make_shared<Scene>(std::move(*makeBuiltin("grid")));
  }
  static void TearDownTestSuite() {
    EXPECT_EQ(renderer->validationMessages(), 0u);
    renderer.reset();
    grid.reset();
  }

  static StabilityJob job(unsigned frames = 6) {
    StabilityJob job{.scene = grid,
                     .views = *viewsAlong(grid->paths[0].keys, frames),
                     .lights = std::vector<Light>(frames, grid->lights[0].light),
                     .size = {128, 128},
                     .methods = {},
                     .points = 1500};
    for (const char* method : {"sm,texels=256", "dv,texels=256", "ray-traced"})
      job.methods.push_back(*parseMethod(method));
    return job;
  }
  static Collected run(const StabilityJob& job) {
    Collected collected;
    const auto done = renderer->runStability(job, {}, collected);
    EXPECT_TRUE(done) << done.error().message;
    return collected;
  }

  static std::unique_ptr<Renderer> renderer;
  static std::shared_ptr<const Scene> grid;
};
std::unique_ptr<Renderer> StabilityTest::renderer;
std::shared_ptr<const Scene> StabilityTest::grid;

TEST_F(StabilityTest, AMovingCameraFlipsOnlyWhatDependsOnIt) {
  const Collected got = run(job());
  ASSERT_EQ(got.results.size(), 3u);
  EXPECT_EQ(got.frames, 18u);
  const StabilityResult &sm = got.results[0], &dv = got.results[1], &traced = got.results[2];
  for (const StabilityResult& result : got.results) {
    EXPECT_EQ(result.points, 1500u);
    EXPECT_EQ(result.frames.size(), 6u);
    EXPECT_EQ(result.frames[0].pairs, 0u);
    EXPECT_EQ(result.frames[3].pairs, sm.frames[3].pairs);
    EXPECT_GT(result.frames[3].pairs, 500u);
  }
  EXPECT_EQ(sm.flipRate, 0);
  EXPECT_EQ(sm.texelJump, 0);
  EXPECT_GT(sm.wrongRate, 0);
  EXPECT_GT(dv.flipRate, 0);
  EXPECT_GE(dv.pop, dv.flipRate);
  EXPECT_GT(dv.texelJump, 0);
  EXPECT_EQ(traced.flipRate, 0);
  EXPECT_EQ(traced.wrongRate, 0);
  EXPECT_GT(sm.bleed, 0);
  EXPECT_EQ(traced.bleed, 0);
  EXPECT_NEAR(sm.drawn, 1, 1e-9) << "sm holds the scene, once";
  EXPECT_LE(dv.drawn, 1);
  EXPECT_EQ(traced.drawn, 0);
}

TEST_F(StabilityTest, AStillCameraFlipsNothing) {
  StabilityJob still = job();
  still.views.assign(6, still.views[2]);
  for (const StabilityResult& result : run(still).results) {
    EXPECT_EQ(result.flipRate, 0) << result.method.label();
    EXPECT_EQ(result.texelJump, 0) << result.method.label();
    EXPECT_GT(result.frames[1].pairs, 1000u);
  }
}

// What `compare` says of the frame.
TEST_F(StabilityTest, PixelsAreHeldAgainstTheTruthWhereThatIsAskedFor) {
  struct Matches final : JobSink {
    void onPlan(std::size_t, const std::vector<PlanView>&) override {}
    void onImage(std::size_t, Image) override {}
    void onResult(std::size_t, MethodResult result) override {
      matches.push_back(result.measures->pixelMatch);
    }
    std::vector<double> matches;
  } rendered;
  StabilityJob still = job(1);
  const RenderJob picture{.scene = grid,
                          .view = still.views[0],
                          .light = still.lights[0],
                          .size = still.size,
                          .methods = still.methods,
                          .images = {},
                          .measures = true};
  ASSERT_TRUE(renderer->run(picture, {}, rendered));
  still.pixels = true;
  const Collected got = run(still);
  ASSERT_EQ(got.results.size(), rendered.matches.size());
  for (std::size_t i = 0; i < got.results.size(); ++i)
    EXPECT_NEAR(got.results[i].wrongPixels, 1 - rendered.matches[i], 1e-12) << got.results[i].method.label();
  EXPECT_GT(got.results[0].wrongPixels, 0);
  EXPECT_EQ(got.results[2].wrongPixels, 0);
  EXPECT_GT(got.results[2].frames[0].pixels, 5000u);
  still.pixels = false;
  EXPECT_EQ(run(still).results[0].wrongPixels, 0);
}

TEST_F(StabilityTest, AMovingLightFlipsMaps) {
  StabilityJob moving = job();
  moving.views.assign(6, moving.views[2]);
  moving.lights = *lightsAlong(grid->lightPaths[0].keys, 6);
  const Collected got = run(moving);
  EXPECT_GT(got.results[0].flipRate, 0);
  EXPECT_EQ(got.results[2].flipRate, 0);
}

TEST_F(StabilityTest, RepeatsForASeedAndDiffersForAnother) {
  StabilityJob wanted = job(4);
  wanted.methods = {*parseMethod("dv,texels=256")};
  const auto counts = [](const Collected& got) {
    std::vector<std::uint64_t> all;
    for (const StabilityFrame& frame : got.results[0].frames)
      all.insert(all.end(), {frame.pairs, frame.flips, frame.seen, frame.wrong});
    return all;
  };
  const auto first = counts(run(wanted));
  EXPECT_EQ(counts(run(wanted)), first);
  wanted.seed = 2;
  EXPECT_NE(counts(run(wanted)), first);
}

TEST_F(StabilityTest, AMethodBesideOthersIsAsAlone) {
  StabilityJob wanted = job(4);
  const Collected together = run(wanted);
  wanted.methods = {wanted.methods[1]};
  EXPECT_EQ(run(wanted).results[0].flipRate, together.results[1].flipRate);
}

TEST_F(StabilityTest, PicturesShowWhereMostFlips) {
  StabilityJob wanted = job();
  wanted.pictures = 2;
  const Collected got = run(wanted);
  const auto& frames = got.results[1].frames;
  const auto& pictures = got.pictures.at(1);
  ASSERT_EQ(pictures.size(), 2u);
  for (std::size_t half = 0; half < 2; ++half) {
    unsigned best = static_cast<unsigned>(3 * half);
    for (unsigned f = best; f < 3 * half + 3; ++f)
      if (frames[f].flips > frames[best].flips) best = f;
    EXPECT_EQ(pictures[half].frame, best);
    EXPECT_EQ(pictures[half].flipped.size(), frames[best].flips);
    EXPECT_EQ(pictures[half].colour.size(), 128u * 128 * 4);
    for (const StabilityPicture::Mark& mark : pictures[half].flipped)
      EXPECT_TRUE(mark.pixel.x >= 0 && mark.pixel.x <= 128 && mark.pixel.y >= 0 && mark.pixel.y <= 128);
  }
  EXPECT_TRUE(got.pictures.at(0)[0].flipped.empty());
  wanted.pictures = 64;
  EXPECT_EQ(run(wanted).pictures.at(0).size(), 6u);
}

TEST_F(StabilityTest, NothingToSeeIsNoError) {
  StabilityJob wanted = job(3);
  wanted.scene = std::make_shared<Scene>(std::move(*makeBuiltin("grid?n=0&ground=0")));
  wanted.pictures = 1;
  for (const StabilityResult& result : run(wanted).results) {
    EXPECT_EQ(result.points, 0u);
    EXPECT_EQ(result.flipRate + result.pop + result.wrongRate + result.texelJump, 0) << result.method.label();
  }
}

TEST_F(StabilityTest, StopsBetweenPasses) {
  std::stop_source stop;
  struct Stopping final : StabilitySink {
    explicit Stopping(std::stop_source& s) : stop(s) {}
    void onFrame(std::size_t, const StabilityFrame&) override {
      ++frames;
      stop.request_stop();
    }
    void onPicture(std::size_t, StabilityPicture) override { ADD_FAILURE(); }
    void onStability(std::size_t, StabilityResult) override { ADD_FAILURE(); }
    std::stop_source& stop;
    unsigned frames = 0;
  } sink(stop);
  const auto done = renderer->runStability(job(), {.stop = stop.get_token()}, sink);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  EXPECT_EQ(sink.frames, 1u);
}

TEST_F(StabilityTest, RefusesWhatIsOutOfRange) {
  Collected sink;
  const auto refuses = [&](const StabilityJob& wanted, const std::string& words) {
    const auto done = renderer->runStability(wanted, {}, sink);
    ASSERT_FALSE(done) << words;
    EXPECT_EQ(done.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(done.error().message.find(words), std::string::npos) << done.error().message;
  };
  StabilityJob wanted = job();
  wanted.points = 0;
  refuses(wanted, "points: 0");
  wanted = job();
  wanted.lights.pop_back();
  refuses(wanted, "lights: 5 for 6");
  wanted = job();
  wanted.views.clear();
  refuses(wanted, "frames: 0");
  wanted = job();
  wanted.views[4].target = wanted.views[4].eye;
  refuses(wanted, "frame 4");
  wanted = job();
  wanted.methods.clear();
  refuses(wanted, "methods");
}

}  // namespace
}  // namespace sundial
