#include "scene_store.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "digest.h"

namespace sundial {

namespace {

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::string_view kDigest = "digest:";

std::unexpected<Error> cancelled() {
  return fail(ErrorCode::cancelled, "nobody waits for the scene any more");
}
std::unexpected<Error> stopping() {
  return fail(ErrorCode::unavailable, "the server is stopping: ask another, or later");
}
std::unexpected<Error> tooMany() {
  return fail(ErrorCode::resourceExhausted,
              "too many requests about scenes wait, or the server is stopping: try again later");
}

// Bytes as a reader likes them.
std::string mebibytes(std::uint64_t bytes) {
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
}

}  // namespace

std::string canonicalBuiltin(std::string_view reference) {
  const std::size_t question = reference.find('?');
  if (question == std::string_view::npos) return std::string(reference);
  std::multiset<std::string> keys;
  for (std::string_view rest = reference.substr(question + 1);;) {
    const std::size_t end = rest.find('&');
    keys.emplace(rest.substr(0, end));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  return fmt::format("{}?{}", reference.substr(0, question), fmt::join(keys, "&"));
}

SceneStore::SceneStore(SceneSource source, StoreOptions options)
    : source_(std::move(source)),
      options_(std::move(options)),
      loader_(options_.maxWaitingLoads),
      files_(options_.maxWaitingLoads) {}

SceneStore::~SceneStore() { stop(); }

void SceneStore::stop() {
  files_.stop();  // first: it posts to the loader
  loader_.stop();
}

bool SceneStore::Held::pinned() const {
  return std::ranges::any_of(names, [](const auto& name) { return name.second; });
}

void SceneStore::load(const std::string& reference, bool pinned, const std::stop_token& stop,
                      Callback callback) {
  if (std::ranges::any_of(reference, [](unsigned char c) { return c < 0x20 || c == 0x7f; })) {
    return callback(invalid("scene: the reference holds a control character"));
  }
  if (reference.empty()) {
    return callback(invalid("scene is empty: give builtin:NAME, a path under the scene root, or digest:HEX"));
  }
  if (reference.starts_with(kDigest)) {
    auto found = find(reference.substr(kDigest.size()), reference, pinned);
    if (found) return callback(std::move(*found));
    return callback(
        fail(ErrorCode::notFound, fmt::format("scene '{}' isn't loaded: upload it again", reference)));
  }
  if (reference.starts_with(kBuiltin)) {
    std::string canonical = canonicalBuiltin(reference);
    if (auto found = find(digestOfBuiltin(canonical), canonical, pinned)) return callback(std::move(*found));
    auto job = [=, this] { return loadBuiltin(canonical, pinned); };
    return post(loader_, stop, std::move(callback), std::move(job));
  }
  if (!options_.root) {
    return callback(
        fail(ErrorCode::notFound,
             fmt::format("no scene '{}': this server has no scene root; name a builtin: scene, upload "
                         "the file, or start the server with --scene-root",
                         reference)));
  }
  auto shared = std::make_shared<Callback>(std::move(callback));
  const bool posted = files_.post([=, this](bool stopped) {
    if (stopped) return (*shared)(stopping());
    if (auto found = findOnDisk(reference, pinned)) return (*shared)(std::move(*found));
    auto job = [=, this] { return loadFile(reference, pinned); };
    post(loader_, stop, std::move(*shared), std::move(job));
  });
  if (!posted) (*shared)(tooMany());
}

void SceneStore::upload(SceneFiles files, const std::stop_token& stop, Callback callback) {
  auto shared = std::make_shared<SceneFiles>(std::move(files));
  auto job = [this, shared, stop]() -> Result<LoadedScene> {
    const std::string digest = digestOf(*shared);
    const std::string reference = std::string(kDigest) + digest;
    if (stop.stop_requested()) return cancelled();
    if (auto found = find(digest, reference, false)) return std::move(*found);
    Result<Scene> scene = source_.parse(*shared, options_.limits);
    if (!scene) return std::unexpected(std::move(scene.error()));
    return keep(std::move(*scene), digest, reference, false, stop);
  };
  post(loader_, stop, std::move(callback), std::move(job));
}

Result<LoadedScene> SceneStore::loadBuiltin(const std::string& reference, bool pinned) {
  const std::string digest = digestOfBuiltin(reference);
  if (auto found = find(digest, reference, pinned)) return std::move(*found);  // loaded while this one waited
  Result<Scene> scene = source_.generate(std::string_view(reference).substr(kBuiltin.size()));
  if (!scene) return std::unexpected(std::move(scene.error()));
  return keep(std::move(*scene), digest, reference, pinned, {});
}

Result<LoadedScene> SceneStore::loadFile(const std::string& reference, bool pinned) {
  if (auto found = findOnDisk(reference, pinned)) return std::move(*found);
  const auto path = options_.root->resolve(reference);
  if (!path) return std::unexpected(path.error());
  const auto readBegan = std::filesystem::file_time_type::clock::now();
  auto files = source_.read(*path, options_.limits);
  if (!files) return std::unexpected(std::move(files.error()));

  const std::string digest = digestOf(*files);
  const auto remember = [&] {
    auto stamps = stampsOf(*path, *files, readBegan);
    const std::lock_guard lock(mutex_);
    if (stamps) {
      onDisk_[reference] = {digest, std::move(*stamps)};
    } else {
      onDisk_.erase(reference);
    }
  };
  if (auto found = find(digest, reference, pinned)) {
    remember();
    return std::move(*found);
  }
  Result<Scene> scene = source_.parse(*files, options_.limits);
  if (!scene) return std::unexpected(std::move(scene.error()));
  auto kept = keep(std::move(*scene), digest, reference, pinned, {});
  if (kept) remember();
  return kept;
}

std::optional<LoadedScene> SceneStore::find(const std::string& digest, const std::string& reference,
                                            bool pinned) {
  const std::lock_guard lock(mutex_);
  const auto found = held_.find(digest);
  if (found == held_.end()) return std::nullopt;
  const bool wasPinned = takeName(reference, digest);
  Held& held = found->second;
  held.lastUse = ++clock_;
  held.names[reference] |= pinned || wasPinned;
  return LoadedScene{reference, digest, held.scene};
}

std::optional<LoadedScene> SceneStore::findOnDisk(const std::string& reference, bool pinned) {
  std::optional<OnDisk> known;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = onDisk_.find(reference); found != onDisk_.end()) known = found->second;
  }
  if (!known || !unchanged(known->stamps)) return std::nullopt;
  return find(known->digest, reference, pinned);
}

