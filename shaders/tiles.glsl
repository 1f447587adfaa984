// Tiles of a square in light space, row by row; row 0 is at the bottom of light space.
#ifndef SUNDIAL_TILES_GLSL
#define SUNDIAL_TILES_GLSL
#include "bindings.glsl"

// False outside of the square.
bool tileAt(vec2 ls, vec2 corner, float tileSide, uint tilesPerSide, out uint tile) {
  const vec2 at = floor((ls - corner) / tileSide);
  tile = 0;
  if (any(lessThan(at, vec2(0))) || any(greaterThanEqual(at, vec2(tilesPerSide)))) return false;
  tile = uint(at.y) * tilesPerSide + uint(at.x);
  return true;
}

#endif
