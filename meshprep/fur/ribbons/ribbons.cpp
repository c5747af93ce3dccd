#include "meshprep/fur/ribbons/ribbons.h"

#include "host/mesh/triangles.h"
#include "host/support/parallel.h"
#include "meshprep/fur/ribbons/below.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tegument {

namespace {

constexpr float kRows = 31;       // steps of a vertex's place along its strand
constexpr float kColorSteps = 31; // of each channel's root
constexpr float kShortSteps = 15;

/// Where a ribbon's rows stand: closer at the tip, which bends most and is what one sees. Whole steps of kRows.
std::vector<float> rowsOf(int segments) {
    std::vector<float> rows;
    for (int i = 0; i <= segments; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(segments);
        rows.push_back(std::round(kRows * (t + 0.25F * t * (1 - t))));
    }
    return rows;
}

/// One at each point of a curve, which a shader finds from its place: places are whole steps, and points are no closer than these.
std::vector<float> rowsOf(const RibbonCurves& curves) {
    std::vector<float> rows;
    for (std::size_t i = 0; i < curves.points; ++i)
        rows.push_back(std::round(kRows * static_cast<float>(i) / static_cast<float>(curves.points - 1)));
    return rows;
}

Result<void> check(const Mesh& mesh, const RibbonOptions& options) {
    if (options.segments < 1 || options.segments > kMostSegments)
        return usageError(7103, fmt::format("a ribbon of {} segments", options.segments), fmt::format("use 1 to {}", kMostSegments));
    if (options.cluster < 1) return usageError(7103, "clusters of 0 roots", "use about 1000");
    if (!(glm::length(options.down) > 0)) return usageError(7103, "down has no direction", "give a vector such as 0 -1 0");
    const std::pair<const char*, const std::optional<FurMap>*> maps[] = {
        {"flow", &options.flowMap}, {"colour", &options.colorMap}, {"region", &options.regionMap}};
    for (const auto& [name, map] : maps)
        if (*map && (*map)->needsUvs() && mesh.uvs.empty())
            return usageError(7106, fmt::format("the {} map is a flat picture, but the mesh has no texture coordinates", name),
                              "give a cube map (DDS with six faces), looked up by the direction from the mesh's centre");
    return {};
}

/// What each root's ribbon is, beside its place.
struct Looks {
    std::vector<glm::vec3> direction;
    std::vector<float> shortness;
    std::vector<glm::vec3> color;
};

glm::vec3 colorAt(const FurMap& map, bool encoded, const FurSurface& surface, const SurfacePoint& point) {
    const glm::vec3 stored(map.at(surface, point));
    return encoded ? glm::vec3(srgbToLinear(stored.x), srgbToLinear(stored.y), srgbToLinear(stored.z)) : stored;
}

Looks looksOf(const RootedMesh& rooted, const RibbonCurves& curves) {
    Looks looks{.shortness = std::vector<float>(rooted.roots.size(), 0.0F)};
    for (const RootedPlace& root : rooted.roots) {
        looks.direction.push_back(curves.direction[root.number]);
        looks.color.push_back(curves.color[root.number]);
    }
    return looks;
}

Looks looksOf(const RootedMesh& rooted, const RibbonOptions& options, glm::dvec3& comb) {
    const std::size_t count = rooted.roots.size();
    Looks looks{.color = std::vector<glm::vec3>(count, glm::vec3(1))};
    std::vector<glm::vec3> told;
    std::vector<float> regions;
    if (options.flowMap || options.colorMap || options.regionMap) {
        const FurSurface surface(rooted.mesh);
        const Below below(surface, options.threads);
        if (options.flowMap) told.resize(count);
        if (options.regionMap) regions.resize(count);
        inChunks(count, options.threads, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i) {
                const SurfacePoint point = below.at(rooted.roots[i]);
                if (options.flowMap) told[i] = glm::vec3(directionAt(*options.flowMap, surface, point));
                if (options.regionMap) regions[i] = static_cast<float>(shareAt(*options.regionMap, surface, point));
                if (options.colorMap) looks.color[i] = colorAt(*options.colorMap, options.encoded, surface, point);
            }
        });
    }
    CoatFlow flow = flowOfCoat(
        rooted, {.comb = options.comb, .down = options.down, .told = told, .thickness = !options.regionMap.has_value()}, options.threads);
    comb = flow.comb;
    looks.direction = std::move(flow.direction);
    looks.shortness = options.regionMap ? std::move(regions) : std::move(flow.shortness);
    return looks;
}

/// Unit: its part across the normal is how far strands are combed, and where to.
glm::vec3 growthOf(const glm::vec3& normal, glm::vec3 direction) {
    direction -= normal * glm::dot(normal, direction);
    const float length = glm::length(direction);
    if (length > 1) direction /= length;
    const glm::vec3 growth = direction + normal * std::sqrt(std::max(1 - glm::dot(direction, direction), 0.0F));
    return glm::normalize(growth);
}

