// sundial unload: lets a server's scene go.
#include <fmt/format.h>

#include <memory>

#include "command/command.h"
#include "command/failure.h"
#include "command/json.h"

namespace sundial::command {
namespace {

void unload(Session& session, const std::string& scene) {
  session.needServer("unload");
  if (isLocalFile(scene))
    throw refusal(
        fmt::format("unload: {} is a local file; name the scene as 'sundial scenes' lists it", scene));
  const auto response = session.answer(session.client().unload(scene));
  if (session.options().json) return printJson(response);
  if (!session.options().quiet) fmt::print("{} is unloaded\n", scene);
}

}  // namespace

void addUnload(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("unload", "Let go of a scene that a server holds");
  command->footer("Example:\n  sundial --server 127.0.0.1:50051 unload builtin:atrium");
  const auto scene = std::make_shared<std::string>();
  command->add_option("SCENE", *scene, "as 'sundial scenes' lists it")->required();
  command->callback([&action, scene] { action = [scene](Session& session) { unload(session, *scene); }; });
}

}  // namespace sundial::command
