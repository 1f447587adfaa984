// How a command ends badly: an exit status and one line.
#pragma once

#include <stdexcept>
#include <string>

#include "sundial/error.h"

namespace sundial::command {

class Failure : public std::runtime_error {
 public:
  Failure(int status, const std::string& line) : std::runtime_error(line), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

// What the command refuses by itself, before it asks a server.
inline Failure refusal(const std::string& line) { return {2, line}; }

// What a server, or the machine, couldn't do.
inline Failure failure(const std::string& line) { return {1, line}; }

template <class T>
T orRefuse(client::Expected<T> value) {
  if (!value) throw refusal(value.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*value);
}

}  // namespace sundial::command
