// Ribbons as a part of a mesh: that every root has one, what its vertices hold, and that nothing a file can hold breaks them.
#include "meshprep/fur/ribbons/ribbons.h"
#include "tests/fur/roots/built.h"
#include "tests/fur/roots/meshes.h"

#include <algorithm>
#include <limits>
#include <map>

using namespace tegument;
using namespace tegument::testing_roots;

namespace {

const MeshPart& part(const Mesh& mesh, const char* name) {
    const auto found = std::ranges::find(mesh.parts, name, &MeshPart::name);
    EXPECT_NE(found, mesh.parts.end()) << name;
    return *found;
}

/// A ball of 3,000 roots with its ribbons.
struct Furry {
    Built built;
    RibbonFigures figures;

    explicit Furry(const RibbonOptions& options = {}, Mesh mesh = ball(50)) : built(build(std::move(mesh), {.count = 3000})) {
        const auto added = addRibbons(built.mesh, built.texture.image, options);
        EXPECT_TRUE(added) << format(added.error());
        if (added) figures = *added;
    }
    [[nodiscard]] const Mesh& mesh() const { return built.mesh; }
};

int codeOf(const Result<RibbonFigures>& result) {
    return result ? 0 : result.error().diagnostics.front().code;
}

Image damaged(Image image, std::size_t texel, std::size_t channel, float value) {
    image.pixels[4 * texel + channel] = value;
    return image;
}

} // namespace

TEST(Ribbons, hold_what_a_vertex_says_exactly) {
    for (int row = 0; row <= 31; ++row)
        for (int level = 0; level <= 31; ++level) {
            const float root = static_cast<float>(level) / 31;
            const RibbonVertex vertex{.along = static_cast<float>(row) / 31,
                                      .color = {root * root, 1, (1 - root) * (1 - root)},
                                      .shortness = static_cast<float>(level % 16) / 15};
            const RibbonVertex read = unpackRibbonVertex(packRibbonVertex(vertex));
            EXPECT_NEAR(read.along, vertex.along, 1e-6);
            EXPECT_NEAR(read.shortness, vertex.shortness, 1e-6);
            EXPECT_LT(glm::distance(read.color, vertex.color), 1e-5) << row << " " << level;
        }
}

TEST(Ribbons, round_colours_to_a_step_of_their_root_and_hold_them_to_0_to_1) {
    for (const float value : {0.0F, 0.003F, 0.18F, 0.5F, 0.93F, 1.0F}) {
        const float read = unpackRibbonVertex(packRibbonVertex({.color = glm::vec3(value)})).color.x;
        EXPECT_LE(std::abs(std::sqrt(read) - std::sqrt(value)), 0.5F / 31 + 1e-6F) << value;
    }
    const RibbonVertex wild = unpackRibbonVertex(packRibbonVertex({.along = 1, .color = {-3, 7, 1}, .shortness = 9}));
    EXPECT_EQ(wild.color, glm::vec3(0, 1, 1));
    EXPECT_EQ(wild.shortness, 1);
    EXPECT_FLOAT_EQ(wild.along, 1);
}

TEST(Ribbons, stand_one_on_each_root) {
    const Furry furry;
    const Mesh& mesh = furry.mesh();
    const std::size_t roots = furry.built.set.roots.size();
    EXPECT_EQ(furry.figures.strands, roots);
    std::map<float, std::size_t> vertices; // by address
    const std::size_t skin = mesh.positions.size() - furry.figures.vertices;
    for (std::size_t i = skin; i < mesh.positions.size(); ++i)
        ++vertices[mesh.uvs[i].y];
    EXPECT_EQ(vertices.size(), roots);
    const auto header = rootHeader(furry.built.texture.image);
    ASSERT_TRUE(header);
    for (std::size_t number = 0; number < roots; ++number) {
        const auto found = vertices.find(static_cast<float>(header->addressOf(number)));
        ASSERT_NE(found, vertices.end()) << number;
        EXPECT_EQ(found->second, 14U) << "two at each end of six segments";
    }
}

TEST(Ribbons, stand_where_their_root_stands_with_its_normal) {
    const Furry furry;
    const Mesh& mesh = furry.mesh();
    std::map<float, Root> roots;
    const auto header = rootHeader(furry.built.texture.image);
    ASSERT_TRUE(header);
    for (std::size_t number = 0; number < header->count; ++number)
        roots[static_cast<float>(header->addressOf(number))] = rootAt(furry.built.texture.image, number);
    for (std::size_t i = mesh.positions.size() - furry.figures.vertices; i < mesh.positions.size(); ++i) {
        const Root& root = roots[mesh.uvs[i].y];
        EXPECT_LT(glm::distance(mesh.positions[i], root.position), 1e-3F) << "mm, of a ball of 50";
        EXPECT_LT(glm::distance(mesh.normals[i], root.normal), 1e-5F);
        EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1, 1e-5);
        EXPECT_EQ(std::abs(mesh.tangents[i].w), 1);
        EXPECT_GE(glm::dot(glm::vec3(mesh.tangents[i]), root.normal), -1e-4F) << "nothing is combed into the skin";
    }
}

