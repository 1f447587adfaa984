// Scene `grid`, whose shadows are known in closed form: the reference agrees with the form, and each method
// that looks shadows up in a map answers exactly what the form says at the centre of the texel that it reads.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/builtin/grid.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr unsigned kPlates = 4;  // along each side: a ground of 16 m
constexpr glm::uvec2 kSize{384, 288};

struct NamedCase {
  std::string name;
  View view;
  Light light;
};

// The light in all quadrants and heights: noon straight down, 5 degrees above the horizon, along an axis, a
// spot, a point.
std::vector<NamedCase> cases() {
  const View high{.eye = {9, 7, 10}, .target = {0, 0, 0}, .verticalFovDegrees = 50};
  const View low{.eye = {-8, 1.6, -7}, .target = {0, 0.4, 0}, .verticalFovDegrees = 55};
  const View close{.eye = {2.6, 1.5, 3.4}, .target = {0.5, 0, 0.5}, .verticalFovDegrees = 50};
  return {{"high, 50 degrees", high, sun(50, 36)},
          {"low, 5 degrees", low, sun(5, 25)},
          {"high, 5 degrees along an axis", high, sun(5, 180)},
          {"close, 30 degrees", close, sun(30, 250)},
          {"high, noon", high, {.direction = {0, -1, 0}}},
          {"high, spot", high, spot({1.5, 9, 2.5}, {0, 0, 0}, 100)},
          {"high, point", high, point({1.5, 5, -0.75})},
          {"low, point", low, point({-2.2, 3.5, 1})}};
}

// The closed form at the height of every horizontal plane in the scene.
class Truth {
 public:
  explicit Truth(const Light& light) {
    const std::vector<builtin::Plate> plates = builtin::gridPlates(kPlates);
    std::vector<double> heights{0};
    for (const builtin::Plate& plate : plates) heights.push_back(plate.height);
    for (const double height : heights)
      if (!shadows_.contains(level(height)))
        shadows_.emplace(level(height), builtin::GridShadow(plates, light, height));
  }
  const builtin::GridShadow& at(const dvec3& position) const { return shadows_.at(level(position.y)); }
  // The plane that a rounded position lies in.
  static double height(const dvec3& position) { return level(position.y) / 4.0; }

 private:
  static int level(double height) { return static_cast<int>(std::lround(height * 4)); }
  std::map<int, builtin::GridShadow> shadows_;
};

// Texels of a view, on horizontal planes.
class Texels {
 public:
  explicit Texels(const PlanView& view)
      : view_(view), world_(glm::inverse(view.shadowFromWorld)), size_(view.gpu.rectSize) {}

  dvec2 of(const dvec3& world) const {
    const dvec4 clip = view_.shadowFromWorld * dvec4(world, 1);
    return (dvec2(clip) / clip.w * 0.5 + 0.5) * size_;
  }
  // Where the light's ray through a place in the map meets the plane.
  dvec2 onPlane(const dvec2& texel, double height) const {
    const dvec2 shadow = texel / size_ * 2.0 - 1.0;
    const auto unproject = [&](double depth) {
      const dvec4 p = world_ * dvec4(shadow, depth, 1);
      return dvec3(p) / p.w;
    };
    const dvec3 a = unproject(1), b = unproject(0.5);
    const dvec3 hit = a + (b - a) * ((height - a.y) / (b.y - a.y));
    return {hit.x, hit.z};
  }
  // The longest way through a texel's footprint in the plane, metres.
  double diagonal(const dvec2& texel, double height) const {
    const dvec2 corner = glm::floor(texel);
    const auto at = [&](double x, double y) { return onPlane(corner + dvec2(x, y), height); };
    return std::max(glm::distance(at(0, 0), at(1, 1)), glm::distance(at(1, 0), at(0, 1)));
  }

 private:
  PlanView view_;
  glm::dmat4 world_;
  dvec2 size_;
};

// Of all views of a plan.
class PlanTexels {
 public:
  explicit PlanTexels(const Rendering& r) : rendering_(r) {
    for (const PlanView& view : r.plan) views_.emplace_back(view);
  }
  const Texels& answering(std::size_t pixel) const {
    return views_.at(rendering_.answered(pixel) ? rendering_.at<std::uint32_t>(Aov::view, pixel) : 0);
  }

 private:
  const Rendering& rendering_;
  std::vector<Texels> views_;
};

