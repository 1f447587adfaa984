// A channel to one server, or to several that share the calls.
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string_view>
#include <vector>

#include "sundial/error.h"

namespace sundial::client {

// `addresses`: "host:port", "unix:PATH", or a comma list of host:port, whose calls gRPC hands out in turn to
// the servers that say they are healthy. The channel connects when it is first used. Errors: INVALID_ARGUMENT
// for what is no address, UNAVAILABLE for a name of a list that doesn't resolve.
Expected<std::shared_ptr<grpc::Channel>> connect(std::string_view addresses);

// The parts of such a list, to speak to each server by itself. They point into it.
std::vector<std::string_view> eachAddress(std::string_view addresses);

}  // namespace sundial::client
