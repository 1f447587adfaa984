#include "sweep/cases.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "sundial/method_choice.h"
#include "sweep/case_id.h"
#include "sweep/group.h"

namespace sundial::sweep {
namespace {

using client::Expected;
namespace fs = std::filesystem;

constexpr std::size_t kMostCases = 1'000'000;  // a slip of the pen, not a sweep
constexpr unsigned kRepetitions = 5, kMaxRepetitions = 25;
constexpr double kQuartileTarget = 0.1;

std::unexpected<client::Error> refuse(std::string why) {
  return client::fail(grpc::INVALID_ARGUMENT, std::move(why));
}

void setView(const v1::SweepView& from, Case& to) {
  to.viewName = from.name();
  if (!from.has_view()) return to.request.set_view_name(from.name());
  *to.request.mutable_view() = from.view();
}

void setLight(const v1::SweepLight& from, Case& to) {
  to.lightName = from.name();
  if (!from.has_light()) return to.request.set_light_name(from.name());
  *to.request.mutable_light() = from.light();
}

v1::StabilityRequest& alongOf(Case& one) { return one.along ? *one.along : one.along.emplace(); }

void setPath(const v1::SweepPath& from, Case& to) {
  to.pathName = from.name();
  if (!from.has_keys()) return alongOf(to).set_path_name(from.name());
  *alongOf(to).mutable_path() = from.keys();
}

void setLightPath(const v1::SweepLightPath& from, Case& to) {
  to.lightPathName = from.name();
  if (!from.has_keys()) return alongOf(to).set_light_path_name(from.name());
  *alongOf(to).mutable_light_path() = from.keys();
}

// Those that a run along the path has, as far as that is known here: the camera's go before the light's.
unsigned framesOf(const v1::SweepGroup& group, const v1::StabilityRequest& along) {
  if (group.frames() != 0) return group.frames();
  if (along.has_path()) return along.path().frames();
  return along.has_path_name() ? 0 : along.light_path().frames();
}

// The rest of a run along a path: numbers, and what stands still.
void completeAlong(const v1::SweepGroup& group, const v1::RenderRequest& still, v1::StabilityRequest& along) {
  along.set_scene(still.scene());
  along.set_width(still.width());
  along.set_height(still.height());
  if (still.has_view()) *along.mutable_view() = still.view();
  if (still.has_view_name()) along.set_view_name(still.view_name());
  if (still.has_light()) *along.mutable_light() = still.light();
  if (still.has_light_name()) along.set_light_name(still.light_name());
  along.set_frames(framesOf(group, along));
  along.set_points(group.points());
  along.set_seed(group.seed());
}

// Every combination of the parameters' values, the last one's changing fastest.
Expected<std::vector<v1::MethodChoice>> combinations(const v1::SweepMethod& method) {
  if (method.name().empty()) return refuse("a method has no name");
  std::vector<v1::MethodChoice> all(1);
  all[0].set_name(method.name());
  std::set<std::string> keys;
  for (const v1::SweepParameter& parameter : method.parameter()) {
    if (parameter.key().empty() || parameter.value().empty())
      return refuse(fmt::format("method {}: parameter '{}' needs a key and at least one value", method.name(),
                                parameter.key()));
    if (!keys.insert(parameter.key()).second)
      return refuse(fmt::format("method {}: parameter '{}' comes twice; give it all of its values at once",
                                method.name(), parameter.key()));
    std::vector<v1::MethodChoice> longer;
    for (const v1::MethodChoice& choice : all)
      for (const std::string& value : parameter.value()) {
        (*longer.emplace_back(choice).mutable_parameters())[parameter.key()] = value;
        if (longer.size() > kMostCases)
          return refuse(fmt::format("method {}: more than {} combinations", method.name(), kMostCases));
      }
    all = std::move(longer);
  }
  return all;
}

class Expansion {
 public:
  explicit Expansion(const fs::path& folder) : folder_(folder) {}

  // The part of a request that all cases share.
  Expected<void> begin(const v1::SweepSpec& spec) {
    auto baseline = client::parseMethodChoice(spec.baseline().empty() ? "sm,texels=2048" : spec.baseline());
    if (!baseline) return refuse("baseline: " + baseline.error().message);
    *common_.mutable_baseline() = std::move(*baseline);
    common_.set_repetitions(spec.repetitions() ? spec.repetitions() : kRepetitions);
    common_.set_max_repetitions(spec.max_repetitions() ? spec.max_repetitions()
                                                       : std::max(kMaxRepetitions, common_.repetitions()));
    common_.set_quartile_target(spec.has_quartile_target() ? spec.quartile_target() : kQuartileTarget);
    common_.set_measures(true);
    if (common_.max_repetitions() < common_.repetitions())
      return refuse(fmt::format("max_repetitions is {}, less than repetitions, {}", common_.max_repetitions(),
                                common_.repetitions()));
    return {};
  }

