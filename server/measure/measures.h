// How wrong a picture of shadows is: the measures of DESIGN section 3 that one view needs.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "shared/frame.h"

namespace sundial {

// All spans have size.x * size.y elements, row 0 at the top.
struct MeasureInput {
  glm::uvec2 size{0};
  std::span<const shared::ViewSample> samples;
  std::span<const float> viewDepth;         // metres along the view's axis; anything where no geometry is
  std::span<const float> visibility;        // S, in [0, 1]
  std::span<const float> reference;         // R, 0 or 1 (or a mean over a footprint)
  std::span<const shared::Answer> answers;  // what answered; empty for methods without a map
  std::uint64_t storeTexels = 0;            // allocated; 0 for methods without a map
  // Omega+: 1 where the sample faces the light (reference.h). Empty: the answers say, and without answers
  // every sample does.
  std::span<const std::uint8_t> facesLight;
};

struct EdgeError {
  double p50 = 0, p95 = 0, max = 0;
};
struct TexelFootprint {
  double p50 = 0, p95 = 0;
};

// Omega: pixels with geometry; Omega+: those of them that face the light. Shares of an empty set are 0, and
// pixel_match of an empty set is 1.
struct Measures {
  double pixelMatch = 1;
  double falseLit = 0, falseShadow = 0;
  double meanAbsError = 0;
  EdgeError edgeErrorPx;  // 0 where no pixel is wrong; the image's diagonal where R never changes
  double interiorError = 0;
  TexelFootprint texelPx;
  double utilisation = 0;
};

Measures measure(const MeasureInput&);

}  // namespace sundial
