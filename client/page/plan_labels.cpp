#include "page/plan_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "page/units.h"

namespace sundial::page {
namespace {

constexpr double kGap = 7;           // pixels around a label
constexpr double kTouch = 0.01;      // neighbours share a rim, up to rounding
constexpr double kLineHeight = 1.2;  // of the font's size
// Of the font's size: what no usual font's letters exceed on average, bold and regular.
constexpr double kBoldAdvance = 0.7, kAdvance = 0.6;

double letters(const std::string& text) {  // of UTF-8
  return static_cast<double>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

glm::dvec2 extent(const std::vector<std::string>& lines, double fontSize) {
  glm::dvec2 size{kBoldAdvance * fontSize * letters(lines[0]), kLineHeight * fontSize};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    size.x = std::max(size.x, kAdvance * kSmallerFont * fontSize * letters(lines[i]));
    size.y += kLineHeight * kSmallerFont * fontSize;
  }
  return size + 2 * kGap;
}

double overlap(const Box& a, const Box& b) {
  const glm::dvec2 common = glm::min(a.most, b.most) - glm::max(a.least, b.least);
  return common.x > kTouch && common.y > kTouch ? common.x * common.y : 0;
}

double area(const Box& box) { return box.size().x * box.size().y; }

// Where a label may lie in its room: the corners first, then along the sides and inside.
std::vector<glm::dvec2> places() {
  std::vector<glm::dvec2> all{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  constexpr int kSteps = 8;
  for (int y = 0; y <= kSteps; ++y)
    for (int x = 0; x <= kSteps; ++x)
      if (x % kSteps != 0 || y % kSteps != 0) all.push_back(glm::dvec2(x, y) / double{kSteps});
  return all;
}

// The place of that size in the room that no label and least of the smaller rooms overlap.
std::optional<Box> place(const Box& room, glm::dvec2 size, const std::vector<Box>& taken,
                         const std::vector<Box>& smaller) {
  if (size.x > room.size().x || size.y > room.size().y) return std::nullopt;
  std::optional<Box> best;
  double leastClaimed = HUGE_VAL;
  for (const glm::dvec2 at : places()) {
    const glm::dvec2 corner = room.least + at * (room.size() - size);
    const Box box{corner, corner + size};
    if (std::ranges::any_of(taken, [&](const Box& other) { return overlap(box, other) > 0; })) continue;
    double claimed = 0;
    for (const Box& other : smaller) claimed += overlap(box, other);
    if (claimed >= leastClaimed) continue;
    leastClaimed = claimed;
    best = box;
  }
  return best;
}

struct Style {
  std::size_t lines;
  double fontSize;
};

std::vector<Style> styles(std::size_t lines) {
  std::vector<Style> all;
  for (; lines > 1; --lines)
    for (const double size : {26., 23., 20., 18.}) all.push_back({lines, size});
  for (const double size : {26., 20., 16., 13., 10.}) all.push_back({1, size});
  return all;
}

std::optional<Label> placeLabel(const LabelWish& wish, const std::vector<Box>& taken,
                                const std::vector<Box>& smaller) {
  for (const auto& [count, fontSize] : styles(wish.lines.size())) {
    std::vector<std::string> lines(wish.lines.begin(),
                                   wish.lines.begin() + static_cast<std::ptrdiff_t>(count));
    if (const auto box = place(wish.room, extent(lines, fontSize), taken, smaller))
      return Label{*box, fontSize, std::move(lines)};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<Label>> placeLabels(const std::vector<LabelWish>& wishes) {
  // Small rooms have the least choice.
  std::vector<std::size_t> order(wishes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(area(wishes[i].room), i); });
  std::vector<std::optional<Label>> labels(wishes.size());
  std::vector<Box> taken, smaller;
  for (const std::size_t i : order) {
    labels[i] = placeLabel(wishes[i], taken, smaller);
    if (labels[i]) taken.push_back(labels[i]->box);
    smaller.push_back(wishes[i].room);
  }
  return labels;
}

std::string labelText(const Label& label, const std::string& colour) {
  double x = label.box.least.x + kGap, y = label.box.least.y + kGap, size = label.fontSize;
  std::string svg = fmt::format(
      R"svg(<g class="label"><rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="#14171b" opacity="0.6"/>)svg",
      label.box.least.x + 2, label.box.least.y + 2, label.box.size().x - 4, label.box.size().y - 4);
  for (std::size_t i = 0; i < label.lines.size(); ++i) {
    y += kLineHeight * size;
    svg += fmt::format(R"svg(<text x="{:.1f}" y="{:.1f}" font-size="{:.1f}" fill="{}"{}>{}</text>)svg", x,
                       y - 0.25 * size, size, i == 0 ? colour : "#e8eaed",
                       i == 0 ? R"( font-weight="700")" : "", escaped(label.lines[i]));
    if (i == 0) size *= kSmallerFont;
  }
  return svg + "</g>";
}

}  // namespace sundial::page
