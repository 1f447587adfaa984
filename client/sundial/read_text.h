#pragma once

#include <google/protobuf/message.h>

#include <filesystem>

#include "sundial/error.h"

namespace sundial::client {

// Fills the message from a file in protobuf text format. Errors name the file: NOT_FOUND where it can't be
// read, INVALID_ARGUMENT, with line and column, where it is no such message.
Expected<void> readText(const std::filesystem::path&, google::protobuf::Message&);

}  // namespace sundial::client
