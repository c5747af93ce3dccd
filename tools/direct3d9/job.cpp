#include "tools/direct3d9/job.h"

#include "host/run/geometry.h"
#include "host/run/pixels.h"
#include "host/run/semantics.h"
#include "host/run/target_desc.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/adopt/wrapper.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace tegument {

namespace fs = std::filesystem;

namespace {

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// In one word.
std::string named(std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
}

std::string shown(const std::string& target) {
    return target.empty() || target.starts_with("<picture") ? "-" : named(target);
}

std::string text(const run::Numbers& numbers) {
    std::string line;
    for (const double number : numbers)
        line += fmt::format(" {}", static_cast<float>(number));
    return line;
}

/// Direct3D 9 has the centre of a pixel where later ones have its corner.
run::Numbers movedHalfAPixel(run::Numbers matrix, int width, int height) {
    for (std::size_t row = 0; row < 4; ++row) {
        matrix[row * 4] -= matrix[row * 4 + 3] / width;
        matrix[row * 4 + 1] += matrix[row * 4 + 3] / height;
    }
    return matrix;
}

std::string valueLines(const Effect& effect, const run::Prepared& prepared, const AuthorsNumbers& theirs, int width, int height) {
    std::string lines;
    for (const Parameter& parameter : effect.parameters) {
        if (!parameter.type.isNumeric()) continue;
        if (run::isViewportSize(parameter)) {
            lines += fmt::format("sized {}\n", parameter.name);
            continue;
        }
        const auto value = prepared.values.require(parameter);
        if (!value) continue;
        run::Numbers numbers = *value;
        const auto* own = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr;
        if (parameter.semantic.empty() && theirs.contains(parameter.name) && own && *own == theirs.at(parameter.name)) continue;
        const bool placed = parameter.name.starts_with("tg_"); // what fixed function draws
        if (placed && numbers.size() == 16) numbers = movedHalfAPixel(std::move(numbers), width, height);
        lines += fmt::format("value {}{}\n", placed ? "placed" : parameter.name, text(numbers));
    }
    return lines;
}

std::string drawLines(const run::DrawStep& draw) {
    std::string lines;
    for (const auto& [name, copy] : draw.copies)
        lines += fmt::format("step sample {} {}\n", name, named(copy));
    for (const auto& [name, value] : draw.written)
        lines += fmt::format("step number {} {}\n", name, value);
    lines += fmt::format("step bind {}", draw.depth ? shown(*draw.depth) : ".");
    for (const auto& color : draw.colors)
        lines += " " + shown(color.value_or(""));
    const auto pass = static_cast<std::size_t>(draw.pass - draw.technique->passes.data());
    const bool pixels = draw.pass->vertexShader && draw.pass->vertexShader->code.find(adopt::kInPixels) != std::string::npos;
    lines += fmt::format("\nstep {} {}\n", draw.kind != DrawKind::Buffer ? "mesh" : pixels ? "pixels" : "quad", pass);
    for (const auto& copied : draw.copies)
        lines += fmt::format("step sample {0} {0}\n", copied.first);
    return lines;
}

/// The frame, step by step. Error: something in it exists on this host alone.
Result<std::string> stepLines(const run::Plan& plan) {
    std::string lines;
    for (const run::Step& step : plan.steps) {
        if (const auto* draw = std::get_if<run::DrawStep>(&step)) {
            if (draw->pass->name.starts_with("<")) return inputError(5260, draw->pass->at, "this host draws " + draw->pass->name);
            lines += drawLines(*draw);
        } else if (const auto* clear = std::get_if<run::ClearStep>(&step)) {
            const std::string target = shown(clear->target);
            if (clear->what == ClearKind::Color)
                lines +=
                    fmt::format("step color {} {} {} {} {}\n", target, clear->color[0], clear->color[1], clear->color[2], clear->color[3]);
            else if (clear->what == ClearKind::Depth)
                lines += fmt::format("step depth {} {}\n", target, clear->depth);
            else
                lines += fmt::format("step stencil {} {}\n", target, clear->stencil);
        } else if (const auto* copy = std::get_if<run::CopyStep>(&step)) {
            lines += fmt::format("step copy {} {}\n", copy->from, named(copy->to));
        }
    }
    return lines;
}

std::string targetLines(const run::Prepared& prepared) {
    std::string lines;
    for (const auto& [name, target] : prepared.targets)
        if (!name.starts_with("<picture"))
            lines += fmt::format("target {} {} {} {} {} {}\n", named(name), gpu::isDepth(target.format) ? "depth" : "color",
                                 target.extent.width, target.extent.height, run::d3dName(target.format), target.mips);
    return lines;
}

Result<std::uint32_t> texelFormat(const std::string& name, gpu::Format format) {
    using gpu::Format; // in the order of client/pixels.h
    constexpr std::array kFormats = {Format::RGBA8,   Format::RGBA8Srgb, Format::RGBA16, Format::R16F,   Format::RG16F,
                                     Format::RGBA16F, Format::R32F,      Format::RG32F,  Format::RGBA32F};
    const auto* found = std::ranges::find(kFormats, format);
    if (found == kFormats.end()) return machineError(5002, fmt::format("{} has a format that the clients do not read", name));
    return static_cast<std::uint32_t>(found - kFormats.begin());
}

std::string header(std::uint32_t format, std::uint32_t width, std::uint32_t height, std::uint32_t levels, std::uint32_t faces) {
    const std::array numbers = {format, width, height, levels, faces};
    std::string bytes;
    append(bytes, numbers.data(), numbers.size());
    return bytes;
}

/// All levels of all faces as the device has them: mip chains made by each engine in its own way would differ in rounding.
Result<std::string> textureBytes(gpu::Device& device, const std::string& name, gpu::Texture& texture) {
    const gpu::TextureDesc& desc = texture.desc();
    const auto format = texelFormat(name, desc.format);
    if (!format) return format.error();
    const std::uint32_t faces = desc.cube ? 6 : 1;
    std::string bytes = header(*format, desc.width, desc.height, desc.mips, faces);
    for (std::uint32_t face = 0; face < faces; ++face)
        for (std::uint32_t level = 0; level < desc.mips; ++level) {
            const auto texels = device.readback(texture, level, face);
            if (!texels) return texels.error();
            append(bytes, texels->data(), texels->size());
        }
    return bytes;
}

} // namespace

