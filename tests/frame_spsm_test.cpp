// Maps that hold triangles: shadows' edges finer than texels, what decides about a sample, and with which
// other stages it goes.
#include "scene/scene_builder.h"
#include "shared/choices.h"
#include "shared/wanted.h"
#include "support/wrong_pixels.h"

namespace sundial::test {
namespace {

using FrameSpsm = WrongPixelsTest;

// Straight edges of large triangles are where they are, whatever the texels' size.
TEST_F(FrameSpsm, EdgesOfLargeTrianglesAreExact) {
  for (const char* light : {"sun", "spot"}) {
    auto w = wrong("grid", "shadows", light,
                   {"sm,texels=256", "spsm,texels=256", "spsm,texels=256,storage=depth-id"});
    EXPECT_GT(w["sm,texels=256"], 0.005) << light;
    EXPECT_LT(w["spsm,texels=256"], 0.15 * w["sm,texels=256"]) << light;
    EXPECT_LT(w["spsm,texels=256,storage=depth-id"], 0.1 * w["sm,texels=256"]) << light;
    EXPECT_LE(w["spsm,texels=256,storage=depth-id"], w["spsm,texels=256"]) << light;
  }
}

TEST_F(FrameSpsm, RebuiltEdgesMakeUpForTrianglesThatNoTexelHolds) {
  auto w = wrong("knot", "main", "sun",
                 {"sm,texels=1024", "spsm,texels=1024,recovery=edges", "spsm,texels=1024,recovery=off",
                  "rgsm,texels=1024", "rgsm,texels=1024,kernel=5"});
  const double edges = w["spsm,texels=1024,recovery=edges"];
  EXPECT_LT(edges, 0.48 * w["sm,texels=1024"]);
  EXPECT_GT(w["spsm,texels=1024,recovery=off"], 3 * edges);
  EXPECT_GT(w["rgsm,texels=1024"], w["rgsm,texels=1024,kernel=5"]);
  EXPECT_GT(w["rgsm,texels=1024,kernel=5"], 2 * edges);
}

TEST_F(FrameSpsm, GoesWithEveryWayToPlaceMaps) {
  for (const auto& [plan, light] : {std::tuple("sdsm-log,texels=256", "sun"),
                                    {"csm,texels=256", "sun"},
                                    {"msf,texels=512", "sun"},
                                    {"ferko,texels=512", "sun"},
                                    {"dv,texels=512", "spot"},
                                    {"iasm,tile_sizes=256:256:256:256", "sun"}}) {
    SCOPED_TRACE(plan);
    const std::string spsm = fmt::format("{},storage=triangle,lookup=spsm", plan);
    const std::string ids = fmt::format("{},storage=depth-id,lookup=spsm", plan);
    auto w = wrong("grid?n=20", "shadows", light, {plan, spsm, ids});
    EXPECT_LT(w[ids], 0.4 * w[plan]);
    // What 16 bits a corner are too few for, in a small tile of a large scene, is asked of the mesh.
    EXPECT_LT(w[spsm], 0.4 * w[plan]);
  }
}

// Triangles that reach far beyond a small tile are the same in it, packed or whole.
TEST_F(FrameSpsm, TilesOfLargeTrianglesHaveNoSeams) {
  const std::string tiles = "iasm,tile_sizes=256:256:256:256,lookup=spsm,recovery=edges,storage=";
  auto w = wrong("grid?n=20", "shadows", "sun", {tiles + "triangle", tiles + "depth-id"});
  EXPECT_LE(w[tiles + "triangle"], w[tiles + "depth-id"] + 1e-4);
}

// The truth of a pixel that one triangle fills: a ray from each of sixteen places in it.
TEST_F(FrameSpsm, SmoothedEdgesAreNearerToWhatPixelsSee) {
  constexpr unsigned kPlaces = 4;  // a side
  const glm::uvec2 size(240, 180);
  const auto scene = builtin("knot?along=60");
  const View view = viewOf(*scene, "shadow");
  const Light light = lightOf(*scene, "sun");
  const Rendering places =
      render(jobOf(scene, view, light, kPlaces * size, {"ray-traced"}, {Aov::reference, Aov::id})).front();
  const auto renderings =
      render(jobOf(scene, view, light, size, {"spsm,texels=1024,recovery=edges", "spsm-aa,texels=1024"},
                   {Aov::visibility, Aov::id}));
  std::array<double, 2> error{};
  std::size_t mixed = 0;
  for (unsigned y = 0; y < size.y; ++y)
    for (unsigned x = 0; x < size.x; ++x) {
      const std::size_t pixel = y * size.x + x;
      double lit = 0;
      bool filled = renderings[0].seen(pixel);
      for (unsigned i = 0; i < kPlaces * kPlaces; ++i) {
        const std::size_t place =
            std::size_t{y * kPlaces + i / kPlaces} * kPlaces * size.x + x * kPlaces + i % kPlaces;
        filled = filled && places.id(place) == renderings[0].id(pixel);
        lit += places.reference(place) / (kPlaces * kPlaces);
      }
      if (!filled) continue;
      mixed += lit > 0 && lit < 1;
      for (std::size_t m = 0; m < 2; ++m) error[m] += std::abs(renderings[m].visibility(pixel) - lit);
    }
  EXPECT_GT(mixed, 500u);
  EXPECT_LT(error[1], 0.8 * error[0]) << error[0] << " " << error[1] << " " << mixed;
}

TEST_F(FrameSpsm, SaysWhatItAnsweredFrom) {
  const auto scene = builtin("knot?along=60");
  const Rendering r =
      render(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {200, 150}, "spsm-aa,texels=512");
  std::array<std::size_t, 4> count{};
  std::size_t between = 0;
  for (std::size_t i = 0; i < r.pixels(); ++i) {
    const auto found = r.at<std::uint32_t>(Aov::lookupClass, i);
    ASSERT_LE(found, shared::kAnswerUncertain);
    ++count[found];
    // Nothing but a rebuilt edge is smoothed.
    if (r.visibility(i) > 0 && r.visibility(i) < 1) {
      ++between;
      EXPECT_EQ(found, shared::kAnswerUncertain);
    }
    EXPECT_EQ(r.visibility(i) * 4, std::round(r.visibility(i) * 4));
  }
  EXPECT_GT(between, 20u);
  EXPECT_EQ(r.work("resolve", "one_triangle"), count[shared::kAnswerOneTriangle]);
  EXPECT_EQ(r.work("resolve", "neighbours"), count[shared::kAnswerNeighbours]);
  EXPECT_EQ(r.work("resolve", "uncertain"), count[shared::kAnswerUncertain]);
  EXPECT_EQ(r.work("resolve", "more_positions"), 3 * count[shared::kAnswerUncertain]);
  EXPECT_GT(count[shared::kAnswerOneTriangle], 4 * count[shared::kAnswerUncertain]);

  const Rendering plain =
      render(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {200, 150}, "sm,texels=512");
  EXPECT_EQ(plain.at<std::uint32_t>(Aov::lookupClass, 0), 0xffffffffu);
}

// The codes' proportions are the world's: a map about a lamp, whose depth is the reciprocal of distance, and
// small tiles of a scene lose no more than one map of the sun.
TEST_F(FrameSpsm, PackingCostsLittleInAnyLight) {
  for (const char* light : {"spot", "lamp"}) {
    auto w = wrong("observatory", "main", light, {"spsm,texels=256", "spsm,texels=256,storage=depth-id"});
    EXPECT_LE(w["spsm,texels=256"], 1.25 * w["spsm,texels=256,storage=depth-id"] + 5e-4) << light;
  }
}

// 16 bytes a texel, and 8 while it is drawn.
TEST_F(FrameSpsm, SaysWhatMemoryItTakes) {
  const auto scene = builtin("grid");
  const auto r = render(
      jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {64, 64},
            {"spsm,texels=64", "spsm,texels=1024", "spsm,texels=1024,storage=depth-id", "rgsm,texels=1024"}));
  EXPECT_EQ(r[0].result.storeBytes, 24u << 12);
  // With more texels than samples a list says which are packed: 4 bytes a texel and a bit.
  const std::uint64_t listed = (28u << 20) + (1u << 17) + sizeof(shared::WantedTexels);
  EXPECT_EQ(r[1].result.storeBytes, listed);
  EXPECT_EQ(r[2].result.storeBytes, 8u << 20);
  EXPECT_EQ(r[3].result.storeBytes, listed);
}

// A texel holds its triangle from both sides of a map's rim.
TEST_F(FrameSpsm, IsLitBeyondItsMapAndWithoutACaster) {
  const auto nothing = sharedScene(SceneBuilder("empty").finish());
  EXPECT_EQ(render(jobOf(nothing, defaultView(*nothing), sun(50, 0), {24, 24},
                         {"spsm,texels=64", "rgsm,texels=64", "dv,texels=64,storage=triangle,lookup=spsm"},
                         kAllImages, true))
                .size(),
            3u);
}

TEST(Spsm, RefusesWhatItCannotRead) {
  const auto why = [](std::string_view text) {
    const auto chosen = parseMethod(text);
    return chosen ? "" : chosen.error().message;
  };
  EXPECT_NE(why("sm,lookup=spsm").find("storage=triangle or storage=depth-id"), std::string::npos);
  EXPECT_NE(why("sm,storage=triangle").find("storage=triangle is read by"), std::string::npos);
  EXPECT_NE(why("rgsm,kernel=4").find("give an odd number"), std::string::npos);
  EXPECT_NE(why("spsm,positions=3").find("choose one of 1, 2, 4, 8"), std::string::npos);
  EXPECT_NE(why("spsm,raster=pipeline").find("raster=compute"), std::string::npos);
  EXPECT_EQ(why("spsm,texels=4096,kernel=5,recovery=off"), "");
}

}  // namespace
}  // namespace sundial::test
