// What the host adds to a method's parameters so that the device can plan: shared::PlanSettings, and the axes
// of light space that the method wants.
#pragma once

#include <vector>

#include "shadow/method.h"
#include "shared/frame.h"

namespace sundial {

// Fills `settings` and the store's size, and turns light space about the light where the focus asks for it.
// From the constants of view, light and scene (frameConstants()) and where the frame's origin lies in the
// world.
void settle(shared::FrameConstants&, const Method&, const glm::dvec3& origin);

// Light space turned about the light: `axis`, a unit vector in it, becomes its x axis.
glm::mat4 turnedAbout(const glm::mat4& lightFromWorld, const glm::dvec2& axis);
// Turns light space about the light: `axis`, a unit vector in it, becomes its x axis. The scene's bounds
// become the box around what they were.
void turnLightSpace(shared::FrameConstants&, const glm::dvec2& axis);

// How many shadow views the method's plan has at most.
std::uint32_t shadowViewsOf(const Method&);
// Whether a warp weighs how near samples are, which needs the nearest one's depth.
bool asksNearness(const Method&);
// Texels of each view's map.
std::vector<glm::uvec2> mapSizesOf(const Method&);
std::uint64_t texelsOf(const std::vector<glm::uvec2>& mapSizes);
// How many of their maps stand in a row of the store's image.
std::uint32_t mapColumnsOf(const Method&);

}  // namespace sundial
