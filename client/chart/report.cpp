#include "chart/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "chart/assets.h"
#include "chart/pass_figure.h"
#include "chart/pictures.h"
#include "page/mark.h"
#include "page/page_assets.h"
#include "page/units.h"

namespace sundial::chart {
namespace {

using nlohmann::ordered_json;
using page::escaped;

ordered_json json(const Spread& spread) { return {spread.median, spread.lower, spread.upper}; }

ordered_json json(const Measures& m) {
  return {{"wrong", m.wrong()},
          {"false_lit", m.falseLit},
          {"false_shadow", m.falseShadow},
          {"mean_abs_error", m.meanAbsError},
          {"interior_error", m.interiorError},
          {"edge_p50", m.edgeP50},
          {"edge_p95", m.edgeP95},
          {"edge_max", m.edgeMax},
          {"texel_p50", m.texelP50},
          {"texel_p95", m.texelP95},
          {"utilisation", m.utilisation},
          {"store_bytes", m.storeBytes},
          {"total_bytes", m.totalBytes},
          {"allocated_bytes", m.allocatedBytes}};
}

ordered_json json(const Stability& s) {
  return {{"flip_rate", s.flipRate},   {"pop", s.pop},       {"texel_jump", s.texelJump},
          {"wrong_rate", s.wrongRate}, {"points", s.points}, {"frames", s.frames}};
}

ordered_json json(const Case& one, Pictures& pictures) {
  ordered_json object{{"id", one.id},           {"scene", one.scene},
                      {"view", one.view},       {"light", one.light},
                      {"size", one.sizeText()}, {"method", one.method},
                      {"label", one.label},     {"parameters", one.parameters},
                      {"device", one.device},   {"baseline", one.baseline}};
  if (one.failed) {
    object["error"] = {{"code", one.failed->code}, {"message", one.failed->message}};
    return object;
  }
  object["ms"] = json(one.frameMs);
  object["ratio"] = json(one.ratio);
  object["m"] = json(one.measures);
  object["plan_views"] = one.planViews;
  object["passes"] = ordered_json::array();
  for (const Pass& pass : one.passes)
    object["passes"].push_back({{"name", pass.name}, {"ms", json(pass.ms)}, {"work", pass.work}});
  if (one.stability) object["stability"] = json(*one.stability);
  object["images"] = ordered_json::object();
  for (const auto& [name, file] : one.images)
    if (const std::string id = pictures.add(file); !id.empty()) object["images"][name] = id;
  return object;
}

// Each value once, in the order in which the cases have them.
template <class Get>
std::vector<std::string> distinct(const std::vector<Case>& cases, Get get) {
  std::vector<std::string> values;
  for (const Case& one : cases)
    if (const std::string& value = std::invoke(get, one);
        !value.empty() && std::ranges::find(values, value) == values.end())
      values.push_back(value);
  return values;
}

ordered_json passes(const std::vector<Case>& cases) {
  std::vector<const Case*> all;
  for (const Case& one : cases) all.push_back(&one);
  ordered_json list = ordered_json::array();
  for (const std::string& name : passOrder(all)) {
    const Paint paint = paintOf(list.size());
    list.push_back(
        {{"name", name}, {"colour", paint.colour}, {"opacity", paint.opacity}, {"ink", paint.ink}});
  }
  return list;
}

ordered_json marks(const std::vector<std::string>& methods) {
  ordered_json marks = ordered_json::object();
  for (std::size_t i = 0; i < methods.size(); ++i)
    marks[methods[i]] = {
        {"outline", page::outlineOf(i)}, {"colour", page::colourOf(i)}, {"filled", page::isFilled(i)}};
  return marks;
}

// JSON that may stand inside a script element.
std::string embedded(const ordered_json& document) {
  std::string text;
  for (const char c : document.dump(-1, ' ', false, ordered_json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

std::string facts(const std::vector<Case>& cases) {
  std::string html = "<dl class=\"facts\">";
  const auto fact = [&](std::string_view name, const std::vector<std::string>& values) {
    if (!values.empty())
      html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name,
                          escaped(fmt::format("{}", fmt::join(values, "; "))));
  };
  fact("device", distinct(cases, &Case::device));
  fact("driver", distinct(cases, &Case::driver));
  fact("baseline, whose time is 1", distinct(cases, &Case::baseline));
  const auto [least, most] = std::ranges::minmax(cases, {}, &Case::repetitions);
  fact("timed frames of each", {least.repetitions == most.repetitions
                                    ? std::to_string(most.repetitions)
                                    : fmt::format("{} to {}", least.repetitions, most.repetitions)});
  return html + "</dl>";
}

std::string definitions() {
  static constexpr std::pair<const char*, const char*> kTerms[] = {
      {"wrong", "share of the pixels with geometry where the method and the ray-traced reference differ"},
      {"false lit, false shadow",
       "shares of the pixels that face the light: lit, but the reference has shadow; and the reverse"},
      {"interior error",
       "share of the pixels that face the light that are wrong and far from every true shadow edge: acne, "
       "leaks, peter-panning"},
      {"mean absolute error", "mean difference of light between method and reference; for filtered lookups"},
      {"edge error", "distance from a wrong pixel to the nearest true shadow edge, in pixels of the picture"},
      {"texel", "width of a shadow texel in pixels of the picture"},
      {"used", "texels that a view sample reads, of those allocated"},
      {"ratio",
       "frame time over the baseline's, timed in turn in one process: ratios travel between machines, "
       "milliseconds don't"},
      {"flip rate",
       "share of points and frames where the shadow changes and the reference's doesn't, while the camera or "
       "the light moves"},
      {"pop", "the largest share of points that flip in one frame"},
      {"texel jump", "the largest |log2| of a shadow texel's size to that of the frame before"},
      {"points wrong",
       "share of the points, over all frames of the path, whose shadow isn't the reference's"}};
  std::string html = "<details><summary>What the numbers mean</summary><dl>";
  for (const auto& [term, meaning] : kTerms) html += fmt::format("<dt>{}</dt><dd>{}</dd>", term, meaning);
  return html + "</dl></details>";
}

// Each {{place}} of the page's body becomes its text.
std::string filled(std::string_view body, const std::map<std::string, std::string>& texts) {
  std::string result(body);
  for (const auto& [name, text] : texts) {
    const std::string place = "{{" + name + "}}";
    result.replace(result.find(place), place.size(), text);
  }
  return result;
}

// Whatever else the page might be made to hold, it fetches nothing. Vega compiles its expressions.
constexpr const char* kPolicy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline' 'unsafe-eval'";

}  // namespace

std::string reportPage(Results& results, const std::vector<std::string>& credits) {
  const std::vector<Case>& cases = results.cases;
  Pictures pictures;
  ordered_json data{{"marks", marks(distinct(cases, &Case::method))},
                    {"passes", passes(cases)},
                    {"baseline", fmt::format("{}", fmt::join(distinct(cases, &Case::baseline), " or "))},
                    {"cases", ordered_json::array()}};
  for (const Case& one : cases) data["cases"].push_back(json(one, pictures));
  if (pictures.missing() > 0)
    results.remarks.push_back(fmt::format(
        "{} of the pictures that the results name can't be read; the page goes without", pictures.missing()));

  const auto scenes = distinct(cases, &Case::scene), methods = distinct(cases, &Case::method);
  std::string creditLines;
  for (const std::string& credit : credits)
    creditLines += fmt::format("<p class=\"credit\">{}</p>\n", escaped(credit));
  const std::string body = filled(
      reportBody(),
      {{"subtitle",
        fmt::format("{} of {} with {}, held against ray-traced shadows",
                    cases.size() == 1 ? "One case" : fmt::format("{} cases", cases.size()),
                    scenes.size() == 1 ? escaped(scenes[0]) : fmt::format("{} scenes", scenes.size()),
                    methods.size() == 1 ? escaped(methods[0]) : fmt::format("{} methods", methods.size()))},
       {"facts", facts(cases)},
       {"definitions", definitions()},
       {"credits", creditLines}});
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">"
      "<meta name=\"viewport\" content=\"width=device-width\">"
      "<title>Accuracy against time · Sundial</title>\n<style>{}{}</style></head>\n<body>\n{}",
      kPolicy, page::kPageStyle, reportStyle(), body);
  html +=
      fmt::format("<details><summary>Licences of what draws the charts</summary><pre>{}</pre></details>\n",
                  escaped(vegaLicences()));
  html += fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", embedded(data));
  html += fmt::format("<script>{}</script>\n<script>\n(() => {{\n'use strict';\n{}}})();\n</script>\n",
                      vegaScript(), reportScript());
  // After the charts, which are drawn before a browser has read these.
  return html + pictures.elements() + "</body></html>\n";
}

}  // namespace sundial::chart
