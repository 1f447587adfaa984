#include "sweep/cases.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "sundial/content_digest.h"
#include "sundial/method_choice.h"

namespace sundial::sweep {
namespace {

using client::Expected;
namespace fs = std::filesystem;

constexpr std::size_t kMostCases = 1'000'000;  // a slip of the pen, not a sweep
constexpr std::size_t kIdDigits = 16;
constexpr unsigned kRepetitions = 5, kMaxRepetitions = 25;
constexpr double kQuartileTarget = 0.1;

std::unexpected<client::Error> refuse(std::string why) {
  return client::fail(grpc::INVALID_ARGUMENT, std::move(why));
}

std::string text(const v1::Vec3& v) { return fmt::format("{},{},{}", v.x(), v.y(), v.z()); }

std::string canonicalView(const Case& one) {
  const v1::RenderRequest& request = one.request;
  if (request.has_view_name()) return "name " + request.view_name();
  if (!request.has_view()) return "default";
  const v1::View& view = request.view();
  return fmt::format("eye {} target {} up {} fov {}", text(view.eye()), text(view.target()), text(view.up()),
                     view.vertical_fov_degrees());
}

std::string canonicalLight(const Case& one) {
  const v1::RenderRequest& request = one.request;
  if (request.has_light_name()) return "name " + request.light_name();
  if (!request.has_light()) return "default";
  const v1::Light& light = request.light();
  if (light.has_sun()) return "sun " + text(light.sun().direction());
  if (light.has_point()) return "point " + text(light.point().position());
  return fmt::format("spot {} to {} cone {}", text(light.spot().eye()), text(light.spot().target()),
                     light.spot().cone_degrees());
}

// What a case is, and nothing of how it is written.
std::string idOf(const Case& one) {
  ContentDigest digest;
  digest.add("case");
  digest.add(one.request.scene());
  digest.add(canonicalView(one));
  digest.add(canonicalLight(one));
  digest.add(fmt::format("{}x{}", one.request.width(), one.request.height()));
  digest.add(client::methodLabel(one.request.methods(0)));
  return digest.hexadecimal().substr(0, kIdDigits);
}

void setView(const v1::SweepView& from, Case& to) {
  to.viewName = from.name();
  if (!from.has_view()) return to.request.set_view_name(from.name());
  v1::View& view = *to.request.mutable_view();
  view = from.view();
  if (!view.has_up()) view.mutable_up()->set_y(1);
  if (view.vertical_fov_degrees() == 0) view.set_vertical_fov_degrees(60);
}

void setLight(const v1::SweepLight& from, Case& to) {
  to.lightName = from.name();
  if (!from.has_light()) return to.request.set_light_name(from.name());
  *to.request.mutable_light() = from.light();
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

// Nothing that can be seen without a server is left to fail on the way.
Expected<void> check(const v1::SweepGroup& group) {
  if (group.scene().empty()) return refuse("it names no scene");
  if (group.method().empty()) return refuse("it names no method");
  for (const v1::SweepSize& size : group.size())
    if (size.width() == 0 || size.height() == 0)
      return refuse(fmt::format("size is {}x{}; both must be at least 1", size.width(), size.height()));
  for (const v1::SweepView& view : group.view())
    if (view.name().empty() && !view.has_view()) return refuse("a view has neither a name nor a view");
  for (const v1::SweepLight& light : group.light())
    if (light.name().empty() && light.light().kind_case() == v1::Light::KIND_NOT_SET)
      return refuse("a light has neither a name nor a sun, spot or point");
  return {};
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

  Expected<void> add(const v1::SweepGroup& group) {
    if (auto checked = check(group); !checked) return checked;
    std::vector<v1::MethodChoice> methods;
    for (const v1::SweepMethod& method : group.method()) {
      auto choices = combinations(method);
      if (!choices) return std::unexpected(choices.error());
      methods.insert(methods.end(), choices->begin(), choices->end());
    }
    v1::SweepSize usual;
    usual.set_width(1024);
    usual.set_height(1024);
    for (const std::string& scene : group.scene()) {
      auto reference = referenceOf(scene);
      if (!reference) return std::unexpected(reference.error());
      for (int s = 0; s < std::max(group.size_size(), 1); ++s)
        for (int v = 0; v < std::max(group.view_size(), 1); ++v)
          for (int l = 0; l < std::max(group.light_size(), 1); ++l) {
            Case one{.id = {}, .scene = scene, .viewName = {}, .lightName = {}, .request = common_};
            one.request.set_scene(*reference);
            const v1::SweepSize& size = group.size().empty() ? usual : group.size(s);
            one.request.set_width(size.width());
            one.request.set_height(size.height());
            if (!group.view().empty()) setView(group.view(v), one);
            if (!group.light().empty()) setLight(group.light(l), one);
            if (auto added = add(one, methods); !added) return added;
          }
    }
    return {};
  }

  Cases take() { return std::move(cases_); }

 private:
  Expected<void> add(const Case& one, const std::vector<v1::MethodChoice>& methods) {
    for (const v1::MethodChoice& method : methods) {
      Case with = one;
      *with.request.add_methods() = method;
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
