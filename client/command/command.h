// The subcommands. Each add...() declares one; parsing a command line that names it sets the action to run.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include "command/session.h"

namespace sundial::command {

// Throws Failure.
using Action = std::function<void(Session&)>;

void addScenes(CLI::App&, Action&);
void addLoad(CLI::App&, Action&);
void addUnload(CLI::App&, Action&);
void addMethods(CLI::App&, Action&);
void addRender(CLI::App&, Action&);
void addCompare(CLI::App&, Action&);
void addStability(CLI::App&, Action&);
void addSweep(CLI::App&, Action&);
void addChart(CLI::App&, Action&);

// What SCENE may be, for the help of every command that takes one.
inline constexpr const char* kSceneHelp =
    "builtin:NAME[?key=value&...], a name under the server's scene root, or a local file, "
    "uploaded, if it begins with / or ./ or ../";
inline constexpr const char* kMethodSyntax = "NAME[,key=value]...";

}  // namespace sundial::command
