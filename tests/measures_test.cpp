// The measures against images small enough to measure by hand.
#include "measure/measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "measure/distance_transform.h"
#include "measure/distinct_texels.h"
#include "measure/reference_edges.h"
#include "shared/plan.h"
#include "shared/scene.h"

namespace sundial::test {
namespace {

// A wall seen from 10 m, a pixel a centimetre; each test changes what it is about.
struct Image {
  explicit Image(const std::vector<std::string>& reference)
      : size(reference[0].size(), reference.size()), samples(size.x * size.y), depth(samples.size(), 10) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const char c = reference[i / size.x][i % size.x];
      const glm::vec2 pixel(i % size.x, i / size.x);
      samples[i] = {glm::vec3(pixel.x * 0.01f, -pixel.y * 0.01f, -10), c == ' ' ? shared::kNoInstance : 0,
                    glm::vec3(0, 0, 1), 0};
      r.push_back(c == '#' ? 1.0f : 0.0f);
      faces.push_back(c == '#' || c == '.');  // '-' faces away
    }
    s = r;
  }
  std::size_t at(std::uint32_t x, std::uint32_t y) const { return y * size.x + x; }
  void flip(std::uint32_t x, std::uint32_t y) { s[at(x, y)] = 1 - s[at(x, y)]; }
  MeasureInput input() const { return {size, samples, depth, s, r, answers, storeTexels, faces}; }
  Measures measured() const { return measure(input()); }

  glm::uvec2 size;
  std::vector<shared::ViewSample> samples;
  std::vector<float> depth, s, r;
  std::vector<shared::Answer> answers;
  std::uint64_t storeTexels = 0;
  std::vector<std::uint8_t> faces;
};

std::string edges(const Image& image) {
  std::string text;
  for (const std::uint8_t e : referenceEdges(image.input())) text += e ? 'e' : '-';
  return text;
}

TEST(Measures, OfAPerfectMatchAreZero) {
  Image image({"##..", "##..", " --#"});
  image.answers.assign(12, {0, 0, 0.0f, 1});
  const Measures m = image.measured();
  EXPECT_EQ(m.pixelMatch, 1);
  EXPECT_EQ(m.falseLit, 0);
  EXPECT_EQ(m.falseShadow, 0);
  EXPECT_EQ(m.meanAbsError, 0);
  EXPECT_EQ(m.edgeErrorPx.max, 0);
  EXPECT_EQ(m.interiorError, 0);
}

TEST(Measures, OfAnEmptyImageAreNeutral) {
  for (const Image& image : {Image({"   ", "   "}), Image({""})}) {
    const Measures m = image.measured();
    EXPECT_EQ(m.pixelMatch, 1);
    EXPECT_EQ(m.falseLit + m.falseShadow + m.meanAbsError + m.interiorError + m.utilisation, 0);
  }
}

TEST(Measures, SharesCountOmegaAndThePartThatFacesTheLight) {
  Image image({"####", "....", "--  "});  // 10 visible, 8 facing
  image.flip(0, 0);
  image.flip(0, 1);
  image.flip(1, 1);
  image.flip(2, 2);  // no geometry: doesn't count
  Measures m = image.measured();
  EXPECT_DOUBLE_EQ(m.pixelMatch, 7.0 / 10);
  EXPECT_DOUBLE_EQ(m.falseShadow, 1.0 / 8);
  EXPECT_DOUBLE_EQ(m.falseLit, 2.0 / 8);
  EXPECT_DOUBLE_EQ(m.meanAbsError, 3.0 / 8);

  image.flip(0, 2);  // lit although it faces away: not R, but no pixel of Omega+
  m = image.measured();
  EXPECT_DOUBLE_EQ(m.pixelMatch, 6.0 / 10);
  EXPECT_DOUBLE_EQ(m.falseLit, 2.0 / 8);
}

TEST(Measures, RoundVisibilityAtOneHalfExceptForTheMeanError) {
  Image image({"##.."});
  image.s = {0.5f, 0.49f, 0.5f, 0.25f};
  const Measures m = image.measured();
  EXPECT_DOUBLE_EQ(m.falseShadow, 1.0 / 4);
  EXPECT_DOUBLE_EQ(m.falseLit, 1.0 / 4);
  EXPECT_NEAR(m.meanAbsError, (0.5 + 0.51 + 0.5 + 0.25) / 4, 1e-6);
}

TEST(Measures, TakeWhoFacesTheLightFromTheAnswersIfNoOneElseSays) {
  Image image({"##.."});
  image.flip(0, 0);
  image.faces.clear();
  EXPECT_DOUBLE_EQ(image.measured().falseShadow, 1.0 / 4) << "every sample faces the light";
  image.answers.assign(4, {0, 0, 0.0f, 1});
  image.answers[2].facesLight = image.answers[3].facesLight = 0;
  EXPECT_DOUBLE_EQ(image.measured().falseShadow, 1.0 / 2);
}

TEST(ReferenceEdges, LieOnBothSidesOfAChange) {
  EXPECT_EQ(edges(Image({"##..", "####"})),
            "-eee"
            "--ee");
  EXPECT_EQ(edges(Image({"##-- #"})), "-ee---") << "turning away is a change, an empty pixel isn't";
}

TEST(ReferenceEdges, DoNotLieWhereTheDepthJumps) {
  Image image({"##.."});
  for (std::uint32_t x : {2u, 3u}) {
    image.depth[x] = 12;
    image.samples[x].wsPosition.z = -12;
  }
  EXPECT_EQ(edges(image), "----");
  // Seen edge-on, the nearer surface's plane contains what is behind it.
  image.samples[0].wsNormal = image.samples[1].wsNormal = glm::vec3(1, 0, 0);
  EXPECT_EQ(edges(image), "----");
}

