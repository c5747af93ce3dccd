#include "meshprep/human/head_surface.h"

#include "meshprep/human/atlas.h"
#include "meshprep/human/cut.h"
#include "meshprep/human/exterior.h"
#include "meshprep/human/subdivide.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tegument {

namespace {

constexpr std::size_t kLeastHiddenPatch = 12; // coarse quads: a smaller unseen patch is a fold of the surface, not an inner space
constexpr float kSkinRim = 8;                 // mm of unseen skin that stay behind lips and lids, against gaps at their corners
constexpr float kEyeRim = 2;                  // mm; an eyeball needs less: the lids lie on it
constexpr double kEyeDensity = 2;             // the iris is small, and the first thing that is looked at
constexpr double kBaseDensity = 0.25;         // nobody looks at the bottom

/// The limit surface of a control sphere lies inside it; the eyelids were modelled against the control points. The cornea is added.
void restoreEyes(const Bust& bust, Subdivided& fine) {
    std::array<std::vector<std::uint32_t>, 2> vertices;
    for (const Quad& quad : fine.quads) {
        const BustPart part = bust.parts[fine.parents[static_cast<std::size_t>(&quad - fine.quads.data())]];
        if (part == BustPart::Skin) continue;
        auto& list = vertices[part == BustPart::LeftEye ? 0 : 1];
        list.insert(list.end(), quad.position.begin(), quad.position.end());
    }
    for (std::size_t e = 0; e < 2; ++e) {
        std::ranges::sort(vertices[e]);
        vertices[e].erase(std::unique(vertices[e].begin(), vertices[e].end()), vertices[e].end());
        for (const std::uint32_t v : vertices[e]) {
            const glm::vec3 outward = glm::normalize(fine.positions[v] - bust.eyes[e].centre);
            fine.positions[v] = bust.eyes[e].centre + outward * eyeSurface(bust.eyes[e], outward);
            fine.normals[v] = eyeNormal(bust.eyes[e], outward);
        }
    }
}

/// A coarse quad counts as seen when any of its children is.
std::vector<std::uint8_t> hiddenCoarseQuads(const Bust& bust, const Subdivided& fine) {
    const std::vector<std::uint8_t> fineSeen = seenFromOutside(fine.positions, fine.quads);
    std::vector<std::uint8_t> seen(bust.quads.size(), 0);
    for (std::size_t q = 0; q < fine.quads.size(); ++q)
        if (fineSeen[q] != 0) seen[fine.parents[q]] = 1;
    std::vector<std::uint8_t> hidden = hiddenPatches(bust.positions, bust.quads, seen, kLeastHiddenPatch, kSkinRim);
    const std::vector<std::uint8_t> hiddenEyes = hiddenPatches(bust.positions, bust.quads, seen, kLeastHiddenPatch, kEyeRim);
    for (std::size_t q = 0; q < hidden.size(); ++q)
        if (bust.parts[q] != BustPart::Skin) hidden[q] = hiddenEyes[q];
    return hidden;
}

/// Two triangles for each quad that stays.
TriangleSurface keptTriangles(const Bust& bust, const Subdivided& fine, const std::vector<std::uint8_t>& hidden) {
    constexpr std::array<std::array<std::size_t, 3>, 2> kHalves = {{{0, 1, 2}, {0, 2, 3}}};
    TriangleSurface surface{.positions = fine.positions, .normals = fine.normals, .uvs = fine.uvs};
    for (std::size_t q = 0; q < fine.quads.size(); ++q) {
        const std::uint32_t parent = fine.parents[q];
        if (bust.support[parent] != 0 || hidden[parent] != 0) continue;
        for (const auto& half : kHalves) {
            CornerTriangle triangle{.part = bust.parts[parent]};
            for (std::size_t c = 0; c < 3; ++c) {
                triangle.position[c] = fine.quads[q].position[half[c]];
                triangle.uv[c] = fine.quads[q].uv[half[c]];
            }
            surface.triangles.push_back(triangle);
        }
    }
    return surface;
}

double triangleArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return static_cast<double>(glm::length(glm::cross(b - a, c - a))) / 2;
}

double densityOf(BustPart part) {
    switch (part) {
    case BustPart::Skin: return 1;
    case BustPart::Base: return kBaseDensity;
    default: return kEyeDensity;
    }
}

class HeadBuilder {
public:
    HeadBuilder(const TriangleSurface& surface)
        : surface_(surface), chartOf_(chartsOf(surface.triangles)), plane_(unfoldCharts(surface, chartOf_)) {}

    Result<HeadSurface> build(double gutter) {
        collectCharts();
        placements_ = packCharts(charts_, gutter);
        if (placements_.empty())
            return inputError(7007, {}, "the charts cannot be packed into the unit square",
                              "some chart has no area in the file's texture coordinates");
        for (const bool eyes : {false, true})
            addPart(eyes);
        addNotes();
        head_.mesh.name = "human";
        head_.mesh.attribution = "MakeHuman base mesh, CC0";
        computeTangents(head_.mesh);
        computeBounds(head_.mesh);
        return std::move(head_);
    }

private:
    static bool isEye(BustPart part) { return part == BustPart::LeftEye || part == BustPart::RightEye; }

