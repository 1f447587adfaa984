// Partitions along the camera's depth: the cuts against closed forms and a plain k-means, the boxes against
// brute force, and what doesn't depend on who knows the plan.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr glm::uvec2 kSize{320, 200};

double depthOf(const View& view, const dvec3& position) {
  return glm::dot(position - view.eye, glm::normalize(view.target - view.eye));
}

// The depths at which partitions end and begin: one more than partitions.
std::vector<double> cutsOf(const Rendering& r) {
  std::vector<double> cuts{r.plan.at(0).gpu.depthBegin};
  for (const PlanView& view : r.plan) cuts.push_back(view.gpu.depthEnd);
  return cuts;
}

void expectCuts(const std::vector<double>& cuts, const std::vector<double>& expected,
                double tolerance = 1e-4) {
  ASSERT_EQ(cuts.size(), expected.size());
  for (std::size_t i = 0; i < cuts.size(); ++i)
    EXPECT_NEAR(cuts[i], expected[i], tolerance * expected[i]) << "cut " << i;
}

// Depths of the samples that face the light.
std::vector<double> depthsOf(const Rendering& r, const View& view, const Light& light) {
  std::vector<double> depths;
  for (std::size_t i = 0; i < r.pixels(); ++i)
    if (r.seen(i) && glm::dot(r.normal(i), light.direction) < -1e-6)
      depths.push_back(depthOf(view, r.position(i)));
  return depths;
}

double practical(double near, double far, double share, double lambda) {
  return lambda * near * std::pow(far / near, share) + (1 - lambda) * (near + (far - near) * share);
}

struct Place {
  std::shared_ptr<const Scene> scene;
  View view;
  Light light;
};

Place place(std::string_view scene, std::string_view view, std::string_view light) {
  const auto made = builtin(scene);
  return {made, viewOf(*made, view), lightOf(*made, light)};
}

class FramePartitions : public RendererTest {
 protected:
  static Rendering at(const Place& p, std::string_view method) {
    return render(p.scene, p.view, p.light, kSize, method);
  }
};

TEST_F(FramePartitions, FormulasOfCutsHold) {
  const Place p = place("trees?count=40", "walk", "sun");
  double far = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Bounds& b = p.scene->bounds;
    far = std::max(far, depthOf(p.view, {corner & 1 ? b.max.x : b.min.x, corner & 2 ? b.max.y : b.min.y,
                                         corner & 4 ? b.max.z : b.min.z}));
  }
  for (const unsigned parts : {1u, 2u, 5u, 8u})
    for (const auto& [choice, lambda] : {std::pair("partition=uniform", 0.0),
                                         {"partition=log", 1.0},
                                         {"partition=practical,lambda=0.7", 0.7}}) {
      SCOPED_TRACE(fmt::format("{} {}", choice, parts));
      std::vector<double> expected;
      for (unsigned i = 0; i <= parts; ++i)
        expected.push_back(practical(0.5, far, static_cast<double>(i) / parts, lambda));
      expectCuts(cutsOf(at(p, fmt::format("pssm,{},partitions={},near=0.5,texels=64", choice, parts))),
                 expected);
    }
  const std::vector<double> byHand = cutsOf(at(p, "csm,splits=4:12:40,texels=64"));
  EXPECT_EQ((std::vector<double>(byHand.begin() + 1, byHand.end())), (std::vector<double>{4, 12, 40}));
}

TEST_F(FramePartitions, SampleDistributionCutsBetweenTheNearestAndTheFarthestSample) {
  for (const Place& p : {place("trees?count=40", "walk", "sun"), place("atrium", "main", "low")}) {
    const Rendering r = at(p, "sdsm-log,texels=64");
    const auto depths = depthsOf(r, p.view, p.light);
    const auto [near, far] = std::ranges::minmax(depths);
    std::vector<double> expected;
    for (unsigned i = 0; i <= 4; ++i) expected.push_back(practical(near, far, i / 4.0, 1));
    expectCuts(cutsOf(r), expected, 1e-3);
    // Each sample was counted in its partition.
    for (std::size_t v = 0; v < 4; ++v) {
      const auto inside = std::ranges::count_if(depths, [&](double d) {
        return (v == 0 || d >= r.plan[v].gpu.depthBegin) && (v == 3 || d < r.plan[v].gpu.depthEnd);
      });
      EXPECT_NEAR(r.plan[v].gpu.sampleCount, inside, 2 + 1e-3 * static_cast<double>(inside)) << v;
    }
  }
}

