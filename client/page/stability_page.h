// The folder that `stability -o` writes: a strip of frames for each method, the report, and a page of it all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/file.h"
#include "sundial/stability.h"

namespace sundial::page {

struct StabilityRun {
  const v1::StabilityReport::Case& report;
  std::vector<client::MethodStability> methods;
  std::vector<std::string> labels;  // of the methods, as the user wrote them
  std::string sentence;             // of a named case, or ""
  bool pixels = false;              // whether wrong_pixels was asked for
};

// CASE-METHOD.png for each, report.json (`reportJson`) and index.html, which opens without a network.
std::vector<image::OutputFile> stabilityFiles(const std::filesystem::path& folder,
                                              const std::vector<StabilityRun>&,
                                              const std::string& reportJson);

}  // namespace sundial::page