    void collectCharts() {
        charts_.resize(std::size_t{1} + std::ranges::max(chartOf_));
        for (std::size_t t = 0; t < chartOf_.size(); ++t) {
            const CornerTriangle& triangle = surface_.triangles[t];
            AtlasChart& chart = charts_[chartOf_[t]];
            std::array<glm::vec3, 3> p{};
            std::array<glm::vec2, 3> uv{};
            for (std::size_t c = 0; c < 3; ++c) {
                p[c] = surface_.positions[triangle.position[c]];
                uv[c] = plane_[triangle.uv[c]];
            }
            chart.triangles.push_back(uv);
            chart.surfaceMm2 += triangleArea(p[0], p[1], p[2]);
            chart.density = densityOf(triangle.part);
        }
    }

    std::uint32_t vertexOf(std::uint32_t position, std::uint32_t uv, const Placement& placement) {
        const auto [entry, isNew] = vertices_.try_emplace({position, uv}, static_cast<std::uint32_t>(head_.mesh.positions.size()));
        if (isNew) {
            const glm::vec2 placed = placement(plane_[uv]);
            head_.mesh.positions.push_back(surface_.positions[position]);
            head_.mesh.normals.push_back(surface_.normals[position]);
            head_.mesh.uvs.emplace_back(placed.x, 1 - placed.y);
        }
        return entry->second;
    }

    void addPart(bool eyes) {
        MeshPart part{.name = eyes ? "eyes" : "skin", .firstIndex = static_cast<std::uint32_t>(head_.mesh.indices.size())};
        for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
            const CornerTriangle& triangle = surface_.triangles[t];
            if (isEye(triangle.part) != eyes) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                head_.mesh.indices.push_back(vertexOf(triangle.position[c], triangle.uv[c], placements_[chartOf_[t]]));
                head_.sourceUvs.push_back(surface_.uvs[triangle.uv[c]]);
            }
            head_.parts.push_back(triangle.part);
            part.indexCount += 3;
        }
        head_.mesh.parts.push_back(part);
    }

    void addNotes() {
        double skinMm2 = 0;
        double skinAtlas = 0;
        for (std::size_t i = 0; i < charts_.size(); ++i) {
            const double area = chartArea(charts_[i]) * placements_[i].scale * placements_[i].scale;
            head_.chartNotes.push_back(fmt::format("chart {}: {:.0f} mm2, {:.1f} % of the atlas, {:.2f} texels/mm at 1024", i + 1,
                                                   charts_[i].surfaceMm2, 100 * area, 1024 * std::sqrt(area / charts_[i].surfaceMm2)));
            if (charts_[i].density != densityOf(BustPart::Skin)) continue;
            skinMm2 += charts_[i].surfaceMm2;
            skinAtlas += area;
        }
        head_.texelsPerMmAt1024 = 1024 * std::sqrt(skinAtlas / skinMm2);
    }

    const TriangleSurface& surface_;
    std::vector<std::uint32_t> chartOf_; // of each triangle
    std::vector<glm::vec2> plane_;       // of each texture coordinate
    std::vector<AtlasChart> charts_;
    std::vector<Placement> placements_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertices_;
    HeadSurface head_;
};

/// The lowest point of the middle of the face: below the eyes, no farther back than their centres.
float chinHeight(const Bust& bust, const Subdivided& fine) {
    constexpr float kMiddle = 5; // mm to either side
    float chin = bust.eyes[0].centre.y;
    for (std::size_t q = 0; q < fine.quads.size(); ++q) {
        if (bust.parts[fine.parents[q]] != BustPart::Skin) continue;
        for (const std::uint32_t v : fine.quads[q].position) {
            const glm::vec3& p = fine.positions[v];
            if (std::abs(p.x) < kMiddle && p.z > bust.eyes[0].centre.z) chin = std::min(chin, p.y);
        }
    }
    return chin;
}

float crownHeight(const std::vector<glm::vec3>& positions) {
    return std::ranges::max_element(positions, {}, &glm::vec3::y)->y;
}

} // namespace

Result<HeadSurface> makeHeadSurface(const Bust& bust, const HeadSurfaceOptions& options) {
    Result<Subdivided> fine = subdivide(bust.positions, bust.uvs, bust.quads, options.subdivisionLevels);
    if (!fine) return fine.error();
    restoreEyes(bust, *fine);
    const std::vector<std::uint8_t> hidden = hiddenCoarseQuads(bust, *fine);
    TriangleSurface surface = keptTriangles(bust, *fine, hidden);
    const float chin = chinHeight(bust, *fine);
    cutBelow(surface, chin - options.neckMm);
    closeBase(surface, chin - options.neckMm);
    Result<HeadSurface> head = HeadBuilder(surface).build(options.gutter);
    if (!head) return head;
    head->eyes = bust.eyes;
    head->chinHeight = chin;
    head->chinToCrownMm = crownHeight(fine->positions) - chin;
    head->coarseQuads = static_cast<std::size_t>(std::ranges::count(bust.support, 0));
    head->hiddenQuads = static_cast<std::size_t>(std::ranges::count(hidden, 1));
    return head;
}

} // namespace tegument
