// A method's mark: a shape and a colour, the same wherever the page speaks of the method. Shapes alone tell
// the first eight apart.
#pragma once

#include <cstddef>
#include <string>

namespace sundial::page {

// SVG elements of the `index`-th mark, centred at x, y (pixels).
std::string markAt(std::size_t index, double x, double y);

// Its shape as SVG path data of 12 pixels around 0, 0. From the ninth mark on, shapes are hollow.
const char* outlineOf(std::size_t index);
bool isFilled(std::size_t index);

// The mark as a small picture of its own, to stand in a line of text.
std::string inlineMark(std::size_t index);

// CSS colour of the mark, and of the index-th of anything else that needs telling apart.
std::string colourOf(std::size_t index);

// Of text on that colour: black or white, whichever contrasts.
std::string inkOn(std::size_t index);

}  // namespace sundial::page
