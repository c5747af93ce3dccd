#include "tests/d3d/job_file.h"

#include "host/run/geometry.h"
#include "host/run/groups.h"
#include "host/run/parts.h"
#include "host/run/pixels.h"
#include "host/support/file.h"
#include "host/support/text.h"
#include "tests/d3d/fur_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

namespace tegument::test {

namespace fs = std::filesystem;

namespace {

using run::Numbers;

/// Shortest text that reads back as the same float.
std::string text(const Numbers& numbers) {
    std::string line;
    for (const double number : numbers)
        line += fmt::format(" {}", static_cast<float>(number));
    return line;
}

Type numeric(int rows, int columns) {
    return {.base = BaseType::Float, .rows = rows, .columns = columns, .elements = 0, .name = "float"};
}

/// What the scene has for a semantic: asked for as a matrix, a vector and a number.
std::optional<Numbers> sceneValue(const std::string& semantic, const std::string& object, const run::SceneView& scene) {
    for (const Type& type : {numeric(4, 4), numeric(1, 3), numeric(1, 1)}) {
        Parameter parameter{.name = semantic, .type = type, .semantic = semantic};
        if (!object.empty()) parameter.annotations.list.push_back({.name = "Object", .type = {}, .value = object});
        if (const auto value = run::semanticValue(parameter, scene); value && *value) return **value;
    }
    return std::nullopt;
}

std::string sceneLines(const run::SceneView& scene) {
    std::string lines;
    for (const std::string& semantic : run::numericSemantics())
        for (const char* object : {"", "PointLight0"})
            if (const auto value = sceneValue(semantic, object, scene))
                lines += fmt::format("scene {} {}{}\n", semantic, *object == '\0' ? "-" : object, text(*value));
    return lines;
}

std::string targetLines(const run::Prepared& prepared) {
    std::string lines;
    for (const auto& [name, target] : prepared.targets) {
        if (name == kPicture || name == kPictureDepth) continue;
        lines += fmt::format("target {} {} {} {} {} {}\n", name, gpu::isDepth(target.format) ? "depth" : "color", target.extent.width,
                             target.extent.height, run::d3dName(target.format), target.mips);
    }
    return lines;
}

std::string blendLine(std::size_t slot, const TargetBlend& blend) {
    return fmt::format("state blend{} {} {} {} {} {} {} {} {}\n", slot, static_cast<int>(blend.enable), static_cast<int>(blend.src),
                       static_cast<int>(blend.dst), static_cast<int>(blend.op), static_cast<int>(blend.srcAlpha),
                       static_cast<int>(blend.dstAlpha), static_cast<int>(blend.opAlpha), blend.writeMask);
}

std::string stateLines(const PipelineState& state) {
    constexpr std::size_t kTargets = 4;
    std::string lines =
        fmt::format("state depth {} {} {}\nstate raster {} {}\n", static_cast<int>(state.depthTest), static_cast<int>(state.depthWrite),
                    static_cast<int>(state.depthCompare), static_cast<int>(state.cull), static_cast<int>(state.frontCounterClockwise));
    for (std::size_t slot = 0; slot < kTargets; ++slot)
        lines += blendLine(slot, state.targets.at(slot));
    return lines;
}

std::string scriptOf(const Annotations& annotations) {
    return annotations.string("Script").value_or("");
}

/// VIEWPORTPIXELSIZE of a compute pass: of the target that Viewport names, nothing is the picture, else of that of Threads.
run::Extent computeExtent(const run::Prepared& prepared, const Pass& pass) {
    const auto viewport = pass.annotations.string("Viewport");
    const std::string name = viewport ? *viewport : pass.annotations.string("Threads").value_or("");
    const auto found = prepared.targets.find(name.empty() ? kPicture : name);
    return found == prepared.targets.end() ? run::Extent{} : found->second.extent;
}

/// How many groups run is reckoned here.
Result<std::string> computeLines(const Case& drawn, const run::ObjectRun& run, const Pass& pass) {
    if (!run.prepared.programs.contains(&pass)) return std::string(); // nothing of this frame
    const auto groups = run::groupsOf(run.input.effect, run.prepared, pass);
    if (!groups) return groups.error();
    const run::Extent viewport = computeExtent(run.prepared, pass);
    return fmt::format("compute {} {} {} {} {} {} {}\npassscript {}\n", pass.name, entryFile(drawn, *pass.computeShader), (*groups)[0],
                       (*groups)[1], (*groups)[2], viewport.width, viewport.height,
                       pass.annotations.find("Script") ? scriptOf(pass.annotations) : "Draw=Compute;");
}

std::string storeLines(const Effect& effect) {
    std::string lines;
    for (const StorageTexture& storage : effect.storages)
        if (storage.target) lines += fmt::format("store {} {}\n", storage.name, storage.target->empty() ? "-" : *storage.target);
    return lines;
}

Result<std::string> passLines(const Case& drawn, const run::ObjectRun& run, const Technique& technique) {
    std::string lines = fmt::format("script {}\n", scriptOf(technique.annotations)) + storeLines(run.input.effect);
    for (const Pass& pass : technique.passes) {
        if (pass.computeShader) {
            const auto compute = computeLines(drawn, run, pass);
            if (!compute) return compute.error();
            lines += *compute;
            continue;
        }
        lines += fmt::format("pass {} {} {}\npassscript {}\n{}", pass.name, entryFile(drawn, *pass.vertexShader),
                             entryFile(drawn, *pass.pixelShader), scriptOf(pass.annotations), stateLines(pass.state));
        if (const auto instances = pass.annotations.string("Instances")) lines += fmt::format("instances {}\n", *instances);
    }
    return lines;
}

std::string samplerLines(const Effect& effect) {
    std::string lines;
    for (const Sampler& sampler : effect.samplers)
        lines += fmt::format("sampler {} {} {}\n", sampler.name, static_cast<int>(sampler.state.minFilter),
                             static_cast<int>(sampler.state.addressU));
    return lines;
}

/// What compiled entry points have lost.
std::string declarationLines(const run::RunInput& input, const run::Prepared& prepared) {
    std::string lines;
    for (const Parameter& parameter : input.effect.parameters) {
        if (!parameter.type.isNumeric()) continue;
        if (!parameter.semantic.empty())
            lines += fmt::format("parameter {} {} {}\n", parameter.name, parameter.semantic,
                                 parameter.annotations.string("Object").value_or("-"));
        if (const Numbers* value = prepared.values.find(parameter.name))
            lines += fmt::format("number {}{}\n", parameter.name, text(*value));
    }
    return lines;
}

} // namespace

std::string effectFile(const Case& drawn, Engine engine) {
    if (engine == Engine::Direct3D12) return drawn.effectName() + ".emitted\\" + drawn.effect.stem().string();
    return drawn.effectName() + (engine == Engine::Direct3D9 ? ".fx2.fxo" : ".fx4.fxo");
}

std::string entryFile(const Case& drawn, const ShaderReference& shader) {
    return drawn.effectName() + "." + shader.entry + ".cso";
}

namespace {

/// What a pass draws of the mesh: here a part is one run of triangles.
Result<std::string> partLines(const run::RunInput& input, const Technique& technique) {
    std::string lines;
    for (const Pass& pass : technique.passes) {
        if (!pass.annotations.find("Part")) continue;
        const auto ranges = run::partOf(input.effect, pass, *input.mesh);
        if (!ranges) return ranges.error();
        assert(ranges->size() == 1);
        lines += fmt::format("part {} {} {}\n", pass.name, ranges->front().first, ranges->front().count);
    }
    return lines;
}

} // namespace

Result<std::string> writeJob(const Case& drawn, Engine engine, const run::ObjectRun& run, const std::string& textures) {
    const auto& [input, prepared] = run;
    const Technique* technique = input.effect.findTechnique(drawn.technique);
    assert(technique);
    const glm::vec3 background = input.workspace.background;
    std::string lines = fmt::format("technique {}\npicture {} {}{}\n", drawn.technique, kPictureWidth, kPictureHeight,
                                    text({background.x, background.y, background.z}));
    if (prepared.drawsMesh) lines += fmt::format("mesh {}\n", drawsFur(drawn) ? kFurMeshFile : kMeshFile);
    const auto parts = partLines(input, *technique);
    if (!parts) return parts.error();
    lines += *parts;
    for (const auto& [name, numbers] : input.workspace.parameters)
        lines += fmt::format("value {}{}\n", name, text(numbers));
    lines += sceneLines(prepared.scene) + textures;
    if (engine != Engine::Direct3D11) lines += fmt::format("effect {}\n", effectFile(drawn, engine));
    if (engine != Engine::Direct3D9) lines += targetLines(prepared); // Wine's Direct3D 10 cannot read the numbers of annotations
    if (engine == Engine::Direct3D11) {
        const auto passes = passLines(drawn, run, *technique);
        if (!passes) return passes.error();
        lines += declarationLines(input, prepared) + samplerLines(input.effect) + *passes;
    }
    const std::string file = fmt::format("{}.{}.job", drawn.name(), engineName(engine));
    if (const auto written = writeFile(drawings() / file, lines); !written) return written.error();
    return file;
}

} // namespace tegument::test