TEST(ReferenceEdges, LieOnAFloorThatRunsToTheHorizon) {
  Image image({"#", "#", ".", "."});
  const float depths[] = {400, 200, 100, 50};
  for (std::uint32_t y = 0; y < 4; ++y) {
    image.depth[y] = depths[y];
    image.samples[y].wsPosition = {0, -1, -depths[y]};
    image.samples[y].wsNormal = {0, 1, 0};
  }
  EXPECT_EQ(edges(image), "-ee-");
}

TEST(Measures, EdgeErrorIsTheDistanceToTheNearestEdge) {
  // Edge pixels are columns 1 and 2.
  Image image({"##........", "##........", "##........"});
  EXPECT_EQ(image.measured().edgeErrorPx.max, 0);
  for (std::uint32_t x : {2u, 3u, 4u, 9u}) image.flip(x, 1);  // at distances 0, 1, 2, 7
  const Measures m = image.measured();
  EXPECT_EQ(m.edgeErrorPx.p50, 1);
  EXPECT_EQ(m.edgeErrorPx.p95, 7);
  EXPECT_EQ(m.edgeErrorPx.max, 7);
}

TEST(Measures, EdgeErrorIsTheDiagonalWhereTheReferenceNeverChanges) {
  Image image({"####", "####", "####"});
  image.flip(2, 1);
  const Measures m = image.measured();
  EXPECT_EQ(m.edgeErrorPx.p50, 5);
  EXPECT_EQ(m.edgeErrorPx.max, 5);
  EXPECT_DOUBLE_EQ(m.interiorError, 1.0 / 12);
}

TEST(Measures, InteriorErrorIsFarFromEdgesAndBeyondTheTexel) {
  Image image({"##........"});
  for (std::uint32_t x : {3u, 4u, 5u, 9u}) image.flip(x, 0);  // at distances 1, 2, 3, 7
  EXPECT_DOUBLE_EQ(image.measured().interiorError, 2.0 / 10) << "without a map: beyond 2 px";
  const auto withFootprint = [&](float footprint) {
    image.answers.assign(10, {0, 0, footprint, 1});
    return image.measured().interiorError;
  };
  EXPECT_DOUBLE_EQ(withFootprint(0.1f), 2.0 / 10);
  EXPECT_DOUBLE_EQ(withFootprint(2), 1.0 / 10) << "3 px are within one and a half texels of 2 px";
  EXPECT_DOUBLE_EQ(withFootprint(5), 0);
  EXPECT_DOUBLE_EQ(withFootprint(std::numeric_limits<float>::quiet_NaN()), 2.0 / 10);
  image.answers.assign(10, {shared::kNoShadowView, 0, 5.0f, 1});
  EXPECT_DOUBLE_EQ(image.measured().interiorError, 2.0 / 10) << "no texel answered";
}

TEST(Measures, TexelPercentilesAreOfNearestRank) {
  Image image({"##########", "----------"});
  for (std::uint32_t i = 0; i < 20; ++i) image.answers.push_back({0, 0, static_cast<float>((i * 7) % 20), 1});
  // The first ten are 0, 7, 14, 1, 8, 15, 2, 9, 16, 3; the others face away.
  EXPECT_EQ(image.measured().texelPx.p50, 7);
  EXPECT_EQ(image.measured().texelPx.p95, 16);
  image.answers[8].view = shared::kNoShadowView;
  EXPECT_EQ(image.measured().texelPx.p95, 15) << "who didn't answer has no footprint";
}

TEST(Measures, UtilisationCountsEachTexelOfAViewOnce) {
  Image image({"######--"});
  const std::uint32_t views[] = {0, 0, 0, 1, 1, shared::kNoShadowView, 0, 0};
  const std::uint32_t texels[] = {5, 5, 6, 5, 5, 7, 8, 9};
  for (std::size_t i = 0; i < 8; ++i) image.answers.push_back({views[i], texels[i], 1.0f, 1});
  image.storeTexels = 12;
  EXPECT_DOUBLE_EQ(image.measured().utilisation, 3.0 / 12);
  image.storeTexels = 0;
  EXPECT_EQ(image.measured().utilisation, 0);
}

TEST(DistinctTexels, CountsLikeASet) {
  DistinctTexels texels;
  for (int round = 0; round < 2; ++round)
    for (std::uint32_t i = 0; i < 1000; ++i) texels.add(i % 4, i / 8 * 4096);
  EXPECT_EQ(texels.count(), 4u * 125);
  texels.add(63, 0xffffffffu);
  EXPECT_EQ(texels.count(), 4u * 125 + 1);
}

TEST(DistanceTransform, AgreesWithTheDistancesTakenOneByOne) {
  std::mt19937 random(1);
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(1, 40), glm::uvec2(40, 1), glm::uvec2(37, 23)})
    for (const std::uint32_t rarity : {1u, 3u, 30u, 300u, 100000u}) {
      std::vector<std::uint8_t> mask(size.x * size.y);
      for (std::uint8_t& m : mask) m = random() % rarity == 0;
      const std::vector<float> distances = distanceTransform(size, mask);
      for (std::size_t i = 0; i < mask.size(); ++i) {
        float nearest = std::numeric_limits<float>::infinity();
        for (std::size_t j = 0; j < mask.size(); ++j)
          if (mask[j])
            nearest = std::min(nearest,
                               std::hypot(static_cast<float>(i % size.x) - static_cast<float>(j % size.x),
                                          static_cast<float>(i / size.x) - static_cast<float>(j / size.x)));
        ASSERT_FLOAT_EQ(distances[i], nearest) << size.x << "x" << size.y << " 1/" << rarity << " at " << i;
      }
    }
}

}  // namespace
}  // namespace sundial::test
