// The square of volume=inscribed [Alecu 2014, section 3.3] and its tiles, row by row; row 0 is at the bottom of light
// space.
#ifndef SUNDIAL_TILES_GLSL
#define SUNDIAL_TILES_GLSL
#include "bindings.glsl"

struct Square {
  vec2 corner;
  float side;
};

Square inscribedSquare() {
  float side = frame.settings.lsSquareSide;
  // Up to rounding every sample is inside.
  if (side == 0)
    side = clamp(1.0001 * uintBitsToFloat(analysis.lsSquareSide), 1e-3, frame.settings.lsSquareSideAtMost);
  return Square(frame.settings.lsSquareEye - side * frame.settings.squareBehind, side);
}

// False outside of the square.
bool tileAt(vec2 ls, vec2 corner, float tileSide, uint tilesPerSide, out uint tile) {
  const vec2 at = floor((ls - corner) / tileSide);
  tile = 0;
  if (any(lessThan(at, vec2(0))) || any(greaterThanEqual(at, vec2(tilesPerSide)))) return false;
  tile = uint(at.y) * tilesPerSide + uint(at.x);
  return true;
}

#endif
