#include "gpu/timers.h"

namespace sundial {

namespace {

// In the order of their bits, which is the order of their results.
constexpr VkQueryPipelineStatisticFlags kStatistics =
    VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT |
    VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;

QueryPool makePool(const Device& device, VkQueryType type, std::uint32_t count,
                   VkQueryPipelineStatisticFlags statistics) {
  const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                   .queryType = type,
                                   .queryCount = count,
                                   .pipelineStatistics = statistics};
  VkQueryPool pool;
  check(vkCreateQueryPool(device, &info, nullptr, &pool), "vkCreateQueryPool");
  return {device, pool};
}

}  // namespace

PassTimers::PassTimers(const Device& device, std::uint32_t passes)
    : device_(device),
      millisecondsPerTick_(device.limits().timestampPeriod * 1e-6),
      timestamps_(makePool(device, VK_QUERY_TYPE_TIMESTAMP, 2 * passes, 0)),
      statistics_(makePool(device, VK_QUERY_TYPE_PIPELINE_STATISTICS, passes, kStatistics)) {}

void PassTimers::begin(VkCommandBuffer command, std::uint32_t pass) const {
  vkCmdResetQueryPool(command, timestamps_, 2 * pass, 2);
  vkCmdResetQueryPool(command, statistics_, pass, 1);
  vkCmdWriteTimestamp2(command, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_, 2 * pass);
  vkCmdBeginQuery(command, statistics_, pass, 0);
}

void PassTimers::end(VkCommandBuffer command, std::uint32_t pass) const {
  vkCmdEndQuery(command, statistics_, pass);
  vkCmdWriteTimestamp2(command, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_, 2 * pass + 1);
}

double PassTimers::milliseconds(std::uint32_t pass) const {
  std::array<std::uint64_t, 2> ticks{};
  check(vkGetQueryPoolResults(device_, timestamps_, 2 * pass, 2, sizeof ticks, ticks.data(), 8,
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  return static_cast<double>(ticks[1] - ticks[0]) * millisecondsPerTick_;
}

PassCounts PassTimers::counts(std::uint32_t pass) const {
  std::array<std::uint64_t, 4> values{};
  check(vkGetQueryPoolResults(device_, statistics_, pass, 1, sizeof values, values.data(), sizeof values,
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  return {.vertices = values[1], .primitives = values[0], .fragments = values[2], .invocations = values[3]};
}

}  // namespace sundial
