// glTF files that are well are read as they mean.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "gltf_file.h"
#include "scene_invariants.h"

namespace sundial {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Scene parsed(const GltfFile& file) {
  Result<Scene> scene = parseGltf(file.files());
  if (!scene) {
    ADD_FAILURE() << scene.error().message;
    return {};
  }
  expectInvariants(*scene);
  return std::move(*scene);
}

// The corners of all triangles, of the mesh and the world alike, by source triangle.
std::vector<std::array<std::array<float, 3>, 3>> corners(const Scene& scene) {
  std::vector<std::array<std::array<float, 3>, 3>> result;
  for (const SourceTriangle& triangle : sourceTriangles(scene)) result.push_back(triangle.corners);
  return result;
}

TEST(Gltf, ReadsASquare) {
  const Scene scene = parsed(squareFile());
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "square");
  EXPECT_EQ(scene.meshes[0].name, "mesh");
  EXPECT_EQ(scene.sourceTriangle.size(), 2u);
  EXPECT_EQ(scene.vertices.size(), 4u);
  EXPECT_EQ(scene.bounds.min, glm::dvec3(0));
  EXPECT_EQ(scene.bounds.max, glm::dvec3(1, 1, 0));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(scene.attributes[i].uv, glm::vec2(scene.vertices[i].position));
  EXPECT_FALSE(scene.materials[0].masked);
}

TEST(Gltf, ReadsStripsFansAndUnindexedTriangles) {
  // The same four corners of a square, in the order that each needs.
  const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  for (const auto& [mode, positions] : {std::pair(5, strip), std::pair(6, fan)}) {
    GltfFile file;
    file.addMesh(
        {{"attributes", {{"POSITION", file.addAccessor(positions, "VEC3", 3, kFloat)}}}, {"mode", mode}});
    file.addRoot({{"mesh", 0}});
    const Scene scene = parsed(file);
    ASSERT_EQ(scene.sourceTriangle.size(), 2u) << "mode " << mode;
    for (std::size_t t = 0; t < 2; ++t) {  // all counter-clockwise
      const auto p = [&](std::size_t c) { return scene.vertices[scene.indices[3 * t + c]].position; };
      EXPECT_EQ(glm::cross(p(1) - p(0), p(2) - p(0)), glm::vec3(0, 0, 1)) << "mode " << mode;
    }
  }
}

TEST(Gltf, SkipsPointsAndLines) {
  GltfFile file = squareFile();
  json lines = file.json["meshes"][0]["primitives"][0];
  lines["mode"] = 1;
  file.json["meshes"][0]["primitives"].insert(file.json["meshes"][0]["primitives"].begin(), lines);
  EXPECT_EQ(parsed(file).sourceTriangle.size(), 2u);
}

TEST(Gltf, CountsDegenerateTrianglesInSourceIndices) {
  GltfFile file = squareFile();
  file.json["meshes"][0]["primitives"][0]["indices"] =
      file.addAccessor(std::vector<std::uint32_t>{0, 0, 1, 0, 1, 2, 1, 3, 1, 0, 2, 3}, "SCALAR", 1, kUint);
  const Scene scene = parsed(file);
  EXPECT_EQ(scene.degenerateTriangles, 2u);
  std::vector<std::uint32_t> source = scene.sourceTriangle;
  std::ranges::sort(source);
  EXPECT_EQ(source, (std::vector<std::uint32_t>{1, 3}));
}

