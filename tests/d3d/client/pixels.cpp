#include "pixels.h"

#include "com.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

namespace client {

namespace {

template <class T>
void readInto(std::ifstream& in, std::vector<T>& values, std::size_t count) {
    values.resize(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

std::ifstream open(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) fail("cannot read " + path);
    return in;
}

void check(const std::ifstream& in, const std::string& path) {
    if (!in) fail(path + " is cut short");
}

} // namespace

unsigned bytesPerTexel(TexelFormat format) {
    switch (format) {
    case TexelFormat::R16Float: return 2;
    case TexelFormat::Rgba16:
    case TexelFormat::Rgba16Float:
    case TexelFormat::Rg32Float: return 8;
    case TexelFormat::Rgba32Float: return 16;
    default: return 4;
    }
}

TextureFile readTexture(const std::string& path) {
    std::ifstream in = open(path);
    std::vector<std::uint32_t> head;
    readInto(in, head, 5);
    check(in, path);
    TextureFile texture{static_cast<TexelFormat>(head[0]), head[1], head[2], head[3], head[4], {}};
    for (unsigned i = 0; i < texture.faces * texture.levels; ++i) {
        const unsigned level = i % texture.levels;
        readInto(in, texture.images.emplace_back(), std::size_t{texture.pitchOf(level)} * texture.heightOf(level));
    }
    check(in, path);
    return texture;
}

MeshFile readMesh(const std::string& path) {
    std::ifstream in = open(path);
    std::vector<std::uint32_t> head;
    readInto(in, head, 2);
    check(in, path);
    MeshFile mesh;
    readInto(in, mesh.vertices, std::size_t{head[0]} * kVertexFloats);
    readInto(in, mesh.indices, head[1]);
    check(in, path);
    return mesh;
}

MeshFile fullScreenQuad() {
    MeshFile quad;
    for (const auto& corner : {std::array{0.0F, 0.0F}, std::array{0.0F, 1.0F}, std::array{1.0F, 0.0F}, std::array{1.0F, 1.0F}}) {
        const float x = 2 * corner[0] - 1;
        const float y = 1 - 2 * corner[1];
        quad.vertices.insert(quad.vertices.end(), {x, y, 0, 0, 0, 1, 1, 0, 0, 1, corner[0], corner[1]});
    }
    quad.indices = {0, 1, 2, 2, 1, 3};
    return quad;
}

void writePixels(const std::string& path, const Pixels& pixels) {
    std::ofstream out(path, std::ios::binary);
    for (const std::uint32_t number : {pixels.width, pixels.height, pixels.channels})
        out.write(reinterpret_cast<const char*>(&number), sizeof number);
    out.write(reinterpret_cast<const char*>(pixels.values.data()), static_cast<std::streamsize>(pixels.values.size() * sizeof(float)));
    if (!out.flush()) fail("cannot write " + path);
}

float halfToFloat(std::uint16_t half) {
    const int exponent = half >> 10 & 31;
    const int mantissa = half & 1023;
    const float sign = (half & 0x8000) != 0 ? -1.0F : 1.0F;
    if (exponent == 0) return sign * std::ldexp(static_cast<float>(mantissa), -24);
    if (exponent == 31) return mantissa != 0 ? std::numeric_limits<float>::quiet_NaN() : sign * std::numeric_limits<float>::infinity();
    return sign * std::ldexp(static_cast<float>(mantissa + 1024), exponent - 25);
}

namespace {

float readValue(const std::uint8_t* row, std::size_t i, Stored stored) {
    if (stored == Stored::Floats) {
        float value = 0;
        std::memcpy(&value, row + sizeof value * i, sizeof value);
        return value;
    }
    std::uint16_t bits = 0;
    std::memcpy(&bits, row + sizeof bits * i, sizeof bits);
    return stored == Stored::Halves ? halfToFloat(bits) : static_cast<float>(bits) / 65535.0F;
}

} // namespace

void appendRows(Pixels& pixels, const void* rows, unsigned pitch, Stored stored) {
    const std::size_t count = std::size_t{pixels.width} * pixels.channels;
    for (unsigned y = 0; y < pixels.height; ++y) {
        const auto* row = static_cast<const std::uint8_t*>(rows) + std::size_t{y} * pitch;
        for (std::size_t i = 0; i < count; ++i)
            pixels.values.push_back(readValue(row, i, stored));
    }
}

} // namespace client
