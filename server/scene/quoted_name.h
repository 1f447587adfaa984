// A name from a file, fit for a one-line message.
#pragma once

#include <string>
#include <string_view>

namespace sundial {

// In single quotes; control characters become '?', more than 60 bytes are cut at a character.
std::string quotedName(std::string_view name);

}  // namespace sundial