// A wall of two parts, near and far, and nothing between.
Place gapped() {
  SceneBuilder builder("gapped");
  const std::uint32_t material = builder.addMaterial(
      {.name = "grey", .gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto wall = [&](float x0, float x1, float z) {
    const float half = 0.8f * z;
    const Primitive square{.positions = {{x0 * half, -half, -z},
                                         {x1 * half, -half, -z},
                                         {x1 * half, half, -z - 0.02f * z},
                                         {x0 * half, half, -z - 0.02f * z}},
                           .uvs = {},
                           .colours = {},
                           .indices = {0, 1, 2, 0, 2, 3},
                           .material = material};
    builder.addInstance("wall", builder.addMesh("wall", {square}), glm::dmat4(1));
  };
  wall(-1, 0, 2);
  wall(0, 1, 60);
  return {sharedScene(std::move(builder).finish()), View{.eye = {0, 0, 0}, .target = {0, 0, -1}},
          Light{.direction = glm::normalize(dvec3(0.3, -0.4, -1))}};
}

TEST_F(FramePartitions, AdaptiveCutsSkipAGap) {
  const Place p = gapped();
  // Logarithmic cuts from 2 to 61 m fall into nothing: 4.7, 11 and 26 m.
  const auto logarithmic = at(p, "sdsm-log,texels=64");
  EXPECT_EQ(logarithmic.plan.at(1).gpu.empty, 1u);
  EXPECT_EQ(logarithmic.plan.at(2).gpu.empty, 1u);
  const auto adaptive = at(p, "sdsm-adaptive,texels=64");
  const auto cuts = cutsOf(adaptive);
  EXPECT_GT(cuts[1], 55) << "the first cut moves to the gap's end";
  std::size_t samples = 0, filled = 0;
  for (const PlanView& view : adaptive.plan) {
    samples += view.gpu.sampleCount;
    filled += view.gpu.sampleCount > 0;
  }
  EXPECT_EQ(samples, depthsOf(adaptive, p.view, p.light).size());
  EXPECT_GE(filled, 3u) << "what the gap held is free for the far wall";
}

// Weighted k-means on the logarithm of depth, over the same bins.
std::vector<double> clusterCuts(const std::vector<double>& depths, double near, double far, unsigned parts) {
  constexpr double kBins = shared::kDepthBins;
  const auto binOf = [&](double d) {
    return std::floor(std::clamp(std::log2(d / near) / std::log2(far / near) * kBins, 0.0, kBins - 1));
  };
  std::vector<double> weights(shared::kDepthBins);
  for (const double d : depths) ++weights[static_cast<std::size_t>(binOf(d))];
  const auto [low, high] = std::ranges::minmax(depths);
  std::vector<double> means;
  for (unsigned i = 0; i < parts; ++i)
    means.push_back(binOf(practical(low, high, (i + 0.5) / parts, 1)) + 0.5);
  for (int round = 0; round < 16; ++round) {
    std::vector<double> sum(parts), count(parts);
    for (std::size_t bin = 0; bin < weights.size(); ++bin) {
      const double centre = static_cast<double>(bin) + 0.5;
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < parts; ++i)
        if (std::abs(centre - means[i]) <= std::abs(centre - means[nearest])) nearest = i;
      sum[nearest] += weights[bin] * centre;
      count[nearest] += weights[bin];
    }
    for (std::size_t i = 0; i < parts; ++i)
      if (count[i] > 0) means[i] = sum[i] / count[i];
  }
  std::vector<double> cuts{low};
  for (unsigned i = 1; i < parts; ++i)
    cuts.push_back(
        std::clamp(near * std::pow(far / near, 0.5 * (means[i - 1] + means[i]) / kBins), low, high));
  cuts.push_back(high);
  return cuts;
}

TEST_F(FramePartitions, ClustersAreThoseOfAPlainKMeans) {
  for (const Place& p : {place("trees?count=40", "walk", "sun"), place("atrium", "main", "sun"), gapped()}) {
    const Rendering r = at(p, "sdsm-kmeans,texels=64");
    double far = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Bounds& b = p.scene->bounds;
      far = std::max(far, depthOf(p.view, {corner & 1 ? b.max.x : b.min.x, corner & 2 ? b.max.y : b.min.y,
                                           corner & 4 ? b.max.z : b.min.z}));
    }
    const double near = std::min(0.02, 1e-3 * p.scene->bounds.diagonal());
    // A sample on a bin's edge may fall to either side.
    expectCuts(cutsOf(r), clusterCuts(depthsOf(r, p.view, p.light), near, far, 4), 0.01);
  }
}

