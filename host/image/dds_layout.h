#pragma once
// Inside host/image only: the layout of a DDS file (Microsoft, "Programming Guide for DDS"). Little-endian 32-bit words.

#include "host/image/dds.h"

#include <array>
#include <cstdint>

namespace tegument::dds {

// Offsets in bytes.
inline constexpr std::size_t kMagic = 0;
inline constexpr std::size_t kHeaderSize = 4; // holds 124
inline constexpr std::size_t kFlags = 8;
inline constexpr std::size_t kHeight = 12;
inline constexpr std::size_t kWidth = 16;
inline constexpr std::size_t kPitch = 20;
inline constexpr std::size_t kDepth = 24;
inline constexpr std::size_t kMipCount = 28;
inline constexpr std::size_t kWriter = 68;          // of what is reserved: where other writers have their names
inline constexpr std::size_t kPixelFormatSize = 76; // holds 32
inline constexpr std::size_t kPixelFormatFlags = 80;
inline constexpr std::size_t kFourCC = 84;
inline constexpr std::size_t kBitCount = 88;
inline constexpr std::size_t kMasks = 92; // red, green, blue, alpha
inline constexpr std::size_t kCaps = 108;
inline constexpr std::size_t kCaps2 = 112;
inline constexpr std::size_t kPixels = 128; // where the old header ends
inline constexpr std::size_t kDxgiFormat = 128;
inline constexpr std::size_t kDimension = 132;
inline constexpr std::size_t kMisc = 136;
inline constexpr std::size_t kArraySize = 140;
inline constexpr std::size_t kAlphaMode = 144;
inline constexpr std::size_t kPixelsDx10 = 148;

constexpr std::uint32_t fourCC(const char (&text)[5]) {
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) << (8 * i);
    return word;
}
inline constexpr std::uint32_t kMagicWord = fourCC("DDS ");
inline constexpr std::uint32_t kOurWord = fourCC("TGMT");
inline constexpr std::uint32_t kDx10Word = fourCC("DX10");

// dwFlags: DDSD_CAPS | HEIGHT | WIDTH | PIXELFORMAT, and those that are not always there.
inline constexpr std::uint32_t kRequiredFlags = 0x1 | 0x2 | 0x4 | 0x1000;
inline constexpr std::uint32_t kPitchFlag = 0x8;
inline constexpr std::uint32_t kMipFlag = 0x20000;
inline constexpr std::uint32_t kVolumeFlag = 0x800000;
inline constexpr std::uint32_t kFourCCFlag = 0x4;
inline constexpr std::uint32_t kRgbFlag = 0x40;
inline constexpr std::uint32_t kAlphaPixelsFlag = 0x1;
inline constexpr std::uint32_t kCapsTexture = 0x1000;
inline constexpr std::uint32_t kCapsMipMap = 0x400000;
inline constexpr std::uint32_t kCapsComplex = 0x8;
inline constexpr std::uint32_t kCaps2Cube = 0x200;
inline constexpr std::uint32_t kCaps2AllFaces = 0xfc00;
inline constexpr std::uint32_t kCaps2Volume = 0x200000;
inline constexpr std::uint32_t kDimension2D = 3; // D3D10_RESOURCE_DIMENSION_TEXTURE2D
inline constexpr std::uint32_t kMiscCube = 0x4;

/// One row per format and order of channels in the file.
struct FormatRow {
    DdsFormat format;
    std::string_view name;
    std::uint32_t dxgi;
    std::uint32_t d3d9; // D3DFORMAT as a FourCC; 0: by masks
    int channels;
    int bytesPerChannel;
    bool blueFirst;
};
inline constexpr std::array kFormats = {FormatRow{DdsFormat::Rgba8, "R8G8B8A8_UNORM", 28, 0, 4, 1, false},
                                        FormatRow{DdsFormat::Rgba8Srgb, "R8G8B8A8_UNORM_SRGB", 29, 0, 4, 1, false},
                                        FormatRow{DdsFormat::R16F, "R16_FLOAT", 54, 111, 1, 2, false},
                                        FormatRow{DdsFormat::Rg16F, "R16G16_FLOAT", 34, 112, 2, 2, false},
                                        FormatRow{DdsFormat::Rgba16F, "R16G16B16A16_FLOAT", 10, 113, 4, 2, false},
                                        FormatRow{DdsFormat::R32F, "R32_FLOAT", 41, 114, 1, 4, false},
                                        FormatRow{DdsFormat::Rg32F, "R32G32_FLOAT", 16, 115, 2, 4, false},
                                        FormatRow{DdsFormat::Rgba32F, "R32G32B32A32_FLOAT", 2, 116, 4, 4, false},
                                        FormatRow{DdsFormat::Rgba8, "B8G8R8A8_UNORM", 87, 0, 4, 1, true},
                                        FormatRow{DdsFormat::Rgba8Srgb, "B8G8R8A8_UNORM_SRGB", 91, 0, 4, 1, true}};

/// The row that is written: red first.
constexpr const FormatRow& row(DdsFormat format) {
    return kFormats[static_cast<std::size_t>(format)];
}

/// Masks of 32-bit pixels, red, green, blue, alpha: D3DFMT_A8R8G8B8 has blue in the lowest byte, D3DFMT_A8B8G8R8 red.
inline constexpr std::array<std::uint32_t, 4> kBlueFirstMasks = {0xff0000, 0xff00, 0xff, 0xff000000};
inline constexpr std::array<std::uint32_t, 4> kRedFirstMasks = {0xff, 0xff00, 0xff0000, 0xff000000};

} // namespace tegument::dds
