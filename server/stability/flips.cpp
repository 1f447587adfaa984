#include "stability/flips.h"

#include <algorithm>
#include <cassert>

namespace sundial {

namespace {

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

StabilityFrame FlipCounter::add(std::span<const PointState> states) {
  assert(frames_ == 0 || states.size() == before_.size());
  StabilityFrame frame{.frame = frames_++};
  flipped_.clear();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const PointState now = states[i];
    if (!(now & kPointSeen)) continue;
    ++frame.seen;
    if (!(now & kPointLit) != !(now & kPointTruthLit)) ++frame.wrong;
    if (before_.empty() || !(before_[i] & kPointSeen)) continue;
    const unsigned changed = now ^ before_[i];
    if (changed & kPointBack) continue;
    ++frame.pairs;
    if (changed != kPointLit) continue;
    ++frame.flips;
    flipped_.push_back(static_cast<std::uint32_t>(i));
  }
  before_.assign(states.begin(), states.end());
  return frame;
}

StabilityResult summed(std::vector<StabilityFrame> frames) {
  StabilityResult result;
  std::uint64_t pairs = 0, flips = 0, seen = 0, wrong = 0, dark = 0, pixels = 0, wrongPixels = 0;
  for (const StabilityFrame& frame : frames) {
    pairs += frame.pairs;
    flips += frame.flips;
    seen += frame.seen;
    wrong += frame.wrong;
    dark += frame.dark;
    pixels += frame.pixels;
    wrongPixels += frame.wrongPixels;
    result.bleed += frame.bleed;
    result.drawn += frame.drawn;
    result.pop = std::max(result.pop, share(frame.flips, frame.pairs));
    result.texelJump = std::max(result.texelJump, frame.texelJump);
  }
  result.flipRate = share(flips, pairs);
  result.wrongRate = share(wrong, seen);
  result.wrongPixels = share(wrongPixels, pixels);
  result.bleed = dark == 0 ? 0 : result.bleed / static_cast<double>(dark);
  if (!frames.empty()) result.drawn /= static_cast<double>(frames.size());
  result.frames = std::move(frames);
  return result;
}

}  // namespace sundial
