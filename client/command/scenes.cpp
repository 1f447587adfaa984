// sundial scenes, load and unload are about the same thing but each is its own command: this one lists.
#include <fmt/format.h>

#include "command/command.h"
#include "command/json.h"

namespace sundial::command {
namespace {

std::string joined(const google::protobuf::RepeatedPtrField<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

void list(Session& session) {
  const auto response = session.answer(session.client().listScenes());
  if (session.options().json) return printJson(response);
  for (const v1::SceneInfo& scene : response.scenes()) {
    fmt::print("{:<28} {}\n", scene.reference(), scene.loaded() ? "loaded" : "");
    if (!scene.description().empty()) fmt::print("    {}\n", scene.description());
    if (scene.triangles() > 0)
      fmt::print("    {} triangles in {} meshes, {} drawn by {} instances\n", scene.triangles(),
                 scene.meshes(), scene.instanced_triangles(), scene.instances());
    if (!scene.views().empty()) fmt::print("    views: {}\n", joined(scene.views()));
    if (!scene.lights().empty()) fmt::print("    lights: {}\n", joined(scene.lights()));
    if (!scene.paths().empty()) fmt::print("    paths: {}\n", joined(scene.paths()));
  }
}

}  // namespace

void addScenes(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("scenes", "List the scenes: loaded, built in, or under the scene root");
  command->footer("Example:\n  sundial --server 127.0.0.1:50051 scenes");
  command->callback([&action] { action = list; });
}

}  // namespace sundial::command
