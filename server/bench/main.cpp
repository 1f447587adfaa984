// sundial-bench: renders in process and prints one JSON line for each method as soon as it is done.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "bench/json.h"
#include "bench/options.h"
#include "bench/place.h"
#include "scene/choose.h"

namespace sundial::bench {

namespace {

class Printer final : public JobSink {
 public:
  explicit Printer(Case of) : case_(std::move(of)) {}
  void onPlan(std::size_t, const std::vector<PlanView>&) override {}
  void onImage(std::size_t, Image) override {}
  void onResult(std::size_t, MethodResult result) override {
    fmt::print("{}\n", toJson(case_, result));
    std::fflush(stdout);
  }

 private:
  const Case case_;
};

Result<void> measureAll(Options options) {
  const auto renderer = Renderer::create(options.device, options.validation);
  if (!renderer) return std::unexpected(renderer.error());
  auto scene = loadScene(options.scene);
  if (!scene) return std::unexpected(std::move(scene.error()));
  const auto view = options.view ? Result<View>(*options.view) : chooseView(*scene, options.viewName);
  if (!view) return std::unexpected(view.error());
  const auto light = options.light ? Result<Light>(*options.light) : chooseLight(*scene, options.lightName);
  if (!light) return std::unexpected(light.error());

  RenderJob& job = options.job;
  job.scene = std::make_shared<const Scene>(std::move(*scene));
  job.view = *view;
  job.light = *light;
  Printer printer({options.scene, options.baseline, (*renderer)->device(), job});
  return (*renderer)->run(job, {}, printer);
}

int complain(std::string message, int status) {
  std::ranges::replace(message, '\n', ' ');
  fmt::print(stderr, "sundial-bench: {}\n", message);
  return status;
}

int run(int argc, char** argv) {
  auto parsed = parseOptions(argc, argv);
  if (!parsed) return complain(parsed.error().message, 2);
  if (const auto* answer = std::get_if<Answer>(&*parsed)) {
    fmt::print("{}", *answer);
    return 0;
  }
  if (const auto done = measureAll(std::move(std::get<Options>(*parsed))); !done)
    return complain(done.error().message, 1);
  return 0;
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  try {
    return sundial::bench::run(argc, argv);
  } catch (const std::exception& unexpected) {
    return sundial::bench::complain(unexpected.what(), 1);
  }
}
