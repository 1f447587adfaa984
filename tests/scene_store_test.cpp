// Scenes by content: held once, found by any name, let go least recently used first, never from outside the
// root.
#include "scene_store.h"

#include <gtest/gtest.h>

#include <fstream>
#include <future>

#include "digest.h"
#include "support/test_server.h"

namespace sundial {
namespace {

namespace fs = std::filesystem;
using test::FakeScenes;

class SceneStoreTest : public ::testing::Test {
 protected:
  SceneStoreTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::path(::testing::TempDir()) / fmt::format("sundial-{}-{}", info->name(), ::getpid());
    fs::create_directories(folder / "root" / "sub");
  }
  ~SceneStoreTest() override {
    scenes.gate.open();
    store.reset();
    fs::remove_all(folder);
  }
  void start(std::uint64_t budget = 1 << 20) {
    options.root = SceneRoot::open(folder / "root").value();
    options.budgetBytes = budget;
    store = std::make_unique<SceneStore>(fakeSource(), options);
  }
  SceneSource fakeSource() {
    SceneSource source = scenes.source();
    source.read = [this](const fs::path& path, const SceneLimits&) -> Result<SceneFiles> {
      ++reads;
      std::ifstream file(path, std::ios::binary);
      std::string content(std::istreambuf_iterator<char>(file), {});
      return SceneFiles{path.filename().string(), {{path.filename().string(), content}}};
    };
    return source;
  }
  void write(const std::string& name, const std::string& content, int age = 10) {
    std::ofstream(folder / "root" / name, std::ios::binary) << content;
    fs::last_write_time(folder / "root" / name, fs::file_time_type::clock::now() - std::chrono::seconds(age));
  }
  std::future<Result<LoadedScene>> loading(const std::string& reference, bool pinned = false,
                                           std::stop_token stop = {}) {
    auto promise = std::make_shared<std::promise<Result<LoadedScene>>>();
    store->load(reference, pinned, stop,
                [promise](Result<LoadedScene> loaded) { promise->set_value(std::move(loaded)); });
    return promise->get_future();
  }
  Result<LoadedScene> load(const std::string& reference, bool pinned = false) {
    return loading(reference, pinned).get();
  }
  std::future<Result<LoadedScene>> uploading(SceneFiles files, std::stop_token stop = {}) {
    auto promise = std::make_shared<std::promise<Result<LoadedScene>>>();
    store->upload(std::move(files), stop,
                  [promise](Result<LoadedScene> loaded) { promise->set_value(std::move(loaded)); });
    return promise->get_future();
  }
  std::vector<SceneListing> list() {
    std::promise<Result<std::vector<SceneListing>>> promise;
    store->list([&](Result<std::vector<SceneListing>> listing) { promise.set_value(std::move(listing)); });
    return promise.get_future().get().value();
  }
  bool holds(const std::string& reference) {
    for (const SceneListing& one : list()) {
      if (one.reference == reference) return one.loaded.has_value();
    }
    return false;
  }

  fs::path folder;
  FakeScenes scenes;
  std::atomic<unsigned> reads = 0;
  StoreOptions options;
  std::unique_ptr<SceneStore> store;
};

TEST_F(SceneStoreTest, DigestIsOfContentsAndReferencesAlone) {
  const SceneFiles one{"a.gltf", {{"a.gltf", "main"}, {"x.bin", "data"}}};
  EXPECT_EQ(digestOf(one).size(), 64u);
  EXPECT_EQ(digestOf(one), digestOf({"b.gltf", {{"b.gltf", "main"}, {"x.bin", "data"}}}));
  EXPECT_NE(digestOf(one), digestOf({"a.gltf", {{"a.gltf", "main"}, {"y.bin", "data"}}}));
  EXPECT_NE(digestOf(one), digestOf({"a.gltf", {{"a.gltf", "main"}, {"x.bin", "date"}}}));
  EXPECT_NE(digestOf(one), digestOf({"a.gltf", {{"a.gltf", "mainx"}, {".bin", "data"}}}));
}

TEST_F(SceneStoreTest, CanonicalBuiltinSortsKeys) {
  EXPECT_EQ(canonicalBuiltin("builtin:trees?seed=3&count=100"), "builtin:trees?count=100&seed=3");
  EXPECT_EQ(canonicalBuiltin("builtin:trees"), "builtin:trees");
}

TEST_F(SceneStoreTest, BuiltinIsGeneratedOnceWhateverItsKeysOrder) {
  start();
  const auto first = load("builtin:small?bytes=100&x=1");
  const auto second = load("builtin:small?x=1&bytes=100");
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->scene, second->scene);
  EXPECT_EQ(first->reference, "builtin:small?bytes=100&x=1");
  EXPECT_EQ(scenes.generated, 1u);
}

