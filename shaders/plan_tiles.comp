#version 460
#extension GL_GOOGLE_include_directive : require
// partition=tiles: a square of light space in equal tiles, of unequal resolution: the most important tile gets the
// largest map [Alecu 2014, sections 3.3 to 3.5]. Views stand in the order of their maps' sizes, so that the host knows
// each view's viewport without knowing which tile it is.
// resolution=estimated gives each tile what its samples' pixels ask for, as the thesis' discussion wishes: less of it to all
// where the buffer doesn't hold it.
// Departures: the square is as large as what is seen of the scene needs, where no extent is given; a tile without samples
// is not drawn; the near plane is the nearest caster's even where the paper takes the
// nearest sample's (see withCasters()).
#include "estimate.glsl"
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

LightBox boxOf(uint tile) {
  const uint tilesPerSide = frame.settings.tilesPerSide;
  const Square square = inscribedSquare();
  const float side = square.side / float(tilesPerSide);
  const vec2 corner = square.corner + side * vec2(tile % tilesPerSide, tile / tilesPerSide);
  LightBox box = sampleBox(tile);
  const bool empty = isEmpty(box);
  if (kFit != kTileBox || empty) {
    box.low.xy = corner;
    box.high.xy = corner + side;
  }
  // An empty tile is shown where it lies; the casters' bounds are already in the tile's range of depth.
  if (empty) box = LightBox(vec3(box.low.xy, min(frame.lsBoundsMin.z, frame.lsBoundsMax.z)), vec3(box.high.xy, frame.lsBoundsMax.z));
  return kFit != kTileCasters ? withCasters(box) : box;
}

// Sizes that together fit the buffer: all are reduced by one factor, none below the least.
void shareOut(uint tiles) {
  const uint kLeast = 8, kRounds = 64;
  float share = 1;
  for (uint round_ = 0; round_ < kRounds; ++round_) {
    float sum = 0;
    for (uint tile = 0; tile < tiles; ++tile) {
      const vec2 size = max(floor(share * vec2(mapTexels[tile])), float(kLeast));
      sum += size.x * size.y;
    }
    if (sum <= float(frame.storeSize.x)) break;
    share *= min(sqrt(float(frame.storeSize.x) / sum), 0.95);
  }
  if (share == 1) return;
  for (uint tile = 0; tile < tiles; ++tile) mapTexels[tile] = max(uvec2(share * vec2(mapTexels[tile])), uvec2(kLeast));
}

void planTile(uint tile, uint view) {
  LightBox box = boxOf(tile);
  const bool empty = analysis.sampleCount[tile] == 0;
  const uvec2 texels = mapTexels[tile];
  plan.viewOfTile[tile] = view;
  placeMap(view);
  plan.views[view].rectOffset = uvec2(0);
  writeView(view, withExtent(kFit == kTileBox && !empty ? withBorder(box, texels) : box), frame.lightFromWorld, texels);
  if (kSizes == kSizesFixed) {
    uint before = 0;
    for (uint v = 0; v < view; ++v) before += frame.settings.tileTexels[v] * frame.settings.tileTexels[v];
    plan.views[view].linearOffset = before;
  }
  shelve(view);
  plan.views[view].sampleCount = analysis.sampleCount[tile];
  plan.views[view].importance = analysis.importance[tile];
  plan.views[view].tile = tile;
  plan.views[view].empty = empty ? 1 : 0;
}

void main() {
  const uint tilesPerSide = frame.settings.tilesPerSide, tiles = tilesPerSide * tilesPerSide;
  const uint tile = gl_LocalInvocationID.x;
  const bool used = tile < tiles;
  const uint view = used ? rankOf(tile, tiles) : 0;
  if (tile == 0) {
    writePlan(tiles, frame.lightFromWorld);
    plan.tilesPerSide = tilesPerSide;
    const Square square = inscribedSquare();
    plan.lsSquareMin = square.corner;
    plan.lsTileSide = square.side / float(tilesPerSide);
  }
  if (used && kSizes == kSizesFixed) mapTexels[tile] = uvec2(frame.settings.tileTexels[view]);
  if (used && kSizes != kSizesFixed) mapTexels[tile] = texelsFor(tile, boxOf(tile), sceneBox(), kFit == kTileBox ? 2 : 0);
  barrier();
  if (kSizes != kSizesFixed && tile == 0) shareOut(tiles);
  barrier();
  if (used) planTile(tile, view);
}
