// What a client is told of a device.
#pragma once

#include <string>

namespace sundial {

struct DeviceInfo {
  std::string name;    // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;  // "llvmpipe, Mesa 22.3.6 (LLVM 15.0.6)"
};

}  // namespace sundial
