// Content addresses: SHA-256 as 64 hexadecimal digits.
#pragma once

#include <string>
#include <string_view>

#include "scene/load.h"

namespace sundial {

// Of a scene's files: their contents, and the names by which the main file refers to the others. The main
// file's own name doesn't count, nor does any order.
std::string digestOf(const SceneFiles&);

// Of a built-in scene: its canonical reference.
std::string digestOfBuiltin(std::string_view canonicalReference);

}  // namespace sundial
