#include "command/json.h"

#include <fmt/format.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <memory>

#include "command/failure.h"

namespace sundial::command {

namespace {

std::string json(const google::protobuf::Message& message, bool whitespace) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = whitespace;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  // By way of bytes whose maps are in order: a message's own are in none.
  std::string bytes, text;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&coded);
  }
  constexpr const char* kPrefix = "type.googleapis.com";
  const std::unique_ptr<google::protobuf::util::TypeResolver> types(
      google::protobuf::util::NewTypeResolverForDescriptorPool(kPrefix,
                                                               message.GetDescriptor()->file()->pool()));
  const std::string type = fmt::format("{}/{}", kPrefix, message.GetDescriptor()->full_name());
  if (const auto status =
          google::protobuf::util::BinaryToJsonString(types.get(), type, bytes, &text, options);
      !status.ok())
    throw failure(fmt::format("the server's answer can't be written as JSON: {}", status.ToString()));
  if (!text.ends_with('\n')) text += '\n';
  return text;
}

}  // namespace

std::string toJson(const google::protobuf::Message& message) { return json(message, true); }

std::string toJsonLine(const google::protobuf::Message& message) { return json(message, false); }

void printJson(const google::protobuf::Message& message) { fmt::print("{}", toJson(message)); }

}  // namespace sundial::command
