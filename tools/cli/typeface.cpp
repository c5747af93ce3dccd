#include "tools/cli/typeface.h"

#include "host/support/kept_inputs.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <system_error>

namespace tegument::app {

struct Typeface::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    Face() = default;
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;
    ~Face() {
        if (face != nullptr) FT_Done_Face(face);
        if (library != nullptr) FT_Done_FreeType(library);
    }
};

namespace {

/// Of a length in 1/64 pixel.
int wholePixels(FT_Pos length) {
    return static_cast<int>((length + 63) / 64);
}

/// The standard library's own conversion of UTF-8; what is none is one question mark.
std::u32string characters(std::string_view text) {
    try {
        return std::filesystem::path(text).u32string();
    } catch (const std::system_error&) {
        return U"?";
    }
}

void drawGlyph(Image& image, int left, int top, const FT_Bitmap& glyph) {
    for (int row = 0; row < static_cast<int>(glyph.rows); ++row)
        for (int column = 0; column < static_cast<int>(glyph.width); ++column) {
            const int x = left + column;
            const int y = top + row;
            if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
            const float paper = 1 - static_cast<float>(glyph.buffer[row * glyph.pitch + column]) / 255;
            for (int c = 0; c < image.channels; ++c)
                image.at(x, y, c) *= paper;
        }
}

/// Calls visit(x) with the glyph rendered, x in pixels from the text's start; returns the width.
template <class Visit>
int forEachGlyph(FT_Face face, std::string_view text, Visit&& visit) {
    FT_Pos x = 0;
    for (const char32_t character : characters(text)) {
        if (FT_Load_Char(face, character, FT_LOAD_RENDER) != 0) continue;
        visit(static_cast<int>(x / 64));
        x += face->glyph->advance.x;
    }
    return wholePixels(x);
}

} // namespace

Result<Typeface> Typeface::open(const std::filesystem::path& file, int size) {
    if (const auto read = kept::noteRead(file); !read) return read.error(); // FreeType opens it itself
    const auto face = std::make_shared<Face>();
    if (FT_Init_FreeType(&face->library) != 0 || FT_New_Face(face->library, file.c_str(), 0, &face->face) != 0 ||
        FT_Set_Pixel_Sizes(face->face, 0, static_cast<FT_UInt>(size)) != 0)
        return machineError(8033, fmt::format("the typeface {} of the labels cannot be read", file.string()),
                            "install fonts-dejavu-core, name a TrueType file with --font, or leave out the labels");
    return Typeface(face);
}

int Typeface::width(std::string_view text) const {
    return forEachGlyph(face_->face, text, [](int) {});
}

int Typeface::height() const {
    return wholePixels(face_->face->size->metrics.height);
}

void Typeface::draw(Image& image, int x, int y, std::string_view text) const {
    FT_FaceRec* const face = face_->face;
    const int baseline = y + wholePixels(face->size->metrics.ascender);
    forEachGlyph(face, text, [&](int at) {
        drawGlyph(image, x + at + face->glyph->bitmap_left, baseline - face->glyph->bitmap_top, face->glyph->bitmap);
    });
}

} // namespace tegument::app
