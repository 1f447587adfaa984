// A view, light or size that can't be rendered is refused by name; the renderer goes on rendering.
#include <functional>
#include <limits>

#include "support/rendering.h"

namespace sundial::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class BadRequest : public RendererTest {
 protected:
  static RenderJob good() {
    static const auto scene = builtin("grid");
    return jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {32, 32}, {"dv,texels=64"},
                 {Aov::visibility}, true);
  }
  // Expects invalidArgument whose message holds all of these words, and nothing sent before it.
  static void expectRefused(const std::function<void(RenderJob&)>& spoil,
                            std::initializer_list<std::string> words) {
    RenderJob job = good();
    spoil(job);
    Collector sink;
    const Result<void> done = renderer().run(job, {}, sink);
    ASSERT_FALSE(done) << *words.begin();
    EXPECT_EQ(done.error().code, ErrorCode::invalidArgument) << done.error().message;
    EXPECT_TRUE(sink.renderings.empty());
    for (const std::string& word : words)
      EXPECT_NE(done.error().message.find(word), std::string::npos)
          << "no \"" << word << "\" in: " << done.error().message;
  }
  void TearDown() override {
    EXPECT_EQ(render(good()).size(), 1u) << "the next job is served";
    RendererTest::TearDown();
  }
};

TEST_F(BadRequest, SizesOutsideTheRangeAreNamed) {
  for (const glm::uvec2 size :
       {glm::uvec2(0, 0), {0, 32}, {32, 0}, {8193, 1}, {1, 8193}, {100'000, 100'000}, {~0u, ~0u}})
    expectRefused([&](RenderJob& job) { job.size = size; },
                  {"size", fmt::format("{}x{}", size.x, size.y), "[1, 8192]"});
}

TEST_F(BadRequest, TheSmallestAndLongestImagesAreRendered) {
  for (const glm::uvec2 size : {glm::uvec2(1, 1), {1, 8192}, {8192, 1}, {33, 17}}) {
    RenderJob job = good();
    job.size = size;
    const auto renderings = render(job);
    EXPECT_EQ(renderings.at(0).images.at(Aov::visibility).bytes.size(), std::size_t{4} * size.x * size.y);
  }
}

TEST_F(BadRequest, NothingToRenderIsNamed) {
  expectRefused([](RenderJob& job) { job.scene = nullptr; }, {"scene"});
  expectRefused([](RenderJob& job) { job.methods.clear(); }, {"methods"});
}

TEST_F(BadRequest, ViewsThatAreNoNumbersAreNamed) {
  for (const double bad : {kNan, kInfinity, -kInfinity})
    for (const auto member : {&View::eye, &View::target, &View::up})
      for (int axis = 0; axis < 3; ++axis)
        expectRefused([&](RenderJob& job) { (job.view.*member)[axis] = bad; }, {"view", "finite"});
}

TEST_F(BadRequest, ViewsWithoutADirectionAreNamed) {
  expectRefused([](RenderJob& job) { job.view.target = job.view.eye; }, {"view", "target", "eye"});
  expectRefused([](RenderJob& job) { job.view.up = glm::dvec3(0); }, {"view", "up"});
  expectRefused([](RenderJob& job) { job.view.up = job.view.target - job.view.eye; },
                {"view", "up", "parallel"});
  expectRefused([](RenderJob& job) { job.view.up = job.view.eye - job.view.target; },
                {"view", "up", "parallel"});
}

TEST_F(BadRequest, FieldsOfViewOutsideTheRangeAreNamed) {
  for (const double fov : {0.0, -1.0, 180.0, 360.0, kNan, kInfinity})
    expectRefused([&](RenderJob& job) { job.view.verticalFovDegrees = fov; },
                  {"view", "fov", "(0, 180) degrees"});
}

TEST_F(BadRequest, LightsThatAreNoNumbersAreNamed) {
  for (const double bad : {kNan, kInfinity})
    for (const auto member : {&Light::direction, &Light::position})
      for (int axis = 0; axis < 3; ++axis)
        expectRefused([&](RenderJob& job) { (job.light.*member)[axis] = bad; }, {"light", "finite"});
}

TEST_F(BadRequest, LightsWithoutADirectionAreNamed) {
  expectRefused([](RenderJob& job) { job.light.direction = glm::dvec3(0); }, {"light", "direction"});
}