Result<LoadedScene> SceneStore::keep(Scene scene, const std::string& digest, const std::string& reference,
                                     bool pinned, const std::stop_token& stop) {
  const std::uint64_t bytes = scene.bytes();
  auto shared = std::make_shared<const Scene>(std::move(scene));
  const std::lock_guard lock(mutex_);
  if (stop.stop_requested()) return cancelled();
  pinned |= takeName(reference, digest);
  if (auto room = makeRoom(bytes); !room) return std::unexpected(std::move(room.error()));
  held_[digest] = {shared, bytes, {{reference, pinned}}, ++clock_};
  bytes_ += bytes;
  return LoadedScene{reference, digest, shared};
}

// A file that changed on disk: its name leaves the content that it named before. Gives whether it was pinned.
bool SceneStore::takeName(const std::string& reference, const std::string& digest) {
  for (auto it = held_.begin(); it != held_.end(); ++it) {
    Held& held = it->second;
    const auto name = held.names.find(reference);
    if (it->first == digest || name == held.names.end()) continue;
    const bool pinned = name->second;
    held.names.erase(name);
    if (held.names.empty()) {
      bytes_ -= held.bytes;
      held_.erase(it);
    }
    return pinned;
  }
  return false;
}

Result<void> SceneStore::makeRoom(std::uint64_t bytes) {
  std::uint64_t pinnedBytes = 0;
  for (const auto& [digest, held] : held_) pinnedBytes += held.pinned() ? held.bytes : 0;
  if (pinnedBytes + bytes > options_.budgetBytes) {
    return fail(
        ErrorCode::resourceExhausted,
        fmt::format("the scene takes {} and scenes kept by LoadScene {} of the budget of {}: unload one, or "
                    "start the server with a larger --scene-budget-mib",
                    mebibytes(bytes), mebibytes(pinnedBytes), mebibytes(options_.budgetBytes)));
  }
  while (bytes_ + bytes > options_.budgetBytes) {
    auto oldest = held_.end();
    for (auto it = held_.begin(); it != held_.end(); ++it) {
      if (it->second.pinned()) continue;
      if (oldest == held_.end() || it->second.lastUse < oldest->second.lastUse) oldest = it;
    }
    bytes_ -= oldest->second.bytes;
    held_.erase(oldest);
  }
  return {};
}

