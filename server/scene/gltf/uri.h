// The URIs of buffers and images.
#pragma once

#include <string>
#include <string_view>

#include "result.h"

namespace sundial::gltf {

bool isDataUri(std::string_view uri);

// The bytes of "data:[type];base64,..." (or percent-encoded). Error: invalidArgument.
Result<std::string> decodeDataUri(std::string_view uri);

// "%20" becomes a space; a '%' that starts no escape stays.
std::string percentDecode(std::string_view uri);

// Whether a decoded URI names a file in the scene's own folder or below it: relative, and never above where
// it began.
bool staysInFolder(std::string_view path);

}  // namespace sundial::gltf
