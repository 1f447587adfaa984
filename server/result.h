// How failure travels: a Result at every edge that meets data from outside, an exception where the machine
// breaks, an assertion where we do.
#pragma once

#include <expected>
#include <string>
#include <utility>

namespace sundial {

enum class ErrorCode {
  invalidArgument,     // the request can never work: names the field, the value and the range
  notFound,            // what it names is not there: names what is
  failedPrecondition,  // it could work in another state
  resourceExhausted,   // over a limit that is named
  deadlineExceeded,
  cancelled,
  dataLoss,     // input is damaged or cut off
  unavailable,  // try again, here or elsewhere
};

// One line: what failed, why, and what to try.
struct Error {
  ErrorCode code;
  std::string message;
};

template <class T>
using Result = std::expected<T, Error>;

inline std::unexpected<Error> fail(ErrorCode code, std::string message) {
  return std::unexpected(Error{code, std::move(message)});
}
inline std::unexpected<Error> invalid(std::string message) {
  return fail(ErrorCode::invalidArgument, std::move(message));
}

}  // namespace sundial
