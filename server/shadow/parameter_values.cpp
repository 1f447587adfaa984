#include "shadow/parameter_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sundial {

namespace {

using Kind = Parameter::Kind;

// A whole text as a number; nothing if it isn't one.
template <class T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "2048" or "1024x512".
std::optional<std::pair<unsigned, unsigned>> parseSize(std::string_view text) {
  const std::size_t x = text.find('x');
  const auto width = parse<unsigned>(text.substr(0, x));
  const auto height = x == std::string_view::npos ? width : parse<unsigned>(text.substr(x + 1));
  if (!width || !height) return std::nullopt;
  return std::pair(*width, *height);
}

// "4:12:40".
std::optional<std::vector<double>> parseList(std::string_view text) {
  std::vector<double> values;
  for (;;) {
    const std::size_t colon = text.find(':');
    const auto value = parse<double>(text.substr(0, colon));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (colon == std::string_view::npos) return values;
    text.remove_prefix(colon + 1);
  }
}

bool within(const Parameter& p, double value) { return value >= p.min && value <= p.max; }

}  // namespace

std::optional<std::string> whyWrong(const Parameter& p, std::string_view value) {
  const std::string unit = p.unit == "1" ? "" : fmt::format(" {}", p.unit);
  const std::string range = fmt::format("[{}, {}]{}", p.min, p.max, unit);
  const std::string orChoice = p.choices.empty() ? "" : fmt::format(" or {}", fmt::join(p.choices, ", "));
  const bool choice = std::ranges::find(p.choices, value) != p.choices.end();
  switch (p.kind) {
    case Kind::choice:
      if (!choice) return fmt::format("choose one of {}", fmt::join(p.choices, ", "));
      break;
    case Kind::size: {
      const auto size = parseSize(value);
      if (!size || !within(p, size->first) || !within(p, size->second))
        return fmt::format("give a side, or WIDTHxHEIGHT, each in {}", range);
      break;
    }
    case Kind::list: {
      if (choice) break;
      const auto list = parseList(value);
      const bool whole = p.unit == "texels";
      if (!list || !std::ranges::all_of(
                       *list, [&](double v) { return within(p, v) && (!whole || v == std::floor(v)); }))
        return fmt::format("give {}numbers with colons between them, each in {}{}", whole ? "whole " : "",
                           range, orChoice);
      break;
    }
    case Kind::integer: {
      const auto number = parse<int>(value);
      if (!number || !within(p, *number)) return fmt::format("give a whole number in {}", range);
      break;
    }
    case Kind::number: {
      if (choice) break;
      const auto number = parse<double>(value);
      if (!number || !within(p, *number)) return fmt::format("give a number in {}{}", range, orChoice);
      break;
    }
  }
  return std::nullopt;
}

double numberIn(std::string_view text) { return parse<double>(text).value(); }

unsigned countIn(std::string_view text) { return parse<unsigned>(text).value(); }

std::pair<unsigned, unsigned> sizeIn(std::string_view text) { return parseSize(text).value(); }

std::vector<double> listIn(std::string_view text) { return parseList(text).value(); }

std::optional<double> unlessAuto(std::string_view text) {
  return text == kAuto ? std::nullopt : std::optional(numberIn(text));
}

}  // namespace sundial
