// Effects of other hosts against Microsoft: the picture of the respelt shaders on Vulkan beside that of the binary which Microsoft's
// compiler makes of the same file, drawn by ID3DXEffect of Direct3D 9 with the same values.

#include "host/adopt/adopt.h"
#include "host/run/pixels.h"
#include "host/run/semantics.h"
#include "host/run/stage.h"
#include "host/run/target_desc.h"
#include "host/support/file.h"
#include "tests/d3d/engines.h"
#include "tests/d3d/job_file.h"
#include "tools/direct3d/microsoft.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/wine.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 160;
constexpr double kStep = 0.01;  // of a display's 255: two and a half
constexpr double kShare = 0.05; // of the pixels: edges, where coverage and filters of two rasterisers differ
constexpr std::size_t kLeast = 20;

/// Where the two differ, and why.
const std::map<std::string, std::string>& explained() {
    static const std::map<std::string, std::string> kAll = {
        {"cloth_volume", "a picture of two dimensions stands in for volumes, which Direct3D 9 reads otherwise"},
        {"volume_noise", "likewise"},
        {"fetches", "tex1D of a picture of two dimensions: the column that Direct3D 9 reads is what else stands in the register"},
        {"fetch_water_projected",
         "anisotropic look-ups with gradients of the shader's own: Mesa's software device draws nothing of use, and dies of "
         "them on Vulkan, where this host leaves the anisotropy out"},
        {"gamebryo_like", "its first technique is assembly with VertexShaderConstant, of which Microsoft's binary draws nothing in Wine; "
                          "the cause is not known"},
        {"odd_spelling", "Microsoft's compiler takes a switch over a constant for its default in shader model 3"},
    };
    return kAll;
}

fs::path folder() {
    return drawings().parent_path() / "foreign";
}

/// Seen as tegument render shows foreign effects.
Workspace workspaceFor() {
    Workspace workspace;
    workspace.camera.position = {2.4F, 1.2F, 5.6F};
    workspace.camera.target = {0, 0, 0};
    workspace.camera.horizontalFov = 25;
    workspace.camera.nearPlane = 0.1F;
    workspace.camera.farPlane = 100;
    workspace.cameraRelative = false;
    return workspace;
}

struct Drawn {
    std::string name;
    fs::path file;
    std::string why;  // it is not compared; empty: it is
    std::string line; // of the jobs
};

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
run::Numbers movedHalfAPixel(run::Numbers matrix, bool transposed) {
    for (std::size_t row = 0; row < 4; ++row) {
        const auto at = [&](std::size_t column) -> double& { return matrix[transposed ? column * 4 + row : row * 4 + column]; };
        at(0) -= at(3) / kSide;
        at(1) += at(3) / kSide;
    }
    return matrix;
}

/// Numbers that the author gave; members of structures among them.
std::map<std::string, std::vector<double>> authorsNumbers(const Effect& read) {
    std::map<std::string, std::vector<double>> numbers;
    for (const Parameter& parameter : read.parameters)
        if (const auto* value = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr)
            numbers[parameter.name] = *value;
    return numbers;
}

std::string valueLines(const Effect& effect, const run::Prepared& prepared, const std::map<std::string, std::vector<double>>& theirs) {
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
        const bool transposed = parameter.semantic.ends_with("PROJECTIONTRANSPOSE");
        if (numbers.size() == 16 && (parameter.semantic.ends_with("PROJECTION") || transposed))
            numbers = movedHalfAPixel(std::move(numbers), transposed);
        lines += fmt::format("value {}{}\n", parameter.name.starts_with("tg_") ? "placed" : parameter.name, text(numbers));
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
    lines += fmt::format("\nstep {} {}\n", draw.kind == DrawKind::Buffer ? "quad" : "mesh", pass);
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

Result<std::string> drawOne(gpu::Device& device, const Mesh& mesh, const Drawn& drawn) {
    auto read = loadEffect(drawn.file, {.lenient = true});
    if (!read) return read.error();
    const auto theirs = authorsNumbers(*read);
    const Adoption adoption = adopted(std::move(*read), {.width = kSide, .height = kSide});
    const Effect& effect = adoption.effect;
    const Technique* technique = effect.defaultTechnique();
    if (!technique || technique->kind != TechniqueKind::D3D9) return inputError(5260, {.file = drawn.name}, "not Direct3D 9's");
    const Workspace workspace = workspaceFor();
    const RunOptions options{.technique = technique->name, .width = kSide, .height = kSide, .compiler = Compiler::Dxc};
    run::Stage stage(device, effect, {.mesh = &mesh});
    auto staged = stage.prepare(workspace, options);
    if (!staged) return staged.error();
    const run::Prepared& prepared = staged->runs.front().prepared;
    const auto steps = stepLines(prepared.plan);
    if (!steps) return steps.error();
    if (const auto done = stage.draw(*staged, staged->frame.items.size()); !done) return done.error();
    const auto picture = run::readBack(device, *stage.resources().picture());
    if (!picture) return picture.error();
    if (const auto written = writeFloats(folder() / (drawn.name + ".vulkan.f32"), *picture); !written) return written.error();
    const auto textures = writeTextures(device, stage, prepared, folder());
    if (!textures) return textures.error();
    const std::string job = fmt::format("foreign\neffect {0}.fxo\ntechnique {1}\npicture {2} {2} 0 0 0\nmesh {3}\n", drawn.name,
                                        technique->name, kSide, adoption.turned.contains(technique->name) ? "turned.bin" : "ball.bin") +
                            valueLines(effect, prepared, theirs) + *textures + targetLines(prepared) + *steps;
    if (const auto written = writeFile(folder() / (drawn.name + ".job"), job); !written) return written.error();
    return fmt::format("{0}.job {0}.\n", drawn.name);
}

std::vector<Drawn> all() {
    std::vector<Drawn> list;
    for (const auto& entry : fs::directory_iterator("tests/adopt/effects"))
        if (entry.path().extension() == ".fx") list.push_back({.name = entry.path().stem().string(), .file = entry.path()});
    std::ranges::sort(list, {}, &Drawn::name);
    return list;
}

/// By Microsoft's compiler, those that have been drawn on Vulkan.
void compile(std::vector<Drawn>& list) {
    std::vector<MicrosoftJob> jobs;
    for (const Drawn& drawn : list)
        jobs.push_back({.profile = "fx_2_0",
                        .source = drawn.file,
                        .output = folder() / (drawn.name + ".fxo"),
                        .includeFolders = {drawn.file.parent_path()},
                        .compatible = true});
    const auto results = compileWithMicrosoft(jobs);
    ASSERT_TRUE(results) << format(results.error());
    for (std::size_t i = 0; i < list.size(); ++i)
        if (!(*results)[i].ok && list[i].why.empty()) list[i].why = "Microsoft's compiler refuses it";
}

/// A client ends with what brings it down: the rest gets another.
void drawWithMicrosoft(std::vector<Drawn*> list) {
    constexpr double kSeconds = 120;
    const auto client = clientIn(folder());
    ASSERT_TRUE(client) << format(client.error());
    while (!list.empty()) {
        std::string jobs;
        for (const Drawn* drawn : list)
            jobs += drawn->line;
        fs::remove(folder() / "results");
        ASSERT_TRUE(writeFile(folder() / "jobs", jobs));
        const auto ran = runInWine(*client, {"9", windowsPath(folder()), "jobs", "results"}, kSeconds + static_cast<double>(list.size()));
        ASSERT_TRUE(ran) << format(ran.error());
        std::istringstream results(readFile(folder() / "results") ? *readFile(folder() / "results") : "");
        std::size_t done = 0;
        bool failed = false;
        for (std::string line; !failed && done < list.size() && std::getline(results, line); ++done) {
            failed = line != "ok";
            if (failed) list[done]->why = line;
        }
        if (!failed && done < list.size()) list[done++]->why = fmt::format("the client ended with {} {}", ran->exitCode, ran->output);
        list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(done));
    }
}

