#include "lab/bench/traffic.h"

#include "host/run/stage.h"
#include "lab/bench/count.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <limits>
#include <map>

namespace tegument::bench {

namespace {

/// A pass that counts.
struct CountingPass {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    std::vector<AccessCounter> counters;
    std::uint32_t writtenColors = 0; // a bit for each target
};

using CountingPasses = std::map<std::string, CountingPass>; // by name

std::uint64_t texelBytes(const gpu::Texture& texture) {
    return gpu::bytesPerPixel(texture.desc().format);
}

std::uint64_t levelBytes(const gpu::Texture& texture) {
    return texelBytes(texture) * texture.desc().width * texture.desc().height * (texture.desc().cube ? 6 : 1);
}

std::shared_ptr<const run::PassProgram> counting(const Pass& pass, const run::PassProgram& plain, CountingPasses& passes) {
    auto program = std::make_shared<run::PassProgram>(plain);
    Shader* shader = program->compute ? &*program->compute : program->pixel ? &*program->pixel : nullptr;
    if (!shader) return program;
    CountedShader counted = countAccesses(*shader);
    program->bindings.push_back({counted.set, counted.binding, BindingKind::StorageBuffer});
    passes[pass.name] = {.set = counted.set,
                         .binding = counted.binding,
                         .counters = std::move(counted.counters),
                         .writtenColors = program->use.writtenColors};
    *shader = std::move(counted.shader);
    return program;
}

/// Puts passes that count in the place of those that are compiled.
CountingPasses makeCount(run::Kit& kit) {
    CountingPasses passes;
    for (auto& [pass, program] : kit.programs)
        program = counting(*pass, *program, passes);
    kit.pipelines.clear();
    kit.computes.clear();
    return passes;
}

const gpu::Texture* textureAt(const run::FrameDraw& draw, const AccessCounter& counter) {
    for (const gpu::BoundResource& bound : draw.draw.resources) {
        if (bound.set != counter.set || bound.binding != counter.binding) continue;
        if (const auto* texture = std::get_if<gpu::Texture*>(&bound.resource)) return *texture;
        if (const auto* stored = std::get_if<gpu::StoredTexture>(&bound.resource)) return stored->texture;
    }
    return nullptr;
}

std::uint64_t writtenBy(const run::FrameDraw& draw, const CountingPass& pass) {
    std::uint64_t bytes = draw.targets.depth ? texelBytes(*draw.targets.depth) : 0;
    for (std::size_t slot = 0; slot < draw.targets.colors.size(); ++slot)
        if ((pass.writtenColors >> slot & 1U) != 0) bytes += texelBytes(*draw.targets.colors[slot]);
    return bytes;
}

Traffic trafficOf(const run::FrameDraw& draw, const CountingPass& pass, const std::vector<std::uint32_t>& numbers) {
    Traffic traffic{.pass = draw.described.name};
    for (std::size_t i = 0; i < pass.counters.size(); ++i) {
        const AccessCounter& counter = pass.counters[i];
        const std::uint64_t count = numbers[i];
        if (counter.access == Access::Call) {
            traffic.calls = count;
            traffic.written += count * writtenBy(draw, pass);
            continue;
        }
        const gpu::Texture* texture = textureAt(draw, counter);
        if (counter.access == Access::Write) {
            traffic.written += texture ? count * texelBytes(*texture) : 0;
            continue;
        }
        traffic.fetches += count;
        traffic.read += texture ? std::min(count * texelBytes(*texture), levelBytes(*texture)) : 0;
    }
    return traffic;
}

void sumUp(std::vector<Traffic>& all, const Traffic& one) {
    const auto found = std::ranges::find(all, one.pass, &Traffic::pass);
    if (found == all.end()) {
        all.push_back(one);
        return;
    }
    found->calls += one.calls;
    found->fetches += one.fetches;
    found->read += one.read;
    found->written += one.written;
}

/// A draw of the frame, and the buffer that its shader counts in.
struct CountedDraw {
    run::FrameDraw* draw = nullptr;
    const CountingPass* pass = nullptr;
    gpu::Buffer numbers;
};

Result<std::deque<CountedDraw>> giveBuffers(gpu::Device& device, run::Frame& frame, const CountingPasses& passes) {
    std::deque<CountedDraw> counted;
    for (run::FrameItem& item : frame.items) {
        auto* draw = std::get_if<run::FrameDraw>(&item);
        if (!draw || !passes.contains(draw->described.name)) continue;
        const CountingPass& pass = passes.at(draw->described.name);
        const std::vector<std::byte> zeros(pass.counters.size() * sizeof(std::uint32_t));
        auto buffer = device.createBuffer(gpu::BufferUsage::Storage, zeros);
        if (!buffer) return buffer.error();
        counted.push_back({.draw = draw, .pass = &pass, .numbers = std::move(*buffer)});
        draw->draw.resources.push_back({pass.set, pass.binding, &counted.back().numbers});
    }
    return counted;
}

} // namespace

Result<std::vector<Traffic>> trafficOf(gpu::Device& device, const Contest& contest, const Contender& contender) {
    const auto effect = loadContender(contest, contender);
    if (!effect) return effect.error();
    run::Stage stage(device, *effect, SessionScene{.mesh = &contest.scene.mesh});
    const RunOptions options = runOptionsOf(contest, contender);
    if (const auto compiled = stage.prepare(contest.scene.workspace, options); !compiled) return compiled.error();
    const CountingPasses passes = makeCount(stage.resources().kit);
    auto staged = stage.prepare(contest.scene.workspace, options);
    if (!staged) return staged.error();
    auto counted = giveBuffers(device, staged->frame, passes);
    if (!counted) return counted.error();
    if (const auto drawn = stage.draw(*staged, std::numeric_limits<std::size_t>::max()); !drawn) return drawn.error();
    std::vector<Traffic> all;
    for (CountedDraw& one : *counted) {
        const auto bytes = device.readback(one.numbers);
        if (!bytes) return bytes.error();
        std::vector<std::uint32_t> numbers(one.pass->counters.size());
        std::memcpy(numbers.data(), bytes->data(), bytes->size());
        sumUp(all, trafficOf(*one.draw, *one.pass, numbers));
    }
    return all;
}

} // namespace tegument::bench
