// Files that are damaged, hostile or beyond a limit give an error that names the cause; none crashes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "gltf_file.h"
#include "scene_invariants.h"

namespace sundial {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Fails, and says so in one line that contains `words`.
void expectError(const Result<Scene>& scene, ErrorCode code, const std::string& words) {
  ASSERT_FALSE(scene) << "expected: " << words;
  EXPECT_EQ(scene.error().code, code) << scene.error().message;
  EXPECT_NE(scene.error().message.find(words), std::string::npos) << scene.error().message;
  EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
}

Result<Scene> parseBytes(std::string bytes) {
  return parseGltf({.main = "test.glb", .files = {{"test.glb", std::move(bytes)}}});
}

struct Damage {
  std::string name;
  std::function<void(json&)> apply;
  ErrorCode code;
  std::string words;
};

TEST(GltfErrors, EachDamageIsNamed) {
  constexpr ErrorCode kInvalid = ErrorCode::invalidArgument, kExhausted = ErrorCode::resourceExhausted;
  const json camera{{"type", "perspective"}, {"perspective", {{"yfov", 4.0}, {"znear", 0.1}}}};
  const std::vector<Damage> damages{
      {"version", [](json& j) { j["asset"]["version"] = "1.0"; }, kInvalid, "glTF version '1.0'"},
      {"no asset", [](json& j) { j.erase("asset"); }, kInvalid, "version"},
      {"extension", [](json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, kInvalid,
       "'KHR_draco_mesh_compression', which is not supported; supported are EXT_meshopt_compression"},
      {"basis textures", [](json& j) { j["extensionsRequired"] = {"KHR_texture_basisu"}; }, kInvalid,
       "'KHR_texture_basisu'"},
      {"accessor index", [](json& j) { j["meshes"][0]["primitives"][0]["indices"] = 9; }, kInvalid,
       "meshes[0].primitives[0].indices is 9, but there are 3 accessors"},
      {"attribute index", [](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7; },
       kInvalid, "meshes[0].primitives[0].attributes.POSITION is 7"},
      {"material index", [](json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }, kInvalid,
       "material is 0, but there are 0 materials"},
      {"mesh index", [](json& j) { j["nodes"][0]["mesh"] = 1; }, kInvalid, "nodes[0].mesh is 1"},
      {"node index", [](json& j) { j["scenes"][0]["nodes"] = {5}; }, kInvalid, "scenes[0].nodes[0] is 5"},
      {"negative index", [](json& j) { j["nodes"][0]["mesh"] = -1; }, kInvalid,
       "nodes[0].mesh must be an integer"},
      {"fractional index", [](json& j) { j["nodes"][0]["mesh"] = 0.5; }, kInvalid,
       "nodes[0].mesh must be an integer"},
      {"scene index", [](json& j) { j["scene"] = 3; }, kInvalid, "scene is 3, but there are 1 scenes"},
      {"view index", [](json& j) { j["accessors"][0]["bufferView"] = 3; }, kInvalid,
       "accessors[0].bufferView is 3"},
      {"buffer index", [](json& j) { j["bufferViews"][0]["buffer"] = 1; }, kInvalid,
       "bufferViews[0].buffer is 1"},
      {"type of a section", [](json& j) { j["meshes"] = 3; }, kInvalid, "meshes must be an array"},
      {"type of an element", [](json& j) { j["nodes"][0] = "x"; }, kInvalid,
       "nodes[0] must be an object, but is '\"x\"'"},
      {"attributes missing", [](json& j) { j["meshes"][0]["primitives"][0].erase("attributes"); }, kInvalid,
       "meshes[0].primitives[0].attributes is missing"},
      {"count", [](json& j) { j["accessors"][0]["count"] = 5; }, kInvalid, "accessors[0]: 5 elements"},
      {"huge count", [](json& j) { j["accessors"][0]["count"] = 9007199254740992; }, kInvalid,
       "9007199254740992"},
      {"huge count of zeros",
       [](json& j) {
         j["accessors"][0].erase("bufferView");
         j["accessors"][0]["count"] = 4000000000;
         j["meshes"][0]["primitives"][0].erase("indices");
       },
       kExhausted, "more than 50000000 triangles"},
      {"huge offset", [](json& j) { j["accessors"][0]["byteOffset"] = 9007199254740992; }, kInvalid,
       "do not fit"},
      {"component type", [](json& j) { j["accessors"][0]["componentType"] = 5124; }, kInvalid,
       "component type 5124"},
      {"accessor type", [](json& j) { j["accessors"][0]["type"] = "VEC2"; }, kInvalid, "has 2 components"},
      {"float indices",
       [](json& j) {
         j["accessors"][2]["componentType"] = 5126;
         j["accessors"][2]["count"] = 3;
       },
       kInvalid, "indices must be unsigned scalars"},
      {"absurd stride", [](json& j) { j["bufferViews"][0]["byteStride"] = 1000000; }, kInvalid,
       "byteStride is 1000000"},
      {"short stride", [](json& j) { j["bufferViews"][0]["byteStride"] = 4; }, kInvalid, "byteStride is 4"},
      {"view beyond its buffer", [](json& j) { j["bufferViews"][0]["byteLength"] = 100000; }, kInvalid,
       "of buffers[0], which has"},
      {"buffer longer than the file",
       [](json& j) {
         j["buffers"] = {{{"byteLength", 100000}}};
       },
       ErrorCode::dataLoss, "buffers[0] is cut off"},
      {"missing file",
       [](json& j) {
         j["buffers"] = {{{"byteLength", 92}, {"uri", "a.bin"}}};
       },
       ErrorCode::notFound, "the file 'a.bin' is missing"},
      {"bad data URI",
       [](json& j) {
         j["buffers"] = {{{"byteLength", 92}, {"uri", "data:;base64,!"}}};
       },
       kInvalid, "base64"},
      {"mode", [](json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }, kInvalid, "mode 7"},
      {"cycle", [](json& j) { j["nodes"][0]["children"] = {0}; }, kInvalid,
       "nodes[0] 'square': it has two parents"},
      {"two parents",
       [](json& j) {
         j["nodes"].push_back({{"children", {0}}});
         j["scenes"][0]["nodes"] = {0, 1};
       },
       kInvalid, "it has two parents"},
      {"short matrix",
       [](json& j) {
         j["nodes"][0]["matrix"] = {1, 0, 0};
       },
       kInvalid, "an array of 16 numbers"},
      {"projective matrix",
       [](json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }, kInvalid,
       "not affine"},
      {"flattening scale",
       [](json& j) {
         j["nodes"][0]["scale"] = {1, 0, 1};
       },
       kInvalid, "instance 'square'"},
      {"infinite translation",
       [](json& j) {
         j["nodes"][0]["translation"] = {0, 1e39, 0};
       },
       kInvalid, "nodes[0].translation[1] must be a finite number"},
      {"zero rotation",
       [](json& j) {
         j["nodes"][0]["rotation"] = {0, 0, 0, 0};
       },
       kInvalid, "rotation is 0 0 0 0"},
      {"camera",
       [&](json& j) {
         j["cameras"] = {camera};
         j["nodes"][0]["camera"] = 0;
       },
       kInvalid, "yfov"},
      {"light type",
       [](json& j) {
         j["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "area"}}};
         j["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
       },
       kInvalid, "'area'"},
      {"light index", [](json& j) { j["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0; },
       kInvalid, "light is 0, but there are 0 lights"},
      {"alpha mode",
       [](json& j) {
         j["materials"] = {{{"alphaMode", "HALF"}}};
       },
       kInvalid, "alpha mode 'HALF'"},
      {"image that is none",
       [](json& j) {
         j["images"] = {{{"bufferView", 0}}};
         j["textures"] = {{{"source", 0}}};
         j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
         j["meshes"][0]["primitives"][0]["material"] = 0;
       },
       kInvalid, "images[0]: the image is neither PNG nor JPEG"},
      {"meshopt stride",
       [](json& j) {
         j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 20}, {"byteStride", 6}, {"count", 4}, {"mode", "ATTRIBUTES"}};
       },
       kInvalid, "multiple of 4"},
      {"meshopt bytes",
       [](json& j) {
         j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 20}, {"byteStride", 12}, {"count", 4}, {"mode", "ATTRIBUTES"}};
       },
       ErrorCode::dataLoss, "bufferViews[0]: 20 bytes do not decode"},
      {"meshopt count",
       [](json& j) {
         j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                                         {"byteLength", 20},
                                                                         {"byteStride", 12},
                                                                         {"count", 300000000},
                                                                         {"mode", "ATTRIBUTES"}};
       },
       ErrorCode::dataLoss, "do not decode"},
  };
  for (const Damage& damage : damages) {
    SCOPED_TRACE(damage.name);
    GltfFile file = squareFile();
    damage.apply(file.json);
    expectError(parseGltf(file.files()), damage.code, damage.words);
  }
}

TEST(GltfErrors, IndexOutOfRangeNamesMeshPrimitiveAndIndex) {
  GltfFile file = squareFile();
  file.json["meshes"][0]["primitives"][0]["indices"] =
      file.addAccessor(std::vector<std::uint16_t>{0, 1, 2, 0, 4, 3}, "SCALAR", 1, kUshort);
  expectError(parseGltf(file.files()), ErrorCode::invalidArgument,
              "meshes[0] 'mesh', primitives[0]: index 4 is 4, but there are 4 vertices");
}

TEST(GltfErrors, NanVertexNamesMeshAndVertex) {
  GltfFile file = squareFile();
  file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      file.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, std::nanf(""), 0, 0, 1, 0}, "VEC3", 3, kFloat);
  expectError(parseGltf(file.files()), ErrorCode::invalidArgument,
              "mesh 'mesh', primitive 0: vertex 2 has a position that is not finite");
}

