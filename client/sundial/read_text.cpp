#include "sundial/read_text.h"

#include <fmt/format.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace sundial::client {
namespace {

// Keeps the first error.
class FirstError final : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, google::protobuf::io::ColumnNumber column, const std::string& what) override {
    if (text.empty()) text = fmt::format("line {}, column {}: {}", line + 1, column + 1, what);
  }
  std::string text;
};

}  // namespace

Expected<void> readText(const std::filesystem::path& path, google::protobuf::Message& message) {
  std::ifstream file(path, std::ios::binary);
  std::error_code ignored;
  if (!file || std::filesystem::is_directory(path, ignored))
    return fail(grpc::NOT_FOUND, fmt::format("can't read {}: {}", path.string(),
                                             file ? "it is a folder" : std::strerror(errno)));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  FirstError error;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  if (!parser.ParseFromString(text, &message))
    return fail(grpc::INVALID_ARGUMENT, fmt::format("{}: {}", path.string(), error.text));
  return {};
}

}  // namespace sundial::client
