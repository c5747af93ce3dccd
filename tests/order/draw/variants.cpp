#include "tests/order/draw/variants.h"

#include "meshprep/prepare/vertices.h"

#include <fmt/format.h>

namespace tegument::testing_order {

namespace {

std::vector<Vertex> interleaved(const Mesh& mesh) {
    std::vector<Vertex> out(mesh.positions.size());
    for (std::size_t v = 0; v < out.size(); ++v)
        out[v] = {.position = mesh.positions[v], .normal = mesh.normals[v]};
    return out;
}

Variant indexed(const std::string& name, const Mesh& mesh) {
    return {.name = name,
            .vertices = interleaved(mesh),
            .indices = mesh.indices,
            .acmr = order::measure(order::fifo(16), mesh.indices, mesh.positions.size()).acmr(),
            .warpAtvr = order::measure(order::kWarp, mesh.indices, mesh.positions.size()).atvr()};
}

Variant unindexed(const Mesh& mesh) {
    Variant out{.name = "unindexed"};
    out.vertices.reserve(mesh.indices.size());
    for (const std::uint32_t v : mesh.indices)
        out.vertices.push_back({.position = mesh.positions[v], .normal = mesh.normals[v]});
    out.warpAtvr = static_cast<double>(mesh.indices.size()) / static_cast<double>(mesh.positions.size());
    return out;
}

} // namespace

Result<std::vector<Variant>> makeVariants(const Triangles& triangles) {
    Mesh mesh;
    mesh.positions = triangles.positions;
    mesh.indices = triangles.indices;
    computeNormals(mesh);
    std::vector<Variant> out = {unindexed(mesh), indexed("indexed", mesh)};
    const auto add = [&](order::Method method, const order::CacheModel& cache) -> Result<void> {
        auto ordered = order::reorder(triangles.indices, triangles.positions.size(), method, cache);
        if (!ordered) return ordered.error();
        Mesh copy = mesh;
        copy.indices = *std::move(ordered);
        prep::orderVertices(copy);
        out.push_back(indexed(fmt::format("{}, {}", order::name(method), order::name(cache)), copy));
        return {};
    };
    for (const order::Method method :
         {order::Method::LinYu, order::Method::Hoppe, order::Method::Tipsify, order::Method::Meshopt, order::Method::Best})
        if (auto done = add(method, order::fifo(16)); !done) return done.error();
    if (auto done = add(order::Method::Best, order::kWarp); !done) return done.error();
    return out;
}

} // namespace tegument::testing_order
