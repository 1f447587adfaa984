#include "flags.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <sstream>

namespace sundial {

namespace {

// The configuration file: TOML, its keys the names of the flags.
class TomlConfig final : public CLI::Config {
 public:
  explicit TomlConfig(const CLI::App& app) : app_(app) {}

  std::string to_config(const CLI::App*, bool, bool, std::string) const override { return {}; }

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    toml::table table;
    try {
      table = toml::parse(input);
    } catch (const toml::parse_error& error) {
      const toml::source_position at = error.source().begin;
      throw CLI::ConfigError(
          fmt::format("--config: line {}, column {}: {}", at.line, at.column, error.description()),
          CLI::ExitCodes::ConfigError);
    }
    std::vector<CLI::ConfigItem> items;
    for (const auto& [key, node] : table) {
      CLI::ConfigItem item;
      item.name = std::string(key.str());
      if (!app_.get_option_no_throw("--" + item.name)) {
        throw CLI::ConfigError(fmt::format("--config: there is no key {}", item.name),
                               CLI::ExitCodes::ConfigError);
      }
      if (const toml::array* list = node.as_array()) {
        for (const toml::node& one : *list) item.inputs.push_back(text(item.name, one));
      } else {
        item.inputs.push_back(text(item.name, node));
      }
      items.push_back(std::move(item));
    }
    return items;
  }

 private:
  const CLI::App& app_;

  static std::string text(const std::string& key, const toml::node& node) {
    if (const auto value = node.value_exact<std::string>()) return *value;
    if (const auto value = node.value_exact<std::int64_t>()) return std::to_string(*value);
    if (const auto value = node.value_exact<double>()) return fmt::format("{}", *value);
    if (const auto value = node.value_exact<bool>()) return *value ? "true" : "false";
    throw CLI::ConfigError(
        fmt::format("--config: {} must be a text, a number, a truth value or a list of them", key),
        CLI::ExitCodes::ConfigError);
  }
};

Result<std::string> readText(const std::string& flag, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) return invalid(fmt::format("{}: can't read {}", flag, path));
  return std::move(text).str();
}

constexpr const char* kFooter = R"(
Example:
  sundiald --listen 127.0.0.1:50051 --scene-root scenes --metrics 127.0.0.1:9464
  sundiald --config sundiald.toml       with listen = ["unix:/run/sundial.sock"], queue = 128, ...

Exit status: 0 stopped by SIGTERM or SIGINT, 1 it couldn't start or its device was lost, 2 bad flags.)";

}  // namespace

