// sundial: the command. Says what it is asked, runs it, and turns every failure into a status and one line.
#include <fmt/format.h>
#include <grpc/grpc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "command/command.h"
#include "command/failure.h"
#include "command/interrupt.h"

namespace sundial::command {
namespace {

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
  app.add_option(
         "--server", options.server,
         "where sundiald listens: HOST:PORT (127.0.0.1:50051 by default there) or unix:PATH; several\n"
         "share the calls. Without it the command starts a sundiald of its own and stops it after")
      ->type_name("ADDR[,ADDR...]");
  app.add_option("--scene-root", options.privateServer.sceneRoot,
                 "folder of scenes of the command's own sundiald")
      ->type_name("DIR")
      ->excludes("--server");
  app.add_option("--device", options.privateServer.device, "device of the command's own sundiald")
      ->type_name("NAME|INDEX")
      ->excludes("--server");
  app.add_option("--timeout", options.timeoutSeconds, "seconds that a call may take [900]")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.001, 86400.0));
  app.add_flag("--json", options.json, "one JSON document on standard output");
  app.add_flag("--quiet", options.quiet, "no progress and no remarks");
}

// "sundial: what" on one line, whatever a server's or a library's message holds.
int complain(std::string line, int status) {
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
  std::ranges::replace_if(
      line, [](unsigned char c) { return std::iscntrl(c); }, ' ');
  fmt::print(stderr, "sundial: {}\n", line);
  return status;
}

int run(int argc, char** argv) {
  setenv("GRPC_VERBOSITY", "NONE", 0);  // failures are told once, by us
  GlobalOptions options;
  Action action;
  CLI::App app("Renders shadows with many methods, and says how wrong each is and what it costs.", "sundial");
  app.footer(
      "Example:\n  sundial compare builtin:atrium --method sm,texels=1024 --method dv -o out\n\n"
      "'sundial COMMAND --help' shows a command's options. Exit status: 0 done, 1 the request failed,\n"
      "2 the command line was refused.");
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", SUNDIAL_VERSION);
  addGlobalOptions(app, options);
  addScenes(app, action);
  addLoad(app, action);
  addUnload(app, action);
  addMethods(app, action);
  addRender(app, action);
  addCompare(app, action);
  addStability(app, action);
  addSweep(app, action);
  addChart(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    if (app.get_subcommands().empty() && !app.remaining().empty())
      return complain(fmt::format("there is no '{}'; see 'sundial --help'", app.remaining().front()), 2);
    return complain(fmt::format("{}; see 'sundial --help'", error.what()), 2);
  }

  const Interrupt interrupt;
  grpc_init();  // and no shutdown: at its end gRPC waits for a poller of its own, up to ten seconds
  const auto end = [&](const std::string& line, int status) {
    if (interrupt.signal() == 0) return complain(line, status);
    return complain("interrupted", 128 + interrupt.signal());
  };
  try {
    Session session(std::move(options), interrupt);
    action(session);
    if (std::fflush(stdout) != 0) return end("standard output can't be written; check its disk or pipe", 1);
    return 0;
  } catch (const Failure& failed) {
    return end(failed.what(), failed.status());
  } catch (const std::exception& unexpected) {
    return end(unexpected.what(), 1);
  }
}

}  // namespace
}  // namespace sundial::command

int main(int argc, char** argv) { return sundial::command::run(argc, argv); }
