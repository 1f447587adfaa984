// What the passes of shadow volumes agree on: which way a triangle faces, and where its volume begins.
//
// A triangle's volume is all that it hides from the light: the prism (in a spot's or a point's light, the pyramid's
// stump) that begins at it and never ends. It is counted whichever side of the triangle is lit, so a point is in as
// many volumes as triangles lie between it and the light, and every polygon soup casts right shadows. Sides that two
// volumes share cancel; what remains are the edges of the silhouette, as often as volumes on both sides differ
// [Aldridge and Woods 2004, "Robust, geometry-independent shadow volumes"].
#ifndef SUNDIAL_VOLUMES_GLSL
#define SUNDIAL_VOLUMES_GLSL
#include "light.glsl"
#include "shared/volumes.h"

layout(set = 0, binding = kBindSilhouette, scalar) buffer SilhouetteBlock {
  SilhouetteDraw draw;
  SilhouetteEdge edges[];
} silhouette;

// Corners of the triangles that a silhouette's edge is drawn as (volume_side.vert).
uint cornersPerEdge() { return lightIsFar() ? 3 : 6; }

// The light in a mesh's own space: a direction towards it (w = 0), or its place (w = 1). The sign of xyz is that of
// the world's: a mirrored mesh turns its triangles around.
vec4 meshLight(Instance place) {
  const mat3 m = transpose(mat3(place.worldFromMesh[0].xyz, place.worldFromMesh[1].xyz, place.worldFromMesh[2].xyz));
  const vec3 origin = vec3(place.worldFromMesh[0].w, place.worldFromMesh[1].w, place.worldFromMesh[2].w);
  // The adjoint is the inverse times the determinant.
  const mat3 adjoint = transpose(mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])));
  precise vec4 light;
  if (lightIsFar())
    light = vec4(adjoint * -frame.wsLightDirection, 0);
  else
    light = vec4(adjoint * (frame.wsLightPosition - origin), determinant(m));
  return light;
}

// 1 where the light is on the side from which the triangle's corners run counter-clockwise, -1 where it isn't: one
// computation for all who ask, because an edge's volumes cancel only if both of its sides agree.
int facing(uint triangle, vec4 light) {
  const vec4 plane = texelFetch(planeTexels, int(triangle));
  precise float side = plane.x * light.x + plane.y * light.y + plane.z * light.z + plane.w * light.w;
  return side > 0 ? 1 : -1;
}

// A triangle hides nothing that is nearer to it than the reference looks: volumes begin that much farther away.
vec3 volumeStart(vec3 ws) {
  return ws - frame.biasWorld * towardsLight(ws);
}

// Where the light's ray through a point ends.
vec4 volumeEnd(vec3 ws) { return vec4(-wayToLight(ws), 0); }

// What a fragment of a volume's surface needs to know.
struct Face {
  vec3 normal;      // of its plane
  vec3 corner;      // on it
  float eye;        // on which side of it the camera is
  float enters;     // how many volumes a ray enters that meets its front
  uvec2 owner;      // instance and triangle of a cap; kNoInstance for sides
  uint atInfinity;  // 1: behind all samples
};

#endif
