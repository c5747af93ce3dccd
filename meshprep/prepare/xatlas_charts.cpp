// Charts by xatlas. Its source is part of this one (CMakeLists.txt says with which change), so that charts are taken from it as they are
// laid out: packing, the only other way to them, rounds each to whole texels, and does not return from a chart without a border.

#include "meshprep/prepare/same_angles.h"

#include <xatlas_pieces.cpp>

#include "meshprep/prepare/charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <unordered_map>

namespace tegument::prep {

namespace {

using Atlas = std::unique_ptr<xatlas::Atlas, decltype(&xatlas::Destroy)>;

/// Maps of light are 1024 texels wide by default; a blurred texel of one chart must not be read by another.
constexpr std::uint32_t kTexels = 1024;
constexpr std::uint32_t kGutter = 4;
/// Diffusion ends at the border of a chart, so few large charts are better than many without stretch, which the Stretch map takes care of.
constexpr float kMostCost = 16;
constexpr std::uint32_t kRounds = 1; // more take longer and leave as many

/// A piece by itself, every point once: vertices that differ only in their normals do not cut a chart. Its numbers are floats, and xatlas
/// compares areas with a millionth: sizes are such that triangles have about an area of 1.
struct Piece {
    std::vector<glm::vec3> places;
    std::vector<std::uint32_t> corners;
};

Piece pieceOf(const Triangles& triangles, const Faces& faces) {
    Piece piece;
    double area = 0;
    for (const std::uint32_t face : faces)
        area += triangles.area(face);
    const double scale = 1 / std::sqrt(area / static_cast<double>(faces.size()));
    const glm::dvec3 origin = triangles.place(faces.front(), 0);
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (const std::uint32_t face : faces)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto [entry, isNew] = numbers.try_emplace(triangles.point(face, corner), static_cast<std::uint32_t>(piece.places.size()));
            if (isNew) piece.places.emplace_back((triangles.place(face, corner) - origin) * scale);
            piece.corners.push_back(entry->second);
        }
    return piece;
}

Chart chartOf(const xatlas::internal::param::Chart& from, const Triangles& triangles, const Faces& piece) {
    const xatlas::internal::Mesh& mesh = *from.unifiedMesh();
    Chart chart;
    for (std::uint32_t f = 0; f < mesh.faceCount(); ++f) {
        chart.faces.push_back(piece[from.mapFaceToSourceFace(f)]);
        std::array<glm::dvec2, 3>& places = chart.places.emplace_back();
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const xatlas::internal::Vector2& at = mesh.texcoord(mesh.vertexAt(3 * f + corner));
            places[corner] = {at.x, at.y};
        }
    }
    scaleToSurface(triangles, chart);
    return chart;
}

/// Charts as xatlas packs them, in texels: each triangle has vertices of its chart. Charts begin at places of their own, because xatlas
/// looks up what is at one place.
struct Layout {
    std::vector<glm::vec2> places;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> owners; // of each triangle
};

Layout layoutOf(std::span<const Chart> charts) {
    double area = 0;
    for (const Chart& chart : charts)
        for (const auto& [p, q, r] : chart.places)
            area += std::abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / 2;
    const double scale = kTexels / std::sqrt(area);
    struct Less {
        bool operator()(const glm::dvec2& a, const glm::dvec2& b) const { return a.x < b.x || (a.x == b.x && a.y < b.y); }
    };
    Layout layout;
    for (std::size_t c = 0; c < charts.size(); ++c) {
        constexpr double kTurn = 0.7548776662466927; // 1 over the plastic number, whose powers spread points evenly
        const glm::dvec2 turns = static_cast<double>(c) * glm::dvec2(kTurn, kTurn * kTurn);
        const glm::dvec2 apart = 64.0 * (turns - glm::floor(turns));
        const glm::dvec2 first = charts[c].places.front()[0];
        std::map<glm::dvec2, std::uint32_t, Less> numbers;
        for (const auto& places : charts[c].places) {
            for (const glm::dvec2& place : places) {
                const auto [entry, isNew] = numbers.try_emplace(place, static_cast<std::uint32_t>(layout.places.size()));
                if (isNew) layout.places.emplace_back((place - first) * scale + apart);
                layout.corners.push_back(entry->second);
            }
            layout.owners.push_back(static_cast<std::uint32_t>(c));
        }
    }
    return layout;
}

} // namespace

std::vector<Chart> xatlasCharts(const Triangles& triangles, const Faces& faces) {
    const Piece piece = pieceOf(triangles, faces);
    const Atlas atlas(xatlas::Create(), xatlas::Destroy);
    xatlas::MeshDecl decl;
    decl.vertexPositionData = piece.places.data();
    decl.vertexPositionStride = sizeof(glm::vec3);
    decl.vertexCount = static_cast<std::uint32_t>(piece.places.size());
    decl.indexData = piece.corners.data();
    decl.indexCount = static_cast<std::uint32_t>(piece.corners.size());
    decl.indexFormat = xatlas::IndexFormat::UInt32;
    if (xatlas::AddMesh(atlas.get(), decl, 1) != xatlas::AddMeshError::Success) return {};
    xatlas::ChartOptions options;
    options.maxCost = kMostCost;
    options.maxIterations = kRounds;
    xatlas::ComputeCharts(atlas.get(), options);
    std::vector<Chart> charts;
    const xatlas::internal::param::Atlas& made = reinterpret_cast<xatlas::Context*>(atlas.get())->paramAtlas;
    for (std::uint32_t group = 0; group < made.chartGroupCount(0); ++group)
        for (std::uint32_t i = 0; i < made.chartGroupAt(0, group)->chartCount(); ++i)
            charts.push_back(chartOf(*made.chartGroupAt(0, group)->chartAt(i), triangles, faces));
    return charts;
}

Packing pack(std::span<const Chart> charts) {
    const Layout layout = layoutOf(charts);
    const Atlas atlas(xatlas::Create(), xatlas::Destroy);
    xatlas::UvMeshDecl decl;
    decl.vertexUvData = layout.places.data();
    decl.vertexStride = sizeof(glm::vec2);
    decl.vertexCount = static_cast<std::uint32_t>(layout.places.size());
    decl.indexData = layout.corners.data();
    decl.indexCount = static_cast<std::uint32_t>(layout.corners.size());
    decl.indexFormat = xatlas::IndexFormat::UInt32;
    decl.faceMaterialData = layout.owners.data();
    if (xatlas::AddUvMesh(atlas.get(), decl) != xatlas::AddMeshError::Success) return {};
    xatlas::ComputeCharts(atlas.get());
    xatlas::PackOptions options;
    options.resolution = kTexels;
    options.padding = kGutter;
    xatlas::PackCharts(atlas.get(), options);
    if (atlas->meshCount != 1 || atlas->meshes[0].vertexCount != layout.places.size()) return {};
    const double side = std::max({atlas->width, atlas->height, 1U});
    Packing packing;
    std::size_t corner = 0;
    for (const Chart& chart : charts) {
        auto& places = packing.places.emplace_back(chart.faces.size());
        glm::dvec2 last(0); // where triangles go that are too thin for xatlas, which leaves them out
        for (auto& triangle : places)
            for (glm::dvec2& place : triangle) {
                const xatlas::Vertex& vertex = atlas->meshes[0].vertexArray[layout.corners[corner++]];
                if (vertex.chartIndex >= 0) last = glm::dvec2(vertex.uv[0], vertex.uv[1]) / side;
                place = last;
            }
    }
    return packing;
}

} // namespace tegument::prep
