#include "page/mark.h"

#include <fmt/format.h>

#include "image/picture.h"

namespace sundial::page {
namespace {

// Outlines of 12 pixels around 0, 0.
constexpr const char* kShapes[] = {
    "M6,0A6,6 0 1 1 -6,0A6,6 0 1 1 6,0Z",                                              // circle
    "M-5.3,-5.3H5.3V5.3H-5.3Z",                                                        // square
    "M0,-6.8L6.4,5H-6.4Z",                                                             // triangle
    "M0,-7.2L7.2,0L0,7.2L-7.2,0Z",                                                     // diamond
    "M-2,-6.5H2V-2H6.5V2H2V6.5H-2V2H-6.5V-2H-2Z",                                      // plus
    "M0,6.8L6.4,-5H-6.4Z",                                                             // triangle, point down
    "M0,-7.4L1.9,-2.4L7.1,-2.3L3,1L4.4,6.1L0,3.1L-4.4,6.1L-3,1L-7.1,-2.3L-1.9,-2.4Z",  // star
    "M-6.8,0L-3.4,-5.9H3.4L6.8,0L3.4,5.9H-3.4Z",                                       // hexagon
};

}  // namespace

std::string colourOf(std::size_t index) {
  const image::Rgb colour = image::kOkabeIto[index % image::kOkabeItoCount];
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

std::string inkOn(std::size_t index) {
  const image::Rgb colour = image::kOkabeIto[index % image::kOkabeItoCount];
  return 54 * colour.r + 183 * colour.g + 19 * colour.b < 256 * 115 ? "#fff" : "#14171b";  // Rec. 709
}

const char* outlineOf(std::size_t index) { return kShapes[index % std::size(kShapes)]; }

bool isFilled(std::size_t index) { return index / std::size(kShapes) % 2 == 0; }

std::string markAt(std::size_t index, double x, double y) {
  const std::string colour = colourOf(index);
  return fmt::format(
      R"svg(<path d="{}" transform="translate({:.1f},{:.1f})" fill="{}" stroke="{}" stroke-width="1.5"/>)svg",
      outlineOf(index), x, y, isFilled(index) ? colour : "none",
      isFilled(index) ? "var(--back,#fff)" : colour);
}

std::string inlineMark(std::size_t index) {
  return R"svg(<svg class="mark" width="18" height="18" viewBox="0 0 18 18" aria-hidden="true">)svg" +
         markAt(index, 9, 9) + "</svg>";
}

}  // namespace sundial::page