TEST_F(SceneStoreTest, ConcurrentLoadsOfOneSceneAreDoneOnce) {
  start();
  scenes.gate.close();
  auto first = loading("builtin:small");
  scenes.gate.awaitArrivals(1);
  auto second = loading("builtin:small");
  auto third = loading("builtin:small");
  scenes.gate.open();
  const auto a = first.get(), b = second.get(), c = third.get();
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->scene, b->scene);
  EXPECT_EQ(a->scene, c->scene);
  EXPECT_EQ(scenes.generated, 1u);
}

TEST_F(SceneStoreTest, SameBytesAreHeldOnceUnderAnyName) {
  start();
  write("a.glb", "scene one");
  write("sub/b.glb", "scene one");
  const auto a = load("a.glb"), b = load("sub/b.glb");
  const auto c = uploading({"c.glb", {{"c.glb", "scene one"}}}).get();
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->scene, b->scene);
  EXPECT_EQ(a->scene, c->scene);
  EXPECT_EQ(c->reference, "digest:" + a->digest);
  EXPECT_EQ(store->count(), 1u);
  EXPECT_EQ(scenes.parsed, 1u);
  EXPECT_EQ(load("digest:" + a->digest)->scene, a->scene);

  // The last name takes the scene with it.
  EXPECT_TRUE(store->unload("a.glb"));
  EXPECT_TRUE(store->unload("sub/b.glb"));
  EXPECT_EQ(store->count(), 1u);
  EXPECT_TRUE(store->unload(c->reference));
  EXPECT_EQ(store->count(), 0u);
  EXPECT_EQ(store->bytes(), 0u);
}

TEST_F(SceneStoreTest, LoadedFileIsNotReadAgainUntilItChanges) {
  start();
  write("a.glb", "scene one");
  const auto first = load("a.glb");
  EXPECT_EQ(load("a.glb")->scene, first->scene);
  EXPECT_EQ(reads, 1u);
  write("a.glb", "scene two", 5);
  const auto second = load("a.glb");
  EXPECT_EQ(reads, 2u);
  EXPECT_NE(second->digest, first->digest);
  EXPECT_EQ(store->count(), 1u);  // the old content has no name any more
}

TEST_F(SceneStoreTest, LeastRecentlyUsedGoesFirst) {
  start(300);
  ASSERT_TRUE(load("builtin:small?bytes=100"));
  ASSERT_TRUE(load("builtin:small?bytes=104"));
  ASSERT_TRUE(load("builtin:small?bytes=100"));  // used again
  ASSERT_TRUE(load("builtin:small?bytes=120"));
  EXPECT_TRUE(holds("builtin:small?bytes=100"));
  EXPECT_FALSE(holds("builtin:small?bytes=104"));
  EXPECT_TRUE(holds("builtin:small?bytes=120"));
  EXPECT_LE(store->bytes(), 300u);
}

TEST_F(SceneStoreTest, PinnedScenesStay) {
  start(300);
  ASSERT_TRUE(load("builtin:small?bytes=200", true));
  ASSERT_TRUE(load("builtin:small?bytes=60"));
  const auto tooMuch = load("builtin:small?bytes=120");
  ASSERT_FALSE(tooMuch);
  EXPECT_EQ(tooMuch.error().code, ErrorCode::resourceExhausted);
  EXPECT_NE(tooMuch.error().message.find("--scene-budget-mib"), std::string::npos);
  EXPECT_TRUE(holds("builtin:small?bytes=60"));  // nothing was let go in vain
  ASSERT_TRUE(store->unload("builtin:small?bytes=200"));
  EXPECT_TRUE(load("builtin:small?bytes=120"));
}

TEST_F(SceneStoreTest, WhoUsesASceneKeepsIt) {
  start(300);
  const auto used = load("builtin:small?bytes=200");
  ASSERT_TRUE(load("builtin:small?bytes=204"));
  EXPECT_FALSE(holds("builtin:small?bytes=200"));
  EXPECT_EQ(used->scene->sourceTriangle.size(), 50u);
}

