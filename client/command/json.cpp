#include "command/json.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include "command/failure.h"

namespace sundial::command {

std::string toJson(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  std::string json;
  if (const auto status = google::protobuf::util::MessageToJsonString(message, &json, options); !status.ok())
    throw failure(fmt::format("the server's answer can't be written as JSON: {}", status.ToString()));
  if (!json.ends_with('\n')) json += '\n';
  return json;
}

void printJson(const google::protobuf::Message& message) { fmt::print("{}", toJson(message)); }

}  // namespace sundial::command
