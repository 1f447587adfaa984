// Where the words of a plan's rectangles go: inside of their own, and none over another.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sundial::page {

// Upright, in pixels; y runs down.
struct Box {
  glm::dvec2 least{0}, most{0};
  glm::dvec2 size() const { return most - least; }
};

struct LabelWish {
  Box room;                        // the label's rectangle
  std::vector<std::string> lines;  // at least one; the first is the largest and the last to be dropped
};

struct Label {
  Box box;                         // that no other label's overlaps
  double fontSize;                 // of the first line, pixels
  std::vector<std::string> lines;  // those that fit
};
inline constexpr double kSmallerFont = 0.62;  // of the other lines, of the first's

// One for each wish; nothing where not even the first line fits. Large type goes before many lines only down
// to what can be read. Places that no smaller rectangle claims are preferred.
std::vector<std::optional<Label>> placeLabels(const std::vector<LabelWish>&);

// SVG of a label on a dim ground, the first line in that colour.
std::string labelText(const Label&, const std::string& colour);

}  // namespace sundial::page
