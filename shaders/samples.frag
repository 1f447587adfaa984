#version 460
#extension GL_GOOGLE_include_directive : require
// Reconstructs the view samples, once for all passes after: position and geometric normal from the G-buffer's ids.
//
// The position is where the pixel's ray meets the triangle's plane: a depth buffer interpolates with an absolute
// error, which for a large triangle is centimetres at a hundred metres. Depth is the fall-back for planes seen edge
// on, where the intersection is ill-conditioned.
#include "bindings.glsl"

layout(location = 0) out uvec4 outPosition;
layout(location = 1) out uvec4 outNormal;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  ViewSample s;
  s.instance = kNoInstance;
  s.triangle = 0;
  s.wsPosition = vec3(0);
  s.wsNormal = vec3(0);
  const float depth = texelFetch(gbufferDepth, pixel, 0).r;
  if (depth > 0) {
    const uvec2 id = texelFetch(gbufferIds, pixel, 0).xy;
    s.instance = drawAt(id.x).instance;
    s.triangle = id.y;

    // Two edges and a corner, in the world.
    const Instance place = instanceAt(s.instance);
    const Triangle triangle = triangleAt(id.y);
    const vec3 a = vertexPosition(triangle.vertices[0]);
    const vec3 ab = vertexPosition(triangle.vertices[1]) - a, ac = vertexPosition(triangle.vertices[2]) - a;
    const vec4 row0 = place.worldFromMesh[0], row1 = place.worldFromMesh[1], row2 = place.worldFromMesh[2];
    const vec3 wsA = placed(place, a);
    const vec3 wsAb = vec3(dot(row0.xyz, ab), dot(row1.xyz, ab), dot(row2.xyz, ab));
    const vec3 wsAc = vec3(dot(row0.xyz, ac), dot(row1.xyz, ac), dot(row2.xyz, ac));
    const vec3 crossed = cross(normalize(wsAb), normalize(wsAc));
    const float area = length(crossed);

    const vec3 ray = frame.wsRayTopLeft + gl_FragCoord.x * frame.wsRayPerPixelX +
                     gl_FragCoord.y * frame.wsRayPerPixelY;
    vec3 normal = area > 0 ? crossed / area : -normalize(ray);
    if (dot(normal, ray) > 0) normal = -normal;

    const float depthByBuffer = frame.nearDistance / depth;
    const float depthByPlane = dot(normal, wsA - frame.wsEye) / dot(normal, ray);
    const bool agree = abs(depthByPlane - depthByBuffer) <= 1e-2 * depthByBuffer;
    s.wsPosition = frame.wsEye + (agree ? depthByPlane : depthByBuffer) * ray;
    s.wsNormal = normal;
  }
  outPosition = uvec4(floatBitsToUint(s.wsPosition), s.instance);
  outNormal = uvec4(floatBitsToUint(s.wsNormal), s.triangle);
}
