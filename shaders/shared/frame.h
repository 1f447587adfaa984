// What every pass of a frame knows, and what a view sample is.
//
// Conventions: right-handed world, y up, metres. On the GPU world space is relative to the frame's `origin`,
// a point that the host chooses in double precision near the camera, on a coarse grid (so that it rarely
// moves). Matrices are named destinationFromSource; prefixes ws, vs, ls name the space of a vector. Depth is
// reversed, the camera's far plane infinite. Pixel centres at +0.5, image row 0 at the top. The light's
// direction is the one in which light travels.
#ifndef SUNDIAL_SHARED_FRAME_H
#define SUNDIAL_SHARED_FRAME_H
#include "interop.h"
#include "plan.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kLightDirectional = 0u;
SUNDIAL_CONST kLightSpot = 1u;
SUNDIAL_CONST kLightPoint = 2u;

// storage=moments: moments.glsl.
struct MomentSettings {
  vec2 exponents;        // of depth from -1 to 1
  float leastDeviation;  // of depth, metres: less is rounding
  float anisotropy;      // the most taps along a footprint
  float bleedReduction;  // in [0, 1)
  float lsBlur;          // width of the blur in light space after division
};

struct FrameConstants {
  mat4 clipFromWorld;  // the camera
  // Light space before division: directional (x, y, height toward the light, 1), metres;
  // spot (x, y, 1, distance along the axis), so that after division z = 1 / distance; point: the same about
  // the first of a cube's faces (cube.h).
  mat4 lightFromWorld;
  vec3 wsEye;
  float nearDistance;
  vec3 wsRayTopLeft;  // the pixel ray through the image's top left corner, of depth 1 along the view's axis
  uint lightKind;
  vec3 wsRayPerPixelX;    // what one pixel to the right adds to it
  float lightCosCone;     // spot: cosine of the half angle
  vec3 wsRayPerPixelY;    // what one pixel down adds to it
  uint drawCount;         // cluster instances in the scene
  vec3 wsLightDirection;  // unit; spot: the axis; point: along the first of a cube's faces
  float biasTexels;
  vec3 wsLightPosition;  // spot, point
  float biasWorld;       // metres
  uvec2 imageSize;       // pixels
  uvec2 storeSize;       // texels of the store's image; a linear buffer counts as one row
  vec3 lsBoundsMin;      // the scene, light space after division
  uint pcfKernel;        // texels a side, odd
  vec3 lsBoundsMax;
  float sceneDepth;  // the camera's depth of the scene's farthest corner, metres
  // partition=cube: what each face holds of the scene, in the face's light space after division; low above
  // high where there is nothing. And which way the face's x axis is turned about its middle.
  vec3 lsFaceMin[kCubeFaces];
  vec3 lsFaceMax[kCubeFaces];
  vec2 faceTurn[kCubeFaces];
  uvec2 drawBuckets[6];  // first chunk and number of chunks of each bucket (scene.h: kBuckets)
  PlanSettings settings;
  MomentSettings moments;
};

// Cull slot of the camera; shadow view v has slot v + 1.
SUNDIAL_CONST kCameraSlot = 0u;

// A visible point: what the reference traces from and what the method resolves, the same numbers for both.
struct ViewSample {
  vec3 wsPosition;  // relative to the frame's origin
  uint instance;    // kNoInstance: no geometry here
  vec3 wsNormal;    // geometric, unit, facing the camera
  uint triangle;    // of the scene
};

// What answered a view sample, for the measures; written apart from the timed frame.
struct Answer {
  uint view;        // index in the plan, or kNoShadowView
  uint texel;       // of the store: y * storeSize.x + x
  float footprint;  // the texel's extent on the receiver's plane, seen in the image, pixels (longer side)
  uint facesLight;  // 1 where the sample faces the light (and, for a spot, lies in its cone)
};

SUNDIAL_SHARED_END
#endif
