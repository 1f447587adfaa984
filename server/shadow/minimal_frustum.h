// focus=calipers: the smallest frustum of the light that holds what the camera could see of the scene, found
// on the host, without looking at samples [NOTW, section 3.2].
#pragma once

#include "shadow/placed_clusters.h"
#include "shared/frame.h"

namespace sundial {

// Turns light space about the light, and sets what of it the map covers (PlanSettings::lsFitMin, lsFitMax):
// the smallest rectangle around the hull of all clusters' boxes, as far as they lie in the camera's frustum
// and in the light's; in depth from the nearest box above that rectangle to the farthest point of the hull.
// `boxes` are the clusters', relative to the frame's origin.
void fitMinimalFrustum(shared::FrameConstants&, const PlacedClusters&);

// The same for each face of a cube about the light: turns it, and makes of what it holds of the scene
// (fitFaces()) what the camera could see of that.
void fitMinimalFaces(shared::FrameConstants&, const PlacedClusters&);

}  // namespace sundial
