#pragma once

#include <string>
#include <string_view>

namespace sundial::page {

// "data:TYPE;base64,...": a file inside a page.
std::string dataUri(std::string_view type, std::string_view bytes);

}  // namespace sundial::page
