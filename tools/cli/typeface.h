#pragma once
// Text in pictures, set by FreeType.

#include "host/image/image.h"
#include "host/support/result.h"

#include <filesystem>
#include <memory>
#include <string_view>

namespace tegument::app {

/// Where Debian's fonts-dejavu-core has it.
inline constexpr const char* kUsualTypeface = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

class Typeface {
public:
    /// `size` is that of the em in pixels. TG8033: no such file, or no typeface that FreeType reads.
    [[nodiscard]] static Result<Typeface> open(const std::filesystem::path& file, int size);

    /// In pixels; text is UTF-8.
    [[nodiscard]] int width(std::string_view text) const;
    /// Of a line, in pixels.
    [[nodiscard]] int height() const;
    /// Black text on what is there, the upper left corner of its line at (x, y); what lies outside the image is left out.
    void draw(Image& image, int x, int y, std::string_view text) const;

private:
    struct Face;
    explicit Typeface(std::shared_ptr<Face> face) : face_(std::move(face)) {}
    std::shared_ptr<Face> face_;
};

} // namespace tegument::app
