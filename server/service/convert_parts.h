// What several requests have in common, checked.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "service/convert.h"

namespace sundial {

// 1 to kMaxNameLength bytes. Errors: invalidArgument.
Result<std::string> checkedName(const std::string& value, const std::string& field);

// Errors: invalidArgument.
Result<glm::uvec2> checkedSize(std::uint32_t width, std::uint32_t height, const RequestLimits&);

// Errors: invalidArgument, notFound for a method.
Result<Method> methodOf(const v1::MethodChoice&, const std::string& field);
Result<std::vector<Method>> methodsOf(const google::protobuf::RepeatedPtrField<v1::MethodChoice>&);

// One of a scene's named things. Errors: notFound, with the names that there are.
template <class Named>
Result<Named> findNamed(const std::vector<Named>& all, const std::string& name, std::string_view what) {
  std::vector<std::string_view> names;
  for (const Named& one : all) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  return fail(ErrorCode::notFound,
              fmt::format("{}_name is '{}': the scene has {}", what, name,
                          names.empty() ? "none with a name" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace sundial
