// Embree's objects with owners: released when they go, and errors as exceptions.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace sundial {

template <auto release>
struct EmbreeRelease {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease<rtcReleaseDevice>>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease<rtcReleaseScene>>;
using EmbreeGeometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, EmbreeRelease<rtcReleaseGeometry>>;

// Throws std::runtime_error if a call on this thread has failed since the last check. A null device: one that
// couldn't be made.
inline void checkEmbree(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(std::string("Embree failed ") + doing + ": error " + std::to_string(error) +
                           (error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

}  // namespace sundial