TEST_F(FramePartitions, BoxesHoldTheirSamplesAndAreTight) {
  const Place p = place("trees?count=40", "walk", "low");
  for (const char* method :
       {"sdsm-log,texels=256", "sdsm-kmeans,texels=256x128,focus=aabb", "sdsm-snapped,texels=256"}) {
    SCOPED_TRACE(method);
    const Rendering r = at(p, method);
    const bool snapped = r.result.method.stages->focus == Focus::snapped;
    for (std::size_t v = 0; v < r.plan.size(); ++v) {
      const PlanView& view = r.plan[v];
      if (view.gpu.empty) continue;
      dvec2 low(2), high(-2);
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        if (!r.seen(i) || glm::dot(r.normal(i), p.light.direction) > -1e-6) continue;
        const double depth =
            snapped ? glm::distance(r.position(i), p.view.eye) : depthOf(p.view, r.position(i));
        const double slack = 1e-5 * depth;
        if ((v > 0 && depth < view.gpu.depthBegin + slack) || (v < 3 && depth > view.gpu.depthEnd - slack))
          continue;
        const dvec4 clip = view.shadowFromWorld * dvec4(r.position(i), 1);
        low = glm::min(low, dvec2(clip) / clip.w);
        high = glm::max(high, dvec2(clip) / clip.w);
        EXPECT_TRUE(clip.z >= -1e-6 && clip.z <= 1 + 1e-6) << clip.z;
      }
      const dvec2 texel = 2.0 / dvec2(view.gpu.rectSize);
      EXPECT_TRUE(low.x >= -1 && low.y >= -1 && high.x <= 1 && high.y <= 1) << v;
      // Powers of two waste up to half of a side, and snapping a texel at each rim.
      const dvec2 unused = snapped ? dvec2(1.02) + 4.0 * texel : 4.0 * texel;
      EXPECT_TRUE(high.x - low.x >= 2 - unused.x && high.y - low.y >= 2 - unused.y)
          << v << " " << low.x << " " << high.x << " " << low.y << " " << high.y;
    }
  }
}

TEST_F(FramePartitions, SnappedTexelsArePowersOfTwoOnAGridOfTheWorld) {
  const Place p = place("trees?count=40", "walk", "sun");
  for (const dvec3& step : {dvec3(0), dvec3(0.013, 0, 0.027), dvec3(-0.4, 0.1, 0.3)}) {
    View moved = p.view;
    moved.eye += step;
    moved.target += step;
    const Rendering r = render(p.scene, moved, p.light, kSize, "sdsm-snapped,texels=256");
    for (const PlanView& view : r.plan) {
      if (view.gpu.empty) continue;
      const double octave = std::log2(view.gpu.texelSize.x);
      EXPECT_NEAR(octave, std::round(octave), 1e-3);
      // The world's origin lies on the corner of a texel of every map, or would if the map reached that far.
      const dvec4 clip = view.shadowFromWorld * dvec4(0, 0, 0, 1);
      const dvec2 texel = (0.5 * dvec2(clip) / clip.w + 0.5) * dvec2(view.gpu.rectSize);
      EXPECT_NEAR(texel.x, std::round(texel.x), 0.02);
      EXPECT_NEAR(texel.y, std::round(texel.y), 0.02);
    }
  }
}

TEST_F(FramePartitions, BlendingChangesAnswersInItsBandAlone) {
  const Place p = place("trees?count=40", "walk", "sun");
  for (const std::string method : {"csm,texels=256,choose=depth", "sdsm-log,texels=256,choose=depth"}) {
    const Rendering hard = at(p, method), blended = at(p, method + ",blend=0.4");
    std::size_t inBand = 0, between = 0, outsideDifferent = 0;
    for (std::size_t i = 0; i < hard.pixels(); ++i) {
      if (!hard.answered(i)) continue;
      const double depth = depthOf(p.view, hard.position(i));
      bool band = false;
      for (std::size_t v = 0; v + 1 < hard.plan.size(); ++v) {
        const double begin = hard.plan[v].gpu.depthBegin, end = hard.plan[v].gpu.depthEnd;
        band = band || (depth > end - 0.4 * (end - begin) && depth < end);
      }
      inBand += band;
      between += blended.visibility(i) > 0 && blended.visibility(i) < 1;
      outsideDifferent += !band && blended.visibility(i) > 0 && blended.visibility(i) < 1;
    }
    EXPECT_GT(inBand, 1000u) << method;
    EXPECT_GT(between, 20u) << method << ": the two maps disagree somewhere";
    EXPECT_EQ(outsideDifferent, 0u) << method;
  }
}

