#include "bench/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace sundial::bench {

int runProgram(std::string_view name, int argc, char** argv, int (*run)(const Arguments&)) {
  const auto complain = [&](const std::exception& error, int status) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return status;
  };
  try {
    return run(Arguments(argv + std::min(argc, 1), argv + argc));
  } catch (const WrongArguments& wrong) {
    return complain(wrong, 2);
  } catch (const std::exception& error) {
    return complain(error, 1);
  }
}

std::optional<unsigned> countOf(std::string_view digits) {
  unsigned count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return count;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace sundial::bench
