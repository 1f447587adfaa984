// The second round: listed triangles, an invocation each. Clipped at the sides of the map, as lavapipe's pipeline clips
// them, they fall into up to five parts; small parts are drawn at once, large ones are cut into bands.
#include "raster_fill.glsl"

layout(local_size_x = 64) in;

const float kLeastW = 1e-30;

// dp / (dp - other) to the last bit or nearly: a division of floats may be off by more, which would move a vertex on
// the grid. The remainder is exact by Dekker's product of halves.
float share(float dp, float denominator) {
  precise const float quotient = dp / denominator;
  precise const float a = quotient * 4097, b = denominator * 4097;
  precise const float qHigh = a - (a - quotient), dHigh = b - (b - denominator);
  precise const float qLow = quotient - qHigh, dLow = denominator - dHigh;
  precise const float product = quotient * denominator;
  precise const float error = ((qHigh * dHigh - product) + qHigh * dLow + qLow * dHigh) + qLow * dLow;
  precise const float remainder = (dp - product) - error;
  precise const float corrected = quotient + remainder / denominator;
  return corrected;
}

// Signed distance to a side of the map, times w: positive inside.
float distanceTo(uint side, vec4 clip) {
  const float position = side < 2 ? clip.x : clip.y;
  return side % 2 == 0 ? clip.w - position : clip.w + position;
}

// Between a corner inside and one outside of a side, found from the nearer one.
Corner crossing(Corner a, float da, Corner b, float db) {
  precise float t;
  Corner near, far;
  if (abs(da) < abs(db)) {
    near = a;
    far = b;
    t = share(-da, db - da);
  } else {
    near = b;
    far = a;
    t = share(-db, da - db);
  }
  precise const vec4 clip = near.clip + t * (far.clip - near.clip);
  precise const vec3 attributes = near.attributes + t * (far.attributes - near.attributes);
  return Corner(clip, attributes);
}

// What of a convex polygon of n corners lies inside a side; the number of its corners.
int clipped(inout Corner corners[kMaxPolygon], int n, uint side) {
  Corner kept[kMaxPolygon];
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const Corner a = corners[i], b = corners[i + 1 < n ? i + 1 : 0];
    const float da = distanceTo(side, a.clip), db = distanceTo(side, b.clip);
    if (da >= 0 && count < kMaxPolygon) kept[count++] = a;
    if ((da >= 0) != (db >= 0) && count < kMaxPolygon) kept[count++] = crossing(a, da, b, db);
  }
  corners = kept;
  return count;
}

void cutIntoBands(uint view, uint id, Placed p[3], ivec4 box) {
  const uint part = atomicAdd(raster.partCount[kKind], 1);
  const uint count = uint(box.w - box.y) / kBandRows + 1;
  const uint first = atomicAdd(raster.bandCount[kKind], count);
  if (part >= push.partRoom || first + count > push.bandRoom) return;
  ivec2 grid[3] = {p[0].grid, p[1].grid, p[2].grid};
  turnInside(grid, false);
  const Varying v = varyingOver(p);
  RasterPart record;
  record.view = view;
  record.id = id;
  record.x = int[3](grid[0].x, grid[1].x, grid[2].x);
  record.y = int[3](grid[0].y, grid[1].y, grid[2].y);
  record.box = int[4](box.x, box.y, box.z, box.w);
  record.depth = v.depth;
  record.depthAtMost = v.depthAtMost;
  if (kMasked) record.attributes = v.attributes;
  parts[kKind * push.partRoom + part] = record;
  for (uint i = 0; i < count; ++i) bands[kKind * push.bandRoom + first + i] = RasterBand(part, i);
  const uint last = first + count - 1;
  atomicMax(raster.bands[kKind].x, min(last + 1, kWorkgroupsInRow));
  atomicMax(raster.bands[kKind].y, last / kWorkgroupsInRow + 1);
}

void drawPart(uint view, uint id, Corner a, Corner b, Corner c, uint material) {
  // At the light itself there is nothing to divide by.
  if (!(min(min(a.clip.w, b.clip.w), c.clip.w) > kLeastW)) return;
  const Placed p[3] = {placedIn(view, a), placedIn(view, b), placedIn(view, c)};
  const ivec4 box = texelBox(view, p);
  if (isEmpty(box)) return;
  if (isSmall(p, box))
    drawSmall(view, id, p, box, material);
  else
    cutIntoBands(view, id, p, box);
}

void main() {
  const uint item = gl_GlobalInvocationID.x;
  if (item >= min(raster.listedCount[kKind], push.listedRoom)) return;
  const ListedTriangle entry = listed[kKind * push.listedRoom + item];
  Corner corners[3];
  readTriangle(entry.view, entry.id, corners);
  Corner polygon[kMaxPolygon];
  for (int i = 0; i < 3; ++i) polygon[i] = corners[i];
  int n = 3;
  for (uint side = 0; side < 4; ++side) n = clipped(polygon, n, side);
  const uint material = materialOf(entry.id);
  for (int i = 2; i < n; ++i) drawPart(entry.view, entry.id, polygon[0], polygon[i - 1], polygon[i], material);
}
