// The scenes that a server holds: addressed by the digest of their content, so that the same bytes are held
// once whatever they are called; loaded by one thread of its own; the least recently used let go over a byte
// budget.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "result.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "scene_root.h"
#include "worker.h"

namespace sundial {

// Who makes scenes. Called on the loading thread; may throw std::bad_alloc.
struct SceneSource {
  std::function<Result<SceneFiles>(const std::filesystem::path&, const SceneLimits&)> read;
  std::function<Result<Scene>(const SceneFiles&, const SceneLimits&)> parse;
  std::function<Result<Scene>(std::string_view)> generate;  // given "NAME[?key=value&...]"
  std::vector<BuiltinInfo> builtins;
};

struct StoreOptions {
  std::optional<SceneRoot> root;
  std::uint64_t budgetBytes = 4ull << 30;  // of host memory, Scene::bytes()
  SceneLimits limits;
  std::size_t maxWaitingLoads = 128;
};

// A reference is "builtin:NAME[?key=value&...]", "digest:HEX", or a path relative to the scene root.
struct LoadedScene {
  std::string reference;  // canonical
  std::string digest;
  std::shared_ptr<const Scene> scene;
};

struct SceneListing {
  std::string reference;
  std::string description;  // of built-in scenes
  std::optional<LoadedScene> loaded;
};

class SceneStore {
 public:
  using Callback = std::move_only_function<void(Result<LoadedScene>)>;

  SceneStore(SceneSource, StoreOptions);
  ~SceneStore();  // stop()

  // Gives a scene, loaded if it isn't. `pinned`: it stays until unload(). The callback is called once: on
  // this thread if the answer is known, otherwise on a thread of the store; it must not throw or wait. A load
  // that `stop` has ended before it began isn't begun; one that has begun is kept, since the work is done.
  // Errors: notFound, invalidArgument, dataLoss, as the source gives them; resourceExhausted over a limit, or
  // when pinned scenes leave no room; cancelled; unavailable after stop().
  void load(const std::string& reference, bool pinned, const std::stop_token& stop, Callback);

  // Parses files and holds the scene as "digest:HEX". Otherwise as load(), but nothing is kept of an upload
  // that `stop` ends meanwhile.
  void upload(SceneFiles, const std::stop_token& stop, Callback);

  // Lets go of a name, and of the scene with its last name; by digest, of the scene. Whoever uses the scene
  // keeps it until done. Errors: notFound, naming what is loaded.
  Result<void> unload(const std::string& reference);

  // Built-in scenes, files under the scene root, and what else is loaded. Called as load()'s callback is.
  void list(std::move_only_function<void(Result<std::vector<SceneListing>>)>);

  void stop();  // ends the load that runs, refuses those that wait

  std::uint64_t bytes() const;  // held now
  std::size_t count() const;

 private:
  struct Held {
    std::shared_ptr<const Scene> scene;
    std::uint64_t bytes = 0;
    std::map<std::string, bool> names;  // reference → pinned
    std::uint64_t lastUse = 0;
    bool pinned() const;
  };
  struct OnDisk {
    std::string digest;
    std::vector<FileStamp> stamps;
  };

  std::optional<LoadedScene> find(const std::string& digest, const std::string& reference, bool pinned);
  std::optional<LoadedScene> findOnDisk(const std::string& reference, bool pinned);
  Result<LoadedScene> loadFile(const std::string& reference, bool pinned);
  Result<LoadedScene> loadBuiltin(const std::string& reference, bool pinned);
  Result<LoadedScene> keep(Scene, const std::string& digest, const std::string& reference, bool pinned,
                           const std::stop_token&);
  bool takeName(const std::string& reference, const std::string& digest);
  Result<void> makeRoom(std::uint64_t bytes);
  void post(Worker&, const std::stop_token&, Callback, std::function<Result<LoadedScene>()>);
  std::vector<SceneListing> listing();

  const SceneSource source_;
  const StoreOptions options_;

  mutable std::mutex mutex_;
  std::map<std::string, Held> held_;      // by digest
  std::map<std::string, OnDisk> onDisk_;  // by reference, for files under the root
  std::uint64_t bytes_ = 0;
  std::uint64_t clock_ = 0;  // counts uses

  Worker loader_;  // reads and parses
  Worker files_;   // looks at the disk, which is quick, and so never waits for a parser
};

// "builtin:trees?seed=3&count=100" → "builtin:trees?count=100&seed=3".
std::string canonicalBuiltin(std::string_view reference);

}  // namespace sundial
