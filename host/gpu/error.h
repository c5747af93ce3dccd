#pragma once
// The door at which Vulkan's exceptions become results.

#include "host/support/result.h"

#include <vulkan/vulkan_raii.hpp>

#include <string_view>
#include <type_traits>

namespace tegument::gpu::detail {

/// A machine error with the VkResult's name: device lost (TG6007), out of memory (TG6008), anything else (TG6006).
[[nodiscard]] Error vulkanError(const vk::SystemError& error, std::string_view doing);

/// Runs `body`, which returns a Result. `doing` completes the sentence "... while ...".
template <class Body>
std::invoke_result_t<Body> guarded(std::string_view doing, Body&& body) {
    try {
        return body();
    } catch (const vk::SystemError& error) {
        return vulkanError(error, doing);
    }
}

/// What the caller asked for cannot be done, on any machine or on this one.
[[nodiscard]] inline Error requestError(int code, std::string text, std::string hint = {}) {
    return inputError(code, {}, std::move(text), std::move(hint));
}

} // namespace tegument::gpu::detail
