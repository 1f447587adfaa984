// Base colour and alpha at a point of a triangle. The reference (server/reference/alpha.cpp) does the same.
#ifndef SUNDIAL_MATERIAL_GLSL
#define SUNDIAL_MATERIAL_GLSL
#include "bindings.glsl"

// Where a coordinate outside [0, 1] is read; clamping stops half a texel inside, because the sampler repeats.
float wrapped(float t, uint wrap, float texels) {
  if (wrap == kWrapClamp) return clamp(t, 0.5 / texels, 1 - 0.5 / texels);
  if (wrap == kWrapMirror) {
    const float folded = abs(t - 2 * floor(t * 0.5 + 0.5));
    return clamp(folded, 0.5 / texels, 1 - 0.5 / texels);
  }
  return t;
}

vec3 linearFromSrgb(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// Linear RGB and alpha.
vec4 baseColour(Material material, vec2 uv, vec4 vertexColour) {
  vec4 colour = material.baseColour * vertexColour;
  if (material.texture != kNoTexture) {
    const vec2 texels = vec2(textureSize(textures, 0).xy);
    const vec2 at = vec2(wrapped(uv.x, material.wrapU, texels.x), wrapped(uv.y, material.wrapV, texels.y));
    const vec4 texel = textureLod(textures, vec3(at, material.texture), 0);
    colour *= vec4(linearFromSrgb(texel.rgb), texel.a);
  }
  return colour;
}

bool isHole(Material material, vec2 uv, vec4 vertexColour) {
  return baseColour(material, uv, vertexColour).a < material.alphaCutoff;
}

#endif
