// What a benchmark can't go on without.
#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "result.h"

namespace sundial::bench {

// Throws std::runtime_error with the error's message.
template <class T>
T need(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace sundial::bench
