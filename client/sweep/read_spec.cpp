#include "sundial/read_text.h"
#include "sweep/cases.h"

namespace sundial::sweep {

client::Expected<v1::SweepSpec> readSpec(const std::filesystem::path& path) {
  v1::SweepSpec spec;
  auto read = client::readText(path, spec);
  if (read) return spec;
  read.error().message += "; a specification is a file in protobuf text format, see 'sundial sweep --help'";
  return std::unexpected(std::move(read.error()));
}

}  // namespace sundial::sweep
