// Static charts for papers: SVG files of each scene, view, light and size.
#pragma once

#include <filesystem>
#include <vector>

#include "chart/results.h"
#include "image/file.h"

namespace sundial::chart {

// In `folder`, for each configuration: error-time-NAME.svg, error-memory-NAME.svg, passes-NAME.svg, and along
// a path stability-NAME.svg.
std::vector<image::OutputFile> figures(const std::vector<Case>&, const std::filesystem::path& folder);

}  // namespace sundial::chart
