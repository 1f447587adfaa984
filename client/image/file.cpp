#include "image/file.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <list>
#include <stdexcept>

namespace sundial::image {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

mode_t usualMode() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

// A file under another name until commit().
class PendingFile {
 public:
  explicit PendingFile(const OutputFile& file) : path_(file.path) {
    std::string pattern = (folderOf(path_) / fmt::format(".{}.XXXXXX", path_.filename().string())).string();
    const int fd = mkstemp(pattern.data());
    if (fd < 0) fail();
    pending_ = pattern;
    bool good = fchmod(fd, usualMode()) == 0;
    for (std::size_t done = 0; good && done < file.bytes.size();) {
      const ssize_t count = write(fd, file.bytes.data() + done, file.bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      good = count >= 0;
      if (good) done += static_cast<std::size_t>(count);
    }
    const int error = errno;
    if (close(fd) == 0 && good) return;
    unlink(pending_.c_str());
    if (!good) errno = error;
    fail();
  }
  ~PendingFile() {
    if (!pending_.empty()) unlink(pending_.c_str());
  }
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void commit() {
    if (rename(pending_.c_str(), path_.c_str()) != 0) fail();
    pending_.clear();
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error(fmt::format("can't write {}: {}; check the folder and its free space",
                                         path_.string(), std::strerror(errno)));
  }

  fs::path path_, pending_;
};

}  // namespace

void writeFiles(const std::vector<OutputFile>& files) {
  std::list<PendingFile> pending;
  for (const OutputFile& file : files) pending.emplace_back(file);
  for (PendingFile& file : pending) file.commit();
}

std::optional<std::string> whyUnwritable(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return fmt::format("{} is a folder; name a file in it", path.string());
  const fs::path folder = folderOf(path);
  if (!fs::is_directory(folder, error))
    return fmt::format("there is no folder {}; make it first", folder.string());
  if (access(folder.c_str(), W_OK) != 0)
    return fmt::format("the folder {} can't be written to: {}", folder.string(), std::strerror(errno));
  return std::nullopt;
}

}  // namespace sundial::image
