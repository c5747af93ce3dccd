#pragma once
// For tests of whatever runs on a device: one device for all tests of a program, under the validation layers.

#include "host/gpu/gpu.h"

#include <gtest/gtest.h>

#include <string>

namespace tegument::test {

/// Null where there is no device; `reason` then says why.
inline gpu::Device* device(std::string& reason) {
    static Result<gpu::Device> made = gpu::Device::create({.validation = true});
    if (made) return &*made;
    reason = format(made.error());
    return nullptr;
}

/// Skips without a device; ends without a message of the validation layers.
class WithDevice : public testing::Test {
protected:
    void SetUp() override {
        std::string reason;
        device_ = device(reason);
        if (!device_) GTEST_SKIP() << reason;
        before_ = device_->validationMessages().size();
    }

    void TearDown() override {
        if (!device_) return;
        const auto messages = device_->validationMessages();
        for (std::size_t i = before_; i < messages.size(); ++i)
            ADD_FAILURE() << messages[i];
    }

    gpu::Device* device_ = nullptr;

private:
    std::size_t before_ = 0;
};

} // namespace tegument::test
