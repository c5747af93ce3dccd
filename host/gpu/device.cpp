#include "host/gpu/device_state.h"
#include "host/gpu/error.h"
#include "host/gpu/instance.h"

#include <atomic>
#include <cassert>

namespace tegument::gpu {

std::uint64_t detail::nextIdentity() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

template <class Handle>
std::uint64_t identityOf(const Handle& handle) {
    assert(handle.state);
    return handle.state->identity;
}

template std::uint64_t identityOf(const Texture&);
template std::uint64_t identityOf(const Buffer&);
template std::uint64_t identityOf(const Sampler&);
template std::uint64_t identityOf(const Pipeline&);

Device::Device(std::shared_ptr<detail::DeviceState> state) : state_(std::move(state)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

Result<Device> Device::create(const DeviceOptions& options) {
    return detail::guarded("starting the Vulkan device", [&]() -> Result<Device> {
        auto state = detail::makeInstance(options);
        if (!state) return state.error();
        if (const auto chosen = detail::choosePhysicalDevice(**state, options); !chosen) return chosen.error();
        if (const auto made = detail::makeLogicalDevice(**state); !made) return made.error();
        return Device(std::move(*state));
    });
}

const DeviceInfo& Device::info() const {
    return state_->info;
}

std::vector<std::string> Device::validationMessages() const {
    const std::scoped_lock lock(state_->log->mutex);
    return state_->log->messages;
}

std::uint64_t Device::allocatedBytes() const {
    return state_->allocatedBytes;
}

} // namespace tegument::gpu
