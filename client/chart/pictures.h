// The pictures of a report: each file once, as text that becomes a picture when someone opens its case.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

namespace sundial::chart {

class Pictures {
 public:
  // The id of the element that will hold it; empty, and counted as missing, if the file isn't a readable
  // .png, .jpg, .webp or .svg.
  std::string add(const std::filesystem::path&);

  std::size_t missing() const { return missing_; }

  // One script element a picture, which browsers don't look into: a data URI, or a drawing as it is.
  std::string elements() const;

 private:
  std::vector<std::string> texts_;
  std::unordered_map<std::string, std::size_t> places_;  // of the texts
  std::size_t missing_ = 0;
};

}  // namespace sundial::chart
