#include "bench/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <sstream>

#include "shadow/camera.h"

namespace sundial::bench {

namespace {

constexpr const char* kFooter = R"(
Prints one JSON line for each method, with the fields that `sundial compare --json` has.

Example:
  sundial-bench --scene builtin:atrium --method sm,texels=1024 --method dv --measures

Exit status: 0 done, 1 a rendering failed, 2 the command line was refused.)";

using Numbers = std::vector<double>;

glm::dvec3 vec3(const Numbers& n, std::size_t first = 0) { return {n[first], n[first + 1], n[first + 2]}; }

std::optional<glm::uvec2> parseSize(std::string_view text) {
  glm::uvec2 size{0};
  const char* const end = text.data() + text.size();
  const auto [x, error] = std::from_chars(text.data(), end, size.x);
  if (error != std::errc() || x == end || *x != 'x') return std::nullopt;
  const auto [last, wrong] = std::from_chars(x + 1, end, size.y);
  if (wrong != std::errc() || last != end) return std::nullopt;
  return size;
}

// What the command line says, as text and numbers.
struct Words {
  std::string scene = "builtin:atrium", device, size = "1024x1024", baseline = "sm,texels=2048";
  std::vector<std::string> methods;
  std::string viewName, lightName;
  Numbers eye, target, up{0, 1, 0}, sun, spot, point;
  double fov = 60;
  unsigned repetitions = 5;
  bool measures = false, validation = false;
};

void describe(CLI::App& app, Words& words) {
  app.footer(kFooter);
  app.set_version_flag("--version", SUNDIAL_VERSION);
  // Numbers separated by commas in one word.
  const auto numbers = [&app](const char* name, Numbers& to, int count, const char* type, const char* text) {
    return app.add_option(name, to, text)->delimiter(',')->expected(count)->type_name(type);
  };
  app.add_option("--scene", words.scene, "builtin:NAME[?key=value&...], or a .glb or .gltf file")
      ->capture_default_str();
  app.add_option("--method", words.methods, "to be timed; repeat it for each; default: every row")
      ->type_name("NAME[,key=value]...")
      ->allow_extra_args(false);
  app.add_option("--baseline", words.baseline, "timed in turn with every method")
      ->type_name("NAME[,key=value]...")
      ->capture_default_str();
  app.add_option("--repetitions", words.repetitions, "timed frames of each method")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--size", words.size, "pixels")->type_name("WxH")->capture_default_str();
  app.add_flag("--measures", words.measures, "also how wrong each method is, against ray tracing");
  app.add_option("--device", words.device, "default: the first GPU, or else a CPU driver")
      ->type_name("NAME|INDEX");
  app.add_flag("--validation", words.validation, "check all use of Vulkan by the validation layer (slow)");

  auto* eye = numbers("--eye", words.eye, 3, "X,Y,Z", "camera position, metres");
  auto* target = numbers("--target", words.target, 3, "X,Y,Z", "point to look at, metres");
  numbers("--up", words.up, 3, "X,Y,Z", "direction that is up in the picture")->needs(eye);
  app.add_option("--fov", words.fov, "vertical field of view, degrees")->needs(eye)->capture_default_str();
  app.add_option("--view", words.viewName, "a view of the scene by its name")->excludes(eye);
  eye->needs(target);
  target->needs(eye);

  auto* sun = numbers("--sun", words.sun, 3, "X,Y,Z", "direction in which the sun's light travels");
  auto* spot = numbers("--spot", words.spot, 7, "EX,EY,EZ,TX,TY,TZ,DEGREES", "position, target, cone");
  auto* point = numbers("--point", words.point, 3, "X,Y,Z", "position of a point light");
  auto* name = app.add_option("--light", words.lightName, "a light of the scene by its name");
  sun->excludes(spot)->excludes(point)->excludes(name);
  spot->excludes(point)->excludes(name);
  point->excludes(name);
}

Result<std::vector<Method>> methodsOf(const std::vector<std::string>& texts) {
  std::vector<Method> methods;
  for (const std::string& text : texts) {
    auto method = parseMethod(text);
    if (!method) return std::unexpected(std::move(method.error()));
    methods.push_back(std::move(*method));
  }
  if (texts.empty())
    for (const MethodRow& row : methodTable()) methods.push_back(*chooseMethod(row.name, {}));
  return methods;
}

std::optional<Light> lightOf(const Words& words) {
  if (!words.sun.empty()) return Light{.kind = LightKind::directional, .direction = vec3(words.sun)};
  if (!words.point.empty()) return Light{.kind = LightKind::point, .position = vec3(words.point)};
  if (words.spot.empty()) return std::nullopt;
  return Light{.kind = LightKind::spot,
               .direction = vec3(words.spot, 3) - vec3(words.spot),
               .position = vec3(words.spot),
               .coneDegrees = words.spot[6]};
}

Result<Options> toOptions(const Words& words) {
  Options options{.scene = words.scene,
                  .device = words.device,
                  .baseline = words.baseline,
                  .validation = words.validation};
  const auto size = parseSize(words.size);
  if (!size || size->x == 0 || size->y == 0)
    return invalid(fmt::format("--size: '{}' is no size; write WIDTHxHEIGHT, at least 1x1", words.size));
  auto methods = methodsOf(words.methods);
  if (!methods) return std::unexpected(std::move(methods.error()));
  auto baseline = parseMethod(words.baseline);
  if (!baseline) return std::unexpected(std::move(baseline.error()));
  options.job.size = *size;
  options.job.methods = std::move(*methods);
  options.job.baseline = std::move(*baseline);
  options.job.repetitions = words.repetitions;
  options.job.measures = words.measures;
  if (!words.eye.empty()) options.view = View{vec3(words.eye), vec3(words.target), vec3(words.up), words.fov};
  if (!words.viewName.empty()) options.viewName = words.viewName;
  options.light = lightOf(words);
  if (auto why = options.view ? whyInvalid(*options.view) : std::nullopt) return invalid(*why);
  if (auto why = options.light ? whyInvalid(*options.light) : std::nullopt) return invalid(*why);
  if (!words.lightName.empty()) options.lightName = words.lightName;
  return options;
}

}  // namespace

Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv) {
  CLI::App app("Times every pass of shadow methods, without a server.", "sundial-bench");
  Words words;
  describe(app, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& said) {
    std::ostringstream out;
    app.exit(said, out, out);
    return out.str();
  } catch (const CLI::ParseError& error) {
    return invalid(fmt::format("{}; see sundial-bench --help", error.what()));
  }
  auto options = toOptions(words);
  if (!options) return std::unexpected(std::move(options.error()));
  return std::move(*options);
}

}  // namespace sundial::bench
