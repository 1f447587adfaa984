#include "chart/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "page/base64.h"

namespace sundial::chart {
namespace {

std::string_view typeOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".png") return "image/png";
  if (extension == ".jpg" || extension == ".jpeg") return "image/jpeg";
  if (extension == ".webp") return "image/webp";
  if (extension == ".svg") return "image/svg+xml";
  return "";
}

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string Pictures::add(const std::filesystem::path& file) {
  const std::string_view type = typeOf(file);
  const std::string bytes = type.empty() ? "" : bytesOf(file);
  if (bytes.empty()) {
    ++missing_;
    return "";
  }
  // A drawing stays as it is, which is shorter, unless it would end the element that holds it.
  const bool plain = type == "image/svg+xml" && !bytes.contains("<!--") && !bytes.contains("script");
  const auto [place, isNew] = places_.try_emplace(plain ? bytes : page::dataUri(type, bytes), texts_.size());
  if (isNew) texts_.push_back(place->first);
  return fmt::format("image-{}", place->second);
}

std::string Pictures::elements() const {
  std::string html;
  for (std::size_t i = 0; i < texts_.size(); ++i)
    html += fmt::format("<script type=\"text/plain\" id=\"image-{}\">{}</script>\n", i, texts_[i]);
  return html;
}

}  // namespace sundial::chart
