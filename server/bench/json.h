// A result as one line of JSON, with the names that the contract's messages have (DESIGN section 4). Written
// by hand here, because the core knows no protobuf; a test holds the two against each other.
#pragma once

#include <string>

#include "renderer.h"

namespace sundial::bench {

struct Case {
  std::string scene, baseline;  // as the user wrote them
  DeviceInfo device;
  const RenderJob& job;
};

std::string toJson(const Case&, const MethodResult&);

}  // namespace sundial::bench
