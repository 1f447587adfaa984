// partition=cube: what its faces hold of the scene.
#pragma once

#include <span>

#include "shadow/host_cull.h"
#include "shared/frame.h"

namespace sundial {

// Sets FrameConstants::lsFaceMin and lsFaceMax: of each face the box around what of the clusters' boxes lies
// in its pyramid, as near as a caster in a pyramid of twice the width, because maps are wider than their
// faces. Faces aren't turned. `boxes` are relative to the frame's origin.
void fitFaces(shared::FrameConstants&, std::span<const WorldBox> boxes);

}  // namespace sundial
