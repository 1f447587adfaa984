// Warps around a point light: each face of the cube has tables of its own, made of the samples that it sees.
#include "shared/cube.h"
#include "support/soups.h"
#include "support/warped.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;

// For tests of faces about the origin: +z, -z, +x and so on by the axes of a point light.
const std::vector<dvec3> kAxes = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
// Where their samples lie, for a camera that looks along each axis.
View along(const dvec3& axis, double fovDegrees) {
  return {.eye = {0, 0, 0},
          .target = axis,
          .up = axis.y == 0 ? dvec3(0, 1, 0) : dvec3(0, 0, 1),
          .verticalFovDegrees = fovDegrees};
}

std::shared_ptr<const Scene> emptyRoom() {
  Soups scene;
  scene.addInstance(scene.addMesh(room(4)));
  return scene.finish();
}

class FrameWarpCube : public FrameWarp {};

TEST_F(FrameWarpCube, EachFacesFunctionsRiseAndItsInverseIsOne) {
  const auto scene = builtin("observatory");
  for (const char* text :
       {"rtw,texels=100x60", "notw,texels=100x60", "notw,texels=64,window=1,even=0.05",
        "rtw,texels=64,analysis=forward", "rtw,texels=96x64,analysis=hybrid,weights=1:1:2:1:1"}) {
    SCOPED_TRACE(text);
    const std::vector<Warped> faces =
        warps(scene, viewOf(*scene, "main"), lightOf(*scene, "lamp"), {300, 200}, text);
    ASSERT_EQ(faces.size(), shared::kCubeFaces);
    double moves = 0;
    for (const Warped& w : faces) {
      if (w.empty) continue;
      expectWarp(w, 0.99 * method(text).settings.even);
      const dvec2 middle = 0.5 * dvec2(w.size);
      moves = std::max(moves, glm::length(w(middle) - middle));
    }
    EXPECT_GT(moves, 2) << "texels";
  }
}

// What a filter sees beyond its face must be in the map: no sample lies there, and it would be left with the
// share that is spread evenly.
TEST_F(FrameWarpCube, WhatLookupsSeeBeyondAFaceKeepsItsWidth) {
  const auto scene = builtin("observatory");
  for (const char* text : {"rtw,texels=64,lookup=pcf,kernel=7", "notw,texels=64x80,lookup=pcf,kernel=7"}) {
    SCOPED_TRACE(text);
    for (const Warped& w : warps(scene, viewOf(*scene, "main"), lightOf(*scene, "lamp"), {300, 200}, text))
      if (!w.empty) expectWarp(w, 0.99 * method(text).settings.even, 4);
  }
}

// From the light itself all of a face's texels are seen by as many pixels.
TEST_F(FrameWarpCube, UniformSamplesAreLeftWhereTheyAre) {
  const auto scene = emptyRoom();
  for (const dvec3& axis : kAxes)
    for (const char* text : {"notw,texels=64,even=0.01,window=1", "rtw,texels=64,even=0.01,window=1"}) {
      SCOPED_TRACE(text);
      std::size_t full = 0;
      for (const Warped& w : warps(scene, along(axis, 90), point({0, 0, 0}), {512, 512}, text)) {
        if (w.empty || w.samples.size() < 512 * 500) continue;
        ++full;
        for (unsigned y = 0; y < w.size.y; ++y)
          for (unsigned x = 0; x < w.size.x; ++x) {
            const dvec2 p(x + 0.5, y + 0.5);
            ASSERT_LT(glm::length(w(p) - p), 1.5) << x << " " << y;
          }
      }
      EXPECT_EQ(full, 1u);
    }
}

TEST_F(FrameWarpCube, EachFaceIsMadeOfItsOwnSamples) {
  const auto scene = emptyRoom();
  std::vector<std::size_t> seenBy(shared::kCubeFaces);
  for (const dvec3& axis : kAxes) {
    const std::vector<Warped> faces =
        warps(scene, along(axis, 60), point({0, 0, 0}), {64, 64}, "notw,texels=64");
    for (std::size_t face = 0; face < faces.size(); ++face) {
      EXPECT_EQ(faces[face].empty, faces[face].samples.empty());
      seenBy[face] += !faces[face].empty;
    }
  }
  EXPECT_EQ(seenBy, std::vector<std::size_t>(shared::kCubeFaces, 1));
}

