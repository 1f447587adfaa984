// Image files in memory, the same bytes for the same pixels: no dates, no names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "image/picture.h"

namespace sundial::image {

enum class FileType { png, jpg, exr };

// By the extension, in either case; nothing for another one.
std::optional<FileType> fileType(const std::filesystem::path&);

// These throw std::runtime_error if the encoder fails.
std::string encodePng(const Picture&);
std::string encodeJpeg(const Picture&, int quality);  // quality in [1, 100]

// All of a method's images as the channels of one OpenEXR file, 32 bits each: R,G,B (linear) and A,
// visibility.V, reference.V, position.X,Y,Z, normal.X,Y,Z as floats; id.instance, id.triangle and view.I as
// unsigned integers, which a float would round. Names are as in DESIGN section 4.
std::string encodeExr(const client::MethodRendering&);

}  // namespace sundial::image
