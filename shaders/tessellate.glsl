// Into how many pieces a triangle's edges are cut, by how long they are in the warped map [NOTW, section 4.1]. Triangles that
// share an edge cut it alike.
#ifndef SUNDIAL_TESSELLATE_GLSL
#define SUNDIAL_TESSELLATE_GLSL
#include "store_warped.glsl"

layout(constant_id = 0) const uint kTexelsPerPiece = 8;
// Of an edge. lavapipe counts the corners of a draw in 16 bits, and 128 triangles cut into so many have 60,032.
const float kMostPieces = 24;

// Beyond one side of the map.
bool isOutside(vec4 a, vec4 b, vec4 c) {
  const bvec2 below = lessThan(max(max(a.xy + a.w, b.xy + b.w), c.xy + c.w), vec2(0));
  const bvec2 above = lessThan(max(max(a.w - a.xy, b.w - b.xy), c.w - c.xy), vec2(0));
  return any(below) || any(above);
}

// From one corner to another before the warp, clip space of the only map.
float piecesOf(vec4 from, vec4 to) {
  if (from.w <= 0 || to.w <= 0) return kMostPieces;
  const vec4 a = warpedClip(0, from), b = warpedClip(0, to);
  const float texels = length(0.5 * (b.xy / b.w - a.xy / a.w) * vec2(warpSize()));
  return clamp(ceil(texels / float(kTexelsPerPiece)), 1, kMostPieces);
}

void setLevels(vec4 a, vec4 b, vec4 c) {
  const vec3 pieces = isOutside(a, b, c) ? vec3(0) : vec3(piecesOf(b, c), piecesOf(c, a), piecesOf(a, b));
  for (int edge = 0; edge < 3; ++edge) gl_TessLevelOuter[edge] = pieces[edge];  // each opposite of its corner
  gl_TessLevelInner[0] = max(max(pieces.x, pieces.y), pieces.z);
}

#endif
