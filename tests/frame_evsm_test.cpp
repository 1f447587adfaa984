// Exponential variance shadow maps: no acne, no light in deep shadow, little bleeding, and edges as soft in
// metres whatever partition answers.
#include <algorithm>
#include <cmath>

#include "support/fingerprint.h"

namespace sundial::test {
namespace {

using glm::dvec3;

constexpr glm::uvec2 kSize{320, 256};
const Light kNoon{.direction = {0, -1, 0}};

// Squares across y: the middle of each, and half its sides along x and z.
struct Square {
  dvec3 middle;
  float halfX, halfZ;
};

std::shared_ptr<const Scene> squares(const std::vector<Square>& list) {
  SceneBuilder builder("squares");
  const std::uint32_t material = builder.addMaterial(
      {.name = "grey", .gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  for (const auto& [middle, x, z] : list) {
    const Primitive square{.positions = {{-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z}},
                           .uvs = {},
                           .colours = {},
                           .indices = {0, 1, 2, 0, 2, 3},
                           .material = material};
    glm::dmat4 place(1);
    place[3] = glm::dvec4(middle, 1);
    builder.addInstance("square", builder.addMesh("square", {square}), place);
  }
  return sharedScene(std::move(builder).finish());
}

// Of the samples that face the light and satisfy `where`.
struct Lit {
  std::size_t count = 0;
  double least = 1, most = 0, mean = 0;
};

template <class Where>
Lit litWhere(const Rendering& r, Where where) {
  Lit lit;
  for (std::size_t i = 0; i < r.pixels(); ++i) {
    if (!r.answered(i) || !where(i)) continue;
    const double v = r.visibility(i);
    ++lit.count;
    lit.least = std::min(lit.least, v);
    lit.most = std::max(lit.most, v);
    lit.mean += v;
  }
  lit.mean /= static_cast<double>(std::max<std::size_t>(lit.count, 1));
  return lit;
}

class FrameEvsm : public RendererTest {};

TEST_F(FrameEvsm, APlaneAloneIsLitAtEveryAngle) {
  const auto scene = squares({{{0, 0, 0}, 20, 20}});
  const View view{.eye = {6, 3, 14}, .target = {0, 0, 0}};
  for (const Light& light : {kNoon, sun(70, 20), sun(35, 130), sun(15, 250), sun(5, 310), sun(3, 45),
                             spot({4, 6, -3}, {0, 0, 0}, 90), spot({15, 2, 0}, {-10, 0, 0}, 60)})
    for (const char* method : {"evsm,texels=256", "evsm,texels=256,blur=0.5", "sdsm-evsm,texels=256",
                               "sdsm-evsm,texels=128,blur=0.3", "sdsm-evsm,texels=512x128,anisotropy=1"}) {
      SCOPED_TRACE(fmt::format("{}, light towards {} {}", method, light.direction.x, light.direction.y));
      const Lit lit = litWhere(render(scene, view, light, kSize, method), [](std::size_t) { return true; });
      EXPECT_GT(lit.count, kSize.x * kSize.y / 20);
      EXPECT_GE(lit.least, 0.97);
    }
}

TEST_F(FrameEvsm, DeepInsideAShadowThereIsNoLight) {
  const auto scene = squares({{{0, 0, 0}, 20, 20}, {{0, 2, 0}, 5, 5}});
  const View view{.eye = {9, 1.5, 9}, .target = {0, 0, 0}};
  for (const Light& light : {kNoon, sun(60, 30), spot({1, 12, 2}, {0, 0, 0}, 80)})
    for (const char* method :
         {"evsm,texels=512", "evsm,texels=512,blur=0.5", "sdsm-evsm", "sdsm-evsm,texels=256,blur=0.5",
          "sdsm-evsm,texels=256,volume=frustum,focus=loose", "dv,texels=256,storage=moments,lookup=evsm",
          "sdsm-snapped,texels=256,storage=moments,lookup=evsm,blur=0.2"}) {
      SCOPED_TRACE(fmt::format("{}, light towards {} {}", method, light.direction.x, light.direction.y));
      const Rendering r = render(scene, view, light, kSize, method);
      // Where the light that reaches a point on the ground crosses the caster's height.
      const Lit lit = litWhere(r, [&](std::size_t i) {
        const dvec3 p = r.position(i);
        const dvec3 along = light.kind == LightKind::spot ? p - light.position : light.direction;
        const dvec3 crossing = p - along * (2 - p.y) / -along.y * 1.0;
        return p.y < 0.1 && std::max(std::abs(crossing.x), std::abs(crossing.z)) < 4;
      });
      EXPECT_GT(lit.count, 1000u);
      EXPECT_LE(lit.most, 0.02);
    }
}

// A low roof over the ground, and high above it the edge of another: at the edge the map holds both.
TEST_F(FrameEvsm, BleedReductionTakesMostOfTheLightThatLeaksUnderTwoCasters) {
  const auto scene = squares({{{0, 0, 0}, 30, 30}, {{0, 1, 0}, 20, 20}, {{15, 100, 0}, 15, 30}});
  const View view{.eye = {1, 0.7, 9}, .target = {0, 0.2, 0}};
  const auto leaked = [&](std::string_view method) {
    const Rendering r = render(scene, view, kNoon, kSize, method);
    const Lit lit = litWhere(r, [&](std::size_t i) {
      return r.position(i).y < 0.1 && std::abs(r.position(i).x) < 1 && r.reference(i) == 0;
    });
    EXPECT_GT(lit.count, 1000u);
    return lit.mean;
  };
  for (const std::string name : {"evsm,texels=512,blur=1", "sdsm-evsm,texels=256,blur=1"}) {
    const double plain = leaked(name + ",bleed_reduction=0"), reduced = leaked(name);
    EXPECT_GT(plain, 0.01) << name;
    EXPECT_LE(reduced, plain / 3) << name;
  }
}

// How far it is from 10 % to 90 % of the light across an edge along z at x = 0, metres, for the samples that
// a view answers.
double edgeWidth(const Rendering& r, std::uint32_t view) {
  constexpr double kReach = 1.5, kBin = 0.05;
  constexpr auto kBins = static_cast<std::size_t>(2 * kReach / kBin);
  std::vector<double> sums(kBins), counts(kBins);
  for (std::size_t i = 0; i < r.pixels(); ++i) {
    const double x = r.position(i).x;
    if (!r.answered(i) || r.at<std::uint32_t>(Aov::view, i) != view || std::abs(x) >= kReach ||
        r.position(i).y > 0.1)
      continue;
    const auto bin = static_cast<std::size_t>((x + kReach) / kBin);
    sums[bin] += r.visibility(i);
    ++counts[bin];
  }
  std::size_t between = 0;  // an edge rises once
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    EXPECT_GT(counts[bin], 0) << "no sample of view " << view << " at "
                              << static_cast<double>(bin) * kBin - kReach;
    const double lit = sums[bin] / std::max(counts[bin], 1.0);
    between += lit > 0.1 && lit < 0.9;
  }
  return static_cast<double>(between) * kBin;
}

TEST_F(FrameEvsm, EdgesAreAsSoftInEveryPartition) {
  const auto scene = squares({{{0, 0, -40}, 12, 60}, {{10, 4, -40}, 10, 60}});
  const View view{.eye = {-3, 2.5, 12}, .target = {-0.5, 0, 0}};
  for (const double blur : {0.6, 1.5}) {
    std::vector<double> widths;
    const Rendering cut =
        render(scene, view, kNoon, {640, 480},
               fmt::format("sdsm-evsm,texels=512,partitions=3,choose=depth,bleed_reduction=0,blur={}", blur));
    ASSERT_EQ(cut.plan.size(), 3u);
    for (std::uint32_t part = 0; part < 3; ++part) widths.push_back(edgeWidth(cut, part));
    const Rendering whole = render(scene, view, kNoon, {640, 480},
                                   fmt::format("evsm,texels=2048,bleed_reduction=0,blur={}", blur));
    widths.push_back(edgeWidth(whole, 0));
    // A box's edge is linear.
    for (const double width : widths) EXPECT_NEAR(width, 0.8 * blur, 0.15 * 0.8 * blur) << "blur " << blur;
  }
}

TEST_F(FrameEvsm, RepeatsExactly) {
  const auto scene = builtin("trees?count=40");
  const RenderJob job = jobOf(
      scene, viewOf(*scene, "walk"), lightOf(*scene, "low"), {160, 120},
      {"evsm,texels=256,blur=0.2", "sdsm-evsm,texels=256,blur=0.1", "sdsm-evsm,texels=128,plan=readback"},
      kAllImages, true);
  const std::string once = fingerprint(renderer(), job);
  EXPECT_EQ(fingerprint(renderer(), job), once);
}

// Half a kilometre of scene, and a view of nothing.
TEST_F(FrameEvsm, StaysFiniteFarAwayAndWhereThereIsNothing) {
  const auto scene = builtin("grid");
  View sky = viewOf(*scene, "main"), far = sky;
  sky.target = sky.eye + dvec3(0.2, 1, 0);
  far.eye += 500.0 * (far.eye - far.target);
  for (const char* light : {"sun", "spot"})
    for (const View& view : {sky, far})
      for (const Rendering& r :
           render(jobOf(scene, view, lightOf(*scene, light), {64, 48},
                        {"evsm,texels=64,blur=1", "sdsm-evsm,texels=100x37,blur=1000", "sdsm-evsm,texels=16"},
                        kAllImages, true))) {
        EXPECT_TRUE(std::isfinite(r.result.measures->meanAbsError));
        for (std::size_t i = 0; i < r.pixels(); ++i)
          ASSERT_TRUE(r.visibility(i) >= 0 && r.visibility(i) <= 1) << r.visibility(i);
      }
  const auto nothing = sharedScene(SceneBuilder("empty").finish());
  for (const Light& light : {kNoon, spot({0, 5, 0}, {0, 0, 0}, 60)})
    EXPECT_EQ(render(jobOf(nothing, defaultView(*nothing), light, {48, 32},
                           {"evsm,texels=64", "sdsm-evsm,texels=64"}, kAllImages, true))
                  .size(),
              2u);
}

// Four floats a texel and a third more for the levels, and four depths a texel of one map.
TEST_F(FrameEvsm, SaysWhatMemoryItTakesAndHowMuchItErrs) {
  const auto scene = builtin("atrium");
  const auto both =
      render(jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), kSize,
                   {"sm,texels=512", "evsm,texels=512", "sdsm-evsm,texels=512"}, kAllImages, true));
  for (const Rendering& r : both)
    EXPECT_LT(r.result.measures->meanAbsError, 0.035) << r.result.method.label();
  constexpr std::uint64_t kTexels = 512 * 512;
  EXPECT_NEAR(static_cast<double>(both[1].result.storeBytes), kTexels * (16 * 4. / 3 + 4 * 4),
              0.01 * kTexels);
  EXPECT_NEAR(static_cast<double>(both[2].result.storeBytes), kTexels * (4 * 16 * 4. / 3 + 4 * 4),
              0.05 * kTexels);
}

}  // namespace
}  // namespace sundial::test
