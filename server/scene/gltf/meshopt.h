// EXT_meshopt_compression: one compressed buffer view.
#pragma once

#include "scene/gltf/buffer_data.h"

namespace sundial::gltf {

// count * byteStride bytes. Errors: resourceExhausted, invalidArgument for parameters that the extension
// excludes, dataLoss for bytes that do not decode.
Result<std::vector<std::byte>> decodeMeshopt(const MeshoptView&, Bytes compressed, Budget&);

}  // namespace sundial::gltf
