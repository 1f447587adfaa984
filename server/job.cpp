#include "job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "shadow/camera.h"
#include "shadow/frame.h"
#include "shadow/frame_runner.h"
#include "shadow/method_in_light.h"
#include "shared/choices.h"

namespace sundial {

namespace {

constexpr unsigned kMaxSide = 8192;

// Linear interpolation between order statistics; of one value it is that value.
Quartiles quartilesOf(std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double q) {
    const double position = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {at(0.25), at(0.5), at(0.75)};
}

bool wants(const RenderJob& job, Aov aov) { return std::ranges::find(job.images, aov) != job.images.end(); }

// What every method of a job is held against.
struct Truth {
  std::vector<shared::ViewSample> samples;
  std::vector<float> visibility;  // these two are empty unless traced
  std::vector<std::uint8_t> facesLight;
};

Truth takeTruth(const Device& device, const ViewTarget& target, const FrameView& view, bool trace) {
  const auto positions = downloaded(device, target.positions, sizeof(glm::uvec4));
  const auto normals = downloaded(device, target.normals, sizeof(glm::uvec4));
  Truth truth{.samples = std::vector<shared::ViewSample>(positions.size() / sizeof(glm::uvec4)),
              .visibility = {}};
  gatherSamples(reinterpret_cast<const glm::uvec4*>(positions.data()),
                reinterpret_cast<const glm::uvec4*>(normals.data()), truth.samples);
  if (trace) {
    truth.visibility.resize(truth.samples.size());
    view.reference->trace(truth.samples, view.light, view.origin, truth.visibility, target.size().x);
    truth.facesLight.resize(truth.samples.size());
    facesLight(truth.samples, view.light, view.origin, truth.facesLight);
  }
  return truth;
}

std::vector<shared::Answer> takeAnswers(const Device& device, const ViewTarget& target, const Frame& frame) {
  device.submit([&](VkCommandBuffer command) { frame.recordAnswers(command); });
  const auto bytes = downloaded(device, target.answers, sizeof(shared::Answer));
  std::vector<shared::Answer> answers(bytes.size() / sizeof(shared::Answer));
  std::memcpy(answers.data(), bytes.data(), bytes.size());
  return answers;
}

constexpr std::uint32_t kNoClass = 0xffffffff;

// What each sample's answer was found from, with lookup=spsm. Takes the place of the target's visibility.
std::vector<std::uint32_t> takeClasses(const Device& device, const ViewTarget& target, const Frame& frame) {
  device.submit([&](VkCommandBuffer command) { frame.recordClasses(command); });
  std::vector<std::uint32_t> classes;
  for (const float found : valuesOf<float>(downloaded(device, target.visibility, sizeof(float))))
    classes.push_back(static_cast<std::uint32_t>(found));
  return classes;
}

// Says what the resolve pass answered from, in samples, and how many places beyond the samples it asked for.
void countClasses(std::vector<PassTiming>& passes, const std::vector<std::uint32_t>& classes,
                  unsigned positions) {
  const auto resolve = std::ranges::find(passes, "resolve", &PassTiming::name);
  if (classes.empty() || resolve == passes.end()) return;
  const auto count = [&](std::uint32_t found) {
    return static_cast<double>(std::ranges::count(classes, found));
  };
  resolve->work.push_back({"one_triangle", count(shared::kAnswerOneTriangle)});
  resolve->work.push_back({"neighbours", count(shared::kAnswerNeighbours)});
  resolve->work.push_back({"uncertain", count(shared::kAnswerUncertain)});
  if (positions > 1)
    resolve->work.push_back({"more_positions", (positions - 1) * count(shared::kAnswerUncertain)});
}

std::vector<PlanView> planViews(const shared::Plan& plan, const glm::dvec3& origin) {
  glm::dmat4 relativeFromWorld(1);
  relativeFromWorld[3] = glm::dvec4(-origin, 1);
  std::vector<PlanView> views;
  for (std::uint32_t v = 0; v < plan.viewCount; ++v) {
    const shared::ShadowView& gpu = plan.views[v];
    views.push_back({glm::dmat4(gpu.shadowFromWorld) * relativeFromWorld, gpu, std::nullopt});
    if (plan.tilesPerSide > 0)
      views.back().tile = glm::uvec2(gpu.tile % plan.tilesPerSide, gpu.tile / plan.tilesPerSide);
  }
  return views;
}

template <class T>
Image makeImage(Aov aov, Image::Format format, glm::uvec2 size, const std::vector<T>& pixels) {
  Image image{
      .aov = aov, .format = format, .size = size, .bytes = std::vector<std::byte>(pixels.size() * sizeof(T))};
  std::memcpy(image.bytes.data(), pixels.data(), image.bytes.size());
  return image;
}

// One value a pixel, from its sample or answer.
template <class Value, class Source, class Function>
std::vector<Value> eachPixel(const std::vector<Source>& source, Function function) {
  std::vector<Value> out(source.size());
  std::ranges::transform(source, out.begin(), function);
  return out;
}

Image takeImage(Aov aov, const JobContext& context, const FrameView& view, const Truth& truth,
                const std::vector<shared::Answer>& answers, const std::vector<std::uint32_t>& classes) {
  using Format = Image::Format;
  using Sample = shared::ViewSample;
  const glm::uvec2 size = context.target.size();
  const Scene& scene = *context.scene.scene;
  switch (aov) {
    case Aov::colour:
      return {aov, Format::rgba8, size, downloaded(context.device, context.target.colour, 4)};
    case Aov::visibility:
      return {aov, Format::r32f, size, downloaded(context.device, context.target.visibility, 4)};
    case Aov::reference:
      return makeImage(aov, Format::r32f, size, truth.visibility);
    case Aov::position:
      return makeImage(aov, Format::rgb32f, size, eachPixel<glm::vec3>(truth.samples, [&](const Sample& s) {
                         return s.instance == shared::kNoInstance
                                    ? glm::vec3(0)
                                    : glm::vec3(glm::dvec3(s.wsPosition) + view.origin);
                       }));
    case Aov::normal:
      return makeImage(aov, Format::rgb32f, size,
                       eachPixel<glm::vec3>(truth.samples, [](const Sample& s) { return s.wsNormal; }));
    case Aov::id:
      return makeImage(aov, Format::rg32u, size, eachPixel<glm::uvec2>(truth.samples, [&](const Sample& s) {
                         return s.instance == shared::kNoInstance
                                    ? glm::uvec2(shared::kNoInstance)
                                    : glm::uvec2(s.instance, scene.sourceTriangle[s.triangle]);
                       }));
    case Aov::lookupClass:
      return makeImage(
          aov, Format::r32u, size,
          classes.empty() ? std::vector<std::uint32_t>(truth.samples.size(), kNoClass) : classes);
    case Aov::view:
      return makeImage(aov, Format::r32u, size,
                       answers.empty()
                           ? std::vector<std::uint32_t>(truth.samples.size(), shared::kNoShadowView)
                           : eachPixel<std::uint32_t>(answers, [](const auto& a) { return a.view; }));
  }
  return {};
}

Measures measured(const JobContext& context, const RenderJob& job, const Truth& truth, const Frame& frame,
                  const FrameView& view, const std::vector<shared::Answer>& answers) {
  const glm::vec3 forward(glm::normalize(job.view.target - job.view.eye));
  const auto depth = eachPixel<float>(
      truth.samples, [&](const auto& s) { return glm::dot(s.wsPosition - view.constants.wsEye, forward); });
  const auto bytes = downloaded(context.device, context.target.visibility, sizeof(float));
  std::vector<float> visibility(bytes.size() / sizeof(float));
  std::memcpy(visibility.data(), bytes.data(), bytes.size());
  return measure({.size = job.size,
                  .samples = truth.samples,
                  .viewDepth = depth,
                  .visibility = visibility,
                  .reference = truth.visibility,
                  .answers = answers,
                  .storeTexels = frame.storeTexels(),
                  .facesLight = truth.facesLight});
}

// Timed frames of a method and its baseline, in turn; the method's is the last, so that the target holds its
// images.
struct Series {
  std::vector<Pass> passes;  // of the frames: a method's first frame may have another order
  std::vector<FrameTiming> frames;
  std::vector<double> ratios;  // frame time over the baseline's, pair by pair
};

// Are the quartiles of what is asked for close enough?
bool settled(const Series& series, double target) {
  std::vector<double> values = series.ratios;
  if (values.empty())
    for (const FrameTiming& timing : series.frames) values.push_back(timing.frameMs);
  const Quartiles q = quartilesOf(std::move(values));
  return q.upper - q.lower <= target * q.median;
}

Result<Series> timeFrames(const Device& device, Frame& frame, Frame* baseline, const RenderJob& job,
                          const Interrupt& interrupt) {
  // Noise is answered with more rounds, within bounds; a job without timed frames asks for none.
  const auto wantsAnother = [&](const Series& series) {
    if (series.frames.size() < std::max(job.repetitions, 1u)) return true;
    return job.repetitions > 0 && job.quartileTarget > 0 && series.frames.size() < job.maxRepetitions &&
           !settled(series, job.quartileTarget);
  };
  Series series;
  // A round before the first is the warm-up: it isn't kept when there are others.
  for (bool kept = job.repetitions == 0; wantsAnother(series); kept = true) {
    double baseMs = 0;
    if (baseline) {
      auto timing = runFrame(device, baseline->passes(), interrupt);
      if (!timing) return std::unexpected(timing.error());
      baseMs = timing->frameMs;
    }
    series.passes = frame.passes();
    auto timing = runFrame(device, series.passes, interrupt);
    if (!timing) return std::unexpected(timing.error());
    if (!kept) continue;
    if (baseline) series.ratios.push_back(timing->frameMs / baseMs);
    series.frames.push_back(std::move(*timing));
  }
  return series;
}

std::vector<PassTiming> passTimings(const std::vector<Pass>& passes, const std::vector<FrameTiming>& frames) {
  std::vector<PassTiming> out;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    std::vector<double> ms;
    for (const FrameTiming& frame : frames) ms.push_back(frame.passMs[i]);
    out.push_back({std::string(passes[i].name), quartilesOf(std::move(ms)), frames.back().work[i]});
  }
  return out;
}

// Says how often the store pass drew the scene: its triangles, summed over all maps, over the scene's.
void countScenes(std::vector<PassTiming>& passes, const Scene& scene) {
  const auto triangles = static_cast<double>(scene.instancedTriangles());
  for (PassTiming& pass : passes) {
    if (pass.name != "store" || triangles == 0) continue;
    const auto drawn = std::ranges::find(pass.work, "primitives", &Work::name);
    if (drawn != pass.work.end()) pass.work.push_back({"scenes", drawn->count / triangles});
  }
}

}  // namespace