TEST(GltfErrors, SparseIndexOutOfRange) {
  GltfFile file = squareFile();
  const std::size_t where = file.addView(std::string("\x04", 1));
  const std::size_t what = file.addView(std::string(12, '\0'));
  file.json["accessors"][0]["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", where}, {"componentType", kUbyte}}},
                                         {"values", {{"bufferView", what}}}};
  expectError(parseGltf(file.files()), ErrorCode::invalidArgument, "accessors[0]: sparse index 0 is 4");
}

TEST(GltfErrors, WhatIsNoGltf) {
  expectError(parseBytes(""), ErrorCode::dataLoss, "empty");
  expectError(parseBytes("\x89PNG\r\n\x1a\n"), ErrorCode::invalidArgument, "not a glTF file");
  expectError(parseBytes("solid cube\n"), ErrorCode::invalidArgument, "not a glTF file");
  expectError(parseBytes("{}"), ErrorCode::invalidArgument, "asset");
  expectError(parseBytes("{\"asset\": }"), ErrorCode::invalidArgument, "malformed near byte");
  expectError(parseBytes("{\"asset\": {\"version\""), ErrorCode::dataLoss, "cut off");
  expectError(parseBytes("{\"a\": 1e999}"), ErrorCode::invalidArgument, "malformed");
  expectError(parseBytes(std::string("glTF\1\0\0\0\x14\0\0\0", 12)), ErrorCode::invalidArgument,
              "GLB version 1");
  expectError(parseBytes("{\"a\":" + std::string(1'000'000, '[')), ErrorCode::invalidArgument,
              "nested deeper");
  expectError(parseBytes("{\"a\":" + std::string(100'000, '[') + std::string(100'000, ']') + "}"),
              ErrorCode::invalidArgument, "nested deeper");
  expectError(parseGltf({.main = "x.glb", .files = {}}), ErrorCode::notFound, "'x.glb': the file is missing");
}

TEST(GltfErrors, ANameDoesNotBreakTheLine) {
  GltfFile file = squareFile();
  file.json["nodes"][0]["name"] = "two\nlines " + std::string(1000, 'x');
  file.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
  const Result<Scene> scene = parseGltf(file.files());
  expectError(scene, ErrorCode::invalidArgument, "'two?lines xxx");
  EXPECT_LT(scene.error().message.size(), 300u);
}

TEST(GltfErrors, LimitsAreNamed) {
  const GltfFile file = squareFile();
  expectError(parseGltf(file.files(), {.maxTriangles = 1}), ErrorCode::resourceExhausted,
              "more than 1 triangles");
  expectError(parseGltf(file.files(), {.maxInstances = 0}), ErrorCode::resourceExhausted,
              "more than 0 instances");
  expectError(parseGltf(file.files(), {.maxFileBytes = 100}), ErrorCode::resourceExhausted,
              "the limit of 100");
  expectError(parseGltf(file.files(), {.maxDecodedBytes = 100}), ErrorCode::resourceExhausted,
              "the limit of 100");
}

TEST(GltfErrors, AChainOfNodesNeedsNoStack) {
  GltfFile file = squareFile();
  constexpr int kNodes = 200'000;
  for (int i = 0; i < kNodes; ++i) file.json["nodes"].push_back({{"children", {i}}});
  file.json["scenes"][0]["nodes"] = {kNodes};
  const Result<Scene> scene = parseGltf(file.files());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->instances.size(), 1u);
}

