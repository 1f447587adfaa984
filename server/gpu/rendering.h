// Drawing into images: one scope begins and ends it, with the layout changes around.
#pragma once

#include <functional>
#include <vector>

#include "gpu/resource.h"

namespace sundial {

// Clears the images to zero, draws, and leaves them ready to be read by shaders. All of one size; viewport
// and scissor cover it and culling is off until `draw` says otherwise.
void renderInto(VkCommandBuffer, const std::vector<const GpuImage*>& colours, const GpuImage* depth,
                const std::function<void()>& draw);
// The same onto what they hold already.
void renderOnto(VkCommandBuffer, const std::vector<const GpuImage*>& colours, const GpuImage* depth,
                const std::function<void()>& draw);
// As renderInto(), the first level of one layer of an array; the others stay as they are.
void renderIntoLayer(VkCommandBuffer, const GpuImage& array, std::uint32_t layer,
                     const std::function<void()>& draw);

// Draws without attachments: what fragment shaders write to buffers is all that stays. The area begins at 0,
// 0.
void renderNowhere(VkCommandBuffer, VkExtent2D, const std::function<void()>& draw);

}  // namespace sundial