/// Every mesh has all attributes or none: the skin gets what it lacks.
void fillSkin(Mesh& mesh) {
    if (mesh.uvs.empty()) mesh.uvs.assign(mesh.positions.size(), glm::vec2(0));
    if (!mesh.tangents.empty()) return;
    for (const glm::vec3& n : mesh.normals) {
        const glm::vec3 axis = std::abs(n.x) < 0.7F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        mesh.tangents.emplace_back(glm::normalize(axis - n * glm::dot(n, axis)), 1.0F);
    }
}

class RibbonWriter {
public:
    RibbonWriter(Mesh& mesh, const RootedMesh& rooted, const Looks& looks, const RibbonOptions& options)
        : mesh_(mesh), rooted_(rooted), looks_(looks), rows_(options.curves ? rowsOf(*options.curves) : rowsOf(options.segments)),
          underfurStep_(options.curves ? 1 : 2), firstVertex_(mesh.positions.size()) {}

    /// Of a ribbon: two at its tip as well, for no ribbon is drawn narrower than a pixel.
    [[nodiscard]] std::size_t vertices() const { return 2 * rows_.size(); }

    void write(std::size_t cluster, unsigned threads) {
        const std::size_t strands = rooted_.roots.size();
        const std::size_t all = firstVertex_ + strands * vertices();
        mesh_.positions.resize(all);
        mesh_.normals.resize(all);
        mesh_.tangents.resize(all);
        mesh_.uvs.resize(all);
        if (!mesh_.colors.empty()) mesh_.colors.resize(all, glm::vec4(1)); // a strand's colour is its root's
        for (MeshAttribute& attribute : mesh_.attributes)
            attribute.values.resize(all * attribute.components);
        inChunks(strands, threads, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i)
                writeVertices(i, firstVertex_ + i * vertices());
        });
        addPart(kStrandsPart, strands, everyRow(1), cluster, threads);
        addPart(kUnderfurPart, strands, everyRow(underfurStep_), cluster, threads);
    }

private:
    void writeVertices(std::size_t root, std::size_t first) {
        const RootedPlace& place = rooted_.roots[root];
        const glm::vec3 position = mesh_.bounds.centre + place.position * mesh_.bounds.radius;
        const glm::vec3 growth = growthOf(place.normal, looks_.direction[root]);
        for (std::size_t i = 0; i < vertices(); ++i) {
            mesh_.positions[first + i] = position;
            mesh_.normals[first + i] = place.normal;
            mesh_.tangents[first + i] = glm::vec4(growth, i % 2 == 0 ? -1 : 1);
            const RibbonVertex vertex{.along = rows_[i / 2] / kRows, .color = looks_.color[root], .shortness = looks_.shortness[root]};
            mesh_.uvs[first + i] = {packRibbonVertex(vertex), place.address};
        }
    }

    /// A ribbon's vertices, in every n-th row and at the tip.
    [[nodiscard]] std::vector<std::uint32_t> everyRow(std::size_t step) const {
        std::vector<std::uint32_t> kept;
        const auto keep = [&](std::size_t row) {
            kept.insert(kept.end(), {static_cast<std::uint32_t>(2 * row), static_cast<std::uint32_t>(2 * row + 1)});
        };
        for (std::size_t row = 0; row + 1 < rows_.size(); row += step)
            keep(row);
        keep(rows_.size() - 1);
        return kept;
    }

    /// Triangles from root to tip, so that each vertex is used again at once.
    void addPart(const char* name, std::size_t strands, const std::vector<std::uint32_t>& kept, std::size_t cluster, unsigned threads) {
        const std::size_t each = 3 * (kept.size() - 2);
        MeshPart part{.name = name,
                      .firstIndex = static_cast<std::uint32_t>(mesh_.indices.size()),
                      .indexCount = static_cast<std::uint32_t>(strands * each),
                      .expanded = true};
        mesh_.indices.resize(mesh_.indices.size() + part.indexCount);
        inChunks(strands, threads, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t strand = first; strand < last; ++strand) {
                const auto vertex = static_cast<std::uint32_t>(firstVertex_ + strand * vertices());
                std::size_t at = part.firstIndex + strand * each;
                for (std::size_t i = 0; i + 2 < kept.size(); ++i)
                    for (const std::size_t corner : {i, i + 1 + i % 2, i + 2 - i % 2})
                        mesh_.indices[at++] = vertex + kept[corner];
            }
        });
        const std::size_t step = cluster * each;
        for (std::size_t first = 0; first < part.indexCount; first += step)
            part.clusters.push_back({.firstIndex = static_cast<std::uint32_t>(first),
                                     .indexCount = static_cast<std::uint32_t>(std::min(step, part.indexCount - first))});
        computeClusters(mesh_, part);
        mesh_.parts.push_back(std::move(part));
    }

    Mesh& mesh_;
    const RootedMesh& rooted_;
    const Looks& looks_;
    std::vector<float> rows_;
    std::size_t underfurStep_;
    std::size_t firstVertex_;
};

double medianCone(const MeshPart& part) {
    std::vector<double> angles;
    for (const MeshCluster& cluster : part.clusters)
        angles.push_back(glm::degrees(std::acos(static_cast<double>(cluster.cosine))));
    std::ranges::nth_element(angles, angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2));
    return angles[angles.size() / 2];
}

} // namespace

