// partition=cube: what its faces hold of the scene.
#pragma once

#include <span>

#include "shadow/host_cull.h"
#include "shadow/method.h"
#include "shared/frame.h"

namespace sundial {

// Sets FrameConstants::lsFaceMin and lsFaceMax: of each face the box around what of the clusters' boxes lies
// in its pyramid, as near as a caster that its map, which is wider, can hold. Faces aren't turned. `boxes`
// are relative to the frame's origin. From settled constants (plan_settings.h) of a method with
// partition=cube.
void fitFaces(shared::FrameConstants&, const Method&, std::span<const WorldBox> boxes);

}  // namespace sundial
