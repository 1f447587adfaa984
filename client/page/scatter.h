// A chart of two logarithmic axes as SVG, with a band for zeros, whiskers, and a front.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sundial::page {

struct ScatterPoint {
  std::string label, tip;         // beside the mark; when the pointer rests on it
  std::string family;             // points of one family are joined in order of x
  std::size_t mark = 0;           // page/mark.h
  double x = 0, y = 0;            // at least 0
  double lowerX = 0, upperX = 0;  // quartiles; no whisker where lowerX is 0
};

struct ScatterChart {
  std::string title, xTitle, yTitle;
  std::vector<ScatterPoint> points;  // at least one
  std::vector<std::size_t> front;    // of the points, in order of x
};

// An SVG element that takes its colours from the reader's light or dark scheme; also a file by itself.
std::string scatterSvg(const ScatterChart&);

// The same in plain black on white, without what only browsers know.
std::string forPaper(std::string svg);

}  // namespace sundial::page
