// The plan covers what it should and no more: the view samples for volume=samples, the scene for
// volume=scene.
#include <algorithm>
#include <cmath>
#include <span>

#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr glm::uvec2 kSize{320, 256};

// After the division by w.
dvec3 inShadow(const PlanView& view, const dvec3& world) {
  const dvec4 clip = view.shadowFromWorld * dvec4(world, 1);
  return dvec3(clip) / clip.w;
}

void expectFinite(const Measures& m) {
  for (const double value :
       {m.pixelMatch, m.falseLit, m.falseShadow, m.meanAbsError, m.edgeErrorPx.p50, m.edgeErrorPx.p95,
        m.edgeErrorPx.max, m.interiorError, m.texelPx.p50, m.texelPx.p95, m.utilisation})
    EXPECT_TRUE(std::isfinite(value)) << value;
}

void expectFinite(const PlanView& view) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) {
      EXPECT_TRUE(std::isfinite(view.shadowFromWorld[c][r]));
    }
}

struct Case {
  std::string scene, view, light;
};
const std::vector<Case> kCases = {{"atrium", "main", "sun"},          {"atrium", "above", "low"},
                                  {"atrium", "main", "spot"},         {"trees?count=40", "above", "low"},
                                  {"trees?count=40", "walk", "spot"}, {"grid", "top", "noon"}};

class FramePlan : public RendererTest {};

TEST_F(FramePlan, DvContainsEveryLightFacingSampleAndIsTight) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.scene + " " + c.view + " " + c.light);
    const auto scene = builtin(c.scene);
    const Light light = lightOf(*scene, c.light);
    const Rendering r = render(scene, viewOf(*scene, c.view), light, kSize, "dv,texels=1024x512");
    ASSERT_EQ(r.plan.size(), 1u);
    const PlanView& view = r.plan[0];
    EXPECT_EQ(view.gpu.empty, 0u);
    EXPECT_EQ(view.gpu.rectOffset, glm::uvec2(0));
    EXPECT_EQ(view.gpu.rectSize, glm::uvec2(1024, 512));
    dvec3 low(2), high(-2);
    std::size_t outside = 0, unanswered = 0, facing = 0;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (r.answered(i)) {
        const dvec3 shadow = inShadow(view, r.position(i));
        low = glm::min(low, shadow);
        high = glm::max(high, shadow);
        outside +=
            glm::any(glm::greaterThan(glm::abs(dvec2(shadow)), dvec2(1))) || shadow.z <= 0 || shadow.z >= 1;
        ++facing;
      } else if (r.seen(i) && light.kind == LightKind::directional) {
        unanswered += glm::dot(r.normal(i), light.direction) < -1e-6;
      }
    }
    EXPECT_GT(facing, 100u);
    EXPECT_EQ(outside, 0u);
    EXPECT_EQ(unanswered, 0u);
    const dvec2 twoTexels = 4.0 / dvec2(view.gpu.rectSize);
    EXPECT_LE(low.x, -1 + twoTexels.x);
    EXPECT_LE(low.y, -1 + twoTexels.y);
    EXPECT_GE(high.x, 1 - twoTexels.x);
    EXPECT_GE(high.y, 1 - twoTexels.y);
  }
}

TEST_F(FramePlan, SmContainsTheWholeScene) {
  for (const Case& c : kCases) {
    const auto scene = builtin(c.scene);
    const Light light = lightOf(*scene, c.light);
    if (light.kind != LightKind::directional) continue;
    SCOPED_TRACE(c.scene + " " + c.light);
    const Rendering r = render(scene, viewOf(*scene, c.view), light, {64, 64}, "sm,texels=256");
    dvec3 low(2), high(-2);
    for (const Instance& instance : scene->instances) {
      const Mesh& mesh = scene->meshes[instance.mesh];
      for (std::uint32_t i = 3 * mesh.firstTriangle; i < 3 * (mesh.firstTriangle + mesh.triangleCount); ++i) {
        const dvec3 world(instance.worldFromMesh * dvec4(scene->vertices[scene->indices[i]].position, 1));
        const dvec3 shadow = inShadow(r.plan.at(0), world);
        low = glm::min(low, shadow);
        high = glm::max(high, shadow);
      }
    }
    EXPECT_TRUE(low.x >= -1 && low.y >= -1 && low.z > 0) << low.x << " " << low.y << " " << low.z;
    EXPECT_TRUE(high.x <= 1 && high.y <= 1 && high.z < 1) << high.x << " " << high.y << " " << high.z;
  }
}

TEST_F(FramePlan, SmDoesNotDependOnTheCamera) {
  const auto scene = builtin("atrium");
  for (const char* light : {"sun", "spot"}) {
    std::vector<shared::ShadowView> plans;
    for (const char* view : {"main", "above", "curtain"})
      plans.push_back(render(scene, viewOf(*scene, view), lightOf(*scene, light), {64, 48}, "sm,texels=256")
                          .plan.at(0)
                          .gpu);
    for (const shared::ShadowView& plan : plans)
      EXPECT_TRUE(
          std::ranges::equal(std::as_bytes(std::span(&plan, 1)), std::as_bytes(std::span(plans.data(), 1))))
          << light;
  }
}