TEST(Gltf, ComposesNodeTransforms) {
  GltfFile file = squareFile();
  const double h = std::sqrt(0.5);
  file.json["nodes"] = {
      {{"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 100000.125, 0, 0, 1}}, {"children", {1}}},
      {{"translation", {0, 3, 0}}, {"rotation", {0, 0, h, h}}, {"scale", {1, 5, 1}}, {"mesh", 0}}};
  file.json["scenes"][0]["nodes"] = {0};
  const Scene scene = parsed(file);
  // Scaled, turned by 90 degrees about z, moved up, then doubled and moved far, in double precision.
  const glm::dvec4 p = scene.instances[0].worldFromMesh * glm::dvec4(1, 1, 0, 1);
  EXPECT_NEAR(p.x, 100000.125 - 10, 1e-9);
  EXPECT_NEAR(p.y, 8, 1e-9);
}

TEST(Gltf, ReadsQuantisedMeshes) {
  GltfFile file;
  const std::size_t positions = file.addAccessor(
      std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 32767, -32768, 0, 0, 0, 16384, 0, 0}, "VEC3", 3,
      kShort, true);
  file.json["accessors"][positions]["count"] = 4;
  file.json["bufferViews"][0]["byteStride"] = 8;
  const std::size_t uvs =
      file.addAccessor(std::vector<std::uint8_t>{0, 0, 0, 0, 255, 0, 0, 0, 255, 255, 0, 0, 51, 0, 0, 0},
                       "VEC2", 4, kUbyte, true);
  file.json["bufferViews"][1]["byteStride"] = 4;
  const std::size_t indices =
      file.addAccessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1, kUbyte);
  file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"indices", indices}});
  file.addRoot({{"mesh", 0}, {"scale", {4, 4, 4}}});
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Scene scene = parsed(file);
  EXPECT_EQ(scene.bounds.max.x, 4);
  EXPECT_EQ(scene.bounds.min, glm::dvec3(0, -4, 0));  // clamped: -32768 is -1
  bool found = false;
  for (const shared::Attributes& a : scene.attributes) found |= a.uv == glm::vec2(0.2f, 0);
  EXPECT_TRUE(found);
}

TEST(Gltf, ReadsSparseAccessors) {
  GltfFile file = squareFile();
  const std::size_t where = file.addView(bytesOf(std::vector<std::uint8_t>{2, 3}));
  const std::size_t what = file.addView(bytesOf(std::vector<float>{5, 5, 1, 0, 7, 0}));
  file.json["accessors"][0]["sparse"] = {{"count", 2},
                                         {"indices", {{"bufferView", where}, {"componentType", kUbyte}}},
                                         {"values", {{"bufferView", what}}}};
  Scene scene = parsed(file);
  EXPECT_EQ(scene.bounds.max, glm::dvec3(5, 7, 1));

  // Without a buffer view all else is zero: the square collapses to one triangle.
  file.json["accessors"][0].erase("bufferView");
  scene = parsed(file);
  EXPECT_EQ(scene.degenerateTriangles, 1u);
  EXPECT_EQ(scene.sourceTriangle, (std::vector<std::uint32_t>{1}));
}

TEST(Gltf, ReadsVertexColoursOfAllTypes) {
  const std::vector<std::pair<std::string, std::size_t>> shapes{{"VEC3", 3}, {"VEC4", 4}};
  for (const auto& [type, components] : shapes) {
    for (const ComponentType componentType : {kUbyte, kUshort, kFloat}) {
      GltfFile file = squareFile();
      const std::size_t n = 4 * components;
      std::size_t colours = 0;
      // Every component one fifth.
      if (componentType == kUbyte)  // padded: elements are 4 bytes apart
        colours = file.addAccessor(std::vector<std::uint8_t>(16, 51), type, 4, kUbyte, true);
      if (componentType == kUshort)
        colours = file.addAccessor(std::vector<std::uint16_t>(16, 13107), type, 4, kUshort, true);
      if (componentType == kFloat)
        colours = file.addAccessor(std::vector<float>(n, 0.2f), type, components, kFloat);
      if (componentType != kFloat)
        file.json["bufferViews"].back()["byteStride"] = componentType == kUbyte ? 4 : 8;
      file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colours;
      const Scene scene = parsed(file);
      for (const shared::Attributes& a : scene.attributes)
        EXPECT_EQ(a.colour, components == 3 ? 0xff333333u : 0x33333333u) << type << " of " << componentType;
    }
  }
}

