// What flips and what doesn't: the counting by itself, paths, the choice of points, and whole runs on the
// device.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "renderer.h"
#include "scene/load.h"
#include "stability/cases.h"
#include "stability/flips.h"
#include "stability/path.h"
#include "stability/points.h"

namespace sundial {
namespace {

// --- Counting

constexpr PointState kSeen = kPointSeen, kLit = kPointSeen | kPointLit, kTruth = kPointSeen | kPointTruthLit,
                     kBoth = kLit | kTruth;

TEST(Flips, AnAnswerThatChangesAloneIsAFlip) {
  FlipCounter counter;
  counter.add(std::vector<PointState>{kBoth, kSeen, kLit, kTruth});
  const StabilityFrame frame = counter.add(std::vector<PointState>{kTruth, kLit, kLit, kTruth});
  EXPECT_EQ(frame.pairs, 4u);
  EXPECT_EQ(frame.flips, 2u);
  EXPECT_EQ(counter.flipped(), (std::vector<std::uint32_t>{0, 1}));
}

TEST(Flips, AChangeThatTheTruthSharesIsNone) {
  FlipCounter counter;
  counter.add(std::vector<PointState>{kBoth, kSeen, kTruth, kLit});
  const StabilityFrame frame = counter.add(std::vector<PointState>{kSeen, kBoth, kLit, kTruth});
  EXPECT_EQ(frame.pairs, 4u);
  EXPECT_EQ(frame.flips, 0u);
}

TEST(Flips, ATruthThatChangesAloneIsNone) {
  FlipCounter counter;
  counter.add(std::vector<PointState>{kSeen});
  EXPECT_EQ(counter.add(std::vector<PointState>{kTruth}).flips, 0u);
}

TEST(Flips, OnlyPointsSeenInBothFramesFromOneSideCount) {
  FlipCounter counter;
  const PointState back = kPointBack;
  counter.add(std::vector<PointState>{kLit, 0, kLit, kLit, PointState(kLit | back)});
  const StabilityFrame frame = counter.add(
      std::vector<PointState>{0, kLit, PointState(kSeen | back), kSeen, PointState(kSeen | back)});
  EXPECT_EQ(frame.pairs, 2u);
  EXPECT_EQ(frame.flips, 2u);
  EXPECT_EQ(counter.flipped(), (std::vector<std::uint32_t>{3, 4}));
}

TEST(Flips, ComparesWithTheFrameJustBefore) {
  FlipCounter counter;
  std::vector<std::uint64_t> flips;
  for (const PointState state : {kLit, kSeen, kSeen, kLit, PointState(0), kSeen, kLit})
    flips.push_back(counter.add(std::vector<PointState>{state}).flips);
  EXPECT_EQ(flips, (std::vector<std::uint64_t>{0, 1, 0, 1, 0, 0, 1}));
}

TEST(Flips, WrongAnswersAreCountedWherePointsAreSeen) {
  FlipCounter counter;
  const StabilityFrame frame =
      counter.add(std::vector<PointState>{kBoth, kSeen, kLit, kTruth, kPointLit, kPointTruthLit});
  EXPECT_EQ(frame.seen, 4u);
  EXPECT_EQ(frame.wrong, 2u);
}

TEST(Flips, RatesAreSharesOfPairs) {
  const StabilityResult result =
      summed({{.frame = 0, .pairs = 0, .flips = 0, .seen = 10, .wrong = 1, .dark = 4, .bleed = 1, .drawn = 3},
              {.frame = 1,
               .pairs = 8,
               .flips = 2,
               .seen = 10,
               .wrong = 2,
               .texelJump = 0.5,
               .pixels = 90,
               .wrongPixels = 9},
              {.frame = 2,
               .pairs = 2,
               .flips = 1,
               .seen = 5,
               .wrong = 2,
               .dark = 6,
               .bleed = 0,
               .texelJump = 0.25,
               .pixels = 30,
               .wrongPixels = 9}});
  EXPECT_DOUBLE_EQ(result.flipRate, 0.3);
  EXPECT_DOUBLE_EQ(result.pop, 0.5);
  EXPECT_DOUBLE_EQ(result.wrongRate, 0.2);
  EXPECT_DOUBLE_EQ(result.wrongPixels, 0.15);
  EXPECT_DOUBLE_EQ(result.texelJump, 0.5);
  EXPECT_DOUBLE_EQ(result.bleed, 0.1) << "of all dark points";
  EXPECT_DOUBLE_EQ(result.drawn, 1) << "a mean of the frames";
  EXPECT_EQ(summed({}).flipRate, 0);
}

// --- Paths

TEST(Paths, BeginAndEndAtTheirKeys) {
  const std::vector<View> keys{{.eye = {0, 1, 0}, .target = {1, 1, 1}, .verticalFovDegrees = 40},
                               {.eye = {0.1, 7, 3}, .target = {1, 1, 1}, .verticalFovDegrees = 50},
                               {.eye = {0.7, 1, 0.3}, .target = {2, 0.1, 1}, .verticalFovDegrees = 63}};
  for (const unsigned frames : {2u, 3u, 7u, 240u}) {
    const auto views = viewsAlong(keys, frames);
    ASSERT_TRUE(views) << views.error().message;
    ASSERT_EQ(views->size(), frames);
    EXPECT_EQ(views->front().eye, keys.front().eye);
    EXPECT_EQ(views->back().eye, keys.back().eye);
    EXPECT_EQ(views->back().target, keys.back().target);
    EXPECT_EQ(views->back().verticalFovDegrees, 63);
  }
  const auto five = viewsAlong(keys, 5);
  EXPECT_EQ((*five)[2].eye, keys[1].eye);
  EXPECT_EQ((*five)[1].eye, glm::dvec3(0.05, 4, 1.5));
  EXPECT_EQ((*viewsAlong(keys, 1))[0].eye, keys[0].eye);
}

TEST(Paths, StandStillExactlyBetweenEqualKeys) {
  const View view{.eye = {0.1, 0.7, 0.3}, .target = {1.1, 0.9, 0.7}};
  const auto views = viewsAlong(std::vector{view, view, view}, 11);
  ASSERT_TRUE(views);
  for (const View& v : *views) EXPECT_TRUE(v.eye == view.eye && v.target == view.target);
}

TEST(Paths, SayWhereTheyCannotBeFollowed) {
  const View ahead{.eye = {0, 0, 0}, .target = {0, 0, -1}}, behind{.eye = {0, 0, 0}, .target = {0, 0, 1}};
  const auto views = viewsAlong(std::vector{ahead, behind}, 3);
  ASSERT_FALSE(views);
  EXPECT_EQ(views.error().code, ErrorCode::invalidArgument);
  EXPECT_NE(views.error().message.find("keys 0 and 1"), std::string::npos) << views.error().message;
  EXPECT_FALSE(viewsAlong({}, 3));
}

TEST(Paths, LightsTurnFromKeyToKey) {
  const std::vector<Light> keys{{.direction = {1, 0, 0}}, {.direction = {0, -1, 0}}};
  const auto lights = lightsAlong(keys, 3);
  ASSERT_TRUE(lights) << lights.error().message;
  EXPECT_EQ(lights->front().direction, keys[0].direction);
  EXPECT_EQ(lights->back().direction, keys[1].direction);
  EXPECT_NEAR((*lights)[1].direction.x, std::numbers::sqrt2 / 2, 1e-12);
  EXPECT_NEAR(glm::length((*lights)[1].direction), 1, 1e-12);

  EXPECT_FALSE(lightsAlong(std::vector<Light>{{.direction = {1, 0, 0}}, {.direction = {-1, 0, 0}}}, 3));
  const auto mixed = lightsAlong(std::vector<Light>{{.kind = LightKind::spot}, {}}, 3);
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().message.find("kinds"), std::string::npos);
}

// --- Points

TEST(Points, AreSpreadByArea) {
  // Two pixels of equal depth, one facing the camera, one at an angle that makes its surface four times as
  // large.
  shared::FrameConstants constants{};
  constants.clipFromWorld[2][3] = -1;  // looks along -z; w is the depth
  constants.wsRayPerPixelX = {1, 0, 0};
  constants.wsRayPerPixelY = {0, 1, 0};
  const float slant = 0.25f;
  std::vector<shared::ViewSample> samples;
  for (int i = 0; i < 20000; ++i)
    samples.push_back(
        {.wsPosition = {0, 0, -1},
         .instance = 0,
         .wsNormal = i % 2 ? glm::vec3(0, 0, 1) : glm::vec3(std::sqrt(1 - slant * slant), 0, slant),
         .triangle = 0});
  Scene scene;
  scene.clusters.push_back({.firstIndex = 0, .indexCount = 3, .material = 0});
  scene.materials.emplace_back();
  PointChooser chooser(1000, 7);
  chooser.add(0, samples, constants, glm::dvec3(0));
  int large = 0;
  const auto points = chooser.take(scene);
  ASSERT_EQ(points.size(), 1000u);
  for (const SurfacePoint& point : points) large += point.normal.x > 0.5f;
  EXPECT_NEAR(large, 800, 50);
}

// --- Whole runs

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

TEST(StabilityCases, NameWhatIsThere) {
  for (const StabilityCase& row : stabilityCases()) {
    SCOPED_TRACE(row.name);
    for (const std::string_view name : {row.scene, row.twinScene}) {
      if (name.empty()) continue;
      ASSERT_TRUE(name.starts_with("builtin:"));
      const auto scene = makeBuiltin(name.substr(8));
      ASSERT_TRUE(scene) << scene.error().message;
      const auto has = [](const auto& all, std::string_view wanted) {
        return std::ranges::any_of(all, [&](const auto& one) { return one.name == wanted; });
      };
      EXPECT_EQ(row.path.empty(), !row.view.empty());
      EXPECT_TRUE(row.path.empty() || has(scene->paths, row.path));
      EXPECT_TRUE(row.view.empty() || has(scene->views, row.view));
      EXPECT_TRUE(has(scene->lights, row.light));
    }
  }
}

}  // namespace
}  // namespace sundial