/// The share of pixels that differ, as a display shows them.
double difference(const Image& a, const Image& b) {
    const auto byte = [](float value) { return std::isnan(value) ? 0.0 : std::clamp(static_cast<double>(value), 0.0, 1.0); };
    std::size_t beyond = 0;
    const std::size_t pixels = std::size_t{kSide} * kSide;
    for (std::size_t i = 0; i < pixels; ++i) {
        double most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(byte(a.pixels[i * static_cast<std::size_t>(a.channels) + c]) -
                                           byte(b.pixels[i * static_cast<std::size_t>(b.channels) + c])));
        beyond += most > kStep ? 1 : 0;
    }
    return static_cast<double>(beyond) / static_cast<double>(pixels);
}

std::string missing() {
    if (std::string reason = clientsMissing(); !reason.empty()) return reason;
    return compilerAvailable(Compiler::Dxc) ? "" : "DXC was left out of this build (./bootstrap test brings it)";
}

TEST(ForeignPicture, is_that_of_microsofts_binary) {
    if (const std::string reason = missing(); !reason.empty()) GTEST_SKIP() << reason;
    auto device = gpu::Device::create({});
    ASSERT_TRUE(device) << format(device.error());
    fs::remove_all(folder());
    fs::create_directories(folder());
    const Mesh mesh = ball();
    ASSERT_TRUE(writeMeshFile(folder() / "ball.bin", mesh));
    Mesh turned = mesh;
    for (std::size_t i = 0; i + 2 < turned.indices.size(); i += 3)
        std::swap(turned.indices[i], turned.indices[i + 1]);
    ASSERT_TRUE(writeMeshFile(folder() / "turned.bin", turned));
    std::vector<Drawn> list = all();
    for (Drawn& drawn : list) {
        const auto line = drawOne(*device, mesh, drawn);
        if (line)
            drawn.line = *line;
        else
            drawn.why = line.error().diagnostics.front().text;
    }
    compile(list);
    std::vector<Drawn*> both;
    for (Drawn& drawn : list)
        if (drawn.why.empty()) both.push_back(&drawn);
    drawWithMicrosoft(both);
    std::size_t agree = 0;
    std::size_t compared = 0;
    for (const Drawn& drawn : list) {
        if (!drawn.why.empty()) {
            fmt::print("{:<28} not compared: {}\n", drawn.name, drawn.why);
            continue;
        }
        const auto vulkan = readFloats(folder() / (drawn.name + ".vulkan.f32"));
        const auto microsoft = readFloats(folder() / (drawn.name + ".picture.f32"));
        ASSERT_TRUE(vulkan && microsoft) << drawn.name;
        const double share = difference(*vulkan, *microsoft);
        ++compared;
        agree += share < kShare ? 1 : 0;
        fmt::print("{:<28} {:.2f} % of the pixels differ\n", drawn.name, share * 100);
        if (!explained().contains(drawn.name)) {
            EXPECT_LT(share, kShare) << drawn.name;
        }
    }
    fmt::print("{} of {} agree\n", agree, compared);
    EXPECT_GE(compared, kLeast);
    EXPECT_GE(static_cast<double>(agree), 0.9 * static_cast<double>(compared));
}

} // namespace
} // namespace tegument::test
