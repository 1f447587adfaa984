#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=hard: the texel that the sample falls into [Williams 1978].
#include "resolve.glsl"
#include "stored_depth.glsl"

float lookup(uint view, Receiver r) { return litBy(view, r, texelIn(view, r.texel)); }
