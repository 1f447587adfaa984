#include "shadow/frame_runner.h"

#include <algorithm>
#include <chrono>

namespace sundial {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<Work> workOf(const PassCounts& counts) {
  return {{"vertices", static_cast<double>(counts.vertices)},
          {"primitives", static_cast<double>(counts.primitives)},
          {"fragments", static_cast<double>(counts.fragments)},
          {"invocations", static_cast<double>(counts.invocations)}};
}

// With `more`, which counts where the statistics don't.
std::vector<Work> merged(std::vector<Work> work, const std::vector<Work>& more) {
  for (const Work& item : more) {
    const auto known = std::ranges::find(work, item.name, &Work::name);
    if (known == work.end())
      work.push_back(item);
    else
      known->count += item.count;
  }
  return work;
}

}  // namespace

Result<FrameTiming> runFrame(const Device& device, const std::vector<Pass>& passes,
                             const Interrupt& interrupt) {
  const auto count = static_cast<std::uint32_t>(passes.size());
  const PassTimers timers(device, count);
  FrameTiming timing{.passMs = std::vector<double>(count), .work = std::vector<std::vector<Work>>(count)};
  const Clock::time_point start = Clock::now();
  for (std::uint32_t i = 0; i < count;) {
    if (auto error = interrupt.raised()) return std::unexpected(*error);
    if (passes[i].host) {
      const Clock::time_point begin = Clock::now();
      passes[i].host();
      timing.passMs[i] = millisecondsSince(begin);
      timing.work[i] = {{"rays", static_cast<double>(passes[i].rays)}};
      ++i;
      continue;
    }
    std::uint32_t end = i + 1;
    while (!device.isCpu() && end < count && passes[end].record) ++end;
    device.submit([&](VkCommandBuffer command) {
      for (std::uint32_t pass = i; pass < end; ++pass) {
        timers.begin(command, pass);
        passes[pass].record(command);
        timers.end(command, pass);
      }
    });
    // A pass that must be recorded again, and what came after it.
    std::uint32_t next = i;
    while (next < end && !(passes[next].again && passes[next].again())) ++next;
    i = next;
  }
  timing.frameMs = millisecondsSince(start);

  for (std::uint32_t i = 0; i < count; ++i) {
    if (!passes[i].record) continue;
    timing.passMs[i] = timers.milliseconds(i);
    timing.work[i] = workOf(timers.counts(i));
    if (passes[i].counted) timing.work[i] = merged(std::move(timing.work[i]), passes[i].counted());
  }
  return timing;
}

}  // namespace sundial
