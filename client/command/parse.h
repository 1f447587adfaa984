// Text of options to numbers. Every failure is a refusal that names the option and what it wants.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sundial/v1/sundial.pb.h"

namespace sundial::command {

// "1,2.5,-3": exactly `count` finite numbers.
std::vector<double> parseNumbers(std::string_view option, std::string_view text, std::size_t count);

v1::Vec3 parseVec3(std::string_view option, std::string_view text);

struct Size {
  unsigned width, height;  // pixels, at least 1
};
Size parseSize(std::string_view option, std::string_view text);  // "1024x768"

// "visibility,id" or "all", each once, in the contract's order; colour comes first in any case.
std::vector<v1::Aov> parseAovs(std::string_view option, std::string_view text);

}  // namespace sundial::command
