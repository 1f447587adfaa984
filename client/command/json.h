// One JSON document on standard output: the protobuf mapping with the contract's own names.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace sundial::command {

// Ends with a newline. Zeros and empty lists are written; messages that aren't set are left out.
std::string toJson(const google::protobuf::Message&);

// The same on one line. Like messages give like bytes.
std::string toJsonLine(const google::protobuf::Message&);

void printJson(const google::protobuf::Message&);

}  // namespace sundial::command