TEST_F(FramePartitions, ByDepthOrTheTightestThatContainsTheSample) {
  const Place p = place("trees?count=40", "walk", "sun");
  const Rendering byDepth = at(p, "sdsm-log,texels=256,choose=depth");
  const Rendering tightest = at(p, "sdsm-log,texels=256,choose=tightest");
  const auto area = [](const PlanView& view) { return view.gpu.texelSize.x * view.gpu.texelSize.y; };
  std::size_t wrongDepth = 0, looser = 0, tighter = 0;
  for (std::size_t i = 0; i < byDepth.pixels(); ++i) {
    if (!byDepth.answered(i) || !tightest.answered(i)) continue;
    const PlanView& its = byDepth.plan[byDepth.at<std::uint32_t>(Aov::view, i)];
    const double depth = depthOf(p.view, byDepth.position(i)), slack = 1e-4 * depth;
    wrongDepth += depth < its.gpu.depthBegin - slack || depth > its.gpu.depthEnd + slack;
    const PlanView& other = tightest.plan[tightest.at<std::uint32_t>(Aov::view, i)];
    looser += area(other) > area(its);
    tighter += area(other) < area(its);
  }
  EXPECT_EQ(wrongDepth, 0u);
  EXPECT_EQ(looser, 0u);
  EXPECT_GT(tighter, 100u);
}

TEST_F(FramePartitions, WhoKnowsThePlanChangesNothing) {
  for (const Place& p : {place("trees?count=40", "main", "sun"), place("atrium", "main", "spot")})
    for (const char* method :
         {"sdsm-log,texels=256", "csm,texels=256", "iasm", "dv,texels=256", "sm,texels=256"}) {
      const Rendering gpu = at(p, method), readback = at(p, fmt::format("{},plan=readback", method));
      EXPECT_EQ(readback.images.at(Aov::visibility).bytes, gpu.images.at(Aov::visibility).bytes) << method;
      EXPECT_EQ(readback.images.at(Aov::colour).bytes, gpu.images.at(Aov::colour).bytes) << method;
      EXPECT_EQ(readback.work("store", "primitives"), gpu.work("store", "primitives")) << method;
      EXPECT_GT(readback.result.totalBytes, gpu.result.totalBytes) << method;
    }
}

TEST_F(FramePartitions, DelayedPlansOfAStillCameraAreItsOwn) {
  const Place p = place("trees?count=40", "main", "sun");
  for (const char* method : {"sdsm-log,texels=256", "iasm", "dv,texels=256"}) {
    RenderJob job = jobOf(p.scene, p.view, p.light, kSize, {}, kAllImages, true);
    job.methods = {test::method(method), test::method(fmt::format("{},plan=delayed", method))};
    job.repetitions = 2;
    const auto renderings = render(job);
    EXPECT_EQ(renderings[1].images.at(Aov::visibility).bytes, renderings[0].images.at(Aov::visibility).bytes)
        << method;
  }
}

TEST_F(FramePartitions, OneSampleAndAllSamplesInOnePartition) {
  const Place p = gapped();
  for (const char* method : {"sdsm-log,texels=64", "sdsm-adaptive,texels=64", "sdsm-kmeans,texels=64",
                             "sdsm-snapped,texels=64", "iasm", "iasm,focus=aabb", "pssm,texels=64"}) {
    SCOPED_TRACE(method);
    const Rendering one = render(p.scene, p.view, p.light, {1, 1}, method);
    EXPECT_EQ(one.visibility(0), 1);
    EXPECT_EQ(one.result.measures->pixelMatch, 1);
    // A wall at one depth: every sample has the same partition.
    const View facing{.eye = {20, 0, -58}, .target = {20, 0, -59}, .verticalFovDegrees = 1};
    const Rendering all = render(p.scene, facing, p.light, kSize, method);
    for (std::size_t i = 0; i < all.pixels(); ++i) ASSERT_EQ(all.visibility(i), 1) << i;
    EXPECT_EQ(all.result.measures->pixelMatch, 1);
  }
}

TEST_F(FramePartitions, AnEmptyViewDrawsNothing) {
  const auto scene = builtin("grid");
  View sky = viewOf(*scene, "main");
  sky.target = sky.eye + dvec3(0.2, 1, 0);
  for (const char* method : {"sdsm-log,texels=64", "sdsm-adaptive,texels=64", "sdsm-kmeans,texels=64",
                             "sdsm-snapped,texels=64", "iasm", "iasm-forward", "iasm-delayed"})
    for (const char* light : {"sun", "spot"}) {
      const Rendering r = render(scene, sky, lightOf(*scene, light), {64, 64}, method);
      SCOPED_TRACE(fmt::format("{} {}", method, light));
      EXPECT_EQ(r.work("store", "primitives"), 0);
      for (const PlanView& view : r.plan) EXPECT_EQ(view.gpu.empty, 1u);
      EXPECT_EQ(r.result.measures->pixelMatch, 1);
    }
}

}  // namespace
}  // namespace sundial::test
