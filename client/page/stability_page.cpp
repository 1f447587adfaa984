#include "page/stability_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/encode.h"
#include "image/flips.h"
#include "page/base64.h"
#include "page/mark.h"
#include "page/page_assets.h"
#include "page/units.h"

namespace sundial::page {
namespace {

constexpr int kJpegQuality = 90;  // of strips inside the page; beside it they are .png
constexpr double kWidth = 860, kHeight = 260, kLeft = 74, kRight = 16, kTop = 16, kBottom = 46;  // pixels

constexpr const char* kStyle =
    "section{margin-top:40px}.strip{overflow-x:auto;margin:6px 0 16px}.strip img{display:block;height:220px;"
    "border-radius:6px}svg text{fill:var(--soft);font:12px system-ui,sans-serif}.good{color:#009e73}"
    ".bad{color:#d55e00}.verdict{font-weight:600}.keys{display:flex;gap:18px;flex-wrap:wrap;font-size:14px}";

std::string fileName(std::string_view text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) || c == '.' ? c : '-';
  return name;
}

std::string css(image::Rgb colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

// Of the pairs of each frame, the share that flipped.
std::vector<double> shares(const v1::StabilityResult& result) {
  std::vector<double> out;
  for (int f = 0; f < result.flips_per_frame_size(); ++f) {
    const double pairs = f < result.pairs_per_frame_size() ? result.pairs_per_frame(f) : 0;
    out.push_back(pairs > 0 ? result.flips_per_frame(f) / pairs : 0);
  }
  return out;
}

// Lines over the frames, told apart by colour and dashes; `top` is the value at the upper edge.
std::string lines(const std::vector<std::vector<double>>& series, double top, const std::string& topLabel,
                  std::string_view title) {
  static constexpr const char* kDashes[] = {"none", "7 4", "2 3", "10 3 2 3"};
  std::size_t frames = 2;
  for (const auto& values : series) frames = std::max(frames, values.size());
  const double right = kWidth - kRight, bottom = kHeight - kBottom;
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
      "<path d=\"M{} {}V{}H{}\" fill=\"none\" stroke=\"currentColor\" stroke-opacity=\".4\"/>"
      "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text><text x=\"{}\" y=\"{}\" "
      "text-anchor=\"end\">0</text>"
      "<text x=\"{}\" y=\"{}\">frame 0</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">frame {}</text>",
      kWidth, kHeight, title, kLeft, kTop, bottom, right, kLeft - 6, kTop + 10, topLabel, kLeft - 6, bottom,
      kLeft, bottom + 20, right, bottom + 20, frames - 1);
  for (std::size_t i = 0; i < series.size(); ++i) {
    std::string points;
    for (std::size_t f = 0; f < series[i].size(); ++f)
      points +=
          fmt::format("{:.1f},{:.1f} ",
                      kLeft + (right - kLeft) * static_cast<double>(f) / static_cast<double>(frames - 1),
                      bottom - (bottom - kTop) * (top > 0 ? series[i][f] / top : 0));
    svg += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\"/>",
        points, colourOf(i), kDashes[i % std::size(kDashes)]);
  }
  return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text></svg>",
                           (kLeft + right) / 2, bottom + 38, title);
}

double largest(const std::vector<std::vector<double>>& series) {
  double most = 0;
  for (const auto& values : series)
    for (const double value : values) most = std::max(most, value);
  return most;
}

