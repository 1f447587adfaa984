// The folder that `compare -o` writes: pictures, the report, and a page that shows it all without a network.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/file.h"
#include "sundial/rendering.h"

namespace sundial::page {

struct Comparison {
  const v1::Report& report;
  const client::Rendering& rendering;  // with colour, visibility, reference, position and view
  std::vector<std::string> labels;     // of the methods, as the user wrote them
  std::string credit;                  // of the scene's makers, plain text; may be empty
};

// For each method LABEL.png, LABEL-visibility.png, LABEL-error.png, LABEL-plan.svg and, where its plan has
// more than one view, LABEL-views.png, its label as a file name;
// reference.png, chart.svg, report.json (`reportJson`) and index.html.
std::vector<image::OutputFile> comparisonFiles(const std::filesystem::path& folder, const Comparison&,
                                               const std::string& reportJson);

}  // namespace sundial::page
