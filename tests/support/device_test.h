// A test on a device of its own, validated: the layer must stay silent. `Base` is ::testing::Test or one with
// a parameter.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "gpu/device.h"

namespace sundial::test {

template <class Base = ::testing::Test>
class DeviceTest : public Base {
 protected:
  static Device& device() {
    static const std::unique_ptr<Device> instance = [] {
      auto made = Device::create("", true);
      if (!made) throw std::runtime_error(made.error().message);
      return std::move(*made);
    }();
    return *instance;
  }
  void TearDown() override { EXPECT_EQ(device().validationMessages(), 0u); }
};

}  // namespace sundial::test