TEST_F(BadRequest, ConesOutsideTheRangeAreNamed) {
  for (const double cone : {0.0, -10.0, 170.5, 360.0, kNan})
    expectRefused([&](RenderJob& job) { job.light = {.kind = LightKind::spot, .coneDegrees = cone}; },
                  {"light", "cone", "(0, 170] degrees"});
}

TEST_F(BadRequest, MethodsThatLookOneWayAreRefusedAroundAPointLightAndCubesElsewhere) {
  for (const char* text : {"csm", "sdsm-log", "iasm", "evsm"})
    expectRefused(
        [&](RenderJob& job) {
          job.light = point({1, 4, 1});
          job.methods = {method(text)};
        },
        {text, "partition="});
  expectRefused([](RenderJob& job) { job.methods = {method("sm,partition=cube")}; },
                {"sm", "partition=cube", "point light", "partition=single"});
  expectRefused(
      [](RenderJob& job) {
        job.light = point({1, 4, 1});
        job.baseline = method("csm");
      },
      {"baseline", "csm", "partition=manual"});
}

TEST_F(BadRequest, VectorsOfAnyLengthGiveTheSamePictureAsUnitVectors) {
  const std::vector<std::byte> expected = render(good())[0].images.at(Aov::visibility).bytes;
  for (const double length : {1e-140, 1e-3, 1e3, 1e140}) {
    RenderJob job = good();
    job.light.direction *= length;
    job.view.up *= length;
    const auto bytes = render(job)[0].images.at(Aov::visibility).bytes;
    std::size_t different = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 4)
      different += std::memcmp(&bytes[i], &expected[i], 4) != 0;
    EXPECT_LE(different, 2u) << length;
  }
}

// Their squares are no numbers.
TEST_F(BadRequest, VectorsTooLongOrTooShortToNormaliseAreNamed) {
  for (const double length : {1e-300, 1e200, 1e300}) {
    expectRefused([&](RenderJob& job) { job.light.direction *= length; }, {"light", "direction"});
    expectRefused([&](RenderJob& job) { job.view.up *= length; }, {"view", "up"});
  }
  for (const double length : {1e200, 1e300})
    expectRefused([&](RenderJob& job) { job.view.target *= length, job.view.target.x = length; },
                  {"view", "target", "eye"});
}

TEST_F(BadRequest, WhatIsStrangeButAllowedRendersFiniteMeasures) {
  for (const std::function<void(RenderJob&)>& bend : std::vector<std::function<void(RenderJob&)>>{
           [](RenderJob& job) { job.view.verticalFovDegrees = 1e-6; },
           [](RenderJob& job) { job.view.verticalFovDegrees = 179.999; },
           [](RenderJob& job) {
             job.view.eye = {1e9, 1e9, 1e9};
           },
           [](RenderJob& job) {
             job.view.target = {1e9, -1e9, 1e9};
           },
           [](RenderJob& job) {
             job.light = spot({1.5, 9, 2.5}, {0, 0, 0}, 1e-3);
           },
           [](RenderJob& job) {
             job.light = spot({1.5, 9, 2.5}, {0, 0, 0}, 170);
           },
           [](RenderJob& job) {
             job.light = spot({0, 0, 0}, {1, 0, 0}, 90);
           },  // in the ground's plane
           [](RenderJob& job) {
             job.light = spot({0, -1e6, 0}, {0, -2e6, 0}, 90);
           },
           [](RenderJob& job) {
             job.light = {.kind = LightKind::point, .direction = {0, 0, 0}, .position = {0, 0, 0}};
           },  // in the ground
           [](RenderJob& job) {
             job.light = point({0, -1e6, 0});
           },
           [](RenderJob& job) { job.light = point(job.view.eye); },
           [](RenderJob& job) {
             job.light.direction = {1, 0, 0};
           },  // along the ground
           [](RenderJob& job) {
             job.light.direction = {0, 1, 0};
           }}) {  // from below
    RenderJob job = good();
    bend(job);
    job.methods.push_back(method("sm,texels=64,lookup=pcf"));
    job.methods.push_back(method("ray-traced"));
    for (const Rendering& r : render(job)) {
      const Measures& m = *r.result.measures;
      for (const double value : {m.pixelMatch, m.falseLit, m.falseShadow, m.meanAbsError, m.interiorError,
                                 m.edgeErrorPx.max, m.texelPx.p50, m.utilisation})
        EXPECT_TRUE(std::isfinite(value)) << r.result.method.label() << " " << value;
    }
  }
}

}  // namespace
}  // namespace sundial::test
