// Radiance's picture (.hdr, RGBE): G. Ward, Real Pixels, Graphics Gems II (1991). Rows from the top, whole or run by run; colours as the
// file has them. Libraries for it take a file that ends early for a black one, so it is read here.

#include "host/image/codecs.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace tegument::codec {

namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr int kExponentBias = 128 + 8; // of RGBE: value = mantissa * 2^(e - 136)

/// What is left of a file, byte by byte.
class HdrReader {
public:
    explicit HdrReader(const Encoded& in) : in_(in) {}

    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::optional<int> byte() {
        if (at_ >= in_.bytes.size()) return std::nullopt;
        return std::to_integer<int>(in_.bytes[at_++]);
    }
    /// Without its end; nothing where the file ends first.
    [[nodiscard]] std::optional<std::string> line() {
        std::string text;
        while (const auto next = byte()) {
            if (*next == '\n') return text;
            if (text.size() >= kLongestLine) return std::nullopt;
            text += static_cast<char>(*next);
        }
        return std::nullopt;
    }

private:
    const Encoded& in_;
    std::size_t at_ = 0;
};

using Texel = std::array<int, 4>; // red, green, blue, exponent

/// A row whose channels stand one behind the other, in runs: its first four bytes are 2, 2 and the width. nullopt: the file ends.
Result<bool> readRuns(const Encoded& in, HdrReader& file, std::vector<Texel>& row) {
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (std::size_t x = 0; x < row.size();) {
            const auto head = file.byte();
            if (!head) return false;
            const bool run = *head > 128;
            const auto count = static_cast<std::size_t>(run ? *head - 128 : *head);
            if (count == 0 || count > row.size() - x) return damaged(in, file.at() - 1, fmt::format("a run of {} pixels", count));
            std::optional<int> value;
            for (std::size_t i = 0; i < count; ++i) {
                if (i == 0 || !run) value = file.byte();
                if (!value) return false;
                row[x++].at(channel) = *value;
            }
        }
    return true;
}

Result<bool> readRow(const Encoded& in, HdrReader& file, std::vector<Texel>& row) {
    for (std::size_t x = 0; x < row.size(); ++x) {
        for (int& value : row[x]) {
            const auto next = file.byte();
            if (!next) return false;
            value = *next;
        }
        const Texel& texel = row[x];
        if (x == 0 && texel[0] == 2 && texel[1] == 2 && static_cast<std::size_t>(256 * texel[2] + texel[3]) == row.size())
            return readRuns(in, file, row);
        if (texel[0] == 1 && texel[1] == 1 && texel[2] == 1)
            return unsupported(in, "a picture with runs of the old kind", "write it anew with any current program", file.at() - 4);
    }
    return true;
}

/// The lines up to the empty one, then the size. Other orders of rows and columns than -Y +X are hardly ever written.
Result<Image> readHead(const Encoded& in, HdrReader& file) {
    for (bool first = true;; first = false) {
        const auto line = file.line();
        if (!line) return truncated(in, file.at(), "in its header");
        if (line->empty()) break;
        if (!first && line->starts_with("FORMAT=") && *line != "FORMAT=32-bit_rle_rgbe")
            return unsupported(in, "an HDR picture of " + line->substr(7), "save it as 32-bit_rle_rgbe");
    }
    const auto size = file.line();
    if (!size) return truncated(in, file.at(), "before its size");
    constexpr std::string_view kBetween = " +X ";
    const std::size_t between = size->find(kBetween);
    std::uint64_t height = 0;
    std::uint64_t width = 0;
    const auto number = [&](std::size_t from, std::size_t to, std::uint64_t& value) {
        const auto read = std::from_chars(size->data() + from, size->data() + to, value);
        return read.ec == std::errc() && read.ptr == size->data() + to;
    };
    if (!size->starts_with("-Y ") || between == std::string::npos || !number(3, between, height) ||
        !number(between + kBetween.size(), size->size(), width))
        return unsupported(in, fmt::format("an HDR picture with the size '{}'", *size), "rows must run from the top: -Y HEIGHT +X WIDTH");
    if (const auto error = sizeError(in, width, height)) return *error;
    return Image{.width = static_cast<int>(width), .height = static_cast<int>(height), .channels = 3};
}

} // namespace

Result<Image> decodeHdr(const Encoded& in) {
    HdrReader file(in);
    Result<Image> head = readHead(in, file);
    if (!head) return head;
    Image image = std::move(*head);
    std::vector<Texel> row(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
        const auto whole = readRow(in, file, row);
        if (!whole) return whole.error();
        if (!*whole) return truncated(in, file.at(), fmt::format("in row {} of {}", y, image.height));
        for (const Texel& texel : row)
            for (std::size_t c = 0; c < 3; ++c)
                image.pixels.push_back(texel[3] == 0 ? 0.0F : std::ldexp(static_cast<float>(texel.at(c)), texel[3] - kExponentBias));
    }
    return image;
}

} // namespace tegument::codec
