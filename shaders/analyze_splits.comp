#version 460
#extension GL_GOOGLE_include_directive : require
// Where the camera's depth is cut: splits[i] to splits[i + 1] is partition i.
//   manual       by hand
//   uniform, logarithmic, practical   [Zhang et al. 2006]: c = lambda n (f/n)^(i/m) + (1 - lambda) (n + (f - n) i/m)
//   adaptive     logarithmic, a cut in a gap of the histogram moves to the gap's end, and what remains is cut anew
//   kmeans       weighted k-means over the histogram [Lloyd 1982]
// The last two and the range of the samples: [Lauritzen et al. 2011, section 3.1 and 3.2].
// Departures: k-means works on the logarithm of depth, where equal distances are equal changes of resolution, and starts
// from the logarithmic splits; the paper names neither.
#include "depth_bins.glsl"
#include "ordered.glsl"
#include "shared/choices.h"

layout(local_size_x = 1) in;

layout(constant_id = 0) const uint kScheme = kCutLog;
layout(constant_id = 1) const bool kFromSamples = false;  // the range is theirs; otherwise the host's
layout(constant_id = 2) const bool kSnapped = false;      // the range is rounded outwards to powers of two

float practical(float near, float far, float share, float lambda) {
  return lambda * near * pow(far / near, share) + (1 - lambda) * (near + (far - near) * share);
}

void splitAdaptively(float near, float far) {
  const uint parts = frame.settings.partitions;
  float begin = near;
  for (uint i = 1; i < parts; ++i) {
    float cut = practical(begin, far, 1 / float(parts - i + 1), 1);
    uint bin = binOf(cut);
    if (analysis.depthHistogram[bin] == 0) {
      while (bin < kDepthBins && analysis.depthHistogram[bin] == 0) ++bin;
      cut = min(depthOfBin(float(bin)), far);
    }
    analysis.splits[i] = cut;
    begin = cut;
  }
}

// Means in bins; a cluster ends half-way to the next one's mean. They rise, so clusters are runs of bins.
void splitByClusters(float near, float far) {
  const uint kRounds = 16;  // times kDepthBins: well under the 65,535 iterations after which lavapipe stops a shader
  const uint parts = frame.settings.partitions;
  float means[kMaxPartitions], ends[kMaxPartitions];
  for (uint i = 0; i < parts; ++i)
    means[i] = float(binOf(practical(near, far, (float(i) + 0.5) / float(parts), 1))) + 0.5;
  for (uint round_ = 0; round_ < kRounds; ++round_) {
    for (uint i = 0; i < parts; ++i)
      ends[i] = i + 1 < parts ? 0.5 * (means[i] + means[i + 1]) : float(kDepthBins);
    uint bin = 0;
    for (uint i = 0; i < parts; ++i) {
      float sum = 0, samples = 0;
      for (; bin < kDepthBins && float(bin) + 0.5 < ends[i]; ++bin) {
        samples += float(analysis.depthHistogram[bin]);
        sum += float(analysis.depthHistogram[bin]) * (float(bin) + 0.5);
      }
      if (samples > 0) means[i] = sum / samples;  // an empty one stays where it is
    }
  }
  for (uint i = 1; i < parts; ++i)
    analysis.splits[i] = clamp(depthOfBin(0.5 * (means[i - 1] + means[i])), near, far);
}

void main() {
  const uint parts = frame.settings.partitions;
  float near = frame.settings.depthNear, far = frame.settings.depthFar;
  if (kFromSamples && analysis.depthMin != 0xffffffffu) {
    // At least the camera's near plane: the splits' formulas divide by it.
    near = max(floatFromOrdered(analysis.depthMin), frame.nearDistance);
    far = max(floatFromOrdered(analysis.depthMax), near);
    if (kSnapped) {
      near = exp2(floor(log2(near)));
      far = exp2(ceil(log2(far)));
    }
  }
  analysis.splits[0] = near;
  analysis.splits[parts] = far;
  if (kScheme == kCutManual) {
    for (uint i = 1; i <= parts; ++i) analysis.splits[i] = frame.settings.splits[i - 1];
  } else if (kScheme == kCutAdaptive) {
    splitAdaptively(near, far);
  } else if (kScheme == kCutKmeans) {
    splitByClusters(near, far);
  } else {
    for (uint i = 1; i < parts; ++i) {
      const float lambda = kScheme == kCutLog ? 1 : kScheme == kCutUniform ? 0 : frame.settings.lambda;
      analysis.splits[i] = practical(near, far, float(i) / float(parts), lambda);
    }
  }
}
