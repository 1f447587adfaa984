#include "service/convert_parts.h"

#include <fmt/format.h>

namespace sundial {

Result<std::string> checkedName(const std::string& value, const std::string& field) {
  if (value.empty() || value.size() > kMaxNameLength) {
    return invalid(fmt::format("{} has {} bytes: must have 1 to {}", field, value.size(), kMaxNameLength));
  }
  return value;
}

Result<void> checkCount(std::string_view field, std::uint64_t value, std::uint64_t low, std::uint64_t high) {
  if (value >= low && value <= high) return {};
  return invalid(fmt::format("{} is {}: must lie in [{}, {}]", field, value, low, high));
}

Result<glm::uvec2> checkedSize(std::uint32_t width, std::uint32_t height, const RequestLimits& limits) {
  for (const auto& [field, side] : {std::pair{"width", width}, std::pair{"height", height}}) {
    if (side < 1 || side > limits.imageSide) {
      return invalid(fmt::format("{} is {}: must lie in [1, {}] pixels", field, side, limits.imageSide));
    }
  }
  return glm::uvec2(width, height);
}

Result<Method> methodOf(const v1::MethodChoice& choice, const std::string& field) {
  if (auto named = checkedName(choice.name(), field + ".name"); !named) return std::unexpected(named.error());
  const std::map<std::string, std::string> parameters(choice.parameters().begin(), choice.parameters().end());
  auto method = chooseMethod(choice.name(), parameters);
  if (!method) method.error().message = fmt::format("{}: {}", field, method.error().message);
  return method;
}

Result<std::vector<Method>> methodsOf(const google::protobuf::RepeatedPtrField<v1::MethodChoice>& choices) {
  if (choices.size() < 1 || choices.size() > kMaxMethods) {
    return invalid(fmt::format("methods has {} entries: must have 1 to {}", choices.size(), kMaxMethods));
  }
  std::vector<Method> methods;
  for (int i = 0; i < choices.size(); ++i) {
    auto method = methodOf(choices[i], fmt::format("methods[{}]", i));
    if (!method) return std::unexpected(std::move(method.error()));
    methods.push_back(std::move(*method));
  }
  return methods;
}

}  // namespace sundial
