#include "page/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "image/picture.h"
#include "page/mark.h"
#include "page/units.h"

namespace sundial::page {
namespace {

std::string vec(const v1::Vec3& v) {
  return fmt::format("{}, {}, {}", significant(v.x()), significant(v.y()), significant(v.z()));
}

std::string lightText(const v1::Light& light) {
  if (light.has_sun()) return "sun along " + vec(light.sun().direction());
  if (light.has_spot())
    return fmt::format("spot at {} towards {}, cone {}°", vec(light.spot().eye()), vec(light.spot().target()),
                       significant(light.spot().cone_degrees()));
  if (light.has_point()) return "point at " + vec(light.point().position());
  return "the scene's default";
}

std::string quartiles(const google::protobuf::RepeatedField<double>& values) {
  return values.size() == 2 ? fmt::format("[{}, {}]", significant(values[0]), significant(values[1])) : "";
}

// Of all methods: in the order of execution (DESIGN section 2), then others as they come.
std::vector<std::string> passNames(const v1::Report& report) {
  std::vector<std::string> names{"gbuffer", "analyze", "plan", "cull", "store", "resolve", "shade"};
  std::set<std::string> used;
  for (const v1::Result& result : report.results())
    for (const v1::Pass& pass : result.passes())
      if (used.insert(pass.name()).second && std::ranges::find(names, pass.name()) == names.end())
        names.push_back(pass.name());
  std::erase_if(names, [&](const std::string& name) { return !used.contains(name); });
  return names;
}

struct Column {
  const char* title;
  const char* unit;
  const char* definition;
  std::function<std::string(const v1::Result&)> text;
};

std::string number(double value, int digits = 2) { return fmt::format("{:.{}f}", value, digits); }

const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"wrong", "", "share of the pixels with geometry where the method and the ray-traced reference differ",
       [](const v1::Result& r) { return percent(wrongShare(r)); }},
      {"false lit", "", "share of the pixels that face the light: lit, but the reference has shadow",
       [](const v1::Result& r) { return percent(r.measures().false_lit()); }},
      {"false shadow", "", "share of the pixels that face the light: in shadow, but the reference is lit",
       [](const v1::Result& r) { return percent(r.measures().false_shadow()); }},
      {"interior", "",
       "share of the pixels that face the light that are wrong and far from every true shadow edge: "
       "acne, leaks, peter-panning",
       [](const v1::Result& r) { return percent(r.measures().interior_error()); }},
      {"edge p95", "px",
       "distance from a wrong pixel to the nearest true shadow edge, in pixels of the picture: 95 % are "
       "nearer",
       [](const v1::Result& r) { return number(r.measures().edge_error_px().p95()); }},
      {"texel p95", "px", "width of a shadow texel in pixels of the picture: 95 % are smaller",
       [](const v1::Result& r) { return number(r.measures().texel_px().p95()); }},
      {"used", "", "texels that a view sample reads, of those allocated",
       [](const v1::Result& r) { return percent(r.measures().utilisation()); }},
      {"store", "", "memory of the shadow map",
       [](const v1::Result& r) { return bytes(r.measures().store_bytes()); }},
      {"total", "", "all memory that the method needs",
       [](const v1::Result& r) { return bytes(r.measures().total_bytes()); }},
      {"frame", "ms", "time of a frame from submission to completion: the median",
       [](const v1::Result& r) { return milliseconds(r.frame_ms()); }},
      {"ratio", "",
       "frame time over the baseline's, timed in turn: the median of the pairs, and their quartiles",
       [](const v1::Result& r) {
         return fmt::format("{} <small>{}</small>", number(r.ratio_to_baseline()),
                            r.ratio_quartiles_size() == 2
                                ? fmt::format("[{:.2f}, {:.2f}]", r.ratio_quartiles(0), r.ratio_quartiles(1))
                                : "");
       }}};
  return all;
}

double passSum(const v1::Result& result) {
  double sum = 0;
  for (const v1::Pass& pass : result.passes()) sum += pass.gpu_ms();
  return sum;
}

}  // namespace

double wrongShare(const v1::Result& result) {
  const double share = 1 - result.measures().pixel_match();
  return std::abs(share) < 1e-12 ? 0 : share;  // 1 - (1 - x) leaves dust
}

