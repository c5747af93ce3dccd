#pragma once
// Pictures on a window: the swapchain of a device that was made for one.

#include "host/gpu/gpu.h"

namespace tegument::gpu {

namespace detail {
struct PresenterState;
}

/// Owns the window's swapchain and makes it anew when the window changes. To be destroyed before the window is.
class Presenter {
public:
    /// Of a device that was made with DeviceOptions::window. TG6062 the window takes no picture that this library can give.
    static Result<Presenter> create(Device& device);
    Presenter(Presenter&&) noexcept;
    Presenter& operator=(Presenter&&) noexcept;
    ~Presenter();

    /// Scales the RGBA8 texture, whose bytes are what the display is to get, to the window's `width` x `height` pixels and waits until the
    /// display can take it. False: nothing is shown, because the window has no area now or changed meanwhile; ask its size and try again.
    Result<bool> show(Texture& texture, std::uint32_t width, std::uint32_t height);

private:
    explicit Presenter(std::unique_ptr<detail::PresenterState> state);
    std::unique_ptr<detail::PresenterState> state_;
};

} // namespace tegument::gpu
