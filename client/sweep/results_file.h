// The file of a sweep's results: one JSON line a case, complete or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "sundial/error.h"

namespace sundial::sweep {

// One writer at a time, over all processes of the machine.
class ResultsFile {
 public:
  // A new file. Errors: ALREADY_EXISTS, with what to do about it; FAILED_PRECONDITION if it can't be made.
  static client::Expected<ResultsFile> create(const std::filesystem::path&);

  // That of a sweep that ended early, or a new one. A last line that is torn is cut off; its case isn't done.
  // Errors: INVALID_ARGUMENT, with its number, for another line that is no result; FAILED_PRECONDITION if the
  // file can't be read and written, or another sweep writes it.
  static client::Expected<ResultsFile> resume(const std::filesystem::path&);

  ResultsFile(ResultsFile&&) noexcept;
  ResultsFile& operator=(ResultsFile&&) = delete;
  ~ResultsFile();

  // What it held when it was opened: for each case, whether it failed.
  const std::map<std::string, bool>& done() const { return done_; }

  // On the disk when it returns. `line` ends with its only newline. Throws std::runtime_error, and leaves
  // nothing of the line, where that is impossible. Not for several threads at once.
  void append(std::string_view line);

 private:
  ResultsFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  client::Expected<void> lock() const;
  client::Expected<void> read();

  std::filesystem::path path_;
  int descriptor_;
  std::map<std::string, bool> done_;
};

}  // namespace sundial::sweep
