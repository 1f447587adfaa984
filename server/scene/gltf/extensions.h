// Which glTF extensions a file may require.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "result.h"

namespace sundial::gltf {

// Errors: invalidArgument for one that is not supported, naming it and those that are.
Result<void> checkRequiredExtensions(const nlohmann::json& document);

}  // namespace sundial::gltf
