// focus=calipers: the smallest frustum of the light that holds what the camera could see lit of the scene,
// found on the host, without looking at samples [NOTW, section 3.2]. Beyond the paper, which fits the
// clusters in view: triangles stand for the clusters at the outline, and those that can't be lit are left
// out.
#pragma once

#include "shadow/placed_clusters.h"
#include "shared/frame.h"

namespace sundial {

// Turns light space about the light, and sets what of it the map covers (PlanSettings::lsFitMin, lsFitMax):
// the rectangle around litOutline() whose texels are smallest (smallestRectangle()); in depth from the
// nearest box above that rectangle to the farthest point of what could be seen. From settled constants
// (plan_settings.h).
void fitMinimalFrustum(shared::FrameConstants&, const PlacedClusters&);

// The same for each face of a cube about the light: turns it, and makes of what it holds of the scene
// (fitFaces()) what the camera could see of that.
void fitMinimalFaces(shared::FrameConstants&, const PlacedClusters&);

}  // namespace sundial
