#version 460
#extension GL_GOOGLE_include_directive : require
// Base colour under one light and a sky: enough to see the shadows, and nothing more.
#include "light.glsl"
#include "material.glsl"

layout(constant_id = 0) const bool kPlainColours = false;  // the scene has neither textures nor vertex colours
layout(location = 0) out vec4 outColour;

vec3 srgbFromLinear(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// Barycentric weights of a point in a triangle's plane, by the ratios of areas.
vec3 barycentric(vec3 p, vec3 a, vec3 b, vec3 c) {
  const vec3 n = cross(b - a, c - a);
  const float area2 = dot(n, n);
  const float v = dot(cross(p - a, c - a), n) / area2, w = dot(cross(b - a, p - a), n) / area2;
  return clamp(vec3(1 - v - w, v, w), 0, 1);
}

vec3 albedoOf(ViewSample s) {
  const Triangle triangle = triangleAt(s.triangle);
  const Material material = materials[triangle.material];
  if (kPlainColours) return material.baseColour.rgb;
  const Instance place = instanceAt(s.instance);
  vec3 corners[3];
  Attributes at[3];
  for (int i = 0; i < 3; ++i) {
    corners[i] = placed(place, vertexPosition(triangle.vertices[i]));
    at[i] = vertexAttributes(triangle.vertices[i]);
  }
  const vec3 weights = barycentric(s.wsPosition, corners[0], corners[1], corners[2]);
  const vec2 uv = mat3x2(at[0].uv, at[1].uv, at[2].uv) * weights;
  const vec4 vertexColour =
      mat3x4(unpackUnorm4x8(at[0].colour), unpackUnorm4x8(at[1].colour), unpackUnorm4x8(at[2].colour)) * weights;
  return baseColour(material, uv, vertexColour).rgb;
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const ViewSample s = sampleAt(pixel);
  outColour = vec4(0);
  if (s.instance == kNoInstance) return;

  const float lit = texelFetch(visibility, pixel, 0).r;
  const float cosine = max(dot(s.wsNormal, towardsLight(s.wsPosition)), 0);
  const vec3 sky = mix(vec3(0.16, 0.15, 0.14), vec3(0.26, 0.30, 0.38), 0.5 + 0.5 * s.wsNormal.y);
  outColour = vec4(srgbFromLinear(clamp(albedoOf(s) * (sky + vec3(1.0, 0.95, 0.85) * (lit * cosine)), 0, 1)), 1);
}
