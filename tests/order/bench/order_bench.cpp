// How the time of each order grows: spheres from 20,000 to 10 million triangles, fans from 1,000 to 100,000 triangles round one vertex.
//
//     order_bench                                     everything; each family ends with its fitted growth (N: linear)
//     order_bench --benchmark_filter=best/Sphere      one family

#include "meshprep/order/order.h"
#include "tests/order/meshes.h"

#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include <map>

namespace tegument::order {
namespace {

using testing_order::Triangles;

const Triangles& sphere(std::int64_t detail) {
    static std::map<std::int64_t, Triangles> meshes;
    const auto at = meshes.find(detail);
    if (at != meshes.end()) return at->second;
    return meshes.emplace(detail, shuffled(*testing_order::loadTriangles("sphere:" + std::to_string(detail)), 1)).first->second;
}

Triangles fan(std::int64_t valence) {
    Triangles out{.name = "fan", .positions = std::vector<glm::vec3>(static_cast<std::size_t>(valence) + 1)};
    const auto rim = static_cast<std::uint32_t>(valence);
    for (std::uint32_t i = 0; i < rim; ++i)
        out.indices.insert(out.indices.end(), {0, 1 + i, 1 + (i + 1) % rim});
    return shuffled(out, 1);
}

void run(benchmark::State& state, const Triangles& mesh, Method method, const CacheModel& model) {
    std::size_t misses = 0;
    for ([[maybe_unused]] auto _ : state) {
        const auto out = reorder(mesh.indices, mesh.positions.size(), method, model);
        state.PauseTiming();
        misses = measure(model, *out, mesh.positions.size()).misses;
        state.ResumeTiming();
    }
    state.SetComplexityN(static_cast<benchmark::IterationCount>(mesh.faces()));
    state.counters["acmr"] = static_cast<double>(misses) / static_cast<double>(mesh.faces());
}

void runMeshoptimizer(benchmark::State& state) {
    const Triangles& mesh = sphere(state.range(0));
    std::vector<std::uint32_t> out(mesh.indices.size());
    for ([[maybe_unused]] auto _ : state)
        meshopt_optimizeVertexCache(out.data(), mesh.indices.data(), out.size(), mesh.positions.size());
    state.SetComplexityN(static_cast<benchmark::IterationCount>(mesh.faces()));
    state.counters["acmr"] = measure(fifo(16), out, mesh.positions.size()).acmr();
}

void addSpheres(benchmark::internal::Benchmark* family) {
    for (const std::int64_t detail : {32, 71, 158, 224, 354, 500, 708}) // 20 detail^2 triangles
        family->Arg(detail);
    family->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
}

void addFans(benchmark::internal::Benchmark* family) {
    for (const std::int64_t valence : {1000, 10'000, 100'000})
        family->Arg(valence);
    family->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
}

/// The families are made while the program starts: the list of methods is one place.
const bool kRegistered = [] {
    const auto add = [](const std::string& label, Method method, const CacheModel& model) {
        addSpheres(benchmark::RegisterBenchmark((label + "/Sphere").c_str(),
                                                [=](benchmark::State& state) { run(state, sphere(state.range(0)), method, model); }));
        addFans(benchmark::RegisterBenchmark((label + "/Fan").c_str(),
                                             [=](benchmark::State& state) { run(state, fan(state.range(0)), method, model); }));
    };
    for (const Method method : {Method::LinYu, Method::Hoppe, Method::Tipsify, Method::Meshopt, Method::Best})
        add(std::string(name(method)), method, fifo(16));
    add("best-warp", Method::Best, kWarp);
    add("best-lru:16", Method::Best, lru(16));
    addSpheres(benchmark::RegisterBenchmark("meshopt_optimizeVertexCache/Sphere", runMeshoptimizer));
    return true;
}();

} // namespace
} // namespace tegument::order
