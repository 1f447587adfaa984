// What of a glTF document is read. Everything else is dropped before tinygltf sees the document, and what
// remains has the types and ranges listed here, so that no reader after this has to check them again.
#pragma once

#include <nlohmann/json.hpp>

#include "result.h"

namespace sundial::gltf {

// Errors: invalidArgument, naming the element by its path ("meshes[3].primitives[0].indices").
Result<nlohmann::json> reduceToSchema(const nlohmann::json& document);

}  // namespace sundial::gltf
