#include "host/run/program.h"

#include "host/effect/entry_points.h"
#include "host/run/geometry.h"
#include "host/spirv/reflect.h"
#include "host/support/parallel.h"
#include "host/support/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>

namespace tegument::run {

namespace {

StageKey keyOf(const ShaderReference& reference, ShaderStage stage) {
    return {.stage = stage, .entry = reference.entry, .code = reference.code};
}

Result<Shader> madeOf(const Effect& effect, const StageKey& key, Compiler compiler, const Stages& stages) {
    const auto found = stages.find(key);
    return found != stages.end() ? found->second : compileStage(effect, key, compiler);
}

BindingKind kindOf(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::Sampler:
    case ResourceKind::CompareSampler: return BindingKind::Sampler;
    case ResourceKind::StorageBuffer: return BindingKind::StorageBuffer;
    case ResourceKind::StorageImage: return BindingKind::StorageTexture;
    default: return BindingKind::Texture;
    }
}

void gatherBlock(const UniformBlock& block, PassProgram& program) {
    program.bindings.push_back({block.set, block.binding, BindingKind::UniformBuffer});
    for (const BlockMember& member : block.members)
        if (member.used) program.numbers.insert(member.name);
}

/// Asked only where there is a sampler that compares.
void gatherCompared(const Shader& shader, PassProgram& program) {
    const auto pictures = spirv::comparedPictures(shader.spirv);
    for (const Resource& resource : shader.reflection.resources)
        if (pictures.contains({resource.set, resource.binding})) program.use.compared.insert(resource.name);
}

void gather(const Shader& shader, PassProgram& program) {
    for (const UniformBlock* block : blocksOf(shader.reflection))
        gatherBlock(*block, program);
    for (const Resource& resource : shader.reflection.resources) {
        if (!resource.used) continue;
        const BindingKind kind = kindOf(resource.kind);
        program.bindings.push_back({resource.set, resource.binding, kind});
        if (kind == BindingKind::Texture) program.use.sampled.insert(resource.name);
        if (kind == BindingKind::Sampler) program.samplers.insert(resource.name);
        if (resource.kind == ResourceKind::CompareSampler) gatherCompared(shader, program);
    }
}

/// What the shaders write besides their targets.
Result<void> gatherStored(const Effect& effect, const Pass& pass, const Reflection& reflection, PassProgram& program) {
    for (const Resource& resource : reflection.resources) {
        if (!resource.used || resource.kind != ResourceKind::StorageImage) continue;
        if (!pass.computeShader)
            return inputError(4003, pass.at, fmt::format("pass {} writes {} while it draws", pass.name, resource.name),
                              "this host writes such textures from compute shaders");
        const StorageTexture* storage = effect.findStorage(resource.name);
        if (!storage || !storage->target)
            return inputError(4062, storage ? storage->at : pass.at,
                              fmt::format("pass {} writes {}, and no target stands behind it", pass.name, resource.name),
                              "gXStore writes the target gXMap; or name another with the annotation Stores");
        if (!program.use.stored.insert(storage->target->empty() ? kPicture : *storage->target).second)
            return inputError(4024, storage->at,
                              fmt::format("pass {} writes one target as {} and by another name", pass.name, resource.name),
                              "write each target by one name");
    }
    return {};
}

Result<PassProgram> compileCompute(const Effect& effect, const Pass& pass, Compiler compiler, const Stages& stages) {
    PassProgram program;
    auto compute = madeOf(effect, keyOf(*pass.computeShader, ShaderStage::Compute), compiler, stages);
    if (!compute) return compute.error();
    program.compute = std::move(*compute);
    gather(*program.compute, program);
    if (const auto stored = gatherStored(effect, pass, program.compute->reflection, program); !stored) return stored.error();
    return program;
}

} // namespace

std::vector<const UniformBlock*> blocksOf(const Reflection& reflection) {
    std::vector<const UniformBlock*> blocks;
    if (reflection.globals) blocks.push_back(&*reflection.globals);
    for (const UniformBlock& block : reflection.constantBuffers)
        blocks.push_back(&block);
    return blocks;
}