// The frame's origin moves with the camera in steps, and with it all rounding: equal sides of a square must
// not change places.
TEST_F(FramePlan, SmIsNotTurnedByAFarCamera) {
  const auto scene = builtin("grid?n=3");
  const View near = viewOf(*scene, "main");
  for (const Light& light : {sun(40, 45), sun(40, 225), sun(30, 0), Light{.direction = {0, -1, 0}}}) {
    const PlanView expected = render(scene, near, light, {16, 16}, "sm,texels=256").plan.at(0);
    for (const dvec3& by :
         {dvec3(1e4, 3e3, 0), dvec3(0, 7e4, -1e5), dvec3(-3e4, 2e3, 5e4), dvec3(1.3e3, 777, 2.9e3)}) {
      View far = near;
      far.eye += by;
      const PlanView plan = render(scene, far, light, {16, 16}, "sm,texels=256").plan.at(0);
      for (const dvec3& p : {dvec3(1, 0, 2), dvec3(-3, 1, 0.5)}) {
        const double metres = glm::distance(near.eye + by, p);
        EXPECT_LT(glm::distance(inShadow(plan, p), inShadow(expected, p)), 1e-6 * metres)
            << light.direction.x << " " << light.direction.z << " " << by.x;
      }
    }
  }
}

TEST_F(FramePlan, SpotsReachFromTheirNearestToTheirFarthestSample) {
  const auto scene = builtin("atrium");
  const Light light = lightOf(*scene, "spot");
  for (const char* method : {"sm,texels=512", "dv,texels=512"}) {
    SCOPED_TRACE(method);
    const Rendering r = render(scene, viewOf(*scene, "main"), light, kSize, method);
    const shared::ShadowView& view = r.plan.at(0).gpu;
    EXPECT_TRUE(view.nearDistance > 0 && view.nearDistance < view.farDistance);
    const double cosCone = std::cos(glm::radians(light.coneDegrees / 2));
    std::size_t answered = 0, outsideCone = 0;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (!r.seen(i)) continue;
      const dvec3 from = r.position(i) - light.position;
      const double cosine = glm::dot(glm::normalize(from), light.direction);
      if (!r.answered(i)) {
        EXPECT_EQ(r.visibility(i), 0) << "no light reaches it";
        outsideCone += cosine < cosCone;
        continue;
      }
      ++answered;
      EXPECT_GE(cosine, cosCone - 1e-5);
      const double distance = glm::dot(from, light.direction);
      EXPECT_GE(distance, view.nearDistance * (1 - 1e-5));
      EXPECT_LE(distance, view.farDistance * (1 + 1e-5));
    }
    EXPECT_GT(answered, 500u);
    EXPECT_GT(outsideCone, 500u);
  }
}

// Where two triangles hold a scene together: a ground and a roof over all of it.
std::shared_ptr<const Scene> roofed() {
  SceneBuilder builder("roofed");
  const std::uint32_t material = builder.addMaterial(
      {.name = "grey", .gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto square = [&](float half, float y) {
    return Primitive{.positions = {{-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}},
                     .uvs = {},
                     .colours = {},
                     .indices = {0, 1, 2, 0, 2, 3},
                     .material = material};
  };
  builder.addInstance("ground", builder.addMesh("ground", {square(10, 0)}), glm::dmat4(1));
  builder.addInstance("roof", builder.addMesh("roof", {square(30, 8)}), glm::dmat4(1));
  return sharedScene(std::move(builder).finish());
}

// What casts lies before the nearest sample: in front of a near plane that fits the samples.
TEST_F(FramePlan, CastersNearerThanAllSamplesCastOnAllSamples) {
  const auto scene = roofed();
  const View view{.eye = {6, 5, 7}, .target = {0, 0, 0}};
  for (const Light& light : {sun(45, 30), sun(70, 200), sun(35, 120), Light{.direction = {0, -1, 0}},
                             spot({2, 20, 1}, {0, 0, 0}, 60)})
    for (const char* method : {"dv,texels=64", "dv,texels=256", "dv,texels=2048", "sm,texels=256",
                               "dv,texels=256,lookup=pcf,kernel=5"}) {
      const Rendering r = render(scene, view, light, kSize, method);
      std::size_t lit = 0, facing = 0;
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        lit += r.visibility(i) > 0;
        facing += r.answered(i);
      }
      EXPECT_GT(facing, r.pixels() / 4) << method;
      EXPECT_EQ(lit, 0u) << method << ", light towards " << light.direction.x << " " << light.direction.y;
    }
}

void expectNothingButSky(const std::vector<Rendering>& renderings) {
  for (const Rendering& r : renderings) {
    SCOPED_TRACE(r.result.method.label());
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      ASSERT_FALSE(r.seen(i));
      ASSERT_EQ(r.visibility(i), 0);
      ASSERT_EQ(r.reference(i), 0);
      ASSERT_EQ(r.at<std::uint32_t>(Aov::colour, i), 0u);
    }
    ASSERT_TRUE(r.result.measures);
    expectFinite(*r.result.measures);
    EXPECT_EQ(r.result.measures->pixelMatch, 1);
    EXPECT_EQ(r.result.measures->utilisation, 0);
    for (const PlanView& view : r.plan) expectFinite(view);
  }
}

