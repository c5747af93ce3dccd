#pragma once
// Inside host/image only: one decoder and encoder per file format, and the errors they share.

#include "host/image/image.h"

#include <cstdint>
#include <optional>

namespace tegument::codec {

/// Widest and tallest image that is read: what a Direct3D 11 device can sample.
inline constexpr std::uint32_t kMaxSize = 16384;

/// A file's bytes and what to call it in messages.
struct Encoded {
    std::span<const std::byte> bytes;
    const std::string& name;
};

[[nodiscard]] Result<Image> decodePng(const Encoded& in);
[[nodiscard]] Result<Image> decodeJpeg(const Encoded& in);
[[nodiscard]] Result<Image> decodeExr(const Encoded& in);
[[nodiscard]] Result<Image> decodeHdr(const Encoded& in);
[[nodiscard]] Result<Image> decodeBmp(const Encoded& in);
[[nodiscard]] bool isTga(std::span<const std::byte> bytes);
[[nodiscard]] Result<Image> decodeTga(const Encoded& in);

/// Eight-bit samples, row by row, ready to be stored.
struct Samples8 {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int channels = 0; // 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
    bool srgb = false;
    std::vector<unsigned char> bytes;
};
[[nodiscard]] Result<std::string> encodePng(const Samples8& samples, const std::map<std::string, std::string>& metadata);
/// 1 or 3 channels; metadata as a comment of lines "key: value".
[[nodiscard]] Result<std::string> encodeJpeg(const Samples8& samples, const std::map<std::string, std::string>& metadata);
[[nodiscard]] Result<std::string> encodeExr(const Image& image, ExrDepth depth);

/// TG5201: the file ends at `byte`, before its own description is fulfilled.
[[nodiscard]] Error truncated(const Encoded& in, std::size_t byte, const std::string& detail);
/// TG5202: what stands at `byte` cannot be decoded.
[[nodiscard]] Error damaged(const Encoded& in, std::size_t byte, const std::string& detail);
/// TG5203: empty or larger than kMaxSize.
[[nodiscard]] std::optional<Error> sizeError(const Encoded& in, std::uint64_t width, std::uint64_t height,
                                             std::optional<std::size_t> byte = {});
/// TG5204: a legal file of a kind that no effect needs.
[[nodiscard]] Error unsupported(const Encoded& in, const std::string& what, const std::string& hint, std::optional<std::size_t> byte = {});
/// TG5205: the machine could not hold or encode it.
[[nodiscard]] Error outOfMemory(const std::string& name);

} // namespace tegument::codec
