#include "command/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "command/failure.h"
#include "sundial/rendering.h"

namespace sundial::command {
namespace {

// The whole text, or false.
template <class T>
bool readNumber(std::string_view text, T& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

}  // namespace

std::vector<double> parseNumbers(std::string_view option, std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ',')) {
    double number = 0;
    if (!readNumber(part, number) || !std::isfinite(number))
      throw refusal(fmt::format("{}: '{}' is no number in '{}'; it wants {} separated by commas", option,
                                part, text, count == 1 ? "one" : fmt::format("{} numbers", count)));
    numbers.push_back(number);
  }
  if (numbers.size() != count)
    throw refusal(fmt::format("{}: '{}' has {} of {} numbers; separate them by commas, without spaces",
                              option, text, numbers.size(), count));
  return numbers;
}

v1::Vec3 parseVec3(std::string_view option, std::string_view text) {
  const auto numbers = parseNumbers(option, text, 3);
  v1::Vec3 vector;
  vector.set_x(numbers[0]);
  vector.set_y(numbers[1]);
  vector.set_z(numbers[2]);
  return vector;
}

Size parseSize(std::string_view option, std::string_view text) {
  const auto x = text.find('x');
  Size size{};
  if (x == std::string_view::npos || !readNumber(text.substr(0, x), size.width) ||
      !readNumber(text.substr(x + 1), size.height) || size.width == 0 || size.height == 0)
    throw refusal(fmt::format(
        "{}: '{}' is no size; write WIDTHxHEIGHT in pixels, at least 1x1, e.g. 1024x768", option, text));
  return size;
}

std::vector<v1::Aov> parseAovs(std::string_view option, std::string_view text) {
  static constexpr v1::Aov kAll[] = {v1::VISIBILITY, v1::REFERENCE, v1::POSITION, v1::NORMAL,
                                     v1::ID,         v1::VIEW,      v1::CLASS};
  std::vector<v1::Aov> aovs{v1::COLOUR};
  if (text.empty()) return aovs;
  std::set<std::string_view> chosen;
  for (const std::string_view part : split(text, ',')) {
    if (part != "all" && std::ranges::find(kAll, part, client::aovName) == std::end(kAll))
      throw refusal(fmt::format(
          "{}: there is no '{}'; there are visibility, reference, position, normal, id, view, class and all",
          option, part));
    chosen.insert(part);
  }
  for (const v1::Aov aov : kAll)
    if (chosen.contains("all") || chosen.contains(client::aovName(aov))) aovs.push_back(aov);
  return aovs;
}

}  // namespace sundial::command
