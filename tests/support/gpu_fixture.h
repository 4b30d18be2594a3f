// One device for a test program, with validation on. A test is skipped where there is no driver, and fails
// when validation has anything to say.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "core/error.h"
#include "gpu/device.h"

namespace nephroid {

class GpuTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const char* choice = std::getenv("NEPHROID_TEST_DEVICE");
    try {
      device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{choice ? choice : "", true});
    } catch (const RuntimeFailure& failure) {
      whyNot_ = failure.what();
    }
  }
  static void TearDownTestSuite() { device_.reset(); }

  void SetUp() override {
    if (!device_) GTEST_SKIP() << "no usable Vulkan device: " << whyNot_;
    device_->clearValidationMessages();
  }
  void TearDown() override {
    if (!device_) return;
    for (const std::string& message : device_->validationMessages()) ADD_FAILURE() << message;
  }

  static gpu::Device& device() { return *device_; }

 private:
  inline static std::unique_ptr<gpu::Device> device_;
  inline static std::string whyNot_;
};

}  // namespace nephroid
