// What several requests have in common, checked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "service/convert.h"

namespace sundial {

// 1 to kMaxNameLength bytes. Errors: invalidArgument.
Result<std::string> checkedName(const std::string& value, const std::string& field);

// Errors: invalidArgument outside of [low, high].
Result<void> checkCount(std::string_view field, std::uint64_t value, std::uint64_t low, std::uint64_t high);

// Errors: invalidArgument.
Result<glm::uvec2> checkedSize(std::uint32_t width, std::uint32_t height, const RequestLimits&);

// Errors: invalidArgument, notFound for a method.
Result<Method> methodOf(const v1::MethodChoice&, const std::string& field);
Result<std::vector<Method>> methodsOf(const google::protobuf::RepeatedPtrField<v1::MethodChoice>&);

}  // namespace sundial
