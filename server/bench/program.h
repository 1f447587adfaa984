// What the programs of this folder share: how they begin and end, and what they can't go on without.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "result.h"

namespace sundial::bench {

// Arguments that a program doesn't take; says what it takes.
struct WrongArguments : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Arguments = std::vector<std::string>;

// A program's main: its status is what `run` returns, 2 for WrongArguments and 1 for anything else that it
// throws, with a line on standard error.
int runProgram(std::string_view name, int argc, char** argv, int (*run)(const Arguments&));

// Nothing for anything but digits, or too many of them.
std::optional<unsigned> countOf(std::string_view digits);

// Throws std::runtime_error with the error's message.
template <class T>
T need(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

double median(std::vector<double>);  // of an even number the upper one; 0 of none

}  // namespace sundial::bench
