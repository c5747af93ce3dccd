#pragma once
// A window of the desktop with its keys and mouse.

#include "host/gpu/gpu.h"
#include "tools/view/input.h"

#include <array>
#include <memory>
#include <string>

struct GLFWwindow;

namespace tegument::view {

struct WindowState;

struct PixelSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool operator==(const PixelSize&) const = default;
};

/// One at a time.
class Window {
public:
    /// TG6060 there is no window system, TG6061 the window cannot be made.
    static Result<Window> open(const std::string& title, PixelSize size);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    /// For gpu::Device; used while it is made only.
    [[nodiscard]] gpu::WindowSurface surface() const;
    /// Waits for input at most so long. `overlay`: the mouse belongs to it, not to camera and light. `border`: share of the width where one
    /// stands that the mouse can take. `picture`: shares of the window, left, top, right, bottom; the mouse beside it belongs to the
    /// overlay, too.
    [[nodiscard]] Input wait(double seconds, bool overlay, std::optional<double> border, const std::array<double, 4>& picture);
    /// Whether something has happened since that wait() will tell, other than the cursor's moving.
    [[nodiscard]] bool hears();
    /// In pixels; 0 x 0 while it is minimised.
    [[nodiscard]] PixelSize pixels() const;
    /// The same in the units of the mouse, which some screens have larger than pixels.
    [[nodiscard]] glm::vec2 points() const;
    /// Of what is written: 2 where the screen has twice the usual number of pixels to the inch.
    [[nodiscard]] float scale() const;
    void setTitle(const std::string& title);
    void copy(const std::string& text); // to the clipboard
    [[nodiscard]] GLFWwindow* handle() const;

private:
    explicit Window(std::unique_ptr<WindowState> state);
    std::unique_ptr<WindowState> state_;
};

} // namespace tegument::view