TEST(Ribbons, are_strips_from_root_to_tip_whose_short_form_has_every_second_row) {
    const Furry furry;
    const Mesh& mesh = furry.mesh();
    const std::pair<const char*, std::vector<float>> parts[] = {{kStrandsPart, {0, 6, 12, 17, 22, 27, 31}},
                                                                {kUnderfurPart, {0, 12, 22, 31}}};
    for (const auto& [name, rows] : parts) {
        const MeshPart& strands = part(mesh, name);
        const std::size_t triangles = 2 * (rows.size() - 1);
        ASSERT_EQ(strands.indexCount, furry.figures.strands * triangles * 3) << name;
        for (std::size_t t = 0; t < triangles; ++t) {
            const std::uint32_t* corner = &mesh.indices[strands.firstIndex + 3 * t];
            for (std::size_t c = 0; c < 3; ++c) {
                const float along = 31 * unpackRibbonVertex(mesh.uvs[corner[c]].x).along;
                const float low = rows[t / 2], high = rows[t / 2 + 1];
                EXPECT_TRUE(std::abs(along - low) < 1e-3F || std::abs(along - high) < 1e-3F) << name << " " << t << ": " << along;
            }
            EXPECT_NE(mesh.tangents[corner[0]].w + mesh.tangents[corner[1]].w + mesh.tangents[corner[2]].w, 3) << "both sides";
        }
    }
}

TEST(Ribbons, come_in_clusters_that_hold_their_vertices_and_normals) {
    const Furry furry({.cluster = 100});
    for (const char* name : {kStrandsPart, kUnderfurPart}) {
        const MeshPart& strands = part(furry.mesh(), name);
        EXPECT_EQ(strands.clusters.size(), (furry.figures.strands + 99) / 100) << name;
        std::uint32_t next = 0;
        for (const MeshCluster& cluster : strands.clusters) {
            EXPECT_EQ(cluster.firstIndex, next);
            next += cluster.indexCount;
            for (std::uint32_t i = 0; i < cluster.indexCount; ++i) {
                const std::uint32_t vertex = furry.mesh().indices[strands.firstIndex + cluster.firstIndex + i];
                EXPECT_LE(glm::distance(furry.mesh().positions[vertex], cluster.centre), cluster.radius);
                EXPECT_GE(glm::dot(furry.mesh().normals[vertex], cluster.axis), cluster.cosine - 1e-6F);
            }
        }
        EXPECT_EQ(next, strands.indexCount);
    }
    EXPECT_LT(furry.figures.widestCone, 60) << "degrees: what looks along one axis";
}

TEST(Ribbons, leave_the_skin_as_it_is) {
    Furry furry;
    Mesh mesh = furry.mesh();
    const Bounds with = mesh.bounds;
    computeBounds(mesh);
    EXPECT_NEAR(mesh.bounds.radius, with.radius, 1e-4) << "roots stand on the mesh, not beyond it";
    removeRibbons(mesh);
    const Mesh bare = ball(50);
    EXPECT_FALSE(hasRibbons(mesh));
    EXPECT_EQ(mesh.indices.size(), bare.indices.size());
    EXPECT_EQ(mesh.positions, bare.positions);
}

TEST(Ribbons, replace_those_that_are_there) {
    Furry furry;
    const std::size_t vertices = furry.mesh().positions.size();
    ASSERT_TRUE(addRibbons(furry.built.mesh, furry.built.texture.image));
    EXPECT_EQ(furry.mesh().positions.size(), vertices);
    EXPECT_EQ(std::ranges::count(furry.mesh().parts, std::string(kStrandsPart), &MeshPart::name), 1);
}

TEST(Ribbons, serve_the_mesh_in_another_unit) {
    Built built = build(ball(50), {.count = 500});
    Mesh metres = ball(0.05);
    const auto added = addRibbons(metres, built.texture.image);
    ASSERT_TRUE(added) << format(added.error());
    for (std::size_t i = metres.positions.size() - added->vertices; i < metres.positions.size(); ++i)
        EXPECT_NEAR(glm::length(metres.positions[i]), 0.05, 1e-4);
}

