// From a triangle over its mesh to where a view sample's ray to the light crosses it: from neighbour to neighbour, across
// the edge that the sample lies beyond as the light sees it, at the cost of a vertex a step. Where a neighbour folds back
// there is a silhouette, and the walk goes on along it; it ends where that turns away, too. Only what is seen from the
// sample enters, so all lights are alike, and none of it is rounded to a map.
#ifndef SUNDIAL_SURFACE_WALK_GLSL
#define SUNDIAL_SURFACE_WALK_GLSL
#include "stored_triangle.glsl"

// The walks of `knot` that arrive at all have arrived by then.
const uint kWalkSteps = 16;

// An edge on the way, its triangle to the left. Places are relative to the sample.
struct WayOut {
  vec3 from, to;
  float inside;  // how far on the triangle's side of it the sample lies; negative beyond it
  uint side;     // 3 * triangle + the number of its edge
};

// Twice the area, about, that two places enclose with the sample, as the light sees them: positive if counter-clockwise.
float areaSeen(vec3 toLight, vec3 from, vec3 to) { return dot(toLight, cross(from, to)); }

// Whether a plane through these places is met on the way to the light, farther away than the bias in metres.
bool isBetween(vec3 toLight, vec3 a, vec3 b, vec3 c) {
  const vec3 normal = cross(b - a, c - a);
  const float along = dot(normal, toLight), steps = dot(normal, a) / along;  // of toLight
  return along != 0 && steps * length(toLight) > frame.biasWorld && (lightIsFar() || steps < 1);
}

// As rays of the reference (server/reference/reference.cpp): where light all but lies in the sample's plane the sample,
// which was rounded, goes back to it, and above it by what rounding may take again. From below walks would meet what
// adjoins the plane from behind.
const float kGrazing = 0.01;    // metres above the plane a metre towards the light
const float kRounding = 5e-7;  // of a position in single precision, relative
ViewSample onItsPlane(ViewSample s) {
  const vec3 toLight = wayToLight(s.wsPosition);
  if (dot(s.wsNormal, toLight) >= kGrazing * length(toLight)) return s;
  const vec3 corner = placed(instanceAt(s.instance), vertexPosition(triangleAt(s.triangle).vertices[0]));
  const float below = dot(s.wsNormal, corner - s.wsPosition);
  const vec3 extent = max(abs(corner), abs(s.wsPosition));
  ViewSample on = s;
  on.wsPosition += (below + kRounding * max(max(extent.x, extent.y), extent.z)) * s.wsNormal;
  return on;
}

vec3 cornerFrom(ViewSample s, Instance place, uint vertex) { return placed(place, vertexPosition(vertex)) - s.wsPosition; }

// Whether the surface that the triangle belongs to is between the sample and the light; then `triangle` becomes the one
// that is.
bool findOccluder(ViewSample s, uint instance, inout uint triangle) {
  const vec3 toLight = wayToLight(s.wsPosition);
  const Instance place = instanceAt(instance);
  const Triangle first = triangleAt(triangle);
  vec3 corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = cornerFrom(s, place, first.vertices[i]);
  vec3 inside;
  for (int i = 0; i < 3; ++i) inside[i] = areaSeen(toLight, corners[i], corners[(i + 1) % 3]);
  // Whether the triangle's corners run clockwise: then its edges are taken the other way.
  bool turned = inside.x + inside.y + inside.z < 0;
  if (turned) inside = -inside;
  if (all(greaterThanEqual(inside, vec3(0)))) return isBetween(toLight, corners[0], corners[1], corners[2]);

  const uint outmost = inside.x <= min(inside.y, inside.z) ? 0 : inside.y <= inside.z ? 1 : 2;
  WayOut out_, other;
  {
    const uint second = inside[(outmost + 1) % 3] <= inside[(outmost + 2) % 3] ? (outmost + 1) % 3 : (outmost + 2) % 3;
    const vec3 a = corners[outmost], b = corners[(outmost + 1) % 3], c = corners[second], d = corners[(second + 1) % 3];
    out_ = WayOut(turned ? b : a, turned ? a : b, inside[outmost], 3 * triangle + outmost);
    other = WayOut(turned ? d : c, turned ? c : d, inside[second], 3 * triangle + second);
  }
  bool hasOther = true, otherTurned = turned;

  for (uint walked = 0; walked < kWalkSteps; ++walked) {
    const uint across = texelFetch(adjacentTexels, int(out_.side)).x;
    const uint next = across >> 3, back = across & 3u;
    const bool nextTurned = turned != ((across & 4u) != 0);
    const vec3 apex = cornerFrom(s, place, triangleAt(next).vertices[(back + 2) % 3]);
    const float left = areaSeen(toLight, out_.from, apex), right = areaSeen(toLight, apex, out_.to);
    if (left + right - out_.inside <= 0) {
      if (!hasOther) return false;
      out_ = other;
      turned = otherTurned;
      hasOther = false;
      continue;
    }
    if (min(left, right) >= 0 && out_.inside <= 0) {
      triangle = next;
      return isBetween(toLight, out_.to, out_.from, apex);
    }
    const uint after = (back + 1) % 3, before = (back + 2) % 3;
    const WayOut a = WayOut(out_.from, apex, left, 3 * next + (nextTurned ? before : after));
    const WayOut b = WayOut(apex, out_.to, right, 3 * next + (nextTurned ? after : before));
    const bool isLeft = left < right;
    if (isLeft) {
      out_ = a;
      other = b;
    } else {
      out_ = b;
      other = a;
    }
    turned = otherTurned = nextTurned;
    hasOther = true;
  }
  return false;
}

// Whether the triangle isn't there where the sample's ray to the light crosses it.
bool isHoleOver(ViewSample s, uint instance, uint triangle) {
  const vec3 toLight = wayToLight(s.wsPosition);
  const Instance place = instanceAt(instance);
  const Triangle t = triangleAt(triangle);
  vec3 corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = cornerFrom(s, place, t.vertices[i]);
  vec3 areas;  // across from each corner
  for (int i = 0; i < 3; ++i) areas[i] = areaSeen(toLight, corners[(i + 1) % 3], corners[(i + 2) % 3]);
  return isHoleAt(t, areas / (areas.x + areas.y + areas.z));
}

#endif
