#include <fmt/format.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "sweep/cases.h"

namespace sundial::sweep {
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

client::Expected<v1::SweepSpec> readSpec(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code ignored;
  if (!file || std::filesystem::is_directory(path, ignored))
    return client::fail(grpc::NOT_FOUND, fmt::format("can't read the specification {}: {}", path.string(),
                                                     file ? "it is a folder" : std::strerror(errno)));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  v1::SweepSpec spec;
  FirstError error;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  if (!parser.ParseFromString(text, &spec))
    return client::fail(grpc::INVALID_ARGUMENT,
                        fmt::format("{}: {}; a specification is protobuf text format, "
                                    "see 'sundial sweep --help'",
                                    path.string(), error.text));
  return spec;
}

}  // namespace sundial::sweep
