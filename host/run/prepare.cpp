#include "host/run/prepare.h"

#include "host/run/geometry.h"
#include "host/run/pieces.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace tegument::run {

namespace {

Result<void> checkSize(const RunInput& input) {
    const RunOptions& options = input.options;
    for (const int side : {options.width, options.height})
        if (side < 1 || side > static_cast<int>(kMaxExtent))
            return usageError(4004, fmt::format("a picture of {} x {} pixels cannot be drawn", options.width, options.height),
                              fmt::format("each side is 1 to {}", kMaxExtent));
    if (options.samples != 1 && options.samples != 2 && options.samples != 4 && options.samples != 8)
        return inputError(4007, {.file = input.effect.file.string()},
                          fmt::format("a picture of {} samples a pixel cannot be drawn", options.samples), "1, 2, 4 or 8");
    return {};
}

/// --set of a file must name a texture of this effect, by name or semantic.
Result<void> checkTextureNames(const RunInput& input) {
    std::vector<std::string> names;
    for (const Parameter& parameter : input.effect.parameters)
        if (parameter.type.isTexture()) names.push_back(parameter.name);
    for (const auto& [name, file] : input.options.textures) {
        const bool known = std::ranges::any_of(input.effect.parameters, [&, &name = name](const Parameter& parameter) {
            return parameter.type.isTexture() && !parameter.isTarget() &&
                   (parameter.name == name || equalsIgnoreCase(parameter.semantic, name));
        });
        if (!known)
            return inputError(4010, {.file = input.effect.file.string()}, fmt::format("no texture '{}' to set to {}", name, file),
                              didYouMean(name, names));
    }
    return {};
}

/// Who may give the frame up is asked by this thread, after each few shaders.
Result<Stages> compileInPieces(const RunInput& input, const std::vector<const Pass*>& passes) {
    const std::vector<StageKey> keys = stagesOf(passes);
    const std::size_t atOnce = input.options.pieces.goOn ? threadsToCompile() : std::max<std::size_t>(keys.size(), 1);
    Stages stages;
    std::size_t ready = 0;
    for (std::size_t first = 0; first < keys.size(); first += atOnce) {
        stages.merge(run::compileStages(input.effect, std::span(keys).subspan(first, std::min(atOnce, keys.size() - first)),
                                        input.options.compiler, [&] {
                                            if (input.options.compiling) input.options.compiling(++ready, keys.size());
                                        }));
        if (const auto pause = pauseAfter(input.options); !pause) return pause.error();
    }
    return stages;
}

Result<void> compilePasses(const RunInput& input, Prepared& prepared) {
    std::vector<const Pass*> unknown;
    for (const Pass* pass : prepared.plan.passes())
        if (const auto known = input.compiled ? input.compiled->find(pass) : Programs::const_iterator();
            input.compiled && known != input.compiled->end())
            prepared.programs.insert(*known);
        else
            unknown.push_back(pass);
    const auto stages = compileInPieces(input, unknown);
    if (!stages) return stages.error();
    for (const Pass* pass : unknown) {
        auto program = compilePass(input.effect, *pass, input.options.compiler, *stages);
        if (!program) return program.error();
        for (const Shader* shader :
             {&program->vertex, program->pixel ? &*program->pixel : nullptr, program->compute ? &*program->compute : nullptr})
            if (shader) prepared.warnings.insert(prepared.warnings.end(), shader->warnings.begin(), shader->warnings.end());
        prepared.programs.emplace(pass, std::make_shared<const PassProgram>(std::move(*program)));
    }
    return {};
}

/// Targets that compute shaders write are made for it. Those have one sample.
Result<void> markStored(const RunInput& input, Prepared& prepared) {
    for (const auto& [pass, program] : prepared.programs)
        for (const std::string& name : program->use.stored) {
            if (name == kPicture && input.options.samples > 1)
                return inputError(
                    4039, pass->at,
                    fmt::format("pass {} computes the picture, which has {} samples a pixel", pass->name, input.options.samples),
                    "draw with one sample a pixel: --samples 1");
            prepared.targets.at(name).stored = true;
        }
    return {};
}

Result<void> describeTargets(const RunInput& input, Prepared& prepared) {
    const Extent picture{static_cast<std::uint32_t>(input.options.width), static_cast<std::uint32_t>(input.options.height)};
    std::set<std::string> names = prepared.plan.targets();
    for (const auto& program : prepared.programs)
        for (const auto* used : {&program.second->use.sampled, &program.second->use.stored})
            names.insert(used->begin(), used->end());
    for (const std::string& name : names) {
        const Parameter* parameter = input.effect.findParameter(name);
        if (!parameter || !parameter->isTarget()) continue;
        const auto target = describeTarget(*parameter, picture);
        if (!target) return target.error();
        prepared.targets.emplace(name, *target);
    }
    const auto samples = static_cast<std::uint32_t>(input.options.samples);
    const PixelFormat color = input.options.halfPicture ? PixelFormat::RGBA16F : PixelFormat::RGBA32F;
    prepared.targets.emplace(kPicture, TargetDesc{.extent = picture, .format = color, .samples = samples});
    prepared.targets.emplace(kPictureDepth, TargetDesc{.extent = picture, .format = PixelFormat::D24S8, .samples = samples});
    if (samples > 1) prepared.targets.emplace(kPictureResolved, TargetDesc{.extent = picture, .format = color});
    return markStored(input, prepared);
}

/// What an earlier frame left in the target may be sampled.
bool keeps(const Effect& effect, const std::string& target) {
    const Parameter* parameter = effect.findParameter(target);
    const auto numbers = parameter ? parameter->annotations.numbers("Keeps") : std::nullopt;
    return numbers && numbers->front() != 0;
}

Result<void> complete(const RunInput& input, Prepared& prepared) {
    std::map<const Pass*, PassUse> uses;
    for (const auto& [pass, program] : prepared.programs)
        uses.emplace(pass, program->use);
    std::map<std::string, TargetShape> shapes;
    for (const auto& [name, target] : prepared.targets)
        shapes.emplace(name, TargetShape{.width = target.extent.width,
                                         .height = target.extent.height,
                                         .mips = target.mips,
                                         .depth = isDepth(target.format),
                                         .samples = target.samples,
                                         .keeps = keeps(input.effect, name)});
    AddedTargets added;
    if (const auto done = completePlan(prepared.plan, uses, shapes, background(input.workspace), prepared.warnings,
                                       input.effect.direct3D9Targets ? &added : nullptr);
        !done)
        return done;
    if (input.effect.reshade) // a back buffer is read that way
        std::erase_if(prepared.warnings, [](const Diagnostic& one) { return one.text.find("samples tgBackBuffer") != std::string::npos; });
    for (const auto& [name, original] : added.copies)
        prepared.targets.emplace(name, prepared.targets.at(original));
    for (const auto& [name, color] : added.depths) {
        const TargetDesc& beside = prepared.targets.at(color);
        prepared.targets.emplace(name, TargetDesc{.extent = beside.extent, .format = PixelFormat::D24S8, .samples = beside.samples});
    }
    std::set<std::string> needed = prepared.plan.targets();
    needed.insert(kPicture);
    needed.insert(kPictureResolved);
    for (const auto& use : uses)
        for (const auto* used : {&use.second.sampled, &use.second.stored})
            needed.insert(used->begin(), used->end());
    std::erase_if(prepared.targets, [&](const auto& target) { return !needed.contains(target.first); });
    return {};
}

/// Annotation WithoutUvs of the effect: its techniques that draw a mesh without texture coordinates, "*" for all, and effects that do.
/// Where a texture is named, they are needed all the same.
WithoutUvs withoutUvs(const RunInput& input, const Prepared& prepared) {
    WithoutUvs without;
    if (const auto& global = input.effect.standardsGlobal) without.instead = global->annotations.string("WithoutUvs").value_or("");
    const bool textured = !input.options.textures.empty() || !input.workspace.textures.empty();
    for (std::string_view rest = without.instead; !rest.empty() && !textured;) {
        const std::size_t comma = rest.find(',');
        const std::string_view name = trim(rest.substr(0, comma));
        without.drawn |= name == "*" || name == prepared.plan.technique->name;
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    }
    return without;
}

Result<void> checkDraws(const RunInput& input, Prepared& prepared) {
    const WithoutUvs without = withoutUvs(input, prepared);
    for (const Step& step : prepared.plan.steps) {
        const auto* draw = std::get_if<DrawStep>(&step);
        if (!draw || draw->kind == DrawKind::Buffer || draw->kind == DrawKind::Compute) continue;
        prepared.drawsMesh = true;
        if (const auto checked = checkMesh(*draw->pass, prepared.programs.at(draw->pass)->vertex.reflection, input.mesh, without); !checked)
            return checked;
    }
    return {};
}

/// Every number that a shader reads has a value; loop indices and the target's size get theirs at each draw.
Result<void> checkNumbers(const RunInput& input, const Prepared& prepared) {
    std::set<std::string> written;
    for (const Step& step : prepared.plan.steps)
        if (const auto* draw = std::get_if<DrawStep>(&step))
            for (const auto& entry : draw->written)
                written.insert(entry.first);
    for (const auto& [pass, program] : prepared.programs)
        for (const std::string& name : program->numbers) {
            const Parameter* parameter = input.effect.findParameter(name);
            if (!parameter)
                return inputError(4005, pass->at,
                                  fmt::format("pass {} reads {}, which the effect does not declare outside FX_ENTRY", pass->name, name),
                                  "declare it outside the #ifdef");
            if (written.contains(name) || isViewportSize(*parameter)) continue;
            if (const auto value = prepared.values.require(*parameter); !value) return value.error();
        }
    return {};
}

/// Normals and Stretch maps follow such a world, and all that is in mm; what a normal map or a coat holds of the mesh itself does not.
void warnUneven(const RunInput& input, Prepared& prepared) {
    if (!input.placed || isEvenlyScaled(input.placed->placement)) return;
    const glm::vec3& scale = input.placed->placement.scale;
    prepared.warnings.push_back(inputWarning(4053, {.file = input.effect.file.string()},
                                             fmt::format("the mesh is scaled by {:g}, {:g}, {:g}: unevenly", scale.x, scale.y, scale.z),
                                             "maps that were made of the mesh keep its own measures: scale the mesh before they are made"));
}

/// Techniques that are gone leave their names to those that draw in their place.
void warnOfFormerName(const RunInput& input, Prepared& prepared) {
    const std::string& asked = input.options.technique;
    const Technique* drawn = asked.empty() ? nullptr : input.effect.findTechnique(asked);
    if (drawn == nullptr || equalsIgnoreCase(drawn->name, asked)) return;
    prepared.warnings.push_back(inputWarning(4082, drawn->at, fmt::format("technique {} is gone: {} is drawn", asked, drawn->name)));
}

void gatherReads(Prepared& prepared) {
    prepared.reads = prepared.plan.read;
    for (const auto& [pass, program] : prepared.programs) {
        prepared.reads.insert(program->numbers.begin(), program->numbers.end());
        for (const char* name : {"Instances", "GroupCount"})
            if (const auto count = pass->annotations.string(name)) prepared.reads.insert(*count);
    }
}

} // namespace

