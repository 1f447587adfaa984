#include "page/plan_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/encode.h"
#include "image/view_colour.h"
#include "page/base64.h"
#include "page/density.h"
#include "page/frustum.h"
#include "page/light_space.h"
#include "page/plan_labels.h"
#include "page/plan_text.h"
#include "page/units.h"

namespace sundial::page {
namespace {

constexpr double kSide = 720, kMargin = 36;  // pixels, of the drawing; its legend is below
constexpr unsigned kMostGridLines = 16;      // across the largest map
constexpr const char* kOpen =
    R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 768" font-family="system-ui,sans-serif"><rect width="720" height="768" fill="#14171b"/>)svg";

std::string css(image::Rgb colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
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

// The world's points that were seen and face the light: elsewhere nobody asks a shadow map.
std::vector<glm::dvec3> samplesOf(const client::MethodRendering& rendering) {
  std::vector<glm::dvec3> samples;
  const client::Image* colour = rendering.find(v1::COLOUR);
  const client::Image* position = rendering.find(v1::POSITION);
  const client::Image* visibility = rendering.find(v1::VISIBILITY);
  const client::Image* view = rendering.find(v1::VIEW);
  if (!colour || !position || !visibility || !view) return samples;
  constexpr std::uint32_t kNone = 0xffffffff;
  const auto xyz = image::numbersOf<float>(*position), lit = image::numbersOf<float>(*visibility);
  const auto views = image::numbersOf<std::uint32_t>(*view);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (colour->bytes[4 * i + 3] == 0) continue;  // no geometry
    // What faces the light and lies in no map counts as lit.
    if (views[i] == kNone && lit[i] == 0) continue;
    samples.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
  }
  return samples;
}

// A line of the world; what of it has no image, behind a spot, is left out. It goes on where it comes to
// another face of a point light.
std::string path(const Frustum::Line& line, const LightSpace& space, const Fit& fit) {
  constexpr int kSteps = 64;
  constexpr double kFar = 1e5;  // pixels
  std::string data;
  bool drawing = false;
  std::size_t plane = 0;
  for (int step = 0; step <= kSteps; ++step) {
    const glm::dvec3 wsPoint = glm::mix(line.first, line.second, step / double{kSteps});
    const auto point = space.project(wsPoint);
    drawing = drawing && space.planeAt(wsPoint) == plane;
    plane = space.planeAt(wsPoint);
    const glm::dvec2 at = point ? fit.at(*point) : glm::dvec2(HUGE_VAL);
    const bool shown = std::abs(at.x) < kFar && std::abs(at.y) < kFar;
    if (shown) data += fmt::format("{}{:.1f},{:.1f}", drawing ? 'L' : 'M', at.x, at.y);
    drawing = shown;
  }
  return data;
}

// The frustum as far as there are samples, cut where partitions end.
std::string drawFrustum(const Frustum& frustum, double depth, const v1::Plan& plan, const LightSpace& space,
                        const Fit& fit) {
  std::string edges, slices;
  for (const auto& line : frustum.edges(depth)) edges += path(line, space, fit);
  for (const auto& line : frustum.slice(depth)) edges += path(line, space, fit);
  for (const v1::PlanView& view : plan.views())
    if (view.depth_end() > view.depth_begin() && view.depth_end() < depth)
      for (const auto& line : frustum.slice(view.depth_end())) slices += path(line, space, fit);
  return fmt::format(
      R"svg(<clipPath id="drawing"><rect width="720" height="720"/></clipPath><g fill="none" stroke="#fff" clip-path="url(#drawing)"><path class="frustum" d="{}" stroke-width="1.2" opacity="0.65"/><path d="{}" stroke-width="1" opacity="0.5" stroke-dasharray="2 3"/></g>)svg",
      edges, slices);
}

struct Outline {
  int view;
  std::vector<glm::dvec2> corners;  // in the order of the map's rows and columns, pixels
};

// Texels from line to line of the grid, the same in all maps so that dense ones look dense.
unsigned gridStep(const v1::Plan& plan) {
  unsigned most = 1, step = 1;
  for (const v1::PlanView& view : plan.views())
    if (view.rect_size() == 4) most = std::max({most, view.rect(2), view.rect(3)});
  while (most / step > kMostGridLines) step *= 2;
  return step;
}

std::string drawView(const v1::PlanView& view, const Outline& outline, unsigned step, bool metres) {
  const auto& at = outline.corners;
  const std::string colour = css(image::viewColour(static_cast<std::size_t>(outline.view)));
  std::string grid;
  const auto lines = [&](unsigned texels, int from, int to, int otherFrom, int otherTo) {
    for (unsigned texel = step; texel < texels; texel += step) {
      const double t = static_cast<double>(texel) / texels;
      const glm::dvec2 a = glm::mix(at[from], at[to], t), b = glm::mix(at[otherFrom], at[otherTo], t);
      grid += fmt::format("M{:.1f},{:.1f}L{:.1f},{:.1f}", a.x, a.y, b.x, b.y);
    }
  };
  if (view.rect_size() == 4 && !view.empty()) {
    lines(view.rect(2), 0, 1, 3, 2);
    lines(view.rect(3), 0, 3, 1, 2);
  }
  std::string title =
      fmt::format("view {}: {} texels of {}", outline.view, mapSize(view), texelSize(view, metres));
  if (const std::string depths = depthRange(view); !depths.empty()) title += ", depths " + depths;
  if (const std::string tile = tilePlace(view); !tile.empty()) title += ", tile in " + tile;
  if (view.sample_count() > 0) title += fmt::format(", {} samples", view.sample_count());
  if (view.empty()) title += ", empty";
  return fmt::format(
      R"svg(<g class="view" fill="none" stroke="{}"><title>{}</title><path d="{}" stroke-width="0.6" opacity="0.4"/><path d="M{:.1f},{:.1f}L{:.1f},{:.1f}L{:.1f},{:.1f}L{:.1f},{:.1f}Z" stroke-width="{}"{}/></g>)svg",
      colour, escaped(title), grid, at[0].x, at[0].y, at[1].x, at[1].y, at[2].x, at[2].y, at[3].x, at[3].y,
      view.empty() ? "1.2" : "2.5", view.empty() ? R"( stroke-dasharray="5 5")" : "");
}

LabelWish wishOf(const v1::PlanView& view, const Outline& outline, bool metres) {
  LabelWish wish{{outline.corners[0], outline.corners[0]}, {mapSize(view)}};
  for (const glm::dvec2 corner : outline.corners) {
    wish.room.least = glm::min(wish.room.least, corner);
    wish.room.most = glm::max(wish.room.most, corner);
  }
  wish.lines.push_back(
      fmt::format("view {} · {}", outline.view, view.empty() ? "empty" : texelSize(view, metres)));
  if (const std::string depths = depthRange(view); !depths.empty()) wish.lines.push_back(depths);
  return wish;
}

// A bar of a round length near a quarter of the drawing.
std::string scaleBar(const Fit& fit, bool metres) {
  const double quarter = kSide / 4 / fit.scale(), decade = std::pow(10, std::floor(std::log10(quarter)));
  const double size = decade * (quarter / decade >= 5 ? 5 : quarter / decade >= 2 ? 2 : 1);
  const double pixels = size * fit.scale();
  return fmt::format(
      R"svg(<path d="M{0:.1f},732h{1:.1f}m0,-6v12m-{1:.1f},0v-12" stroke="#e8eaed" stroke-width="1.5" fill="none"/><text x="{2:.1f}" y="737" font-size="14" fill="#e8eaed">{3}</text>)svg",
      kMargin, pixels, kMargin + pixels + 8, metres ? length(size) : fmt::format("{:g} m at 1 m", size));
}

// What the greys and the grid stand for, and which views have no place.
std::string legend(const v1::Plan& plan, const Density& density, unsigned step) {
  std::string svg = fmt::format(
      R"svg(<linearGradient id="density"><stop stop-color="{}"/><stop offset="1" stop-color="{}"/></linearGradient><g font-size="14" fill="#9aa4af"><text x="540" y="737" text-anchor="end">1</text><rect x="546" y="726" width="90" height="12" fill="url(#density)"/><text x="642" y="737">{}</text><text x="36" y="755">white: the camera's frustum; a line every {} texels</text><text x="684" y="755" text-anchor="end">view samples a cell</text>)svg",
      css(densityGrey(0)), css(densityGrey(1)), std::max(density.most, 1u), step);
  std::string empty;
  for (int i = 0; i < plan.views_size(); ++i)
    if (!hasPlace(plan.views(i))) empty += fmt::format("{}{}", empty.empty() ? "" : ", ", i);
  if (!empty.empty())
    svg += fmt::format(R"svg(<text x="36" y="15">without samples: view {}</text>)svg", empty);
  return svg + "</g>";
}

// Views whose rectangles have no room for words, above the drawing in their colours.
std::string unlabelledViews(const v1::Plan& plan, const std::vector<int>& views, bool metres) {
  constexpr std::size_t kMost = 3;
  if (views.empty()) return "";
  std::string svg = R"svg(<text x="36" y="31" font-size="14" fill="#9aa4af">small:)svg";
  for (std::size_t i = 0; i < std::min(views.size(), kMost); ++i)
    svg += fmt::format(R"svg( <tspan fill="{}">view {}: {} · {}</tspan>{})svg",
                       css(image::viewColour(static_cast<std::size_t>(views[i]))), views[i],
                       mapSize(plan.views(views[i])), texelSize(plan.views(views[i]), metres),
                       i + 1 < views.size() ? "," : "");
  if (views.size() > kMost) svg += fmt::format(" and {} more", views.size() - kMost);
  return svg + "</text>";
}

}  // namespace

std::string planNote(std::string_view text) {
  return fmt::format(
      R"svg({}<text x="360" y="360" text-anchor="middle" font-size="20" fill="#9aa4af">{}</text></svg>)svg",
      kOpen, escaped(text));
}

std::string planPicture(const client::MethodRendering& rendering, const v1::View& view,
                        const v1::Light& light, unsigned cells) {
  const v1::Plan& plan = rendering.plan;
  if (plan.views().empty()) return planNote("this method needs no shadow map: no plan");
  const auto space = LightSpace::of(light, plan);
  if (!space) return planNote(fmt::format("a plan of {} views that no one plane shows", plan.views_size()));

  Fit fit;
  std::vector<Outline> outlines;
  for (int i = 0; i < plan.views_size(); ++i) {
    auto corners = hasPlace(plan.views(i)) ? space->outline(plan.views(i)) : std::nullopt;
    if (!corners) continue;
    for (const glm::dvec2 corner : *corners) fit.include(corner);
    outlines.push_back({i, std::move(*corners)});
  }
  if (outlines.empty()) return planNote("the plan's views have no place in light space");
  const auto wsSamples = samplesOf(rendering);
  const client::Image* colour = rendering.find(v1::COLOUR);
  const Frustum frustum(view, colour ? static_cast<double>(colour->width) / colour->height : 1);
  std::vector<glm::dvec2> samples;
  double depth = 0;
  for (const glm::dvec3 sample : wsSamples) {
    depth = std::max(depth, frustum.depthOf(sample));
    const auto point = space->project(sample);
    if (!point) continue;
    fit.include(*point);
    samples.push_back(*point);
  }

  // From here on in pixels.
  std::ranges::for_each(samples, [&](glm::dvec2& sample) { sample = fit.at(sample); });
  for (Outline& outline : outlines)
    std::ranges::for_each(outline.corners, [&](glm::dvec2& corner) { corner = fit.at(corner); });
  const Density density = densityOf(samples, kSide, cells);
  const unsigned step = gridStep(plan);
  const bool metres = space->metres();
  std::string svg = kOpen;
  svg += fmt::format(R"svg(<image width="{0}" height="{0}" href="{1}"/>)svg", kSide,
                     dataUri("image/png", image::encodePng(density.picture)));
  std::vector<LabelWish> wishes;
  for (const Outline& outline : outlines) {
    const v1::PlanView& shown = plan.views(outline.view);
    svg += drawView(shown, outline, step, metres);
    wishes.push_back(wishOf(shown, outline, metres));
  }
  svg += drawFrustum(frustum, depth, plan, *space, fit);
  const auto labels = placeLabels(wishes);
  std::vector<int> unlabelled;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i])
      svg += labelText(*labels[i], css(image::viewColour(static_cast<std::size_t>(outlines[i].view))));
    else
      unlabelled.push_back(outlines[i].view);
  }
  svg += unlabelledViews(plan, unlabelled, metres);
  return svg + scaleBar(fit, metres) + legend(plan, density, step) + "</svg>\n";
}

}  // namespace sundial::page