std::optional<std::string> whyInvalid(glm::uvec2 size, const std::vector<Method>& methods, LightKind light,
                                      const Device& device) {
  const unsigned limit = device.limits().maxImageDimension2D, most = std::min(kMaxSide, limit);
  if (size.x < 1 || size.y < 1 || size.x > most || size.y > most)
    return fmt::format("size: {}x{} pixels; each side must be in [1, {}]", size.x, size.y, most);
  if (methods.empty()) return "methods: none is given";
  for (const Method& method : methods) {
    const Result<Method> inLight = methodInLight(method, light);
    if (!inLight) return inLight.error().message;
    if (auto why = whyTooLarge(*inLight, device)) return fmt::format("method {}: {}", inLight->label(), *why);
  }
  return std::nullopt;
}

std::optional<std::string> whyInvalid(const RenderJob& job, const Device& device) {
  if (!job.scene) return "scene: none is given";
  if (auto why = whyInvalid(job.size, job.methods, job.light.kind, device)) return why;
  if (job.baseline)
    if (auto why = whyInvalid(job.size, {*job.baseline}, job.light.kind, device)) return "baseline: " + *why;
  const auto counts = [](const Method& m) { return m.row->technique == Technique::shadowVolumes; };
  if (job.baseline && counts(*job.baseline))
    if (auto why = whyNoVolumes(*job.scene))
      return fmt::format("baseline {}: {}", job.baseline->label(), *why);
  for (const Method& method : job.methods)
    if (counts(method))
      if (auto why = whyNoVolumes(*job.scene)) return fmt::format("method {}: {}", method.label(), *why);
  if (auto why = whyInvalid(job.view)) return why;
  return whyInvalid(job.light);
}

