#version 460
#extension GL_GOOGLE_include_directive : require
// partition=tiles: a square of light space in equal tiles, of unequal resolution: the most important tile gets the
// largest map [Alecu 2014, sections 3.3 to 3.5]. Views stand in the order of their maps' sizes, so that the host knows
// each view's viewport without knowing which tile it is.
// Departures: the square is as large as what is seen of the scene needs, where no extent is given; a tile without samples
// is not drawn; the near plane is the nearest caster's even where the paper takes the
// nearest sample's (see withCasters()).
#include "plan_view.glsl"
#include "shared/choices.h"
#include "tiles.glsl"

layout(local_size_x = kMaxShadowViews) in;

layout(constant_id = 0) const uint kFit = kTileDepth;
layout(constant_id = 1) const bool kRanked = true;  // by importance; otherwise sizes are given tile by tile

// Tiles with more importance, and of equals those with smaller numbers, come first.
uint rankOf(uint tile, uint tiles) {
  if (!kRanked) return tile;
  uint rank = 0;
  for (uint other = 0; other < tiles; ++other) {
    const uint mine = analysis.importance[tile], its = analysis.importance[other];
    rank += its > mine || (its == mine && other < tile) ? 1 : 0;
  }
  return rank;
}

void main() {
  const uint tilesPerSide = frame.settings.tilesPerSide, tiles = tilesPerSide * tilesPerSide;
  const uint tile = gl_LocalInvocationID.x;
  const Square square = inscribedSquare();
  const float side = square.side / float(tilesPerSide);
  if (tile == 0) {
    writePlan(tiles, frame.lightFromWorld);
    plan.tilesPerSide = tilesPerSide;
    plan.lsSquareMin = square.corner;
    plan.lsTileSide = side;
  }
  if (tile >= tiles) return;

  const uint view = rankOf(tile, tiles);
  const uvec2 texels = uvec2(frame.settings.tileTexels[view]);
  plan.viewOfTile[tile] = view;
  const vec2 corner = square.corner + side * vec2(tile % tilesPerSide, tile / tilesPerSide);
  LightBox box = sampleBox(tile);
  const bool empty = isEmpty(box);
  if (kFit != kTileBox || empty) {
    box.low.xy = corner;
    box.high.xy = corner + side;
  }
  // An empty tile is shown where it lies; the casters' bounds are already in the tile's range of depth.
  if (empty) box = LightBox(vec3(box.low.xy, min(frame.lsBoundsMin.z, frame.lsBoundsMax.z)), vec3(box.high.xy, frame.lsBoundsMax.z));
  if (kFit != kTileCasters) box = withCasters(box);
  box = withExtent(kFit == kTileBox && !empty ? withBorder(box, texels) : box);
  placeMap(view);
  writeView(view, box, frame.lightFromWorld, texels);
  uint before = 0;
  for (uint v = 0; v < view; ++v) before += frame.settings.tileTexels[v] * frame.settings.tileTexels[v];
  plan.views[view].rectOffset = uvec2(0);
  plan.views[view].linearOffset = before;
  plan.views[view].sampleCount = analysis.sampleCount[tile];
  plan.views[view].importance = analysis.importance[tile];
  plan.views[view].tile = tile;
  plan.views[view].empty = empty ? 1 : 0;
}
