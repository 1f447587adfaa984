// The document of `compare --json`, from what a server answered.
#pragma once

#include <string>

#include "command/session.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial::command {

// Every message of the document is there, so that every key is printed. `scene` is what the user called it.
v1::Report makeReport(const std::string& scene, const v1::RenderRequest&, const client::Rendering&,
                      const v1::ServerInfo&);

}  // namespace sundial::command
