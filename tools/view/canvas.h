#pragma once
// Textured triangles on an 8-bit target: the picture as the window shows it, and the text on top.

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace tegument::view {

/// Position in clip space, colour with straight alpha.
struct CanvasVertex {
    float x = 0;
    float y = 0;
    float u = 0;
    float v = 0;
    std::array<float, 4> color{1, 1, 1, 1};
};

/// How texels become bytes: channel c is texel * scale[c] + offset[c], then what the flags say.
struct Levels {
    std::array<float, 4> scale{1, 1, 1, 1};
    std::array<float, 4> offset{0, 0, 0, 0};
    int channel = 0; // 0 colour, 1 to 4 one channel as grey
    bool toneMap = false;
    bool encode = false; // as sRGB
    int mip = 0;
    bool operator==(const Levels&) const = default;
};

/// Which part of a texture is seen: `zoom` times as large, with the point `at` (shares from the left top) where it was.
struct Closer {
    float zoom = 1;
    std::array<float, 2> at{0.5F, 0.5F};
};

/// Pixels: left, top, right, bottom.
using ClipRectangle = std::array<float, 4>;

/// Of a target, as shares.
inline constexpr std::array<double, 4> kAllOfIt{0, 0, 1, 1};

class Canvas {
public:
    static Result<Canvas> create(gpu::Device& device, Compiler compiler);
    Canvas(Canvas&&) noexcept;
    Canvas& operator=(Canvas&&) noexcept;
    ~Canvas();

    struct Fit {
        std::array<double, 4> area = kAllOfIt; // shares of the target that are the texture's: left, top, right, bottom
        bool fill = false;                     // all of that, whatever the texture's shape, with soft edges between its texels
        Closer closer;
    };
    /// Black, then the texture in the middle, as large as its shape allows. NaN and infinity are shown in magenta.
    [[nodiscard]] Result<void> show(gpu::Texture& target, gpu::Texture& texture, const Levels& levels, const Fit& fit);
    [[nodiscard]] Result<void> show(gpu::Texture& target, gpu::Texture& texture, const Levels& levels);

    struct Mesh {
        std::span<const CanvasVertex> vertices;
        std::span<const std::uint32_t> indices;
        gpu::Texture* texture = nullptr;
        ClipRectangle clip{};
        bool soft = false; // edges between texels that are enlarged
    };
    /// Blended over what is there.
    [[nodiscard]] Result<void> blend(gpu::Texture& target, std::span<const Mesh> meshes);

    /// Does `what`, and then draws all that it showed and blended by one submission: each is waited for, a millisecond on some devices.
    /// Nothing is drawn where it fails.
    [[nodiscard]] Result<void> together(const std::function<Result<void>()>& what);

private:
    /// Those that wait.
    [[nodiscard]] Result<void> draw();

    struct State;
    explicit Canvas(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tegument::view
