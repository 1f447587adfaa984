// Alpha-tested cards: one sees through their holes and light falls through them, wherever a texture's
// coordinates wrap, the same in the G-buffer, in the maps and for the rays of the reference.
#include <cmath>

#include "reference/alpha.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr glm::uvec2 kSize{384, 320};
constexpr std::uint32_t kGround = 0, kCard = 1;  // instances
constexpr double kCutoff = 0.5;

// A horizontal card at 1.5 m above the ground, 3 m a side, whose texture coordinates run from -1 to 2.
constexpr double kHeight = 1.5, kHalf = 1.5;
dvec2 uvOnCard(const dvec2& xz) { return (xz + kHalf) / (2 * kHalf) * 3.0 - 1.0; }

Texture pattern() {
  // No symmetry: a mirrored, a repeated and a stretched border all differ.
  const std::vector<std::string> rows = {"##..####", "#..#####", "########", "###.....",
                                         "###.....", "###..###", "########", ".#######"};
  Texture texture{.size = {8, 8}, .texels = {}};
  for (const std::string& row : rows)
    for (const char c : row) texture.texels.emplace_back(200, 220, 90, c == '#' ? 255 : 0);
  return texture;
}

std::shared_ptr<const Scene> card(std::uint32_t wrap, bool holes = true) {
  SceneBuilder builder("card");
  const std::uint32_t texture = builder.addTexture(pattern());
  const std::uint32_t grey = builder.addMaterial(
      {.name = "grey", .gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const std::uint32_t leaf = builder.addMaterial(
      {.name = "card",
       .gpu = {glm::vec4(1), holes ? static_cast<float>(kCutoff) : 0, texture, wrap, wrap},
       .masked = holes,
       .doubleSided = true});
  const auto square = [&](float half, float y, std::uint32_t material) {
    return Primitive{.positions = {{-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}},
                     .uvs = {{-1, 2}, {2, 2}, {2, -1}, {-1, -1}},
                     .colours = {},
                     .indices = {0, 1, 2, 0, 2, 3},
                     .material = material};
  };
  builder.addInstance("ground", builder.addMesh("ground", {square(6, 0, grey)}), glm::dmat4(1));
  builder.addInstance("card", builder.addMesh("card", {square(static_cast<float>(kHalf), kHeight, leaf)}),
                      glm::dmat4(1));
  return sharedScene(std::move(builder).finish());
}

enum class There { card, hole, unsure, beside };

// What is at a place of the card's plane. Unsure: within single precision of a border.
There whatIsAt(const Scene& scene, const dvec2& xz, std::uint32_t wrap) {
  const double outside = std::max(std::abs(xz.x), std::abs(xz.y)) - kHalf;
  if (std::abs(outside) < 1e-3) return There::unsure;
  if (outside > 0) return There::beside;
  const dvec2 uv = uvOnCard(xz);
  const float alpha = sampleAlpha(scene, 0, glm::vec2(uv), wrap, wrap);
  if (std::abs(alpha - kCutoff) < 0.02) return There::unsure;
  // Where coordinates repeat and mirror, a tile's border is one texel that two tiles share or don't.
  return alpha < kCutoff ? There::hole : There::card;
}

const View kView{.eye = {2.5, 6, 4}, .target = {0, 0.5, 0}, .verticalFovDegrees = 50};

// Where the pixel's ray meets the card's plane.
dvec2 throughPixel(std::size_t pixel) {
  const dvec3 forward = glm::normalize(kView.target - kView.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, kView.up)), up = glm::cross(right, forward);
  const double tanY = std::tan(glm::radians(kView.verticalFovDegrees) / 2);
  const double x =
      (2 * (static_cast<double>(pixel % kSize.x) + 0.5) / kSize.x - 1) * tanY * kSize.x / kSize.y;
  const double y = (1 - 2 * (static_cast<double>(pixel / kSize.x) + 0.5) / kSize.y) * tanY;
  const dvec3 ray = forward + x * right + y * up;
  const dvec3 hit = kView.eye + ray * ((kHeight - kView.eye.y) / ray.y);
  return {hit.x, hit.z};
}

dvec2 towardsSunAtCard(const dvec3& ground, const Light& light) {
  const dvec3 hit = ground + light.direction * (kHeight / light.direction.y);
  return {hit.x, hit.z};
}

class FrameAlpha : public RendererTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(FrameAlpha, GBufferShowsWhatIsBehindHolesAndNothingElse) {
  const auto scene = card(GetParam());
  const Rendering r = render(scene, kView, sun(60, 40), kSize, "sm,texels=256");
  std::size_t holes = 0, cards = 0, wrong = 0;
  for (std::size_t i = 0; i < r.pixels(); ++i) {
    if (!r.seen(i)) continue;
    const There there = whatIsAt(*scene, throughPixel(i), GetParam());
    if (there == There::unsure) continue;
    holes += there == There::hole;
    cards += there == There::card;
    wrong += r.id(i).x != (there == There::card ? kCard : kGround);
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(holes, 500u);
  EXPECT_GT(cards, 2000u);
}

TEST_P(FrameAlpha, ReferenceLetsLightThroughHoles) {
  const auto scene = card(GetParam());
  const Light light = sun(60, 40);
  const Rendering r = render(scene, kView, light, kSize, "ray-traced");
  std::size_t lit = 0, dark = 0, wrong = 0;
  for (std::size_t i = 0; i < r.pixels(); ++i) {
    if (!r.seen(i) || r.id(i).x != kGround) continue;
    const There there = whatIsAt(*scene, towardsSunAtCard(r.position(i), light), GetParam());
    if (there == There::unsure) continue;
    lit += there == There::hole;
    dark += there == There::card;
    wrong += (r.reference(i) == 1) != (there != There::card);
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(lit, 300u);
  EXPECT_GT(dark, 300u);
}

// A texel is dark where the card covers its centre, so that the answer is what is at most half its diagonal
// away.
TEST_P(FrameAlpha, MapsAgreeWithTheReferenceUpToATexel) {
  const auto scene = card(GetParam());
  const Light light = sun(60, 40);
  for (const Rendering& r :
       render(jobOf(scene, kView, light, kSize, {"sm,texels=1024", "dv,texels=1024"}, kAllImages, true))) {
    SCOPED_TRACE(r.result.method.label());
    // Light space, projected along the light onto the ground: longer than it is wide.
    const glm::vec2 texel = r.plan.at(0).gpu.texelSize;
    const double reach = 0.51 * std::hypot(texel.x, texel.y) / -light.direction.y;
    std::size_t lit = 0, dark = 0, wrong = 0;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (!r.seen(i) || r.id(i).x != kGround) continue;
      const dvec2 at = towardsSunAtCard(r.position(i), light);
      bool anyCard = false, anyHole = false;
      for (const double dx : {-1.0, -0.5, 0.0, 0.5, 1.0})
        for (const double dz : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
          const There there = whatIsAt(*scene, at + reach * dvec2(dx, dz), GetParam());
          anyCard |= there == There::card || there == There::unsure;
          anyHole |= there != There::card;
        }
      if (anyCard && anyHole) continue;
      wrong += r.visibility(i) != (anyHole ? 1 : 0);
      lit += anyHole && whatIsAt(*scene, at, GetParam()) == There::hole;
      dark += anyCard;
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(lit, 200u);
    EXPECT_GT(dark, 200u);
    // A pixel at a hole's rim, where driver and reference filter alpha with different rounding.
    EXPECT_LT(r.result.measures->interiorError, 1e-4);
  }
}

std::string nameOf(const ::testing::TestParamInfo<std::uint32_t>& info) {
  return info.param == shared::kWrapRepeat ? "repeat" : info.param == shared::kWrapClamp ? "clamp" : "mirror";
}
INSTANTIATE_TEST_SUITE_P(Wraps, FrameAlpha,
                         ::testing::Values(shared::kWrapRepeat, shared::kWrapClamp, shared::kWrapMirror),
                         nameOf);

class FrameAlphaOnce : public RendererTest {};

TEST_F(FrameAlphaOnce, EachWrapHasAPatternOfItsOwn) {
  std::vector<std::vector<std::byte>> patterns;
  for (const std::uint32_t wrap : {shared::kWrapRepeat, shared::kWrapClamp, shared::kWrapMirror})
    patterns.push_back(render(card(wrap), kView, sun(60, 40), kSize, "ray-traced").images.at(Aov::id).bytes);
  EXPECT_NE(patterns[0], patterns[1]);
  EXPECT_NE(patterns[1], patterns[2]);
  EXPECT_NE(patterns[0], patterns[2]);
}

TEST_F(FrameAlphaOnce, AnOpaqueMaterialHasNoHolesWhateverItsTexturesAlpha) {
  const auto scene = card(shared::kWrapRepeat, false);
  for (const Rendering& r :
       render(jobOf(scene, kView, sun(60, 40), kSize, {"sm", "ray-traced"}, kAllImages))) {
    std::size_t seenThrough = 0, litThrough = 0;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (!r.seen(i)) continue;
      const dvec2 xz = glm::abs(throughPixel(i));
      seenThrough += std::max(xz.x, xz.y) < kHalf - 0.01 && r.id(i).x != kCard;
      if (r.id(i).x != kGround) continue;
      const dvec2 above = glm::abs(towardsSunAtCard(r.position(i), sun(60, 40)));
      litThrough += std::max(above.x, above.y) < kHalf - 0.02 && r.visibility(i) > 0;
    }
    EXPECT_EQ(seenThrough, 0u);
    EXPECT_EQ(litThrough, 0u);
  }
}

}  // namespace
}  // namespace sundial::test