std::string table(const StabilityRun& run) {
  std::string rows;
  for (std::size_t i = 0; i < run.labels.size(); ++i) {
    const v1::StabilityResult& result = run.report.results(static_cast<int>(i));
    rows += fmt::format(
        "<tr><th>{} {}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.0f}</td><td>{:.0f}</td>{}</tr>",
        inlineMark(i), escaped(run.labels[i]), percent(result.flip_rate()), percent(result.pop()),
        significant(result.texel_jump()), percent(result.wrong_rate()), result.points(), result.pairs(),
        run.pixels ? fmt::format("<td>{}</td>", percent(result.wrong_pixels())) : "");
  }
  return "<div class=\"wide\"><table><thead><tr><th>method</th><th>flip rate</th><th>pop</th>"
         "<th>texel jump, log2</th><th>wrong</th><th>points</th><th>pairs</th>" +
         std::string(run.pixels ? "<th>wrong pixels</th>" : "") + "</tr></thead><tbody>" + rows +
         "</tbody></table></div>";
}

std::string section(const StabilityRun& run, const std::string& strips) {
  std::string html = fmt::format("<section><h2>{}</h2>", escaped(run.report.case_()));
  if (!run.sentence.empty()) html += fmt::format("<p>{}</p>", escaped(run.sentence));
  if (run.report.has_verdict())
    html += fmt::format("<p class=\"verdict {}\">{}: {}</p>", run.report.verdict().good() ? "good" : "bad",
                        run.report.verdict().good() ? "as it must be" : "not as it must be",
                        escaped(run.report.verdict().why()));
  html += table(run);
  std::vector<std::vector<double>> flips, jumps;
  for (const v1::StabilityResult& result : run.report.results()) {
    flips.push_back(shares(result));
    jumps.emplace_back(result.plan_jumps().begin(), result.plan_jumps().end());
  }
  if (!flips.empty() && flips.front().size() > 1) {
    html += "<div class=\"figure\">" +
            lines(flips, largest(flips), percent(largest(flips)), "share of points that flip in a frame");
    if (largest(jumps) > 0)
      html += lines(jumps, largest(jumps), significant(largest(jumps)),
                    "jump of a texel's size from the frame before, |log2|");
    html += "</div>";
  }
  return html + strips + "</section>\n";
}

}  // namespace

std::vector<image::OutputFile> stabilityFiles(const std::filesystem::path& folder,
                                              const std::vector<StabilityRun>& runs,
                                              const std::string& reportJson) {
  std::vector<image::OutputFile> files;
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\"><title>Stability · Sundial</title>\n"
      "<style>{}{}</style></head>\n<body><header><h1>Stability</h1><p>Fixed points on surfaces, asked in "
      "every "
      "frame: which answers change although the truth doesn't.</p></header>\n"
      "<p class=\"legend\"><span><i style=\"background:{}\"></i>became lit</span>"
      "<span><i style=\"background:{}\"></i>fell into shadow</span></p>\n",
      kPageStyle, kStyle, css(image::kBecameLit), css(image::kBecameDark));
  for (const StabilityRun& run : runs) {
    std::string strips;
    for (std::size_t i = 0; i < run.methods.size(); ++i) {
      const auto& pictures = run.methods[i].pictures;
      if (pictures.empty()) continue;
      const image::Picture strip = image::flipStrip(pictures);
      files.push_back(
          {folder / fmt::format("{}-{}-{}.png", fileName(run.report.case_()), i + 1, fileName(run.labels[i])),
           image::encodePng(strip)});
      std::string frames;
      for (const client::StabilityPicture& picture : pictures)
        frames += fmt::format("{}{} ({})", frames.empty() ? "" : ", ", picture.about.frame(),
                              picture.about.flipped_size());
      strips += fmt::format(
          "<figure><figcaption>{} <strong>{}</strong><span>frames (flips): {}</span></figcaption>"
          "<div class=\"strip\"><img src=\"{}\" alt=\"frames of {} with their flipped "
          "points\"></div></figure>",
          inlineMark(i), escaped(run.labels[i]), frames,
          dataUri("image/jpeg", image::encodeJpeg(strip, kJpegQuality)), escaped(run.labels[i]));
    }
    html += section(run, strips);
  }
  files.push_back({folder / "report.json", reportJson});
  files.push_back({folder / "index.html", html + "</body></html>\n"});
  return files;
}

}  // namespace sundial::page