TEST_F(SceneStoreTest, NothingOutsideTheRootIsServed) {
  start();
  std::ofstream(folder / "secret.glb") << "scene secret";
  fs::create_symlink(folder / "secret.glb", folder / "root" / "link.glb");
  fs::create_directory_symlink(folder, folder / "root" / "up");
  write("a.glb", "scene a");
  std::ofstream(folder / "root" / "notes.txt") << "scene text";
  const std::string absolute = folder / "secret.glb";
  for (const std::string& name : {std::string("../secret.glb"), std::string("sub/../../secret.glb"),
                                  std::string("link.glb"), std::string("up/secret.glb"), absolute}) {
    const auto loaded = load(name);
    ASSERT_FALSE(loaded) << name;
    EXPECT_EQ(loaded.error().code, ErrorCode::invalidArgument) << name;
  }
  for (const std::string name : {"notes.txt", "b.glb", "sub", "."}) {
    const auto loaded = load(name);
    ASSERT_FALSE(loaded) << name;
    EXPECT_EQ(loaded.error().code, ErrorCode::notFound) << name;
    EXPECT_NE(loaded.error().message.find("a.glb"), std::string::npos) << loaded.error().message;
  }
  const auto listing = list();
  ASSERT_EQ(listing.size(), 2u);
  EXPECT_EQ(listing[0].reference, "builtin:small");
  EXPECT_EQ(listing[1].reference, "a.glb");
}

TEST_F(SceneStoreTest, ReferencesAreChecked) {
  start();
  EXPECT_EQ(load("").error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(load(std::string("a\0.glb", 6)).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(load("digest:00").error().code, ErrorCode::notFound);
  EXPECT_EQ(load("builtin:none").error().code, ErrorCode::notFound);
  EXPECT_EQ(store->unload("builtin:small").error().code, ErrorCode::notFound);
}

TEST_F(SceneStoreTest, UnloadNamesWhatIsLoaded) {
  start();
  ASSERT_TRUE(load("builtin:small"));
  const auto unloaded = store->unload("builtin:large");
  ASSERT_FALSE(unloaded);
  EXPECT_NE(unloaded.error().message.find("loaded: builtin:small"), std::string::npos)
      << unloaded.error().message;
}

TEST_F(SceneStoreTest, UploadGivenUpWhileItLoadsIsNotKept) {
  start();
  scenes.gate.close();
  std::stop_source stop;
  auto upload = uploading({"a.glb", {{"a.glb", "scene a"}}}, stop.get_token());
  scenes.gate.awaitArrivals(1);
  stop.request_stop();
  scenes.gate.open();
  EXPECT_EQ(upload.get().error().code, ErrorCode::cancelled);
  EXPECT_EQ(store->count(), 0u);
}

TEST_F(SceneStoreTest, LoadGivenUpBeforeItBeginsIsNotBegun) {
  start();
  scenes.gate.close();
  auto first = loading("builtin:small");
  scenes.gate.awaitArrivals(1);
  std::stop_source stop;
  auto second = loading("builtin:small?bytes=100", false, stop.get_token());
  stop.request_stop();
  scenes.gate.open();
  EXPECT_TRUE(first.get());
  EXPECT_EQ(second.get().error().code, ErrorCode::cancelled);
  EXPECT_EQ(scenes.generated, 1u);
}

TEST_F(SceneStoreTest, MemoryThatRunsOutIsAnError) {
  SceneSource source = fakeSource();
  source.generate = [](std::string_view) -> Result<Scene> { throw std::bad_alloc(); };
  store = std::make_unique<SceneStore>(source, options);
  EXPECT_EQ(load("builtin:small").error().code, ErrorCode::resourceExhausted);
}

TEST_F(SceneStoreTest, StoppingAnswersThoseThatWait) {
  options.maxWaitingLoads = 1'000'000;  // so that only stopping refuses
  start();
  scenes.gate.close();
  auto first = loading("builtin:small");
  scenes.gate.awaitArrivals(1);
  auto second = loading("builtin:small?bytes=100");
  auto stopped = std::async(std::launch::async, [&] { store->stop(); });
  // Nothing new is taken once stopping has begun; until then another load waits with the second.
  std::vector<std::future<Result<LoadedScene>>> more;
  for (;;) {
    more.push_back(loading("builtin:small?bytes=104"));
    if (more.back().wait_for(std::chrono::seconds(0)) == std::future_status::ready) break;
  }
  scenes.gate.open();
  stopped.get();
  EXPECT_TRUE(first.get());
  EXPECT_EQ(second.get().error().code, ErrorCode::unavailable);
  EXPECT_EQ(scenes.generated, 1u);
}

}  // namespace
}  // namespace sundial