// The square with a texture of 2 x 2 texels, one of them with the alpha given.
GltfFile texturedFile(char alpha) {
  GltfFile file = squareFile();
  const std::string texels =
      "\x01\x02\x03\xff\x11\x12\x13\xff\x21\x22\x23\xff\x31\x32\x33" + std::string(1, alpha);
  file.json["images"] = {{{"bufferView", file.addView(png(2, 2, texels))}, {"mimeType", "image/png"}}};
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  file.json["materials"] = {{{"name", "leaf"},
                             {"doubleSided", true},
                             {"alphaMode", "MASK"},
                             {"alphaCutoff", 0.25},
                             {"pbrMetallicRoughness",
                              {{"baseColorTexture", {{"index", 0}}}, {"baseColorFactor", {0.5, 1, 1, 1}}}}}};
  file.json["meshes"][0]["primitives"][0]["material"] = 0;
  return file;
}

TEST(Gltf, ReadsAlphaTestedMaterials) {
  const Scene scene = parsed(texturedFile('\0'));
  const MaterialInfo& material = scene.materials[0];
  EXPECT_EQ(material.name, "leaf");
  EXPECT_TRUE(material.masked);
  EXPECT_TRUE(material.doubleSided);
  EXPECT_EQ(material.gpu.alphaCutoff, 0.25f);
  EXPECT_EQ(material.gpu.baseColour, glm::vec4(0.5, 1, 1, 1));
  EXPECT_EQ(material.gpu.wrapU, shared::kWrapClamp);
  EXPECT_EQ(material.gpu.wrapV, shared::kWrapMirror);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textureSize, glm::uvec2(2));
  EXPECT_EQ(scene.textures[0][1], glm::u8vec4(0x11, 0x12, 0x13, 0xff));
  EXPECT_EQ(scene.textures[0][3], glm::u8vec4(0x31, 0x32, 0x33, 0));
}

TEST(Gltf, ReadsBlendAsMaskAtAHalf) {
  GltfFile file = texturedFile('\x20');
  file.json["materials"][0]["alphaMode"] = "BLEND";
  const Scene scene = parsed(file);
  EXPECT_TRUE(scene.materials[0].masked);
  EXPECT_EQ(scene.materials[0].gpu.alphaCutoff, 0.5f);
}

TEST(Gltf, TestsNoAlphaThatIsNeverBelowTheCutoff) {
  const Scene scene = parsed(texturedFile('\x50'));
  EXPECT_FALSE(scene.materials[0].masked);
  EXPECT_EQ(scene.materials[0].gpu.alphaCutoff, 0.0f);
}

TEST(Gltf, LoadsNoImageThatNothingUses) {
  GltfFile file = texturedFile('\0');
  file.json["images"].push_back({{"uri", "missing.png"}});
  file.json["textures"].push_back({{"source", 1}});
  file.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
  EXPECT_EQ(parsed(file).textures.size(), 1u);
}

TEST(Gltf, BakesTextureTransforms) {
  GltfFile file = texturedFile('\0');
  file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;
  file.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
           ["KHR_texture_transform"] = {
      {"offset", {0.5, 0}}, {"rotation", std::acos(-1) / 2}, {"scale", {2, 3}}, {"texCoord", 1}};
  const Scene scene = parsed(file);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::vec2 uv(scene.vertices[i].position);  // as the file has them
    // Scaled, turned so that u goes to -v, moved.
    EXPECT_NEAR(scene.attributes[i].uv.x, 3 * uv.y + 0.5f, 1e-6);
    EXPECT_NEAR(scene.attributes[i].uv.y, -2 * uv.x, 1e-6);
  }
}

