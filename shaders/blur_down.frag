#version 460
#extension GL_GOOGLE_include_directive : require
#include "blur.glsl"

void main() { outMoments = blurred(blurredAcross, 0, 1); }
