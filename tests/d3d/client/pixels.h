#pragma once
// Textures, meshes and targets as files. Numbers are little endian, as on every machine that runs Direct3D.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace client {

/// The numbers stand in files.
enum class TexelFormat : std::uint32_t { Rgba8, Rgba8Srgb, Rgba16, R16Float, Rg16Float, Rgba16Float, R32Float, Rg32Float, Rgba32Float };

unsigned bytesPerTexel(TexelFormat format);

/// File: format, width, height, number of levels, number of faces (1, or 6 in Direct3D's order); then each face's levels, largest first,
/// tightly packed rows.
struct TextureFile {
    TexelFormat format = TexelFormat::Rgba8;
    unsigned width = 0;
    unsigned height = 0;
    unsigned levels = 1;
    unsigned faces = 1;
    std::vector<std::vector<std::uint8_t>> images; // face * levels + level

    [[nodiscard]] unsigned widthOf(unsigned level) const { return width >> level > 1 ? width >> level : 1; }
    [[nodiscard]] unsigned heightOf(unsigned level) const { return height >> level > 1 ? height >> level : 1; }
    [[nodiscard]] unsigned pitchOf(unsigned level) const { return widthOf(level) * bytesPerTexel(format); }
    [[nodiscard]] const std::uint8_t* image(unsigned face, unsigned level) const { return images[face * levels + level].data(); }
};
TextureFile readTexture(const std::string& path);

/// File: number of vertices, number of indices; then POSITION float3, NORMAL float3, TANGENT float4, TEXCOORD float2 each; then the
/// indices.
struct MeshFile {
    std::vector<float> vertices;
    std::vector<std::uint32_t> indices;
};
inline constexpr unsigned kVertexFloats = 12;
inline constexpr unsigned kVertexBytes = kVertexFloats * sizeof(float);
MeshFile readMesh(const std::string& path);
/// Two counter-clockwise triangles in clip space, v = 0 at the top.
MeshFile fullScreenQuad();

/// A target's texels as floats, row 0 first.
struct Pixels {
    unsigned width = 0;
    unsigned height = 0;
    unsigned channels = 4;
    std::vector<float> values;
};
/// File: width, height, channels; then the floats.
void writePixels(const std::string& path, const Pixels& pixels);

enum class Stored { Floats, Halves, Shares }; // shares: 16 bits of 0..1

/// What Direct3D hands out of a mapped target: rows `pitch` bytes apart.
void appendRows(Pixels& pixels, const void* rows, unsigned pitch, Stored stored);

float halfToFloat(std::uint16_t half);

} // namespace client
