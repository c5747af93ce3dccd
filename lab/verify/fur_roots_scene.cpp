#include "lab/verify/fur_roots_scene.h"

#include "lab/verify/fur_scene.h"
#include "lab/verify/truth.h"
#include "meshprep/fur/roots/root_texture.h"

#include <algorithm>
#include <cmath>

namespace tegument::verify {

namespace {

/// From technique Cellular's lattice: 2 rho = 1 point per square, of which those near the slab's faces grow shorter strands
/// (docs/design/modules/FurRoots.md).
constexpr double kLatticeDensity = 0.875;
constexpr double kReach = 2.5; // of a root: strands stray, a step and a pixel are wide

constexpr double kMostStrands = 150'000;
constexpr float kAfar = 2.5F; // times as far as usual

/// Width of a pixel at the mesh, mm.
double pixelAt(const Scene& scene, const VerifyOptions& options) {
    const PlacedScene placed = placeScene(scene.workspace, scene.mesh.bounds);
    const double distance = static_cast<double>(glm::length(placed.camera.position - scene.mesh.bounds.centre));
    return 2 * distance * std::tan(glm::radians(static_cast<double>(placed.camera.horizontalFov)) / 2) / options.pictureSize;
}

/// The random number of a root is three, with 24, 16 and 8 bits.
glm::dvec3 spread(double random) {
    const glm::dvec3 v = random * glm::dvec3(1, 256, 65536);
    return v - glm::floor(v);
}

reference::FurRoot rootOf(const Root& root, const StrandsScene& scene, const RootSet& set) {
    const glm::dvec3 place = (glm::dvec3(root.position) - glm::dvec3(scene.scene.mesh.bounds.centre)) / scene.fur.spacing;
    return {.strand = {.root = place,
                       .length = static_cast<double>(root.share),
                       .radius = scene.fur.radius * static_cast<double>(root.radius) / set.radius,
                       .random = spread(static_cast<double>(root.random))},
            .normal = glm::dvec3(root.normal),
            .straying = glm::dvec3(root.lean + root.curl * root.normal),
            .limit = static_cast<double>(root.limit) / scene.fur.thickness};
}

/// At each vertex, from the nodes around it; along the skin.
std::vector<glm::dvec4> grownAt(const Mesh& mesh, const Image& roots) {
    std::vector<glm::dvec4> grown;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec4 coat(coatAround(roots, mesh.positions[v]));
        const glm::dvec3 normal(mesh.normals[v]);
        grown.emplace_back(glm::dvec3(coat) - normal * glm::dot(glm::dvec3(coat), normal), coat.w);
    }
    return grown;
}

} // namespace

glm::dvec3 randomOf(const Root& root) {
    return spread(static_cast<double>(root.random));
}

Result<void> growRoots(StrandsScene& scene, const RootOptions& options) {
    const Mesh& mesh = scene.scene.mesh;
    auto set = makeRoots(mesh, options);
    if (!set) return set.error();
    scene.set = std::move(*set);
    auto texture = buildRootTexture(scene.set); // sorts the roots
    if (!texture) return texture.error();
    scene.fur.density = 1;
    scene.fur.shortest = 1;
    std::vector<reference::FurRoot> roots;
    for (const Root& root : scene.set.roots) {
        roots.push_back(rootOf(root, scene, scene.set));
        scene.fur.shortest = std::min(scene.fur.shortest, static_cast<double>(root.share));
    }
    scene.strands = reference::rootedStrands(std::move(roots));
    scene.grown = grownAt(mesh, texture->image);
    scene.roots = std::move(texture->image);
    return {};
}

namespace {

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const auto corner = [&](std::uint32_t c) { return glm::dvec3(mesh.positions[mesh.indices[3 * t + c]]); };
        area += glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    }
    return area;
}

/// `pixels`: spacing of the strands in pixels, unless that were too many.
Result<StrandsScene> sceneOn(FurScene fur, const VerifyOptions& options, const std::string& technique, double pixels) {
    StrandsScene scene{.name = std::move(fur.name), .technique = technique, .scene = std::move(fur.scene), .coat = fur.coat};
    const double radius = static_cast<double>(scene.scene.mesh.bounds.radius);
    scene.coat.layers = 8;
    scene.coat.spread = 1;
    scene.coat.lean = 0.3;
    scene.coat.outerFirst = false;
    scene.fur.layers = scene.coat.layers;
    scene.fur.spacing = std::max(pixels * pixelAt(scene.scene, options), std::sqrt(areaOf(scene.scene.mesh) / kMostStrands));
    scene.coat.length = std::min(0.2, 4 * scene.fur.spacing / radius);
    scene.fur.thickness = scene.coat.length * radius;
    scene.fur.lean = scene.coat.lean * glm::dvec3(0, -1, 0);
    scene.fur.density = kLatticeDensity;
    if (technique == "Cellular")
        scene.strands = reference::latticeStrands(scene.fur.radius, scene.fur.shortest);
    else if (const auto grown = growRoots(
                 scene, {.density = 1 / (scene.fur.spacing * scene.fur.spacing), .reach = kReach, .lean = 0.3, .comb = {0.6, -0.5, 0.6}});
             !grown)
        return grown.error();
    return scene;
}

} // namespace

Result<StrandsScene> strandsNearBy(const VerifyOptions& options, const std::string& technique) {
    return sceneOn(furTorus(options), options, technique, 3);
}

Result<StrandsScene> strandsFarAway(const VerifyOptions& options, const std::string& technique) {
    FurScene ball = furBall(options);
    if (!options.mesh) {
        ball.name = "ball from afar";
        ball.scene.workspace.camera.position *= kAfar;
    }
    return sceneOn(std::move(ball), options, technique, 1 / 1.5);
}

std::map<std::string, std::vector<double>> parametersOf(const StrandsScene& scene) {
    auto parameters = parametersOf(scene.coat);
    const reference::FurSwept& fur = scene.fur;
    parameters["gFurSpacing"] = {fur.spacing / static_cast<double>(scene.scene.mesh.bounds.radius)};
    parameters["gFurRadius"] = {fur.radius};
    parameters["gFurShortest"] = {fur.shortest};
    parameters["gFurScatter"] = {fur.scatter};
    parameters["gFurCurls"] = {fur.curls};
    parameters["gFurTurns"] = {fur.turns};
    parameters["gFurTufts"] = {fur.tufts};
    parameters["gFurTuftSize"] = {fur.tuftSize};
    parameters["gFurVariation"] = {fur.variation};
    parameters["gFurSegment"] = {fur.segment};
    parameters["gFurFewest"] = {fur.fewest};
    return parameters;
}

} // namespace tegument::verify