TEST(GltfErrors, EveryTruncationIsReported) {
  const std::string whole = squareFile().glb();
  ASSERT_TRUE(parseBytes(whole));
  for (std::size_t size = 0; size < whole.size(); ++size)
    expectError(parseBytes(whole.substr(0, size)), ErrorCode::dataLoss, "test.glb");
}

TEST(GltfErrors, EveryTruncationOfJsonIsReported) {
  GltfFile file = squareFile();
  file.json["buffers"] = {{{"uri", "a.bin"}, {"byteLength", file.binary().size()}}};
  const std::string text = file.json.dump();
  for (std::size_t size = 0; size < text.size(); ++size)
    expectError(
        parseGltf({.main = "a.gltf", .files = {{"a.gltf", text.substr(0, size)}, {"a.bin", file.binary()}}}),
        ErrorCode::dataLoss, "a.gltf");
  for (std::size_t size = 0; size < file.binary().size(); ++size)
    expectError(
        parseGltf({.main = "a.gltf", .files = {{"a.gltf", text}, {"a.bin", file.binary().substr(0, size)}}}),
        ErrorCode::dataLoss, "buffers[0] is cut off");
}

// Cut off, but with a header that owns up to it, so that what lies behind the header is tried.
std::string patched(std::string bytes) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  for (std::size_t i = 0; i < 4 && 8 + i < bytes.size(); ++i)
    bytes[8 + i] = static_cast<char>(size >> (8 * i) & 0xff);
  return bytes;
}

