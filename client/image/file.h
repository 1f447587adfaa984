// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sundial::image {

struct OutputFile {
  std::filesystem::path path;
  std::string bytes;
};

// Writes each beside its place and moves them there when all are written. Throws std::runtime_error with the
// file and the reason; nothing is left of a failed write.
void writeFiles(const std::vector<OutputFile>&);

// Why no file can be written at `path`; nothing if it can.
std::optional<std::string> whyUnwritable(const std::filesystem::path& path);

}  // namespace sundial::image
