// The outside of a glTF file: the JSON text and, in a GLB, the binary chunk beside it.
#pragma once

#include <optional>
#include <string_view>

#include "result.h"

namespace sundial::gltf {

struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;  // GLB: the chunk that buffer 0 without a URI means
};

// Views into `bytes`. Errors: dataLoss for a GLB cut off, invalidArgument for what is no glTF file at all.
Result<Container> openContainer(std::string_view bytes);

}  // namespace sundial::gltf
