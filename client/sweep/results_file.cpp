#include "sweep/results_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sundial/v1/sweep.pb.h"

namespace sundial::sweep {
namespace {

using client::Expected;
namespace fs = std::filesystem;

std::unexpected<client::Error> unusable(const fs::path& path, const char* verb) {
  return client::fail(grpc::FAILED_PRECONDITION, fmt::format("can't {} {}: {}; choose another with -o", verb,
                                                             path.string(), std::strerror(errno)));
}

std::optional<v1::SweepLine> parsed(std::string_view text) {
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;  // of a newer sweep
  v1::SweepLine line;
  const bool good = google::protobuf::util::JsonStringToMessage(
                        google::protobuf::StringPiece(text.data(), text.size()), &line, options)
                        .ok();
  if (!good || line.case_().empty()) return std::nullopt;
  return line;
}

}  // namespace

Expected<ResultsFile> ResultsFile::create(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno == EEXIST)
    return client::fail(
        grpc::ALREADY_EXISTS,
        fmt::format("{} exists; add --resume to go on with it, choose another with -o, or remove it",
                    path.string()));
  if (descriptor < 0) return unusable(path, "write");
  ResultsFile file(path, descriptor);
  if (auto locked = file.lock(); !locked) return std::unexpected(locked.error());
  return file;
}

Expected<ResultsFile> ResultsFile::resume(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) return unusable(path, "write");
  ResultsFile file(path, descriptor);
  if (auto locked = file.lock(); !locked) return std::unexpected(locked.error());
  if (auto read = file.read(); !read) return std::unexpected(read.error());
  return file;
}

ResultsFile::ResultsFile(ResultsFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      done_(std::move(other.done_)) {}

ResultsFile::~ResultsFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

Expected<void> ResultsFile::lock() const {
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return {};
  if (errno != EWOULDBLOCK) return unusable(path_, "lock");
  return client::fail(
      grpc::FAILED_PRECONDITION,
      fmt::format("another sweep writes {}; wait for it, or choose another file with -o", path_.string()));
}

Expected<void> ResultsFile::read() {
  std::string text;
  std::string piece(1 << 20, '\0');
  for (;;) {
    const ssize_t count = pread(descriptor_, piece.data(), piece.size(), static_cast<off_t>(text.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unusable(path_, "read");
    if (count == 0) break;
    text.append(piece, 0, static_cast<std::size_t>(count));
  }
  std::size_t begin = 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    const bool last = end == std::string::npos || end + 1 == text.size();
    const auto line =
        end == std::string::npos ? std::nullopt : parsed(std::string_view(text).substr(begin, end - begin));
    if (!line && last) break;
    if (!line)
      return client::fail(
          grpc::INVALID_ARGUMENT,
          fmt::format("{}: line {} is no result of a sweep; remove it, or choose another file with -o",
                      path_.string(), number));
    done_[line->case_()] = line->has_error();
    begin = end + 1;
  }
  if (begin < text.size() && ftruncate(descriptor_, static_cast<off_t>(begin)) != 0)
    return unusable(path_, "mend");
  return {};
}

void ResultsFile::append(std::string_view line) {
  const off_t before = lseek(descriptor_, 0, SEEK_END);
  ssize_t count = 0;
  do {
    count = write(descriptor_, line.data(), line.size());
  } while (count < 0 && errno == EINTR);
  const bool whole = count == static_cast<ssize_t>(line.size());
  if (whole && fdatasync(descriptor_) == 0) return;
  const int error = whole || count < 0 ? errno : ENOSPC;
  const bool mended = ftruncate(descriptor_, before) == 0;
  throw std::runtime_error(
      fmt::format("can't write {}: {}; {} go on with --resume", path_.string(), std::strerror(error),
                  mended ? "make room and" : "its last line may be torn: make room and"));
}

}  // namespace sundial::sweep
