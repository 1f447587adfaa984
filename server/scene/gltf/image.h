// PNG and JPEG images.
#pragma once

#include "scene/gltf/buffer_data.h"
#include "scene/scene_builder.h"

namespace sundial::gltf {

// Width and height as the header says. Errors: invalidArgument for another format, which it names, for a side
// of 0 or over 16384; dataLoss for a header cut off.
Result<glm::uvec2> imageSize(Bytes);

// Error: dataLoss for an image that doesn't decode.
Result<Texture> decodeImage(Bytes);

}  // namespace sundial::gltf
