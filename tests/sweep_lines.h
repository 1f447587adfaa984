// A sweep's results as tests compare them: without times, in no order.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "process.h"

namespace sundial::test {

// By case, each once; the fields that a clock decides are left out.
inline std::map<std::string, std::string> withoutTimes(const std::string& path) {
  std::map<std::string, std::string> lines;
  std::istringstream file(contents(path));
  for (std::string text; std::getline(file, text);) {
    nlohmann::json line = nlohmann::json::parse(text);
    for (const char* time :
         {"frame_ms", "frame_quartiles", "ratio_to_baseline", "ratio_quartiles", "repetitions"})
      line.erase(time);
    for (nlohmann::json& pass : line["passes"])
      for (const char* time : {"gpu_ms", "quartiles"}) pass.erase(time);
    EXPECT_TRUE(lines.emplace(line["case"], line.dump()).second) << "twice: " << text;
  }
  return lines;
}

}  // namespace sundial::test
