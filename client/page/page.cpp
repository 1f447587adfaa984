#include "page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "image/class_tint.h"
#include "image/encode.h"
#include "image/overlay.h"
#include "image/view_tint.h"
#include "page/base64.h"
#include "page/chart.h"
#include "page/mark.h"
#include "page/page_assets.h"
#include "page/plan_picture.h"
#include "page/plan_table.h"
#include "page/sections.h"
#include "page/units.h"

namespace sundial::page {
namespace {

constexpr int kPageJpegQuality = 88;  // of the shaded pictures inside the page; beside it they are .png

// The label with nothing that a shell or a URL minds; numbered where two methods have one label.
std::string fileName(const std::string& label, std::set<std::string>& taken) {
  std::string name;
  for (const char c : label)
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' ? c : '-';
  std::string unique = name;
  for (int number = 2; !taken.insert(unique).second; ++number) unique = fmt::format("{}-{}", name, number);
  return unique;
}

std::string errorChartOf(const Comparison& comparison) {
  std::vector<ChartPoint> points;
  for (std::size_t i = 0; i < comparison.labels.size(); ++i) {
    const v1::Result& result = comparison.report.results(static_cast<int>(i));
    ChartPoint point{.label = comparison.labels[i],
                     .family = result.method(),
                     .ms = result.frame_ms(),
                     .wrong = wrongShare(result)};
    if (result.frame_quartiles_size() == 2) {
      point.lowerMs = result.frame_quartiles(0);
      point.upperMs = result.frame_quartiles(1);
    }
    points.push_back(point);
  }
  return errorChart(points);
}

std::string layer(std::string_view name, const std::string& uri, std::string_view alternative) {
  return fmt::format("<img class=\"on-{}\" src=\"{}\" alt=\"{}\">", name, uri, alternative);
}

std::string css(image::Rgb colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

// Large pictures matter more than few rows.
std::size_t columnsFor(std::size_t methods) { return methods == 4 ? 2 : std::min<std::size_t>(methods, 3); }

struct Page {
  std::string cards, reference;
};

std::string document(const Comparison& comparison, const Page& page, const std::string& chart) {
  const std::string scene = escaped(comparison.report.scene());
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">"
      "<title>{} · Sundial</title>\n<style>{}</style></head>\n<body>\n",
      scene, kPageStyle);
  html += fmt::format(
      "<header><h1>{}</h1><p>{} held against ray-traced shadows</p></header>\n{}", scene,
      comparison.labels.size() == 1 ? "One method" : fmt::format("{} methods", comparison.labels.size()),
      facts(comparison));
  html += fmt::format(
      "<main data-layer=\"error\">\n<nav aria-label=\"What the pictures show\">"
      "<button data-show=\"colour\">Picture</button><button data-show=\"visibility\">Visibility</button>"
      "<button data-show=\"error\" aria-pressed=\"true\">Errors</button><button "
      "data-show=\"plan\">Plan</button><button data-show=\"views\">Views</button>"
      "<button data-show=\"reference\">Reference</button>"
      "<span class=\"legend\"><span><i style=\"background:{}\"></i>false lit: should be in shadow</span>"
      "<span><i style=\"background:{}\"></i>false shadow: should be lit</span></span></nav>\n"
      "<p class=\"hint\">Keys 1–6 choose. Hold the space bar to flick to the reference. The wheel zooms all "
      "pictures together, dragging moves them, a double click resets. A faint halo of one pixel surrounds "
      "each wrong "
      "pixel, so that single ones can be seen.</p>\n<div class=\"cards\" style=\"--columns:{}\">\n{}</div>\n",
      css(image::kFalseLit), css(image::kFalseShadow), columnsFor(comparison.labels.size()), page.cards);
  html += fmt::format("<img id=\"reference\" hidden alt=\"\" src=\"{}\">\n</main>\n", page.reference);
  if (!comparison.credit.empty())
    html += fmt::format("<p class=\"credit\">{}</p>\n", escaped(comparison.credit));
  html += "<section><h2>Numbers</h2>\n" + numbersTable(comparison) + definitions() + "</section>\n";
  if (const std::string tables = planTables(comparison); !tables.empty())
    html += "<section><h2>Shadow views</h2>\n" + tables + "</section>\n";
  html += "<section><h2>Error against time</h2>\n<div class=\"figure\">" + chart + "</div></section>\n";
  html += "<section><h2>Time of every pass</h2>\n" + passBars(comparison) + "</section>\n";
  return html + fmt::format("<script>{}</script>\n</body></html>\n", kPageScript);
}

}  // namespace

std::vector<image::OutputFile> comparisonFiles(const std::filesystem::path& folder,
                                               const Comparison& comparison, const std::string& reportJson) {
  std::vector<image::OutputFile> files;
  std::set<std::string> taken{"reference", "chart", "report", "index"};
  Page page;
  for (std::size_t i = 0; i < comparison.labels.size(); ++i) {
    const client::MethodRendering& rendering = comparison.rendering.methods[i];
    const client::Image &colour = *rendering.find(v1::COLOUR), &visibility = *rendering.find(v1::VISIBILITY),
                        &reference = *rendering.find(v1::REFERENCE);
    const std::string name = fileName(comparison.labels[i], taken);
    const image::Picture shaded = image::toPicture(colour);
    const std::string visibilityPng = image::encodePng(image::toPicture(visibility));
    const std::string plan = planPicture(rendering, comparison.report.view(), comparison.report.light());
    files.push_back({folder / (name + ".png"), image::encodePng(shaded)});
    files.push_back({folder / (name + "-visibility.png"), visibilityPng});
    files.push_back({folder / (name + "-error.png"),
                     image::encodePng(image::errorOverlay(colour, visibility, reference))});
    files.push_back({folder / (name + "-plan.svg"), plan});
    std::string views = dataUri("image/svg+xml", planNote(rendering.plan.views().empty()
                                                              ? "this method needs no shadow map: no views"
                                                              : "one view answers all that faces the light"));
    if (rendering.plan.views_size() > 1) {
      const image::Picture tint = image::viewTint(colour, *rendering.find(v1::VIEW));
      files.push_back({folder / (name + "-views.png"), image::encodePng(tint)});
      views = dataUri("image/jpeg", image::encodeJpeg(tint, kPageJpegQuality));
    }
    if (const client::Image* classes = rendering.find(v1::CLASS); classes && image::hasClasses(*classes))
      files.push_back(
          {folder / (name + "-classes.png"), image::encodePng(image::classTint(colour, *classes))});
    if (i == 0) {
      files.push_back({folder / "reference.png", image::encodePng(image::toPicture(reference))});
      page.reference = dataUri("image/png", files.back().bytes);
    }

    const v1::Result& result = comparison.report.results(static_cast<int>(i));
    page.cards += fmt::format(
        "<figure><figcaption>{} <strong>{}</strong><span>{} wrong · {} ms</span></figcaption>"
        "<div class=\"frame\"><div class=\"stack\" style=\"aspect-ratio:{}/{}\">",
        inlineMark(i), escaped(comparison.labels[i]), percent(wrongShare(result)),
        milliseconds(result.frame_ms()), colour.width, colour.height);
    page.cards +=
        layer("colour", dataUri("image/jpeg", image::encodeJpeg(shaded, kPageJpegQuality)), "shaded picture");
    page.cards += layer("visibility", dataUri("image/png", visibilityPng), "visibility");
    page.cards +=
        layer("error", dataUri("image/png", image::encodePng(image::errorLayer(visibility, reference))),
              "wrong pixels");
    page.cards += layer("plan", dataUri("image/svg+xml", plan), "plan over light space");
    page.cards += layer("views", views, "which shadow view answered");
    page.cards += "<img class=\"on-reference\" alt=\"reference\"></div></div></figure>\n";
  }
  const std::string chart = errorChartOf(comparison);
  files.push_back({folder / "chart.svg", chart});
  files.push_back({folder / "report.json", reportJson});
  files.push_back({folder / "index.html", document(comparison, page, chart)});
  return files;
}

}  // namespace sundial::page
