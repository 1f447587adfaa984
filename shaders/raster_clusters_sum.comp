#version 460
#extension GL_GOOGLE_include_directive : require
#include "raster_clusters.glsl"

#include "keep_sum.glsl"