std::string facts(const Comparison& comparison) {
  const v1::Report& report = comparison.report;
  const auto fact = [](std::string_view name, const std::string& value) {
    return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, escaped(value));
  };
  std::string html = "<dl class=\"facts\">";
  html += fact("picture",
               report.size_size() == 2 ? fmt::format("{} × {} pixels", report.size(0), report.size(1)) : "");
  html +=
      fact("view", fmt::format("from {} to {}, {}°", vec(report.view().eye()), vec(report.view().target()),
                               significant(report.view().vertical_fov_degrees())));
  html += fact("light", lightText(report.light()));
  html += fact("device", report.device());
  html += fact("driver", report.driver());
  html += fact("baseline", report.baseline());
  return html + "</dl>\n";
}

std::string numbersTable(const Comparison& comparison) {
  std::string html = "<div class=\"wide\"><table><thead><tr><th scope=\"col\">method</th>";
  for (const Column& column : columns())
    html += fmt::format("<th scope=\"col\"><abbr title=\"{}\">{}</abbr>{}</th>", column.definition,
                        column.title, *column.unit ? fmt::format(" <small>{}</small>", column.unit) : "");
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < comparison.labels.size(); ++i) {
    html += fmt::format("<tr><th scope=\"row\">{} {}</th>", inlineMark(i), escaped(comparison.labels[i]));
    for (const Column& column : columns())
      html += fmt::format("<td>{}</td>", column.text(comparison.report.results(static_cast<int>(i))));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string passBars(const Comparison& comparison) {
  double longest = 0;
  for (const v1::Result& result : comparison.report.results()) longest = std::max(longest, passSum(result));
  if (longest == 0) return "<p>No passes were timed.</p>\n";
  const std::vector<std::string> names = passNames(comparison.report);
  const auto texture = [](std::size_t index) {
    return index < image::kOkabeItoCount ? "" : " class=\"hatched\"";
  };
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };

  std::string html = "<p class=\"legend\">";
  for (const std::string& name : names)
    html += fmt::format("<span><i{} style=\"background-color:{}\"></i>{}</span>", texture(place(name)),
                        colourOf(place(name)), escaped(name));
  html += "</p>\n<div class=\"bars\">";
  for (std::size_t i = 0; i < comparison.labels.size(); ++i) {
    const v1::Result& result = comparison.report.results(static_cast<int>(i));
    html += fmt::format("<span class=\"who\">{} {}</span><div class=\"bar\">", inlineMark(i),
                        escaped(comparison.labels[i]));
    for (const v1::Pass& pass : result.passes()) {
      std::string work;
      for (const auto& [name, count] : std::map<std::string, double>(pass.work().begin(), pass.work().end()))
        work += fmt::format("\n{}: {:.0f}", name, count);
      const double share = pass.gpu_ms() / longest;
      html += fmt::format(
          "<b{} style=\"width:{:.3f}%;background-color:{};color:{}\" title=\"{}: {} ms {}{}\">{}</b>",
          texture(place(pass.name())), 100 * share, colourOf(place(pass.name())), inkOn(place(pass.name())),
          escaped(pass.name()), milliseconds(pass.gpu_ms()), quartiles(pass.quartiles()), escaped(work),
          share > 0.06 ? escaped(pass.name()) : std::string());
    }
    html += fmt::format("</div><span class=\"sum\">{} ms</span>\n", milliseconds(passSum(result)));
  }
  html +=
      "</div>\n<details><summary>As numbers: median milliseconds of every pass</summary><div "
      "class=\"wide\"><table>"
      "<thead><tr><th scope=\"col\">method</th>";
  for (const std::string& name : names) html += fmt::format("<th scope=\"col\">{}</th>", escaped(name));
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < comparison.labels.size(); ++i) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(comparison.labels[i]));
    for (const std::string& name : names) {
      const auto& passes = comparison.report.results(static_cast<int>(i)).passes();
      const auto pass = std::ranges::find(passes, name, &v1::Pass::name);
      html += pass == passes.end() ? "<td>–</td>"
                                   : fmt::format("<td>{} <small>{}</small></td>",
                                                 milliseconds(pass->gpu_ms()), quartiles(pass->quartiles()));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></details>\n";
}

std::string definitions() {
  std::string html = "<details><summary>What the numbers mean</summary><dl>";
  for (const Column& column : columns())
    html += fmt::format("<dt>{}{}</dt><dd>{}</dd>", column.title,
                        *column.unit ? fmt::format(" [{}]", column.unit) : "", column.definition);
  return html + "</dl></details>\n";
}

}  // namespace sundial::page