namespace {

/// OpKill, OpTerminateInvocation or OpDemoteToHelperInvocation stands in the module.
bool discardsPixels(const std::vector<std::uint32_t>& spirv) {
    constexpr std::size_t kHeader = 5; // words
    constexpr std::array<std::uint32_t, 3> kEnds = {252, 4416, 5380};
    for (std::size_t at = kHeader; at < spirv.size(); at += std::max<std::size_t>(1, spirv[at] >> 16U))
        if (std::ranges::find(kEnds, spirv[at] & 0xffffU) != kEnds.end()) return true;
    return false;
}

} // namespace

std::vector<StageKey> stagesOf(const std::vector<const Pass*>& passes) {
    std::vector<const Pass*> drawn;
    for (const Pass* pass : passes) {
        if (!drawable(*pass)) break;
        drawn.push_back(pass);
    }
    std::vector<StageKey> keys;
    for (const ShaderUse& use : entryPoints(drawn))
        keys.push_back(keyOf(*use.shader, use.stage));
    return keys;
}

unsigned threadsToCompile() {
    constexpr unsigned kAtOnce = 8; // each takes some 20 MB
    return std::min(availableThreads(), kAtOnce);
}

Result<Shader> compileStage(const Effect& effect, const StageKey& key, Compiler compiler) {
    const bool own = !key.code.empty();
    const ShaderRequest request{.code = own ? key.code : effect.code,
                                .file = effect.file.string(),
                                .entry = std::string(key.entry),
                                .stage = key.stage,
                                .language2018 = own || effect.reshade};
    auto shader = compileShader(request, compiler);
    if (shader) return shader;
    Error error = shader.error();
    for (Diagnostic& diagnostic : error.diagnostics) // SPIR-V knows names, and no lines
        if (diagnostic.code == 3006 && diagnostic.at.line == 0)
            for (const Parameter& parameter : effect.parameters)
                if (diagnostic.text.find(" " + parameter.name + " ") != std::string::npos) diagnostic.at = parameter.at;
    return error;
}

Stages compileStages(const Effect& effect, std::span<const StageKey> keys, Compiler compiler, const std::function<void()>& done) {
    Stages stages;
    std::mutex mutex;
    forEachInParallel(
        keys.size(),
        [&](std::size_t item) {
            auto shader = compileStage(effect, keys[item], compiler);
            const std::scoped_lock lock(mutex);
            stages.emplace(keys[item], std::move(shader));
            if (done) done();
        },
        {}, threadsToCompile());
    return stages;
}

Result<PassProgram> compilePass(const Effect& effect, const Pass& pass, Compiler compiler, const Stages& stages) {
    if (const auto checked = drawable(pass); !checked) return checked.error();
    if (pass.computeShader) return compileCompute(effect, pass, compiler, stages);
    PassProgram program;
    auto vertex = madeOf(effect, keyOf(*pass.vertexShader, ShaderStage::Vertex), compiler, stages);
    if (!vertex) return vertex.error();
    program.vertex = std::move(*vertex);
    if (!spirv::writesPosition(program.vertex.spirv)) return writesNoPosition(pass.vertexShader->entry, pass.vertexShader->at);
    if (pass.pixelShader) {
        auto pixel = madeOf(effect, keyOf(*pass.pixelShader, ShaderStage::Pixel), compiler, stages);
        if (!pixel) return pixel.error();
        program.pixel = std::move(*pixel);
        if (const auto linked = linkStages(program.vertex, *program.pixel); !linked) return linked.error();
    }
    auto attributes = bindStream(pass, program.vertex.reflection);
    if (!attributes) return attributes.error();
    program.attributes = std::move(*attributes);
    gather(program.vertex, program);
    if (program.pixel) {
        gather(*program.pixel, program);
        program.use.discards = discardsPixels(program.pixel->spirv);
        for (const StageVariable& output : program.pixel->reflection.outputs)
            program.use.writtenColors |= 1U << output.location;
        if (const auto stored = gatherStored(effect, pass, program.pixel->reflection, program); !stored) return stored.error();
    }
    return program;
}

} // namespace tegument::run
