#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=rgsm: reconstructable geometry [Dai et al. 2008]: a sample is in shadow if its ray to the light crosses a
// triangle that one of the texels about it holds. What no texel holds casts no shadow.
#include "resolve.glsl"
#include "texel_triangle.glsl"

float lookup(uint view, Receiver r) {
  const ivec2 centre = texelIn(view, r.texel), high = ivec2(plan.views[view].rectSize) - 1;
  const int reach = int(frame.pcfKernel) / 2;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const ivec2 texel = clamp(centre + ivec2(x, y), ivec2(0), high);
      if (hides(heldIn(view, texel), r, r.texel - (vec2(texel) + 0.5))) return 0;
    }
  return 1;
}