Result<std::optional<Flags>> parseFlags(int argc, const char* const* argv, std::string& text) {
  Flags flags;
  CLI::App app("Renders shadows as a service: a headless Vulkan server behind gRPC.", "sundiald");
  app.footer(kFooter);
  app.set_version_flag("--version", SUNDIAL_VERSION);
  app.config_formatter(std::make_shared<TomlConfig>(app));
  app.set_config("--config", "", "a TOML file whose keys are these flags' names; flags come before it");
  app.allow_config_extras(false);
  app.option_defaults()->always_capture_default();

  ServerOptions& server = flags.server;
  std::string sceneRoot, certificate, key, clientAuthority;
  std::uint64_t outputMib = 512, unsentMib = 2048, sceneMib = 4096, uploadMib = 2048;
  double defaultDeadline = 60, maxDeadline = 900, stall = 30, drain = 30;
  const auto positive = CLI::Range(1, 1 << 24);
  const auto seconds = CLI::Range(0.001, 1e6);

  app.add_option("--listen", server.listen,
                 "HOST:PORT (port 0: any that is free) or unix:PATH; may be repeated")
      ->type_name("ADDR")
      ->take_all();
  app.add_option("--scene-root", sceneRoot, "a folder whose .glb and .gltf files clients may name")
      ->type_name("DIR");
  app.add_option("--device", flags.device,
                 "the device's index or a part of its name; default: the first GPU, or else "
                 "a CPU driver")
      ->type_name("NAME|INDEX");
  app.add_flag("--validation", flags.validation, "check all use of Vulkan by the validation layer (slow)");
  app.add_flag("--list-devices", flags.listDevices, "print the devices and exit");
  app.add_option("--queue", server.queue.waiting, "renderings that may wait")->check(positive);
  app.add_option("--queue-per-client", server.queue.waitingPerClient,
                 "of them, of one client: a certificate, or else a connection")
      ->check(positive);
  app.add_option("--max-image-side", server.calls.request.imageSide, "pixels")->check(CLI::Range(1, 8192));
  app.add_option("--max-output-mib", outputMib, "images of one rendering")->check(positive);
  app.add_option("--max-unsent-mib", unsentMib, "images that wait for clients to read them")->check(positive);
  app.add_option("--scene-budget-mib", sceneMib, "memory for loaded scenes; the least recently used go first")
      ->check(positive);
  app.add_option("--max-upload-mib", uploadMib, "a scene's files; all uploads in flight together")
      ->check(positive);
  app.add_option("--max-triangles", server.store.limits.maxTriangles, "of one scene, before instancing")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
  app.add_option("--default-deadline-s", defaultDeadline, "for a rendering whose client sets none")
      ->check(seconds);
  app.add_option("--max-deadline-s", maxDeadline, "for any rendering")->check(seconds);
  app.add_option("--stall-timeout-s", stall, "ends a stream or an upload without progress")->check(seconds);
  app.add_option("--drain-s", drain, "on SIGTERM, for renderings that were accepted")
      ->check(CLI::Range(0.0, 1e6));
  app.add_option("--log-level", flags.logLevel, "debug, info, warn, error")
      ->default_val("info")
      ->check(CLI::IsMember({"debug", "info", "warn", "error"}));
  auto* cert = app.add_option("--tls-cert", certificate, "the server's certificate, PEM")->type_name("FILE");
  auto* pkey = app.add_option("--tls-key", key, "its key, PEM")->type_name("FILE");
  cert->needs(pkey);
  pkey->needs(cert);
  app.add_option("--tls-client-ca", clientAuthority, "clients must show a certificate of this authority, PEM")
      ->type_name("FILE")
      ->needs(cert);
  app.add_option("--metrics", flags.metricsAddress, "serve Prometheus metrics at http://ADDR/metrics")
      ->type_name("ADDR");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      std::ostringstream out;
      app.exit(error, out, out);
      text = out.str();
      return std::nullopt;
    }
    return invalid(fmt::format("{}; see sundiald --help", error.what()));
  }

  const auto milliseconds = [](double s) {
    return std::chrono::milliseconds(static_cast<std::int64_t>(s * 1000));
  };
  flags.drain = milliseconds(drain);
  server.calls.defaultDeadline = milliseconds(std::min(defaultDeadline, maxDeadline));
  server.calls.maxDeadline = milliseconds(maxDeadline);
  server.calls.stallTimeout = milliseconds(stall);
  server.calls.request.outputBytes = outputMib << 20;
  server.calls.uploadBytes = uploadMib << 20;
  server.queue.unsentBytes = std::max(unsentMib, outputMib) << 20;
  server.store.budgetBytes = sceneMib << 20;
  server.store.limits.maxFileBytes = uploadMib << 20;
  server.store.limits.maxDecodedBytes =
      std::min(server.store.limits.maxDecodedBytes, server.store.budgetBytes);
  if (!sceneRoot.empty()) {
    auto root = SceneRoot::open(sceneRoot);
    if (!root) return std::unexpected(std::move(root.error()));
    server.store.root = std::move(*root);
  }
  if (!certificate.empty()) {
    TlsOptions tls;
    for (const auto& [flag, path, content] :
         {std::tuple{"--tls-cert", certificate, &tls.certificate}, std::tuple{"--tls-key", key, &tls.key},
          std::tuple{"--tls-client-ca", clientAuthority, &tls.clientAuthority}}) {
      if (path.empty()) continue;
      auto file = readText(flag, path);
      if (!file) return std::unexpected(std::move(file.error()));
      *content = std::move(*file);
    }
    server.tls = std::move(tls);
  }
  return flags;
}

}  // namespace sundial
