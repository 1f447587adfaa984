// What lies across triangles' edges, by which surfaces are walked.
#include "scene/edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/load.h"
#include "support/tiny_scene.h"

namespace sundial::test {
namespace {

struct Across {
  std::uint32_t triangle, edge;
  bool sameWay;
};

Across across(const std::vector<std::uint32_t>& adjacent, std::uint32_t triangle, std::uint32_t edge) {
  const std::uint32_t word = adjacent[3 * triangle + edge];
  return {word >> 3, word & 3u, (word & 4u) != 0};
}

// The edge's ends, as the triangle runs along it.
std::array<glm::vec3, 2> endsOf(const Scene& scene, std::uint32_t triangle, std::uint32_t edge) {
  const auto at = [&](std::uint32_t corner) {
    return scene.vertices[scene.indices[3 * triangle + corner % 3]].position;
  };
  return {at(edge), at(edge + 1)};
}

// Every edge meets one in its place, and the way across leads back.
void expectEdgesToMeet(const Scene& scene) {
  const auto adjacent = findAdjacent(scene);
  ASSERT_EQ(adjacent.size(), scene.indices.size());
  for (std::uint32_t t = 0; t < adjacent.size() / 3; ++t)
    for (std::uint32_t e = 0; e < 3; ++e) {
      const Across there = across(adjacent, t, e);
      auto ends = endsOf(scene, t, e), met = endsOf(scene, there.triangle, there.edge);
      if (!there.sameWay) std::swap(met[0], met[1]);
      ASSERT_EQ(ends, met) << t << " " << e;
      std::uint32_t round = 0;
      for (Across next = there; next.triangle != t || next.edge != e; ++round) {
        next = across(adjacent, next.triangle, next.edge);
        ASSERT_LT(round, 100u);
      }
    }
}

TEST(Edges, OfBuiltinScenesMeet) {
  for (const char* name : {"knot?along=60", "atrium", "trees"}) {
    SCOPED_TRACE(name);
    expectEdgesToMeet(*makeBuiltin(name));
  }
}

// A closed mesh whose triangles agree on their front: each edge has one other triangle, which runs the other
// way.
TEST(Edges, OfAClosedMeshHaveTwoSides) {
  TinyScene builder;
  builder.addInstance(builder.addMesh(sphere(12)));
  const auto adjacent = findAdjacent(*builder.finish());
  for (std::uint32_t t = 0; t < adjacent.size() / 3; ++t)
    for (std::uint32_t e = 0; e < 3; ++e) {
      const Across there = across(adjacent, t, e);
      EXPECT_NE(there.triangle, t);
      EXPECT_FALSE(there.sameWay);
    }
}

TEST(Edges, OfARimMeetThemselves) {
  TinyScene builder;
  builder.addInstance(builder.addMesh(quad({0, 0, 0}, {1, 0, 0}, {0, 0, 1})));
  const auto adjacent = findAdjacent(*builder.finish());
  int rims = 0;
  for (std::uint32_t t = 0; t < 2; ++t)
    for (std::uint32_t e = 0; e < 3; ++e) {
      const Across there = across(adjacent, t, e);
      if (there.triangle != t) continue;
      EXPECT_EQ(there.edge, e);
      EXPECT_TRUE(there.sameWay);
      ++rims;
    }
  EXPECT_EQ(rims, 4);
}

}  // namespace
}  // namespace sundial::test
