#include "command/folder.h"

#include <fmt/format.h>

#include "command/failure.h"
#include "image/file.h"

namespace sundial::command {

void makeFolder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(folder, error) && !fs::create_directories(folder, error))
    throw refusal(fmt::format("-o: can't make the folder {}: {}; choose another", folder.string(),
                              error ? error.message() : "a file is in its place"));
  if (const auto why = image::whyUnwritable(folder / "index.html")) throw refusal("-o: " + *why);
}

}  // namespace sundial::command