  Expected<void> add(const v1::SweepGroup& asWritten) {
    const auto group = complete(asWritten, folder_);
    if (!group) return std::unexpected(group.error());
    std::vector<v1::MethodChoice> methods;
    for (const v1::SweepMethod& method : group->method()) {
      auto choices = combinations(method);
      if (!choices) return std::unexpected(choices.error());
      methods.insert(methods.end(), choices->begin(), choices->end());
    }
    for (const std::string& scene : group->scene()) {
      auto reference = referenceOf(scene);
      if (!reference) return std::unexpected(reference.error());
      for (const v1::SweepSize& size : group->size()) {
        Case one{.id = {}, .scene = scene, .request = common_};
        one.request.set_scene(*reference);
        one.request.set_width(size.width());
        one.request.set_height(size.height());
        if (auto added = addCameras(*group, one, methods); !added) return added;
      }
    }
    return {};
  }

  Cases take() { return std::move(cases_); }

 private:
  using Methods = std::vector<v1::MethodChoice>;

  Expected<void> addCameras(const v1::SweepGroup& group, const Case& one, const Methods& methods) {
    const int views = group.view_size(), paths = group.path_size();
    for (int i = 0; i < std::max(views + paths, 1); ++i) {
      Case with = one;
      if (i < views)
        setView(group.view(i), with);
      else if (i < views + paths)
        setPath(group.path(i - views), with);
      if (auto added = addLights(group, with, methods); !added) return added;
    }
    return {};
  }

  Expected<void> addLights(const v1::SweepGroup& group, const Case& one, const Methods& methods) {
    const int lights = group.light_size(), paths = group.light_path_size();
    for (int i = 0; i < std::max(lights + paths, 1); ++i) {
      Case with = one;
      if (i < lights)
        setLight(group.light(i), with);
      else if (i < lights + paths)
        setLightPath(group.light_path(i - lights), with);
      if (with.along) completeAlong(group, with.request, *with.along);
      if (auto added = addMethods(with, methods); !added) return added;
    }
    return {};
  }

  Expected<void> addMethods(const Case& one, const Methods& methods) {
    for (const v1::MethodChoice& method : methods) {
      Case with = one;
      *with.request.add_methods() = method;
      if (with.along) *with.along->add_methods() = method;
      with.id = idOf(with);
      if (!ids_.insert(with.id).second) continue;
      cases_.list.push_back(std::move(with));
      if (cases_.list.size() > kMostCases) return refuse(fmt::format("more than {} cases", kMostCases));
    }
    return {};
  }

  // A local scene is named by its content.
  Expected<std::string> referenceOf(const std::string& scene) {
    if (!scene.starts_with("/") && !scene.starts_with("./") && !scene.starts_with("../")) return scene;
    if (const auto known = references_.find(scene); known != references_.end()) return known->second;
    auto files = client::gatherSceneFiles(folder_ / scene);
    if (!files) return std::unexpected(files.error());
    const auto digest = client::digestOf(*files);
    if (!digest) return std::unexpected(digest.error());
    std::string reference = "digest:" + *digest;
    cases_.files.emplace(reference, std::move(*files));
    return references_[scene] = std::move(reference);
  }

  const fs::path folder_;
  v1::RenderRequest common_;
  Cases cases_;
  std::set<std::string> ids_;
  std::map<std::string, std::string> references_;  // of local scenes, as they are written
};

}  // namespace

Expected<Cases> expand(const v1::SweepSpec& spec, const fs::path& folder) {
  Expansion expansion(folder);
  if (auto begun = expansion.begin(spec); !begun) return std::unexpected(begun.error());
  if (spec.group().empty()) return refuse("the specification has no group; see 'sundial sweep --help'");
  for (int i = 0; i < spec.group_size(); ++i)
    if (auto added = expansion.add(spec.group(i)); !added) {
      added.error().message = fmt::format("group {}: {}", i + 1, added.error().message);
      return std::unexpected(added.error());
    }
  return expansion.take();
}

bool Shard::has(const Case& one) const {
  std::uint64_t number = 0;
  std::from_chars(one.id.data(), one.id.data() + one.id.size(), number, 16);
  return number % count == index - 1;
}

}  // namespace sundial::sweep
