// The folder of -o.
#pragma once

#include <filesystem>

namespace sundial::command {

// Makes it if it isn't there; it will hold an index.html. Throws a refusal where it can't be written.
void makeFolder(const std::filesystem::path&);

}  // namespace sundial::command
