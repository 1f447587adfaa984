#include "page/plan_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/encode.h"
#include "page/base64.h"
#include "page/light_space.h"
#include "page/mark.h"
#include "page/units.h"

namespace sundial::page {
namespace {

constexpr double kSide = 720, kMargin = 36;  // pixels
constexpr int kMostLabels = 20;
constexpr const char* kOpen =
    R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 720" font-family="system-ui,sans-serif"><rect width="720" height="720" fill="#14171b"/>)svg";

std::string note(std::string_view text) {
  return fmt::format(
      R"svg({}<text x="360" y="360" text-anchor="middle" font-size="20" fill="#9aa4af">{}</text></svg>)svg",
      kOpen, escaped(text));
}

// From light space to the drawing: one scale, centred.
struct Fit {
  glm::dvec2 least{HUGE_VAL}, most{-HUGE_VAL};
  void include(glm::dvec2 point) {
    least = glm::min(least, point);
    most = glm::max(most, point);
  }
  double scale() const {
    return (kSide - 2 * kMargin) / std::max({most.x - least.x, most.y - least.y, 1e-9});
  }
  glm::dvec2 at(glm::dvec2 point) const { return kSide / 2 + (point - 0.5 * (least + most)) * scale(); }
};

std::vector<glm::dvec2> samplesOf(const client::MethodRendering& rendering, const LightSpace& space) {
  std::vector<glm::dvec2> samples;
  const client::Image* colour = rendering.find(v1::COLOUR);
  const client::Image* position = rendering.find(v1::POSITION);
  if (!colour || !position) return samples;
  const auto xyz = image::numbersOf<float>(*position);
  for (std::size_t i = 0; 3 * i + 2 < xyz.size(); ++i) {
    if (colour->bytes[4 * i + 3] == 0) continue;  // no geometry
    if (const auto point = space.project({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}))
      samples.push_back(*point);
  }
  return samples;
}

// Brightness is the logarithm of the number of samples.
image::Picture density(const std::vector<glm::dvec2>& samples, const Fit& fit, unsigned cells) {
  std::vector<unsigned> counts(std::size_t{cells} * cells);
  unsigned most = 1;
  for (const glm::dvec2 sample : samples) {
    const glm::uvec2 cell(glm::clamp(fit.at(sample) / kSide * static_cast<double>(cells), 0.0, cells - 1.0));
    most = std::max(most, ++counts[std::size_t{cell.y} * cells + cell.x]);
  }
  image::Picture picture{cells, cells, 3, {}};
  for (const unsigned count : counts) {
    const double level = count == 0 ? 0 : 0.25 + 0.75 * std::log1p(count) / std::log1p(most);
    const auto channel = [&](double from, double to) {
      return static_cast<std::uint8_t>(std::lround(from + (to - from) * level));
    };
    picture.pixels.insert(picture.pixels.end(),
                          {channel(0x14, 0xee), channel(0x17, 0xf0), channel(0x1b, 0xf2)});
  }
  return picture;
}

// A view's outline, a line every eighth of its texels, and what it is.
std::string drawView(const v1::PlanView& view, int index, const std::vector<glm::dvec2>& corners,
                     const Fit& fit, bool labelled, bool metres) {
  std::vector<glm::dvec2> at;
  for (const glm::dvec2 corner : corners) at.push_back(fit.at(corner));
  const std::string colour = colourOf(static_cast<std::size_t>(index) + 4);  // sky blue first: light on dark
  std::string svg = fmt::format(R"svg(<g fill="none" stroke="{}">)svg", colour);
  std::string grid;
  for (int step = 1; step < 8; ++step) {
    const double t = step / 8.0;
    const glm::dvec2 top = glm::mix(at[0], at[1], t), bottom = glm::mix(at[3], at[2], t);
    const glm::dvec2 left = glm::mix(at[0], at[3], t), right = glm::mix(at[1], at[2], t);
    grid += fmt::format("M{:.1f},{:.1f}L{:.1f},{:.1f}M{:.1f},{:.1f}L{:.1f},{:.1f}", top.x, top.y, bottom.x,
                        bottom.y, left.x, left.y, right.x, right.y);
  }
  svg += fmt::format(R"svg(<path d="{}" stroke-width="0.7" opacity="0.45"/>)svg", grid);
  svg += fmt::format(
      R"svg(<path d="M{:.1f},{:.1f}L{:.1f},{:.1f}L{:.1f},{:.1f}L{:.1f},{:.1f}Z" stroke-width="2.5"{}/></g>)svg",
      at[0].x, at[0].y, at[1].x, at[1].y, at[2].x, at[2].y, at[3].x, at[3].y,
      view.empty() ? R"( stroke-dasharray="5 5")" : "");
  if (!labelled || view.rect_size() != 4) return svg;
  const glm::dvec2 corner = glm::min(glm::min(at[0], at[1]), glm::min(at[2], at[3]));
  svg += fmt::format(
      R"svg(<text x="{:.1f}" y="{:.1f}" font-size="17" font-weight="600" fill="{}" stroke="#14171b" stroke-width="4" paint-order="stroke">{}: {}×{} texels of {}{}</text>)svg",
      corner.x + 8, corner.y + 22, colour, index, view.rect(2), view.rect(3), length(view.texel_size()),
      metres ? "" : " at 1 m");
  return svg;
}

// A bar of a round length near a quarter of the drawing.
std::string scaleBar(const Fit& fit, bool metres) {
  const double quarter = kSide / 4 / fit.scale(), decade = std::pow(10, std::floor(std::log10(quarter)));
  const double size = decade * (quarter / decade >= 5 ? 5 : quarter / decade >= 2 ? 2 : 1);
  const double pixels = size * fit.scale();
  return fmt::format(
      R"svg(<path d="M{0:.1f},696h{1:.1f}m0,-6v12m-{1:.1f},0v-12" stroke="#e8eaed" stroke-width="1.5" fill="none"/><text x="{2:.1f}" y="701" font-size="15" fill="#e8eaed">{3}</text><text x="684" y="701" font-size="15" text-anchor="end" fill="#9aa4af">grid: an eighth of a map's texels</text>)svg",
      kMargin, pixels, kMargin + pixels + 8, metres ? length(size) : fmt::format("{:g} m at 1 m", size));
}

}  // namespace

std::string planPicture(const client::MethodRendering& rendering, const v1::Light& light, unsigned cells) {
  if (rendering.plan.views().empty()) return note("this method needs no shadow map: no plan");
  const auto space = LightSpace::of(light, rendering.plan);
  if (!space)
    return note(fmt::format("a plan of {} views that no one plane shows", rendering.plan.views_size()));

  Fit fit;
  std::vector<std::pair<int, std::vector<glm::dvec2>>> outlines;
  for (int i = 0; i < rendering.plan.views_size(); ++i) {
    auto outline = space->outline(rendering.plan.views(i));
    if (!outline) continue;
    for (const glm::dvec2 corner : *outline) fit.include(corner);
    outlines.emplace_back(i, std::move(*outline));
  }
  const auto samples = samplesOf(rendering, *space);
  for (const glm::dvec2 sample : samples) fit.include(sample);
  if (outlines.empty()) return note("the plan's views have no place in light space");

  std::string svg = kOpen;
  svg += fmt::format(R"svg(<image width="{0}" height="{0}" href="{1}"/>)svg", kSide,
                     dataUri("image/png", image::encodePng(density(samples, fit, cells))));
  for (const auto& [index, outline] : outlines)
    svg += drawView(rendering.plan.views(index), index, outline, fit,
                    static_cast<int>(outlines.size()) <= kMostLabels, space->metres());
  return svg + scaleBar(fit, space->metres()) + "</svg>\n";
}

}  // namespace sundial::page