// Whether light reaches the side that one sees.
bool facesLight(const Light& light, const Rendering& r, std::size_t pixel) {
  if (!r.seen(pixel)) return false;
  if (light.kind == LightKind::directional) return glm::dot(r.normal(pixel), light.direction) < 0;
  const dvec3 from = glm::normalize(r.position(pixel) - light.position);
  return glm::dot(r.normal(pixel), from) < 0 &&
         (light.kind == LightKind::point ||
          glm::dot(from, light.direction) > std::cos(glm::radians(light.coneDegrees / 2)));
}

double pixelMetres(const View& view, const dvec3& position) {
  const double depth = glm::dot(position - view.eye, glm::normalize(view.target - view.eye));
  return 2 * depth * std::tan(glm::radians(view.verticalFovDegrees) / 2) / kSize.y;
}

class FrameGrid : public RendererTest {};

// A hundredth of a pixel along the ground is less than one in the image, so that this asks for more than
// promised.
TEST_F(FrameGrid, ReferenceAgreesWithTheFormBeyondAHundredthOfAPixel) {
  const auto scene = builtin(fmt::format("grid?n={}", kPlates));
  for (const NamedCase& c : cases()) {
    SCOPED_TRACE(c.name);
    const Rendering r = render(scene, c.view, c.light, kSize, "ray-traced");
    const Truth truth(c.light);
    std::size_t facing = 0, dark = 0, wrong = 0;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (!facesLight(c.light, r, i)) {
        wrong += r.reference(i) != 0;
        continue;
      }
      ++facing;
      const dvec3 p = r.position(i);
      const bool lit = truth.at(p).lit({p.x, p.z});
      dark += !lit;
      wrong += (r.reference(i) == 1) != lit &&
               truth.at(p).edgeDistance({p.x, p.z}) > 0.01 * pixelMetres(c.view, p);
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(facing, r.pixels() / 5);
    EXPECT_GT(dark, facing / 100) << "a case without shadows proves nothing";
  }
}

// The bias moves receivers along the light, which in a plane changes nothing until it reaches the next plate.
TEST_F(FrameGrid, HardLookupIsWrongOnlyWithinHalfATexelsDiagonalOfAnEdge) {
  const auto scene = builtin(fmt::format("grid?n={}", kPlates));
  const std::initializer_list<std::string_view> methods = {
      "sm,texels=256",      "sm,texels=512", "sm,texels=1024", "sm,texels=2048",
      "sm,texels=1024x256", "dv,texels=512", "dv,texels=2048", "sm,texels=512,bias_texels=0",
      "dv,texels=256x1024"};
  for (const NamedCase& c : cases()) {
    const Truth truth(c.light);
    for (const Rendering& r : render(jobOf(scene, c.view, c.light, kSize, methods, kAllImages))) {
      SCOPED_TRACE(c.name + ": " + r.result.method.label());
      const PlanTexels planTexels(r);
      std::size_t facing = 0, wrong = 0, unexplained = 0;
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        if (!facesLight(c.light, r, i)) {
          unexplained += r.visibility(i) != 0;
          continue;
        }
        ++facing;
        const dvec3 p = r.position(i);
        const dvec2 xz(p.x, p.z);
        if ((r.visibility(i) == 1) == truth.at(p).lit(xz)) continue;
        ++wrong;
        const Texels& texels = planTexels.answering(i);
        unexplained +=
            truth.at(p).edgeDistance(xz) > 0.5 * texels.diagonal(texels.of(p), Truth::height(p)) * 1.001;
      }
      EXPECT_EQ(unexplained, 0u) << "of " << wrong << " wrong pixels";
      EXPECT_GT(wrong, 0u) << "a map that is never wrong isn't one";
      EXPECT_LT(wrong, facing / 3);
    }
  }
}

// The brute force: what a box of whole and cut texels around the sample says when each texel is the form's.
double boxFiltered(const builtin::GridShadow& form, const Texels& texels, const dvec2& at, double height,
                   int kernel, double& edgeDistance) {
  const dvec2 low = at - 0.5 * kernel, high = at + 0.5 * kernel;
  double lit = 0;
  for (double y = std::floor(low.y); y < high.y; ++y)
    for (double x = std::floor(low.x); x < high.x; ++x) {
      const dvec2 covered = glm::min(dvec2(x + 1, y + 1), high) - glm::max(dvec2(x, y), low);
      const dvec2 centre = texels.onPlane({x + 0.5, y + 0.5}, height);
      lit += covered.x * covered.y * form.lit(centre);
      edgeDistance = std::min(edgeDistance, form.edgeDistance(centre));
    }
  return lit / (kernel * kernel);
}

