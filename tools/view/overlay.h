#pragma once
// Text and controls beside the picture: Dear ImGui, drawn by the canvas, its letters as large as the screen asks for.

#include "tools/view/canvas.h"
#include "tools/view/window.h"

#include <functional>
#include <memory>

namespace tegument::view {

/// One at a time, as Dear ImGui has it. To be destroyed before the window is.
class Overlay {
public:
    /// Without a window there is no input, and the display has the target's size.
    static Result<Overlay> create(gpu::Device& device, const Window* window);
    Overlay(Overlay&&) noexcept;
    Overlay& operator=(Overlay&&) noexcept;
    ~Overlay();

    /// Height of a letter's box, in the window's points.
    [[nodiscard]] float em() const;
    /// The mouse is over something that takes it.
    [[nodiscard]] bool wantsMouse() const;
    /// A field of it takes what is typed, or a dialog is open.
    [[nodiscard]] bool wantsKeys() const;
    /// Keys wait for its next frame.
    [[nodiscard]] bool hasKeys() const;
    /// Runs `content`, which calls Dear ImGui, and draws what it laid out over `target`.
    [[nodiscard]] Result<void> draw(Canvas& canvas, gpu::Texture& target, const std::function<void()>& content);

private:
    [[nodiscard]] Result<void> fitFont();
    struct State;
    explicit Overlay(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tegument::view