TEST(GltfErrors, TruncationsOfALargeFile) {
  const fs::path path = SUNDIAL_SCENES "/apartment_meshopt.glb";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  const Result<SceneFiles> files = readSceneFiles(path);
  ASSERT_TRUE(files);
  const std::string& whole = files->files.at(files->main);
  for (std::size_t i = 1; i < 40; ++i) {
    const std::string cut = whole.substr(0, whole.size() * i / 40);
    expectError(parseBytes(cut), ErrorCode::dataLoss, "cut off");
    expectError(parseBytes(patched(cut)), ErrorCode::dataLoss, "");
  }
}

// Flips bytes; whatever comes out must be an error in one line or a scene that keeps its promises.
void fuzz(const std::string& whole, unsigned rounds, unsigned seed, std::size_t from) {
  std::mt19937 random(seed);
  unsigned accepted = 0;
  for (unsigned round = 0; round < rounds; ++round) {
    std::string bytes = whole;
    const unsigned flips = 1 + random() % 4;
    for (unsigned i = 0; i < flips; ++i)
      bytes[from + random() % (bytes.size() - from)] =
          static_cast<char>(random() % 3 == 0 ? '0' + random() % 10 : random());
    const SceneLimits limits{.maxDecodedBytes = 64 << 20, .maxTriangles = 1'000'000};
    const Result<Scene> scene = parseGltf({.main = "test.glb", .files = {{"test.glb", bytes}}}, limits);
    if (scene) {
      ++accepted;
      expectInvariants(*scene);
    } else {
      EXPECT_FALSE(scene.error().message.empty());
      EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
    }
  }
  EXPECT_LT(accepted, rounds);
  EXPECT_GT(accepted, 0u);
}

TEST(GltfErrors, FlippedBytesOfASmallFile) { fuzz(squareFile().glb(), 5'000, 1, 12); }

TEST(GltfErrors, FlippedBytesOfACompressedFile) {
  const fs::path path = SUNDIAL_SCENES "/apartment_meshopt.glb";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  const Result<SceneFiles> files = readSceneFiles(path);
  ASSERT_TRUE(files);
  fuzz(files->files.at(files->main), 25, 2, 12);
}

TEST(SceneFiles, RefusesUrisThatLeaveTheFolder) {
  const fs::path folder = fs::path(testing::TempDir()) / "sundial_scene_files_test";
  fs::create_directories(folder);
  for (const std::string uri : {"../a.bin", "/etc/passwd", "x/../../a.bin", "%2e%2e/a.bin",
                                "file:///etc/passwd", "..%2Fa.bin", "a\\..\\..\\b.bin", "."}) {
    GltfFile file = squareFile();
    file.json["buffers"] = {{{"uri", uri}, {"byteLength", 92}}};
    std::ofstream(folder / "a.gltf", std::ios::binary) << file.json.dump();
    const Result<SceneFiles> files = readSceneFiles(folder / "a.gltf");
    ASSERT_FALSE(files) << uri;
    EXPECT_EQ(files.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(files.error().message.find("inside the scene's folder"), std::string::npos)
        << files.error().message;
  }
  fs::remove_all(folder);
}

TEST(SceneFiles, NamesWhatIsMissingOrTooLarge) {
  const fs::path folder = fs::path(testing::TempDir()) / "sundial_scene_files_test2";
  fs::create_directories(folder);
  Result<SceneFiles> files = readSceneFiles(folder / "none.glb");
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, ErrorCode::notFound);
  EXPECT_FALSE(readSceneFiles(folder));

  std::ofstream(folder / "a.glb", std::ios::binary) << squareFile().glb();
  files = readSceneFiles(folder / "a.glb", {.maxFileBytes = 100});
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, ErrorCode::resourceExhausted);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sundial
