// One Vulkan device for all tests of an executable, under validation that must stay silent.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "device.hpp"
#include "instance.hpp"

namespace ppm::tests {

/// Makes the device when it is first asked for, and destroys it after the last test, so that
/// validation reports what was left behind. PPM_TEST_DEVICE selects the device as --device does.
class DeviceEnvironment : public ::testing::Environment {
 public:
  gpu::Device& device() {
    if (!device_) {
      const char* const selector = std::getenv("PPM_TEST_DEVICE");
      device_ = std::make_unique<gpu::Device>(
          gpu::DeviceOptions{.selector = selector ? selector : "", .validation = true});
    }
    return *device_;
  }

  void TearDown() override {
    const auto before = gpu::all_validation_messages();
    device_.reset();
    EXPECT_EQ(gpu::all_validation_messages(), before) << "objects outlived the device";
  }

 private:
  std::unique_ptr<gpu::Device> device_;
};

inline DeviceEnvironment* const device_environment = [] {
  auto* const environment = new DeviceEnvironment;  // GoogleTest frees it
  ::testing::AddGlobalTestEnvironment(environment);
  return environment;
}();

/// Base of fixtures that use the device; a test in which validation says anything fails.
class DeviceTest : public ::testing::Test {
 protected:
  void SetUp() override { messages_before_ = gpu::all_validation_messages(); }
  void TearDown() override {
    EXPECT_EQ(gpu::all_validation_messages(), messages_before_)
        << "see the validation messages above";
  }

  static gpu::Device& device() { return device_environment->device(); }

 private:
  std::uint64_t messages_before_ = 0;
};

}  // namespace ppm::tests