Result<void> runJob(const JobContext& context, const RenderJob& job, const Interrupt& interrupt,
                    JobSink& sink) {
  const Scene& scene = *context.scene.scene;
  const glm::dvec3 origin = frameOrigin(scene, job.view);
  context.scene.buffers.moveTo(context.device, origin);

  const bool traceTruth = job.measures || wants(job, Aov::reference);
  const auto isTraced = [](const Method& m) { return m.row->technique == Technique::rayTraced; };
  const bool needsReference =
      traceTruth || std::ranges::any_of(job.methods, isTraced) || (job.baseline && isTraced(*job.baseline));
  if (needsReference && !context.scene.reference)
    context.scene.reference = std::make_unique<Reference>(context.scene.scene);

  const auto isVolumes = [](const Method& m) { return m.row->technique == Technique::shadowVolumes; };
  if ((std::ranges::any_of(job.methods, isVolumes) || (job.baseline && isVolumes(*job.baseline))) &&
      !context.scene.edges)
    context.scene.edges = std::make_unique<EdgeBuffers>(context.device, context.scene.buffers);

  Light light = job.light;
  light.direction = glm::normalize(light.direction);
  const FrameView view{.device = context.device,
                       .pipelines = context.pipelines,
                       .scene = context.scene.buffers,
                       .target = context.target,
                       .reference = context.scene.reference.get(),
                       .edges = context.scene.edges.get(),
                       .light = light,
                       .origin = origin,
                       .constants = frameConstants(scene, job.view, light, job.size, origin)};

  std::optional<Frame> baseline;
  if (job.baseline && job.repetitions > 0)
    baseline.emplace(view, methodInLight(*job.baseline, light.kind).value());
  std::optional<Truth> truth;
  for (std::size_t i = 0; i < job.methods.size(); ++i) {
    const Method method = methodInLight(job.methods[i], light.kind).value();
    Frame frame(view, method);
    auto series = timeFrames(context.device, frame, baseline ? &*baseline : nullptr, job, interrupt);
    if (!series) return std::unexpected(series.error());

    const bool samplesWanted = traceTruth || wants(job, Aov::position) || wants(job, Aov::normal) ||
                               wants(job, Aov::id) || wants(job, Aov::view) || wants(job, Aov::lookupClass);
    if (samplesWanted && !truth) truth = takeTruth(context.device, context.target, view, traceTruth);
    if (auto error = interrupt.raised()) return std::unexpected(*error);
    std::vector<shared::Answer> answers;
    if (method.stages && (job.measures || wants(job, Aov::view)))
      answers = takeAnswers(context.device, context.target, frame);

    const shared::Plan plan = frame.downloadPlan();
    MethodResult result{.method = method, .plan = planViews(plan, origin)};
    sink.onPlan(i, result.plan);
    if (job.measures) result.measures = measured(context, job, *truth, frame, view, answers);
    std::vector<std::uint32_t> classes;
    const auto sendImage = [&](Aov aov) {
      sink.onImage(i, takeImage(aov, context, view, truth ? *truth : Truth{}, answers, classes));
    };
    for (const Aov aov : job.images)
      if (aov != Aov::lookupClass) sendImage(aov);
    if (method.stages && method.stages->lookup == Lookup::spsm &&
        (job.measures || wants(job, Aov::lookupClass)))
      classes = takeClasses(context.device, context.target, frame);
    if (wants(job, Aov::lookupClass)) sendImage(Aov::lookupClass);

    std::vector<double> frameMs;
    for (const FrameTiming& timing : series->frames) frameMs.push_back(timing.frameMs);
    result.frameMs = quartilesOf(std::move(frameMs));
    result.repetitions = job.repetitions == 0 ? 0 : static_cast<unsigned>(series->frames.size());
    if (!series->ratios.empty()) result.ratio = quartilesOf(std::move(series->ratios));
    result.passes = passTimings(series->passes, series->frames);
    countScenes(result.passes, scene);
    countClasses(result.passes, classes, method.settings.positions);
    result.storeBytes = frame.usedStoreBytes(plan);
    result.totalBytes = result.storeBytes + frame.otherBytes();
    result.allocatedBytes = frame.storeBytes();
    sink.onResult(i, std::move(result));
  }
  return {};
}

}  // namespace sundial
