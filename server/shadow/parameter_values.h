// What users write as a parameter's value: "2048", "1024x512", "0.5", "4:12:40", a choice, "auto".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shadow/method.h"

namespace sundial {

inline constexpr std::string_view kAuto = "auto";

// Why the value isn't one of the parameter's.
std::optional<std::string> whyWrong(const Parameter&, std::string_view value);

// Of values that aren't wrong.
double numberIn(std::string_view text);
unsigned countIn(std::string_view text);
std::pair<unsigned, unsigned> sizeIn(std::string_view text);
std::vector<double> listIn(std::string_view text);
std::optional<double> unlessAuto(std::string_view text);

}  // namespace sundial