Result<void> SceneStore::unload(const std::string& reference) {
  std::shared_ptr<const Scene> last;  // freed after the lock
  const std::lock_guard lock(mutex_);
  const std::string name = reference.starts_with(kBuiltin) ? canonicalBuiltin(reference) : reference;
  for (auto it = held_.begin(); it != held_.end(); ++it) {
    Held& held = it->second;
    if (name == std::string(kDigest) + it->first) {
      held.names.clear();
    } else if (held.names.erase(name) == 0) {
      continue;
    }
    if (held.names.empty()) {
      last = std::move(held.scene);
      bytes_ -= held.bytes;
      held_.erase(it);
    }
    onDisk_.erase(name);
    return {};
  }
  std::vector<std::string> loaded;
  for (const auto& [digest, held] : held_) loaded.push_back(held.names.begin()->first);
  std::ranges::sort(loaded);
  return fail(ErrorCode::notFound,
              fmt::format("scene '{}' isn't loaded; loaded: {}", reference,
                          loaded.empty() ? "none" : fmt::format("{}", fmt::join(loaded, ", "))));
}

// Runs `job` on a worker and hands its answer to `callback`.
void SceneStore::post(Worker& worker, const std::stop_token& stop, Callback callback,
                      std::function<Result<LoadedScene>()> job) {
  auto shared = std::make_shared<Callback>(std::move(callback));
  const bool posted = worker.post([=](bool stopped) {
    if (stopped) return (*shared)(stopping());
    if (stop.stop_requested()) return (*shared)(cancelled());
    Result<LoadedScene> answer = [&]() -> Result<LoadedScene> {
      try {
        return job();
      } catch (const std::bad_alloc&) {
        return fail(ErrorCode::resourceExhausted, "the scene needs more memory than the server has");
      } catch (const std::exception& broken) {
        return fail(ErrorCode::unavailable, fmt::format("loading failed: {}", broken.what()));
      }
    }();
    (*shared)(std::move(answer));
  });
  if (!posted) (*shared)(tooMany());
}

std::uint64_t SceneStore::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::size_t SceneStore::count() const {
  const std::lock_guard lock(mutex_);
  return held_.size();
}

void SceneStore::list(std::move_only_function<void(Result<std::vector<SceneListing>>)> callback) {
  auto shared = std::make_shared<decltype(callback)>(std::move(callback));
  const bool posted = files_.post([this, shared](bool stopped) {
    if (stopped) return (*shared)(stopping());
    (*shared)(listing());
  });
  if (!posted) (*shared)(tooMany());
}

std::vector<SceneListing> SceneStore::listing() {
  std::vector<SceneListing> all;
  for (const BuiltinInfo& builtin : source_.builtins) {
    all.push_back({std::string(kBuiltin) + std::string(builtin.name), std::string(builtin.description), {}});
  }
  if (options_.root) {
    for (std::string& name : options_.root->list()) all.push_back({std::move(name), {}, {}});
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [digest, held] : held_) {
    for (const auto& [name, pinned] : held.names) {
      auto it = std::ranges::find(all, name, &SceneListing::reference);
      if (it == all.end()) it = all.insert(all.end(), {name, {}, {}});
      it->loaded = LoadedScene{name, digest, held.scene};
    }
  }
  return all;
}

}  // namespace sundial
