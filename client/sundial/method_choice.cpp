#include "sundial/method_choice.h"

#include <fmt/format.h>

#include <map>

namespace sundial::client {

Expected<v1::MethodChoice> parseMethodChoice(std::string_view text) {
  const auto refuse = [&](std::string_view why) {
    return fail(
        grpc::INVALID_ARGUMENT,
        fmt::format("'{}' is no method: {}; write NAME[,key=value]..., e.g. sm,texels=2048", text, why));
  };
  v1::MethodChoice choice;
  std::string_view rest = text;
  for (bool first = true;; first = false) {
    const auto comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    if (first) {
      if (part.empty()) return refuse("its name is empty");
      if (part.contains('=')) return refuse("it begins with a parameter");
      choice.set_name(std::string(part));
    } else {
      const auto equals = part.find('=');
      if (equals == std::string_view::npos || equals == 0 || equals + 1 == part.size())
        return refuse(fmt::format("'{}' is not key=value", part));
      const std::string key(part.substr(0, equals));
      if (!choice.mutable_parameters()->insert({key, std::string(part.substr(equals + 1))}).second)
        return refuse(fmt::format("'{}' is given twice", key));
    }
    if (comma == std::string_view::npos) return choice;
    rest.remove_prefix(comma + 1);
  }
}

std::string methodLabel(const v1::MethodChoice& choice) {
  std::string label = choice.name();
  const std::map<std::string, std::string> ordered(choice.parameters().begin(), choice.parameters().end());
  for (const auto& [key, value] : ordered) label += fmt::format(",{}={}", key, value);
  return label;
}

}  // namespace sundial::client
