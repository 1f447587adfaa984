// sundiald's flags and configuration file.
#pragma once

#include <optional>
#include <string>

#include "result.h"
#include "service/server.h"

namespace sundial {

struct Flags {
  ServerOptions server;
  std::string device;
  std::string logLevel;
  std::string metricsAddress;  // empty: no metrics
  std::chrono::milliseconds drain{};
  bool validation = false;
  bool listDevices = false;
};

// Nothing when all is said (--help, --version): what to print is in `text`. Errors: invalidArgument, one
// line. Reads the files that the flags name: configuration, certificates.
Result<std::optional<Flags>> parseFlags(int argc, const char* const* argv, std::string& text);

}  // namespace sundial
