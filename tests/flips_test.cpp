// What counts as a flip, and what frames' counts add up to.
#include "stability/flips.h"

#include <gtest/gtest.h>

namespace sundial {
namespace {

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

}  // namespace
}  // namespace sundial
