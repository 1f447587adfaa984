#include "page/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sundial::page {

std::string significant(double number) {
  if (number == 0 || !std::isfinite(number)) return fmt::format("{}", number);
  const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(number)))), 0, 6);
  return std::abs(number) < 1e-5 ? fmt::format("{:.2g}", number) : fmt::format("{:.{}f}", number, digits);
}

std::string percent(double share) { return significant(100 * share) + " %"; }

std::string milliseconds(double ms) { return significant(ms); }

std::string bytes(double count) {
  static constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB"};
  std::size_t unit = 0;
  while (count >= 1024 && unit + 1 < std::size(kUnits)) {
    count /= 1024;
    ++unit;
  }
  return fmt::format("{} {}", unit == 0 ? fmt::format("{:.0f}", count) : significant(count), kUnits[unit]);
}

std::string length(double metres) {
  if (metres >= 1000) return significant(metres / 1000) + " km";
  if (metres >= 1) return significant(metres) + " m";
  if (metres >= 0.1) return significant(100 * metres) + " cm";
  return significant(1000 * metres) + " mm";
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace sundial::page
