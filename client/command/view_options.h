// --eye ... --light: the view and the light of a request, for every command that renders.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "command/parse.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial::command {

class ViewOptions {
 public:
  // `size`: the default of --size, "WxH".
  void addTo(CLI::App&, const std::string& size = "1024x1024");

  // Throws a refusal for what can never be a view or a light.
  void apply(v1::RenderRequest&) const;

 private:
  void applyView(v1::RenderRequest&) const;
  void applyLight(v1::RenderRequest&) const;

  std::string eye_, target_, up_, fov_, size_, viewName_;
  std::string sun_, spot_, point_, lightName_;
};

}  // namespace sundial::command