float packRibbonVertex(const RibbonVertex& vertex) {
    const glm::vec3 root = glm::round(kColorSteps * glm::sqrt(glm::clamp(vertex.color, 0.0F, 1.0F)));
    const float shortness = std::round(kShortSteps * std::clamp(vertex.shortness, 0.0F, 1.0F));
    const float code = shortness + (kShortSteps + 1) * (root.x + (kColorSteps + 1) * (root.y + (kColorSteps + 1) * root.z));
    return code + std::round(kRows * vertex.along) / (kRows + 1);
}

RibbonVertex unpackRibbonVertex(float packed) {
    const float code = std::floor(packed);
    const float colors = std::floor(code / (kShortSteps + 1));
    const float greens = std::floor(colors / (kColorSteps + 1));
    const float blue = std::floor(greens / (kColorSteps + 1));
    const glm::vec3 root(colors - (kColorSteps + 1) * greens, greens - (kColorSteps + 1) * blue, blue);
    return {.along = (packed - code) * (kRows + 1) / kRows,
            .color = root * root / (kColorSteps * kColorSteps),
            .shortness = (code - (kShortSteps + 1) * colors) / kShortSteps};
}

bool hasRibbons(const Mesh& mesh) {
    return std::ranges::any_of(mesh.parts, isRibbons);
}

Result<Image> growRibbons(Mesh& mesh, const RootOptions& roots, const RibbonOptions& options) {
    auto set = makeRoots(mesh, roots);
    if (!set) return set.error();
    auto texture = buildRootTexture(*set, roots.threads);
    if (!texture) return texture.error();
    if (const auto added = addRibbons(mesh, texture->image, options); !added) return added.error();
    return std::move(texture->image);
}

std::optional<std::string> whyNotItsRoots(const Mesh& mesh, const Image& roots) {
    const auto header = rootHeader(roots);
    if (!header) return "it holds no roots";
    constexpr std::size_t kLooked = 64; // strands: roots of another run, or in another order, agree in none
    constexpr double kTolerance = 1e-3; // of the radius; roots stand ten times as far from each other
    const auto strands = std::ranges::find(mesh.parts, kStrandsPart, &MeshPart::name);
    const std::size_t triangles = strands == mesh.parts.end() ? 0 : strands->indexCount / 3;
    const std::size_t texels = roots.pixels.size() / 4;
    for (std::size_t i = 0; i < std::min(kLooked, triangles); ++i) {
        const std::uint32_t vertex = mesh.indices[strands->firstIndex + 3 * (i * triangles / kLooked)];
        const float address = mesh.uvs[vertex].y;
        if (!(address >= static_cast<float>(header->firstRoot)) || !(address < static_cast<float>(texels)))
            return fmt::format("it has no texel {}", address);
        const float* texel = &roots.pixels[4 * static_cast<std::size_t>(address)];
        const glm::dvec3 made = (glm::dvec3(texel[0], texel[1], texel[2]) - header->centre) / header->ballRadius;
        const glm::dvec3 drawn = glm::dvec3(mesh.positions[vertex] - mesh.bounds.centre) / static_cast<double>(mesh.bounds.radius);
        if (!(glm::distance(made, drawn) < kTolerance)) return fmt::format("the root at texel {} stands elsewhere", address);
    }
    return std::nullopt;
}

void removeRibbons(Mesh& mesh) {
    if (!hasRibbons(mesh)) return;
    std::vector<bool> ribbons(mesh.indices.size() / 3, false);
    for (const MeshPart& part : mesh.parts)
        if (isRibbons(part)) std::fill_n(ribbons.begin() + part.firstIndex / 3, part.indexCount / 3, true);
    keepTriangles(mesh, [&](std::span<const std::uint32_t, 3>, std::size_t triangle) { return !ribbons[triangle]; });
    keepReferenced(mesh);
}

Result<RibbonFigures> addRibbons(Mesh& mesh, const Image& roots, const RibbonOptions& options) {
    mesh.motion.reset(); // it knows no strands; a pose takes their roots along
    mesh.motionVertices.clear();
    const auto start = std::chrono::steady_clock::now();
    if (const auto checked = check(mesh, options); !checked) return checked.error();
    removeRibbons(mesh);
    RibbonFigures figures;
    const auto rooted = readRooted(mesh, roots, options.threads);
    if (!rooted) return rooted.error();
    const Looks looks = options.curves ? looksOf(*rooted, *options.curves) : looksOf(*rooted, options, figures.comb);
    fillSkin(mesh);
    RibbonWriter writer(mesh, *rooted, looks, options);
    writer.write(options.cluster, options.threads);
    const MeshPart& part = *std::ranges::find(mesh.parts, kStrandsPart, &MeshPart::name);
    figures.strands = rooted->roots.size();
    figures.vertices = figures.strands * writer.vertices();
    figures.triangles = part.indexCount / 3;
    figures.clusters = part.clusters.size();
    figures.widestCone = medianCone(part);
    figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return figures;
}

} // namespace tegument
