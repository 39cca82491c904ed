// A device with the validation layer on, for tests: any message fails the test that caused it.
#pragma once

#include <gtest/gtest.h>

#include "shadewright/gpu/device.h"

namespace shadewright::gpu {

class DeviceTest : public testing::Test {
 protected:
  /// One device for the whole program: making one costs more than most tests.
  static const Device& device() {
    static const Device shared(DeviceOptions{"", true});
    return shared;
  }
  void SetUp() override { messages_before_ = device().validation_messages().size(); }
  void TearDown() override {
    const auto messages = device().validation_messages();
    for (size_t i = messages_before_; i < messages.size(); ++i) ADD_FAILURE() << "validation: " << messages[i];
  }

 private:
  size_t messages_before_ = 0;
};

}  // namespace shadewright::gpu