// A plate below the light and a floor, seen from close above it: the shadow is the plate, seen from the
// light. It lies across four of the cube's edges.
TEST_F(FrameWarpCube, AShadowEndsWhereThePlatesRimPutsIt) {
  const dvec3 corner(-1.1, -1, -0.7), along(0.3, 0, 2), across(2, 0, -0.3);
  Soups soups;
  soups.addInstance(soups.addMesh(quad({-9, -2, -9}, {0, 0, 18}, {18, 0, 0})));
  soups.addInstance(soups.addMesh(quad(glm::vec3(corner), glm::vec3(along), glm::vec3(across))));
  const auto scene = soups.finish();
  const View view{.eye = {2, -0.5, 2.5}, .target = {0, -2, 0}, .verticalFovDegrees = 70};
  // Where the ray to the light passes the plate's plane, in shares of its sides.
  const auto inShadow = [&](const dvec3& p, const dvec3& lamp) {
    const dvec3 from = glm::mix(lamp, p, (corner.y - lamp.y) / (p.y - lamp.y)) - corner;
    const double u = glm::dot(from, along) / glm::dot(along, along);
    const double v = glm::dot(from, across) / glm::dot(across, across);
    return u > 0 && u < 1 && v > 0 && v < 1;
  };
  const auto wrong = [&](std::string_view text) {
    std::size_t pixels = 0;
    for (const dvec3& lamp : {dvec3(0.2, 0.1, 0.15), dvec3(-0.1, 0.1, 0.35)}) {
      const Rendering r = render(scene, view, point(lamp), {320, 240}, text);
      for (std::size_t i = 0; i < r.pixels(); ++i)
        if (r.seen(i) && r.position(i).y < -1.9)
          pixels += (r.visibility(i) < 0.5) != inShadow(r.position(i), lamp);
    }
    return pixels;
  };
  const std::size_t plain = wrong("sm,texels=64");
  EXPECT_LT(wrong("ray-traced"), 3u);
  EXPECT_LT(wrong("rtw,texels=64"), plain);
  EXPECT_LT(wrong("notw,texels=64"), plain);
  EXPECT_LT(wrong("notw,texels=512"), plain / 5);
}

TEST_F(FrameWarpCube, FewerPixelsAreWrongThanWithoutAWarp) {
  const auto scene = builtin("observatory");
  for (const char* name : {"main", "floor", "dome"}) {
    SCOPED_TRACE(name);
    const auto rs = render(jobOf(scene, viewOf(*scene, name), lightOf(*scene, "lamp"), {512, 512},
                                 {"sm,texels=256", "rtw,texels=256", "notw,texels=256"}, {}, true));
    const auto wrong = [&](std::size_t i) { return 1 - rs[i].result.measures->pixelMatch; };
    EXPECT_LT(wrong(1), wrong(0));
    EXPECT_LT(wrong(2), wrong(1));
    EXPECT_LT(rs[2].result.measures->interiorError, 2e-3);
  }
}

TEST_F(FrameWarpCube, EveryAnalysisAndLookupAnswersAsTheReferenceDoes) {
  const auto scene = builtin("observatory");
  for (const char* text : {"rtw,texels=512,analysis=forward", "rtw,texels=512,analysis=hybrid",
                           "rtw,texels=512,lookup=pcf", "notw,texels=512,lookup=pcf", "notw"}) {
    const Rendering r = render(scene, viewOf(*scene, "main"), lightOf(*scene, "lamp"), {320, 320}, text);
    EXPECT_GT(r.result.measures->pixelMatch, 0.98) << text;
    EXPECT_LT(r.result.measures->interiorError, 2e-3) << text;
  }
}

TEST_F(FrameWarpCube, TheBytesRepeatWhoeverKnowsThePlan) {
  const auto scene = builtin("observatory");
  const auto visibility = [&](const std::string& text) {
    return render(scene, viewOf(*scene, "main"), lightOf(*scene, "lamp"), {160, 120}, text)
        .images.at(Aov::visibility)
        .bytes;
  };
  for (const std::string name : {"rtw,texels=128", "rtw,texels=128,analysis=forward", "notw,texels=128"}) {
    const auto first = visibility(name);
    EXPECT_TRUE(visibility(name) == first) << name;
    EXPECT_TRUE(visibility(name + ",plan=readback") == first) << name;
    EXPECT_TRUE(visibility(name + ",plan=delayed") == first) << name;
  }
}

// The papers' limit, as with one map: the pipeline draws straight edges between warped vertices.
TEST_F(FrameWarpCube, EdgesBendInTheVertexShaderAlone) {
  const auto scene = builtin("observatory");
  for (const char* row : {"rtw", "notw"}) {
    const auto interior = [&](std::string_view more) {
      return render(scene, viewOf(*scene, "main"), lightOf(*scene, "lamp"), {320, 320},
                    fmt::format("{},texels=512{}", row, more))
          .result.measures->interiorError;
    };
    EXPECT_LT(interior(""), 0.001) << row;
    EXPECT_GT(interior(",raster=pipeline"), 0.02) << row;
  }
}

}  // namespace
}  // namespace sundial::test