TEST_F(FramePlan, IsEmptyWhereTheCameraSeesNothing) {
  const auto scene = builtin("grid");
  View view = viewOf(*scene, "main");
  view.target = view.eye + dvec3(0.2, 1, 0);
  for (const char* light : {"sun", "spot"}) {
    const auto renderings = render(
        jobOf(scene, view, lightOf(*scene, light), {64, 64},
              {"sm,texels=64", "dv,texels=64", "dv,texels=64,lookup=pcf", "ray-traced"}, kAllImages, true));
    expectNothingButSky(renderings);
    EXPECT_EQ(renderings[0].plan.at(0).gpu.empty, 0u) << "sm's plan is the scene's";
    EXPECT_EQ(renderings[1].plan.at(0).gpu.empty, 1u);
    EXPECT_EQ(renderings[1].work("store", "primitives"), 0);
  }
}

TEST_F(FramePlan, IsEmptyWhereNothingSeenFacesTheLight) {
  const auto scene = builtin("grid");
  const View view{.eye = {3, -4, 5}, .target = {0, 0, 0}};  // from below the ground
  for (const Rendering& r : render(jobOf(scene, view, sun(50, 36), kSize,
                                         {"dv,texels=64", "sm,texels=64", "ray-traced"}, kAllImages, true))) {
    SCOPED_TRACE(r.result.method.label());
    std::size_t seen = 0;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      seen += r.seen(i);
      EXPECT_EQ(r.visibility(i), 0);
      EXPECT_EQ(r.reference(i), 0);
    }
    EXPECT_GT(seen, r.pixels() / 2);
    expectFinite(*r.result.measures);
    EXPECT_EQ(r.result.measures->pixelMatch, 1);
    if (r.result.method.row->name == "dv") {
      EXPECT_EQ(r.plan.at(0).gpu.empty, 1u);
    }
  }
}

TEST_F(FramePlan, IsEmptyForAnEmptyScene) {
  const auto scene = sharedScene(SceneBuilder("empty").finish());
  for (const Light& light : {sun(50, 36), spot({0, 5, 0}, {0, 0, 0}, 60)}) {
    const auto renderings = render(jobOf(scene, defaultView(*scene), light, {48, 32},
                                         {"sm,texels=64", "dv,texels=64", "ray-traced"}, kAllImages, true));
    expectNothingButSky(renderings);
    EXPECT_EQ(renderings[0].plan.at(0).gpu.empty, 1u);
    EXPECT_EQ(renderings[1].plan.at(0).gpu.empty, 1u);
  }
}

std::shared_ptr<const Scene> moved(const Scene& scene, const dvec3& by) {
  Scene far = scene;
  for (Instance& instance : far.instances) instance.worldFromMesh[3] += dvec4(by, 0);
  far.bounds = {scene.bounds.min + by, scene.bounds.max + by};
  return std::make_shared<const Scene>(std::move(far));
}

TEST_F(FramePlan, GivesTheSamePictureAHundredKilometresFromTheOrigin) {
  const dvec3 by(100'000, -300, 70'000);
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.scene + " " + c.view + " " + c.light);
    const auto scene = builtin(c.scene);
    const View view = viewOf(*scene, c.view);
    const Light light = lightOf(*scene, c.light);
    View farView = view;
    farView.eye += by;
    farView.target += by;
    Light farLight = light;
    farLight.position += by;
    const std::initializer_list<std::string_view> methods = {"sm,texels=1024", "dv,texels=1024",
                                                             "ray-traced"};
    const auto here = render(jobOf(scene, view, light, kSize, methods, kAllImages, true));
    const auto there = render(jobOf(moved(*scene, by), farView, farLight, kSize, methods, kAllImages, true));
    for (std::size_t m = 0; m < here.size(); ++m) {
      std::size_t different = 0;
      for (std::size_t i = 0; i < here[m].pixels(); ++i)
        different += here[m].visibility(i) != there[m].visibility(i);
      // Doubles at 100 km differ from those at the origin by 1e-11 m: a sample may fall on the other side of
      // an edge.
      EXPECT_LE(different, here[m].pixels() / 5000) << methods.begin()[m];
      EXPECT_NEAR(here[m].result.measures->pixelMatch, there[m].result.measures->pixelMatch, 2e-4);
      EXPECT_NEAR(here[m].result.measures->interiorError, there[m].result.measures->interiorError, 2e-4);
    }
  }
}

}  // namespace
}  // namespace sundial::test
