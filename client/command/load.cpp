// sundial load: brings a scene to a server and keeps it there.
#include <fmt/format.h>

#include <memory>

#include "command/command.h"
#include "command/failure.h"
#include "command/json.h"

namespace sundial::command {
namespace {

void load(Session& session, const std::string& scene) {
  session.needServer("load");
  const v1::SceneInfo info = isLocalFile(scene) ? session.upload(orRefuse(client::gatherSceneFiles(scene)))
                                                : session.answer(session.client().load(scene));
  if (session.options().json) return printJson(info);
  if (!session.options().quiet)
    fmt::print("{}: {} triangles, {} instances, {:.1f} MiB\n", info.reference(), info.triangles(),
               info.instances(), static_cast<double>(info.bytes()) / (1 << 20));
}

}  // namespace

void addLoad(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("load", "Load a scene into a server that outlives the command");
  command->footer("Example:\n  sundial --server 127.0.0.1:50051 load ./apartment.glb");
  const auto scene = std::make_shared<std::string>();
  command->add_option("SCENE", *scene, kSceneHelp)->required();
  command->callback([&action, scene] { action = [scene](Session& session) { load(session, *scene); }; });
}

}  // namespace sundial::command