TEST(Gltf, ReadsCamerasAndLights) {
  GltfFile file = squareFile();
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 2}, {"znear", 1}}}}};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"name", "sun"}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
      {{"type", "point"}}};
  const double h = std::sqrt(0.5);
  const auto light = [](int index) { return json{{"KHR_lights_punctual", {{"light", index}}}}; };
  file.addRoot({{"name", "cam"}, {"camera", 0}, {"translation", {1, 2, 3}}});
  file.addRoot({{"name", "cam"}, {"camera", 0}});
  file.addRoot({{"camera", 1}});
  file.addRoot({{"extensions", light(0)}, {"rotation", {-h, 0, 0, h}}});
  file.addRoot(
      {{"name", "lamp"}, {"extensions", light(1)}, {"translation", {0, 5, 0}}, {"scale", {2, 2, 2}}});
  file.addRoot({{"name", "bulb"}, {"extensions", light(2)}, {"translation", {0, 6, 0}}});
  const Scene scene = parsed(file);

  ASSERT_EQ(scene.views.size(), 2u);
  EXPECT_EQ(scene.views[0].name, "cam");
  EXPECT_EQ(scene.views[1].name, "cam 2");
  EXPECT_EQ(scene.views[0].view.eye, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.views[0].view.target, glm::dvec3(1, 2, 2));
  EXPECT_NEAR(scene.views[0].view.verticalFovDegrees, 57.29578, 1e-4);

  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_NEAR(scene.lights[0].light.direction.y, -1, 1e-9);
  EXPECT_EQ(scene.lights[1].light.kind, LightKind::spot);
  EXPECT_NEAR(scene.lights[1].light.coneDegrees, 57.29578, 1e-4);
  EXPECT_NEAR(glm::length(scene.lights[1].light.direction), 1, 1e-12);
  EXPECT_EQ(scene.lights[2].light.kind, LightKind::point);
  EXPECT_EQ(scene.lights[2].light.position, glm::dvec3(0, 6, 0));
}

TEST(Gltf, InstancesAMeshThatSeveralNodesPlace) {
  GltfFile file = squareFile();
  file.addRoot({{"mesh", 0}, {"translation", {5, 0, 0}}});
  file.addRoot({{"mesh", 0}, {"scale", {0, 0, 0}}});  // hidden
  const Scene scene = parsed(file);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instancedTriangles(), 4u);
}

TEST(Gltf, ReadsNoMoreOfASharedAccessorThanAPrimitiveUses) {
  // 1,000 primitives share one accessor of 100,000 vertices: 1.2 GB, if each read all of it.
  GltfFile file;
  std::vector<float> positions(300'000);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i * i % 1009);
  const std::size_t vertices = file.addAccessor(positions, "VEC3", 3, kFloat);
  const std::size_t indices =
      file.addAccessor(std::vector<std::uint32_t>{7, 70'000, 99'999}, "SCALAR", 1, kUint);
  file.addMesh({{"attributes", {{"POSITION", vertices}}}, {"indices", indices}});
  const json primitive = file.json["meshes"][0]["primitives"][0];
  file.json["meshes"][0]["primitives"] = json(1000, primitive);
  file.addRoot({{"mesh", 0}});
  const Result<Scene> scene = parseGltf(file.files(), {.maxDecodedBytes = 8 << 20});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->sourceTriangle.size(), 1000u);
}

TEST(Gltf, DecodesMeshoptCompression) {
  const GltfFile plain = squareFile();
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  for (const std::string mode : {"TRIANGLES", "INDICES"}) {
    for (const std::string filter : {"NONE", "EXPONENTIAL"}) {
      GltfFile file = plain;
      std::vector<float> source = positions;
      if (filter == "EXPONENTIAL") meshopt_encodeFilterExp(source.data(), 4, 12, 15, positions.data());
      std::string vertexBytes(meshopt_encodeVertexBufferBound(4, 12), '\0');
      vertexBytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(vertexBytes.data()),
                                                    vertexBytes.size(), source.data(), 4, 12));
      std::string indexBytes(meshopt_encodeIndexBufferBound(6, 4) + meshopt_encodeIndexSequenceBound(6, 4),
                             '\0');
      auto* to = reinterpret_cast<unsigned char*>(indexBytes.data());
      indexBytes.resize(mode == "TRIANGLES"
                            ? meshopt_encodeIndexBuffer(to, indexBytes.size(), indices.data(), 6)
                            : meshopt_encodeIndexSequence(to, indexBytes.size(), indices.data(), 6));

      // Views 0 and 2 now live in a fallback buffer without data.
      const auto compress = [&](std::size_t view, const std::string& bytes, std::size_t stride,
                                std::size_t count, const std::string& how, const std::string& filtered) {
        const std::size_t at = file.addView(bytes);
        json extension = {{"buffer", 0},
                          {"byteOffset", file.json["bufferViews"][at]["byteOffset"]},
                          {"byteLength", bytes.size()},
                          {"byteStride", stride},
                          {"count", count},
                          {"mode", how},
                          {"filter", filtered}};
        file.json["bufferViews"][view] = {{"buffer", 1},
                                          {"byteLength", stride * count},
                                          {"extensions", {{"EXT_meshopt_compression", extension}}}};
      };
      compress(0, vertexBytes, 12, 4, "ATTRIBUTES", filter);
      compress(2, indexBytes, 2, 6, mode, "NONE");
      file.json["buffers"] = {
          {{"byteLength", file.binary().size()}},
          {{"byteLength", 48}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
      file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
      EXPECT_EQ(corners(parsed(file)), corners(parsed(plain))) << mode << ' ' << filter;
    }
  }
}

