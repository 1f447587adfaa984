// What Prometheus is told.
#pragma once

#include <memory>
#include <string>

#include "result.h"
#include "service/call.h"

namespace sundial {

class Server;

class Metrics {
 public:
  // Serves http://ADDRESS/metrics. Errors: failedPrecondition when the address can't be had.
  static Result<std::unique_ptr<Metrics>> serve(const std::string& address);
  virtual ~Metrics() = default;

  virtual void count(const CallRecord&) = 0;  // any thread
  // Whose queue and scenes are shown; null: nobody's. The server must outlive this or be taken back before it
  // ends.
  virtual void watch(const Server*) = 0;
};

}  // namespace sundial
