#include "page/plan_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/view_colour.h"
#include "page/mark.h"
#include "page/plan_text.h"
#include "page/units.h"

namespace sundial::page {
namespace {

std::string orDash(const std::string& text) { return text.empty() ? "–" : text; }

std::string swatch(std::size_t view) {
  const image::Rgb colour = image::viewColour(view);
  return fmt::format("<i class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></i>", colour.r, colour.g,
                     colour.b);
}

// Columns that say nothing of any view are left out.
std::string planTable(const v1::Plan& plan, bool metres) {
  const auto any = [&](auto has) { return std::ranges::any_of(plan.views(), has); };
  const bool depths = any([](const auto& view) { return !depthRange(view).empty(); });
  const bool tiles = any([](const auto& view) { return view.tile_size() == 2; });
  const bool samples = any([](const auto& view) { return view.sample_count() > 0; });
  const bool importance = any([](const auto& view) { return view.importance() > 0; });
  std::string html =
      "<div class=\"wide\"><table><thead><tr><th scope=\"col\">view</th><th scope=\"col\">texels</th>"
      "<th scope=\"col\">of a texel</th>";
  const auto heading = [&](bool shown, std::string_view text) {
    if (shown) html += fmt::format("<th scope=\"col\">{}</th>", text);
  };
  heading(depths, "the camera's depth");
  heading(tiles, "tile");
  heading(samples, "samples");
  heading(importance, "importance");
  heading(true, "along the light <small>m</small>");
  html += "</tr></thead><tbody>\n";
  for (int i = 0; i < plan.views_size(); ++i) {
    const v1::PlanView& view = plan.views(i);
    const auto cell = [&](bool shown, const std::string& text) {
      if (shown) html += fmt::format("<td>{}</td>", orDash(text));
    };
    const bool placed = hasPlace(view);
    html += fmt::format("<tr><th scope=\"row\">{}{}{}</th>", swatch(static_cast<std::size_t>(i)), i,
                        view.empty() ? " <small>empty</small>" : "");
    cell(true, mapSize(view));
    cell(true, placed ? texelSize(view, metres) : "");
    cell(depths, depthRange(view));
    cell(tiles, tilePlace(view));
    cell(samples, fmt::format("{}", view.sample_count()));
    cell(importance, fmt::format("{}", view.importance()));
    cell(true,
         view.empty() ? "" : fmt::format("{} to {}", significant(view.near()), significant(view.far())));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string planTables(const Comparison& comparison) {
  std::string html;
  for (std::size_t i = 0; i < comparison.labels.size(); ++i) {
    const v1::Plan& plan = comparison.rendering.methods[i].plan;
    if (plan.views().empty()) continue;
    html += fmt::format("<details{}><summary>{} {}: {}</summary>\n{}</details>\n",
                        plan.views_size() > 1 && plan.views_size() <= 8 ? " open" : "", inlineMark(i),
                        escaped(comparison.labels[i]),
                        plan.views_size() == 1 ? "one view" : fmt::format("{} views", plan.views_size()),
                        planTable(plan, comparison.report.light().has_sun()));
  }
  return html;
}

}  // namespace sundial::page
