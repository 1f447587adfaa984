// sundial-bench's command line: the words of the command `sundial`, without a server.
#pragma once

#include <string>
#include <variant>

#include "renderer.h"

namespace sundial::bench {

struct Options {
  std::string scene, device, baseline;
  bool validation = false;
  RenderJob job;  // all but the scene, and the view and the light where they are named
  std::optional<View> view;
  std::optional<Light> light;
  std::optional<std::string> viewName, lightName;
};

// Text to print, when all is said (--help, --version).
using Answer = std::string;

// Errors: invalidArgument or notFound for what can be refused without the scene.
Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv);

}  // namespace sundial::bench