TEST(Gltf, ReadsBuffersFromDataUrisAndFiles) {
  GltfFile file = squareFile();
  const std::string& binary = file.binary();
  file.json["buffers"] = {{{"uri", "my%20square.bin"}, {"byteLength", binary.size()}}};
  const auto expectSquare = [](const SceneFiles& files) {
    const Result<Scene> scene = parseGltf(files);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->sourceTriangle.size(), 2u);
  };
  const std::string text = file.json.dump();
  expectSquare({.main = "a.gltf", .files = {{"a.gltf", text}, {"my%20square.bin", binary}}});
  expectSquare({.main = "a.gltf", .files = {{"a.gltf", "\xef\xbb\xbf" + text}, {"my square.bin", binary}}});

  // From a disk.
  const fs::path folder = fs::path(testing::TempDir()) / "sundial_gltf_test";
  fs::create_directories(folder);
  std::ofstream(folder / "a.gltf", std::ios::binary) << text;
  std::ofstream(folder / "my square.bin", std::ios::binary) << binary;
  const Result<SceneFiles> files = readSceneFiles(folder / "a.gltf");
  ASSERT_TRUE(files) << files.error().message;
  expectSquare(*files);
  fs::remove_all(folder);

  std::string base64;
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < binary.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < binary.size() ? static_cast<unsigned char>(binary[i + k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6) base64.push_back(kDigits[word >> shift & 63]);
  }
  file.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
  expectSquare({.main = "a.gltf", .files = {{"a.gltf", file.json.dump()}}});
}

TEST(Gltf, ApartmentIsTheSameCompressedAndPlain) {
  const fs::path plain = SUNDIAL_SCENES "/apartment.glb",
                 compressed = SUNDIAL_SCENES "/apartment_meshopt.glb";
  if (!fs::exists(plain) || !fs::exists(compressed)) GTEST_SKIP() << plain << " is not there";
  std::vector<std::vector<SourceTriangle>> triangles;
  for (const fs::path& path : {plain, compressed}) {
    const Result<SceneFiles> files = readSceneFiles(path);
    ASSERT_TRUE(files) << files.error().message;
    const Result<Scene> scene = parseGltf(*files);
    ASSERT_TRUE(scene) << scene.error().message;
    expectInvariants(*scene);
    EXPECT_EQ(scene->sourceTriangle.size() + scene->degenerateTriangles, 177'934u);
    EXPECT_LE(scene->vertices.size(), scene->sourceTriangle.size() * 102 / 100);
    triangles.push_back(sourceTriangles(*scene));
  }
  EXPECT_TRUE(triangles[0] == triangles[1]);
}

TEST(Gltf, ReadsScenesFoundInTheWild) {
  const std::vector<std::pair<std::string, std::uint64_t>> scenes{
      {"jungle.glb", 18'515}, {"carriage.glb", 130'362}, {"space.glb", 50'003}};
  if (!fs::exists(SUNDIAL_SCENES)) GTEST_SKIP() << SUNDIAL_SCENES << " is not there";
  for (const auto& [name, triangles] : scenes) {
    const Result<SceneFiles> files = readSceneFiles(fs::path(SUNDIAL_SCENES) / name);
    ASSERT_TRUE(files) << files.error().message;
    const Result<Scene> scene = parseGltf(*files);
    ASSERT_TRUE(scene) << scene.error().message;
    expectInvariants(*scene);
    EXPECT_EQ(scene->sourceTriangle.size() + scene->degenerateTriangles, triangles) << name;
  }
}

}  // namespace
}  // namespace sundial