TEST(Ribbons, take_colours_and_regions_from_maps) {
    Mesh mesh = ball(50);
    std::vector<glm::dvec3> colors, regions;
    for (const glm::vec3& p : mesh.positions) {
        colors.emplace_back(p.y > 0 ? 1.0 : 0.0, 0.25, 0.5);
        regions.emplace_back(p.x > 0 ? 1.0 : 0.0);
    }
    const Furry furry({.colorMap = FurMap(colors), .regionMap = FurMap(regions)}, mesh);
    for (std::size_t i = furry.mesh().positions.size() - furry.figures.vertices; i < furry.mesh().positions.size(); ++i) {
        const glm::vec3& p = furry.mesh().positions[i];
        if (std::min(std::abs(p.x), std::abs(p.y)) < 4) continue; // between vertices they change
        const RibbonVertex vertex = unpackRibbonVertex(furry.mesh().uvs[i].x);
        EXPECT_NEAR(vertex.color.x, p.y > 0 ? 1 : 0, 1e-5);
        EXPECT_NEAR(vertex.color.y, 0.25, 0.02);
        EXPECT_NEAR(vertex.shortness, p.x > 0 ? 1 : 0, 1e-5);
    }
}

TEST(Ribbons, of_pictures_that_hold_no_roots_are_refused) {
    const Built built = build(ball(50), {.count = 300});
    const Image& good = built.texture.image;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image cut = good;
    cut.height = 2;
    cut.pixels.resize(std::size_t{4} * static_cast<std::size_t>(cut.width) * 2);
    const Image grey{.width = 4096, .height = 1, .channels = 1, .pixels = std::vector<float>(4096)};
    const Image narrow{.width = 16, .height = 16, .channels = 4, .pixels = std::vector<float>(1024)};
    const std::pair<const char*, Image> all[] = {{"no rows", {}},
                                                 {"grey", grey},
                                                 {"narrow", narrow},
                                                 {"cut off", cut},
                                                 {"no count", damaged(good, 2, 2, 0)},
                                                 {"a count of NaN", damaged(good, 2, 2, nan)},
                                                 {"a count beyond the texture", damaged(good, 2, 2, 3e6F)},
                                                 {"half a root", damaged(good, 2, 2, 10.5F)},
                                                 {"a first root in the first row", damaged(good, 6, 0, 8)},
                                                 {"a first root beyond the texture", damaged(good, 6, 0, 4096 * 4000)},
                                                 {"no density", damaged(good, 3, 3, 0)},
                                                 {"no ball", damaged(good, 4, 3, -1)},
                                                 {"a ball nowhere", damaged(good, 4, 0, nan)}};
    for (const auto& [what, image] : all) {
        Mesh mesh = ball(50);
        EXPECT_EQ(codeOf(addRibbons(mesh, image)), 7109) << what;
        EXPECT_EQ(mesh.positions.size(), ball(50).positions.size()) << what;
    }
}

TEST(Ribbons, leave_out_roots_that_are_nowhere) {
    const Built built = build(ball(50), {.count = 300});
    const auto header = rootHeader(built.texture.image);
    ASSERT_TRUE(header);
    Image image = damaged(built.texture.image, header->addressOf(7), 1, std::numeric_limits<float>::infinity());
    image = damaged(image, header->addressOf(9) + 1, 0, std::numeric_limits<float>::quiet_NaN());
    Mesh mesh = ball(50);
    const auto added = addRibbons(mesh, image);
    ASSERT_TRUE(added) << format(added.error());
    EXPECT_EQ(added->strands, header->count - 2);
    for (const glm::vec3& p : mesh.positions)
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

TEST(Ribbons, of_no_segment_or_too_many_and_flat_maps_without_coordinates_are_refused) {
    const Built built = build(ball(50), {.count = 300});
    Mesh mesh = ball(50);
    EXPECT_EQ(codeOf(addRibbons(mesh, built.texture.image, {.segments = 0})), 7103);
    EXPECT_EQ(codeOf(addRibbons(mesh, built.texture.image, {.segments = 16})), 7103);
    EXPECT_EQ(codeOf(addRibbons(mesh, built.texture.image, {.cluster = 0})), 7103);
    EXPECT_EQ(codeOf(addRibbons(mesh, built.texture.image, {.down = glm::dvec3(0)})), 7103);
    const FurMap flat(DdsTexture{.images = {Image{.width = 1, .height = 1, .channels = 1, .pixels = {1}}}});
    EXPECT_EQ(codeOf(addRibbons(mesh, built.texture.image, {.colorMap = flat})), 7106);
}

TEST(Ribbons, are_the_same_on_one_thread_and_on_many) {
    const Furry one({.threads = 1});
    const Furry many({.threads = 4});
    EXPECT_EQ(one.mesh().indices, many.mesh().indices);
    EXPECT_EQ(one.mesh().uvs, many.mesh().uvs);
    EXPECT_EQ(one.mesh().tangents, many.mesh().tangents);
}