std::array<float, 4> background(const Workspace& workspace) {
    return {workspace.background.x, workspace.background.y, workspace.background.z, 0};
}

PlacedScene placeObjects(const Workspace& workspace, std::span<const RunObject> objects) {
    std::vector<PlacedMesh> meshes;
    for (const RunObject& object : objects)
        meshes.push_back({.mesh = object.mesh, .placement = object.placement});
    return placeScene(workspace, boundsOfAll(meshes));
}

Result<Prepared> prepare(const RunInput& input) {
    if (const auto checked = checkSize(input); !checked) return checked.error();
    if (const auto checked = checkTextureNames(input); !checked) return checked.error();
    Prepared prepared;
    const Extent picture{static_cast<std::uint32_t>(input.options.width), static_cast<std::uint32_t>(input.options.height)};
    prepared.scene = input.placed ? viewScene(*input.placed, *input.mesh, picture) : viewScene(input.workspace, input.mesh, picture);
    const ValueSources sources{.set = &input.options.parameters,
                               .workspace = &input.workspace.parameters,
                               .workspaceFile = input.workspace.file.string(),
                               .scene = &prepared.scene};
    warnUneven(input, prepared);
    warnOfFormerName(input, prepared);
    auto values = Values::resolve(input.effect, sources, prepared.warnings);
    if (!values) return values.error();
    prepared.values = std::move(*values);
    auto plan = planFrame(input.effect, input.options.technique, prepared.values, background(input.workspace));
    if (!plan) return plan.error();
    prepared.plan = std::move(*plan);
    for (const auto step : {compilePasses, describeTargets, complete, checkDraws})
        if (const auto done = step(input, prepared); !done) return done.error();
    if (const auto checked = checkNumbers(input, prepared); !checked) return checked.error();
    gatherReads(prepared);
    return prepared;
}

} // namespace tegument::run