void expectsBoxes(const std::vector<Rendering>& renderings, const Light& light) {
  const Truth truth(light);
  for (const Rendering& r : renderings) {
    SCOPED_TRACE(r.result.method.label());
    const PlanTexels planTexels(r);
    const dvec2 mapSize(r.plan[0].gpu.rectSize);
    const int kernel =
        r.result.method.stages->lookup == Lookup::pcf ? static_cast<int>(r.result.method.settings.kernel) : 0;
    std::size_t compared = 0, between = 0;
    double worst = 0;
    for (std::size_t i = 0; i < r.pixels(); i += 7) {
      if (!facesLight(light, r, i)) continue;
      const dvec3 p = r.position(i);
      const Texels& texels = planTexels.answering(i);
      const dvec2 at = texels.of(p);
      // At the map's rim the box is cut off; never at the rim of a cube's face.
      const double reach = 0.5 * kernel;
      if (glm::any(glm::lessThan(at, dvec2(reach))) || glm::any(glm::greaterThan(at, mapSize - reach))) {
        EXPECT_NE(light.kind, LightKind::point) << at.x << ", " << at.y;
        continue;
      }
      // In single precision a sample on a texel's border may read either.
      const dvec2 toBorder = glm::abs(at - glm::round(at));
      if (kernel == 0 && std::min(toBorder.x, toBorder.y) < 1e-3) continue;
      double edgeDistance = std::numeric_limits<double>::infinity();
      const double expected =
          kernel == 0
              ? boxFiltered(truth.at(p), texels, glm::floor(at) + 0.5, Truth::height(p), 1, edgeDistance)
              : boxFiltered(truth.at(p), texels, at, Truth::height(p), kernel, edgeDistance);
      // Nor can anyone say what a rasteriser makes of an edge through a texel's centre.
      if (edgeDistance < 1e-3 * texels.diagonal(at, Truth::height(p))) continue;
      ++compared;
      between += expected > 0 && expected < 1;
      worst = std::max(worst, std::abs(r.visibility(i) - expected));
    }
    EXPECT_LT(worst, kernel == 0 ? 1e-12 : 2e-3);
    EXPECT_GT(compared, r.pixels() / 7 / 10);
    EXPECT_EQ(between > 0, kernel > 0);
  }
}

TEST_F(FrameGrid, HardLookupAnswersWhatTheFormSaysAtTheTexelsCentre) {
  const auto scene = builtin(fmt::format("grid?n={}", kPlates));
  for (const NamedCase& c : cases()) {
    SCOPED_TRACE(c.name);
    expectsBoxes(
        render(jobOf(scene, c.view, c.light, kSize, {"sm,texels=512", "dv,texels=700x300"}, kAllImages)),
        c.light);
  }
}

TEST_F(FrameGrid, PcfIsTheBoxFilterOfTheTexelsThatTheFormPredicts) {
  const auto scene = builtin(fmt::format("grid?n={}", kPlates));
  for (const NamedCase& c : cases()) {
    SCOPED_TRACE(c.name);
    expectsBoxes(render(jobOf(scene, c.view, c.light, kSize,
                              {"sm,texels=512,lookup=pcf,kernel=1", "sm,texels=1024,lookup=pcf,kernel=3",
                               "dv,texels=512,lookup=pcf,kernel=4", "dv,texels=600x400,lookup=pcf,kernel=9"},
                              kAllImages)),
                 c.light);
  }
}

TEST_F(FrameGrid, PcfStaysWithinZeroAndOneAndSoftensWithItsKernel) {
  const auto scene = builtin(fmt::format("grid?n={}", kPlates));
  const View view = viewOf(*scene, "main");
  const auto renderings =
      render(jobOf(scene, view, sun(50, 36), kSize,
                   {"sm,texels=512", "sm,texels=512,lookup=pcf,kernel=1", "sm,texels=512,lookup=pcf",
                    "sm,texels=512,lookup=pcf,kernel=7", "sm,texels=512,lookup=pcf,kernel=15"},
                   kAllImages));
  std::vector<std::size_t> between(renderings.size());
  for (std::size_t m = 0; m < renderings.size(); ++m)
    for (std::size_t i = 0; i < renderings[m].pixels(); ++i) {
      const float lit = renderings[m].visibility(i);
      ASSERT_TRUE(lit >= 0 && lit <= 1) << lit;
      between[m] += lit > 0 && lit < 1;
    }
  EXPECT_EQ(between[0], 0u);
  for (std::size_t m = 1; m < between.size(); ++m) EXPECT_GT(between[m], between[m - 1]);
}

}  // namespace
}  // namespace sundial::test