Result<void> writeMeshFile(const fs::path& path, const Mesh& mesh) {
    const std::vector<float> vertices = run::interleave(mesh);
    const std::array counts = {static_cast<std::uint32_t>(mesh.positions.size()), static_cast<std::uint32_t>(mesh.indices.size())};
    std::string bytes;
    append(bytes, counts.data(), counts.size());
    append(bytes, vertices.data(), vertices.size());
    append(bytes, mesh.indices.data(), mesh.indices.size());
    return writeFile(path, bytes);
}

Result<std::string> writeTextures(gpu::Device& device, run::Stage& stage, const run::Prepared& prepared, const fs::path& folder) {
    std::string lines;
    for (const auto& entry : prepared.textures) {
        gpu::Texture* texture = stage.resources().texture(prepared, entry.first);
        assert(texture); // the frame has sampled it
        const auto bytes = textureBytes(device, entry.first, *texture);
        if (!bytes) return bytes.error();
        const std::string file = contentHash(*bytes) + ".texture";
        std::error_code code;
        if (!fs::exists(folder / file, code))
            if (const auto written = writeFile(folder / file, *bytes); !written) return written.error();
        lines += fmt::format("texture {} {}\n", entry.first, file);
    }
    return lines;
}

Result<Image> readFloats(const fs::path& path) {
    const auto bytes = readFile(path);
    if (!bytes) return bytes.error();
    std::array<std::uint32_t, 3> head{};
    if (bytes->size() >= sizeof head) std::memcpy(head.data(), bytes->data(), sizeof head);
    const std::size_t count = std::size_t{head[0]} * head[1] * head[2];
    if (count == 0 || bytes->size() != sizeof head + count * sizeof(float))
        return inputError(5201, {.file = path.string()}, "not a file of raw floats, or cut short");
    Image image{.width = static_cast<int>(head[0]), .height = static_cast<int>(head[1]), .channels = static_cast<int>(head[2])};
    image.pixels.resize(count);
    std::memcpy(image.pixels.data(), bytes->data() + sizeof head, count * sizeof(float));
    return image;
}

Result<void> writeFloats(const fs::path& path, const Image& image) {
    const std::array head = {static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height),
                             static_cast<std::uint32_t>(image.channels)};
    std::string bytes(reinterpret_cast<const char*>(head.data()), sizeof head);
    bytes.append(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(float));
    return writeFile(path, bytes);
}

Result<std::string> frameLines(const Effect& effect, const run::Prepared& prepared, const AuthorsNumbers& theirs, int width, int height) {
    auto steps = stepLines(prepared.plan);
    if (!steps) return steps;
    return valueLines(effect, prepared, theirs, width, height) + targetLines(prepared) + *steps;
}

} // namespace tegument
