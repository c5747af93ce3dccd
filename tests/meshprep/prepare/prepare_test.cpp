// The whole way, from file to file.
#include "host/mesh/triangles.h"
#include "meshprep/prepare/levels.h"
#include "meshprep/prepare/simplify.h"
#include "meshprep/write/write_mesh.h"
#include "tests/meshprep/prepare/meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace tegument;
using namespace tegument::prep;
using namespace tegument::testing_prep;

namespace {

using Prepare = PrepFolder;

/// Corners of every triangle by position, the smallest first: equal for meshes that show the same surface, however it is stored.
std::multiset<std::array<float, 9>> trianglesOf(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
    std::multiset<std::array<float, 9>> set;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        std::array<std::array<float, 3>, 3> t{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = mesh.positions[indices[i + k]];
            t[k] = {p.x, p.y, p.z};
        }
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        set.insert({t[0][0], t[0][1], t[0][2], t[1][0], t[1][1], t[1][2], t[2][0], t[2][1], t[2][2]});
    }
    return set;
}

std::multiset<std::array<float, 9>> trianglesOf(const Mesh& mesh) {
    return trianglesOf(mesh, mesh.indices);
}

double acmrAfter(const PrepReport& report, std::string_view model) {
    for (const CacheComparison& c : report.cache)
        if (c.model.name == model) return c.after.acmr();
    return 0;
}

} // namespace

TEST_F(Prepare, the_cube_and_the_torus_have_the_source_document_s_counts) {
    const Prepared cube = prepare(makeShape(Shape::Cube));
    EXPECT_EQ(cube.report.output.vertices, 8u);
    EXPECT_EQ(cube.report.output.faces, 12u);
    EXPECT_EQ(changedBy(cube.report, "weld"), 28u);
    const Prepared torus = prepare(makeShape(Shape::Torus));
    EXPECT_EQ(torus.report.output.vertices, 192u);
    EXPECT_EQ(torus.report.output.faces, 384u);
}

TEST_F(Prepare, generated_meshes_have_the_counts_of_their_formulas) {
    const Prepared sphere = prepare(makeShape(Shape::Sphere, 20), {.levels = 1});
    EXPECT_EQ(sphere.report.output.faces, 20u * 20 * 20);
    EXPECT_EQ(sphere.report.output.vertices, 10u * 20 * 20 + 2) << "Euler: V = F / 2 + 2";
    const Prepared terrain = prepare(makeShape(Shape::Terrain, 30), {.levels = 1});
    EXPECT_EQ(terrain.report.output.faces, 2u * 30 * 30);
    EXPECT_EQ(terrain.report.output.vertices, 31u * 31);
}

TEST_F(Prepare, the_surface_is_the_same_before_and_after_whatever_the_order) {
    const Mesh sphere = makeShape(Shape::Sphere, 12);
    const auto before = trianglesOf(sphere);
    using order::Method;
    for (const auto method : {Method::LinYu, Method::Hoppe, Method::Tipsify, Method::Meshopt, Method::Best}) {
        const Prepared prepared = prepare(sphere, {.centre = CentreMode::None, .order = method, .overdraw = true, .levels = 1});
        EXPECT_EQ(trianglesOf(prepared.mesh), before);
    }
}

TEST_F(Prepare, ordering_reduces_the_vertices_transformed) {
    const Prepared file = prepare(makeShape(Shape::Terrain, 60), {.order = std::nullopt, .levels = 1});
    const Prepared best = prepare(makeShape(Shape::Terrain, 60), {.cache = order::fifo(16), .levels = 1});
    EXPECT_GT(acmrAfter(file.report, "fifo16"), 0.95);
    EXPECT_LT(acmrAfter(best.report, "fifo16"), 0.62);
}

TEST_F(Prepare, parts_keep_their_triangles) {
    Mesh mesh = makeShape(Shape::Sphere, 10);
    const auto half = static_cast<std::uint32_t>(mesh.indices.size() / 6 * 3);
    mesh.parts = {{.name = "upper", .firstIndex = 0, .indexCount = half},
                  {.name = "lower", .firstIndex = half, .indexCount = static_cast<std::uint32_t>(mesh.indices.size()) - half}};
    ASSERT_TRUE(writeGlb(folder_ / "parts.glb", mesh));
    const auto prepared = prepareMesh(folder_ / "parts.glb", {.centre = CentreMode::None});
    ASSERT_TRUE(prepared) << format(prepared.error());
    ASSERT_EQ(prepared->mesh.parts.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto of = [](const Mesh& m, const MeshPart& part) {
            return trianglesOf(m, {m.indices.begin() + part.firstIndex, m.indices.begin() + part.firstIndex + part.indexCount});
        };
        EXPECT_EQ(of(prepared->mesh, prepared->mesh.parts[i]), of(mesh, mesh.parts[i]));
        EXPECT_EQ(prepared->mesh.parts[i].name, mesh.parts[i].name);
    }
}

TEST_F(Prepare, levels_have_a_quarter_of_the_triangles_and_state_their_error) {
    const Prepared prepared = prepare(makeShape(Shape::Sphere, 40));
    ASSERT_EQ(prepared.report.levels.size(), 3u);
    std::size_t expected = prepared.report.output.faces;
    double last = 0;
    for (const LevelFigures& level : prepared.report.levels) {
        expected /= 4;
        EXPECT_NEAR(static_cast<double>(level.triangles), static_cast<double>(expected), 0.02 * static_cast<double>(expected) + 2);
        EXPECT_GT(level.error.greatest, last);
        EXPECT_LE(level.error.rms, level.error.greatest);
        last = level.error.greatest;
    }
    EXPECT_LT(last, 0.1) << "a tenth of the radius, at 500 triangles";
}

TEST_F(Prepare, levels_that_would_be_too_small_are_said_and_those_that_are_made_are_not) {
    const auto said = [&](int levels) {
        const Prepared prepared = prepare(makeShape(Shape::Sphere, 20), {.levels = levels});
        const auto step = std::ranges::find(prepared.report.steps, "levels", &PrepStep::name);
        return step == prepared.report.steps.end() ? std::string() : step->text;
    };
    EXPECT_NE(said(9).find("; no more: another would have fewer than"), std::string::npos) << said(9);
    EXPECT_EQ(said(2).find("no more"), std::string::npos) << said(2);
}

TEST_F(Prepare, levels_of_a_tiny_and_of_a_huge_mesh_are_those_of_the_same_mesh) {
    for (const float size : {1e-36f, 1e30f}) {
        Mesh mesh = makeShape(Shape::Sphere, 16);
        for (glm::vec3& p : mesh.positions)
            p *= size;
        const Prepared prepared = prepare(mesh, {.levels = 2});
        ASSERT_EQ(prepared.report.levels.size(), 1u) << size;
        EXPECT_NEAR(static_cast<double>(prepared.report.levels[0].triangles), 1280, 26) << size;
        EXPECT_LT(prepared.report.levels[0].error.greatest / size, 0.1);
        EXPECT_GT(prepared.report.levels[0].error.greatest / size, 1e-4);
    }
}

/// What a user of the simplifier gets for as many triangles is among what is tried. 1 % is for what is roughly known of a distance.
TEST_F(Prepare, levels_are_never_further_off_than_what_the_simplifier_gives_its_other_users) {
    for (const auto& [shape, detail] : {std::pair(Shape::Sphere, 16), std::pair(Shape::Terrain, 35), std::pair(Shape::Terrain, 60)}) {
        const Mesh mesh = prepare(makeShape(shape, detail), {.levels = 1}).mesh;
        std::vector<SimplifiedAttributes> attributes;
        for (const glm::vec3& n : mesh.normals)
            attributes.push_back({n.x, n.y, n.z, 0, 0});
        const DistanceFrom distance(mesh.positions, mesh.indices);
        for (const Level& level : makeLevels(mesh, 4).levels) {
            const auto plain = simplify({.from = mesh.indices,
                                         .positions = mesh.positions,
                                         .attributes = attributes,
                                         .counted = 3,
                                         .triangles = level.mesh.indices.size() / 3},
                                        kNormalWeights[0]);
            EXPECT_LE(level.error.reached, 1.01 * distance.to(plain).reached) << detail << ", " << plain.size() / 3 << " triangles";
        }
    }
}

/// Stripes of a terrain, each with the vertices of its border in common with the next.
Mesh striped(Mesh mesh, std::size_t stripes) {
    const auto stripeOf = [&](std::size_t triangle) {
        const float x = mesh.positions[mesh.indices[3 * triangle]].x + mesh.positions[mesh.indices[3 * triangle + 1]].x +
                        mesh.positions[mesh.indices[3 * triangle + 2]].x;
        const float width = 6 * mesh.bounds.radius;
        return std::min(static_cast<std::size_t>(std::max(x / width + 0.5f, 0.0f) * static_cast<float>(stripes)), stripes - 1);
    };
    std::vector<std::vector<std::uint32_t>> lists(stripes);
    for (std::size_t i = 0; i < mesh.indices.size() / 3; ++i)
        lists[stripeOf(i)].insert(lists[stripeOf(i)].end(), &mesh.indices[3 * i], &mesh.indices[3 * i] + 3);
    mesh.indices.clear();
    mesh.parts.clear();
    for (std::size_t i = 0; i < stripes; ++i) {
        if (lists[i].empty()) continue;
        MeshPart part{};
        part.firstIndex = static_cast<std::uint32_t>(mesh.indices.size());
        part.indexCount = static_cast<std::uint32_t>(lists[i].size());
        mesh.parts.push_back(part);
        mesh.indices.insert(mesh.indices.end(), lists[i].begin(), lists[i].end());
    }
    return mesh;
}

double areaOfTriangles(const Mesh& mesh, std::span<const std::uint32_t> indices) {
    double area = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[indices[i]]), b(mesh.positions[indices[i + 1]]), c(mesh.positions[indices[i + 2]]);
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

/// Users of the simplifier who do not know of parts have their vertices in common: borders of parts hold nothing then. The first level of a
/// terrain of 20 stripes; 1 % as above. Each stripe stays what it was: where a border moves it gains or loses less than a row of triangles
/// of the level on each side, half of its width.
TEST_F(Prepare, levels_of_parts_that_share_vertices_are_as_near_as_if_they_were_one) {
    const Mesh mesh = striped(prepare(makeShape(Shape::Terrain, 60), {.levels = 1}).mesh, 20);
    ASSERT_GT(mesh.parts.size(), 10u);
    const DistanceFrom distance(mesh.positions, mesh.indices);
    for (const Level& level : makeLevels(mesh, 3).levels) {
        const auto plain = simplify({.from = mesh.indices, .positions = mesh.positions, .triangles = level.mesh.indices.size() / 3}, 0);
        EXPECT_LE(level.error.reached, 1.01 * distance.to(plain).reached) << plain.size() / 3 << " triangles";
        if (level.mesh.indices.size() * 5 < mesh.indices.size()) continue; // a stripe is two triangles wide
        ASSERT_EQ(level.mesh.parts.size(), mesh.parts.size());
        for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
            const auto of = [&](const std::vector<std::uint32_t>& all, const MeshPart& part) {
                return areaOfTriangles(mesh, std::span(all).subspan(part.firstIndex, part.indexCount));
            };
            const double before = of(mesh.indices, mesh.parts[i]);
            EXPECT_NEAR(of(level.mesh.indices, level.mesh.parts[i]), before, before / 2) << "stripe " << i;
        }
    }
}

TEST_F(Prepare, levels_keep_every_triangle_in_the_part_whose_vertices_it_has) {
    Mesh mesh = prepare(makeShape(Shape::Sphere, 16), {.levels = 1}).mesh;
    const auto count = static_cast<std::uint32_t>(mesh.indices.size()), vertices = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i < vertices; ++i) {
        mesh.positions.push_back(0.5f * mesh.positions[i] + glm::vec3(3, 0, 0));
        mesh.normals.push_back(mesh.normals[i]);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        mesh.indices.push_back(mesh.indices[i] + vertices);
    mesh.parts = {{.name = "one", .firstIndex = 0, .indexCount = count}, {.name = "other", .firstIndex = count, .indexCount = count}};
    for (const Level& level : makeLevels(mesh, 3).levels) {
        ASSERT_EQ(level.mesh.parts.size(), 2u);
        for (std::size_t part = 0; part < 2; ++part) {
            const MeshPart& of = level.mesh.parts[part];
            EXPECT_GT(of.indexCount, 0u);
            for (const std::uint32_t index : std::span(level.mesh.indices).subspan(of.firstIndex, of.indexCount))
                ASSERT_EQ(index >= vertices, part == 1) << part;
        }
    }
}

TEST_F(Prepare, a_written_glb_returns_the_mesh_bit_for_bit) {
    const Prepared prepared = prepare(makeShape(Shape::Torus));
    ASSERT_TRUE(writeGlb(folder_ / "out.glb", prepared.mesh, prepared.glb));
    const auto read = loadMesh(folder_ / "out.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->positions, prepared.mesh.positions);
    EXPECT_EQ(read->normals, prepared.mesh.normals);
    EXPECT_EQ(read->indices, prepared.mesh.indices);
}

TEST_F(Prepare, a_written_ply_returns_the_mesh_bit_for_bit) {
    const Prepared prepared = prepare(makeShape(Shape::Torus));
    ASSERT_TRUE(writePly(folder_ / "out.ply", prepared.mesh));
    const auto read = loadMesh(folder_ / "out.ply");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(read->positions, prepared.mesh.positions);
    EXPECT_EQ(read->normals, prepared.mesh.normals);
    EXPECT_EQ(read->indices, prepared.mesh.indices);
}

TEST_F(Prepare, unorm16_is_read_back_within_the_stated_error) {
    const Prepared full = prepare(makeShape(Shape::Sphere, 12), {.levels = 1});
    const Prepared small = prepare(makeShape(Shape::Sphere, 12), {.levels = 1, .precision = VertexPrecision::Unorm16});
    ASSERT_TRUE(writeGlb(folder_ / "small.glb", small.mesh, small.glb));
    const auto read = loadMesh(folder_ / "small.glb");
    ASSERT_TRUE(read) << format(read.error());
    ASSERT_EQ(read->positions.size(), full.mesh.positions.size());
    const VertexError& stated = small.report.precision;
    const double step = 2 * full.mesh.bounds.radius / 65535;
    EXPECT_LT(stated.positionMm, step) << "at most half a step in each of three directions";
    for (std::size_t i = 0; i < read->positions.size(); ++i) {
        // 1e-6: the reader's floats, at a radius of 1
        EXPECT_LE(glm::distance(glm::dvec3(read->positions[i]), glm::dvec3(full.mesh.positions[i])), stated.positionMm + 1e-6);
        EXPECT_LE(degreesBetween(read->normals[i], full.mesh.normals[i]), stated.normalDegrees + 1e-5);
    }
    EXPECT_LT(std::filesystem::file_size(folder_ / "small.glb"), 16 * read->positions.size() + 2 * read->indices.size() + 4000);
}

TEST_F(Prepare, half_states_the_error_of_ten_bits) {
    const Prepared prepared = prepare(makeShape(Shape::Sphere, 12), {.precision = VertexPrecision::Half});
    // 11 significant bits: half a unit of the last place is 2^-12 of a coordinate of at most 1.2
    EXPECT_LE(prepared.report.precision.positionMm, 1.2 * std::sqrt(3.0) / 4096);
    EXPECT_GT(prepared.report.precision.positionMm, 1e-5);
    EXPECT_LE(prepared.report.precision.normalDegrees, std::sqrt(3.0) / 4096 * 180 / std::numbers::pi);
}

TEST_F(Prepare, half_refuses_what_it_cannot_hold) {
    Mesh mesh = makeShape(Shape::Cube);
    for (glm::vec3& p : mesh.positions)
        p *= 1e6f;
    ASSERT_TRUE(writePly(folder_ / "big.ply", mesh));
    const auto result = prepareMesh(folder_ / "big.ply", {.precision = VertexPrecision::Half});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().diagnostics.front().code, 7026);
}

TEST_F(Prepare, pieces_with_16_bit_indices_hold_the_same_surface_in_all_levels) {
    const Prepared prepared = prepare(makeShape(Shape::Terrain, 300), {.centre = CentreMode::None, .levels = 2, .chunk16 = true});
    EXPECT_GE(prepared.report.chunks.count, 2u);
    for (const MeshPart& part : prepared.mesh.parts) {
        const auto own = std::span(prepared.mesh.indices).subspan(part.firstIndex, part.indexCount);
        const auto [low, high] = std::ranges::minmax_element(own);
        EXPECT_LT(*high - *low, 65535u);
    }
    EXPECT_EQ(trianglesOf(prepared.mesh), trianglesOf(makeShape(Shape::Terrain, 300)));
    const Prepared whole = prepare(makeShape(Shape::Terrain, 300), {.centre = CentreMode::None, .levels = 2});
    EXPECT_EQ(trianglesOf(prepared.mesh, prepared.glb.levels[0].indices), trianglesOf(whole.mesh, whole.glb.levels[0].indices));
}

TEST_F(Prepare, a_glb_of_pieces_is_read_as_the_same_mesh) {
    const Prepared prepared = prepare(makeShape(Shape::Terrain, 300), {.levels = 2, .chunk16 = true});
    ASSERT_TRUE(writeGlb(folder_ / "pieces.glb", prepared.mesh, prepared.glb));
    const auto read = loadMesh(folder_ / "pieces.glb");
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(trianglesOf(*read), trianglesOf(prepared.mesh));
    EXPECT_EQ(read->positions.size(), prepared.report.output.vertices + prepared.report.chunks.duplicates);
}

TEST_F(Prepare, overdraw_falls_where_a_ball_is_drawn_before_the_one_that_hides_it) {
    Mesh mesh = makeShape(Shape::Sphere, 20);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t indices = mesh.indices.size();
    for (std::uint32_t i = 0; i < count; ++i)
        mesh.positions.push_back(mesh.positions[i] * 2.0f);
    for (std::size_t i = 0; i < indices; ++i)
        mesh.indices.push_back(mesh.indices[i] + count);
    mesh.parts[0].indexCount *= 2;
    const Prepared prepared = prepare(mesh, {.order = std::nullopt, .overdraw = true, .levels = 1});
    ASSERT_TRUE(prepared.report.overdraw);
    EXPECT_GT(prepared.report.overdraw->before, 1.2) << "a ball of half the radius covers a quarter of the picture";
    EXPECT_LT(prepared.report.overdraw->after, 1.05);
}

TEST_F(Prepare, a_sphere_looked_up_by_equal_area_is_even) {
    // A sphere without displacement: its position is its normal, and Lambert's projection keeps areas. At 8,000 triangles the chords of
    // neighbouring charts still differ a little from the arcs.
    Mesh mesh = makeShape(Shape::Sphere, 20);
    for (glm::vec3& p : mesh.positions)
        p = glm::normalize(p);
    const Prepared prepared = prepare(mesh, {.levels = 1, .mappingReport = true});
    for (const MappingFigures& m : prepared.report.mapping) {
        if (m.name != "position, equal area" && m.name != "position, cube map") continue;
        EXPECT_NEAR(m.mirrored, 0, 1e-3) << m.name;
        // the cube map's density is (u^2 + v^2 + 1)^1.5 on its face: CV 0.39 over the sphere
        EXPECT_NEAR(m.cvFace, m.name == "position, cube map" ? 0.39 : 0.0, 0.02) << m.name;
    }
}

TEST_F(Prepare, a_sphere_map_keeps_the_areas_of_a_cap) { // sin(angle / 2) from the middle, as Lambert's projection; its rim is behind
    Mesh mesh = makeShape(Shape::Sphere, 20), cap = mesh;
    cap.indices.clear();
    for (glm::vec3& p : cap.positions)
        p = glm::normalize(p);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        if (cap.positions[mesh.indices[i]].z > 0.2f)
            cap.indices.insert(cap.indices.end(), {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    cap.parts = {{.name = "cap", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(cap.indices.size())}};
    const Prepared prepared = prepare(cap, {.centre = CentreMode::None, .levels = 1, .mappingReport = true});
    const auto found = std::ranges::find(prepared.report.mapping, "position, sphere map", &MappingFigures::name);
    ASSERT_NE(found, prepared.report.mapping.end());
    EXPECT_NEAR(found->cvFace, 0, 0.02) << "chords in place of arcs";
    EXPECT_NEAR(found->density1, 1, 0.02);
}

TEST_F(Prepare, a_square_of_texture_coordinates_has_the_figures_of_its_affine_map) {
    Mesh mesh = makeShape(Shape::Terrain, 8);
    for (glm::vec3& p : mesh.positions)
        p = {p.x, -p.z, 0};
    for (const glm::vec3& p : mesh.positions)
        mesh.uvs.emplace_back(p.x, -p.y / 2); // stretched twice as much along u
    const Prepared prepared = prepare(mesh, {.levels = 1, .mappingReport = true});
    const MappingFigures& m = prepared.report.mapping.front();
    EXPECT_EQ(m.name, "texture coordinates");
    EXPECT_NEAR(m.cvFace, 0, 1e-5);
    EXPECT_NEAR(m.anisotropy50, 2, 1e-4);
    EXPECT_NEAR(m.anisotropy95, 2, 1e-4);
    EXPECT_EQ(m.seamLength, 0);
    EXPECT_EQ(m.mirrored, 0);
}

TEST_F(Prepare, seams_are_as_long_as_the_edges_that_they_follow) {
    // A strip of ten squares, 10 x 1, whose coordinates jump after the seventh: one edge of length 1, over the root of the area.
    for (const float size : {1.0f, 0.001f}) {
        Mesh mesh;
        for (std::uint32_t square = 0; square < 10; ++square) {
            for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
                mesh.positions.emplace_back(size * static_cast<float>(square + static_cast<std::uint32_t>(x)), size * static_cast<float>(y),
                                            0);
                mesh.uvs.emplace_back(0.05f * static_cast<float>(square + static_cast<std::uint32_t>(x)),
                                      (square > 6 ? 0.5f : 0.0f) + 0.05f * static_cast<float>(y));
            }
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
                mesh.indices.push_back(4 * square + corner);
        }
        mesh.parts = {{.name = "strip", .firstIndex = 0, .indexCount = 60}};
        const Prepared prepared = prepare(mesh, {.levels = 1, .mappingReport = true});
        EXPECT_NEAR(prepared.report.mapping.front().seamLength, 1 / std::sqrt(10.0), 1e-6) << size;
        EXPECT_NEAR(*prepared.report.mapping.front().seamJumpTexels, 512, 1e-2) << size;
    }
}

TEST_F(Prepare, contradicting_weld_options_are_refused) {
    const struct {
        SamePlace same;
        int code;
    } cases[] = {{{.epsilon = -1}, 7022},
                 {{.epsilon = NAN}, 7022},
                 {{.epsilon = 0, .decimals = 13}, 7023},
                 {{.epsilon = 0, .decimals = -1}, 7023},
                 {{.epsilon = 1, .decimals = 6}, 7024}};
    for (const auto& test : cases) {
        const auto result = prepareMesh("none.ply", {.same = test.same});
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().diagnostics.front().code, test.code);
        EXPECT_EQ(result.error().blame, Blame::Usage);
    }
}

/// Found by fuzzing: a small triangle beside a line so long that its corners are one float once the middle is the origin.
TEST_F(Prepare, a_mesh_that_loses_its_area_to_floats_is_refused_before_it_is_written) {
    ASSERT_TRUE(
        writePly(folder_ / "wide.ply", meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e30F, 0, 0}, {2e30F, 0, 0}}, {0, 1, 2, 0, 3, 4})));
    const auto result = prepareMesh(folder_ / "wide.ply", {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().diagnostics.front().code, 7020);
    EXPECT_NE(format(result.error()).find("leave out what lies far from the rest"), std::string::npos) << format(result.error());
}

TEST_F(Prepare, a_mesh_that_never_had_an_area_is_told_so) {
    ASSERT_TRUE(writePly(folder_ / "line.ply", meshOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2})));
    const auto result = prepareMesh(folder_ / "line.ply", {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().diagnostics.front().code, 7020);
    EXPECT_NE(format(result.error()).find("on one line"), std::string::npos) << format(result.error());
}

/// Half floats are a millimetre apart there.
TEST_F(Prepare, a_mesh_that_loses_its_area_to_half_floats_is_refused_too) {
    ASSERT_TRUE(
        writePly(folder_ / "wide.ply", meshOf({{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0}, {1500, 0, 0}, {3000, 0, 0}}, {0, 1, 2, 0, 3, 4})));
    EXPECT_TRUE(prepareMesh(folder_ / "wide.ply", {}));
    const auto result = prepareMesh(folder_ / "wide.ply", {.precision = VertexPrecision::Half});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().diagnostics.front().code, 7020);
    EXPECT_NE(format(result.error()).find("--vertex float"), std::string::npos) << format(result.error());
}

TEST_F(Prepare, a_mesh_of_nothing_but_collapsed_triangles_names_the_reason) {
    ASSERT_TRUE(writePly(folder_ / "flat.ply", meshOf({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {0, 1, 2})));
    const auto result = prepareMesh(folder_ / "flat.ply", {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().diagnostics.front().code, 7020);
    EXPECT_NE(format(result.error()).find("1 triangles with two corners at one place"), std::string::npos);
}

TEST_F(Prepare, no_level_tells_a_larger_error_than_a_coarser_one) {
    EXPECT_EQ(told({.greatest = 31.2, .reached = 0.36}), 0.36) << "a bound that says nothing";
    EXPECT_EQ(told({.greatest = 1.01, .reached = 1}), 1.01) << "a bound that is near";
    EXPECT_EQ(told({.greatest = 0, .reached = 0}), 0);
    const auto plate = [](double bump, std::uint32_t side) { // triangles that lie nearly within one plane: bounds are far off there
        std::vector<glm::vec3> places;
        std::vector<std::uint32_t> indices;
        for (std::uint32_t j = 0; j <= side; ++j)
            for (std::uint32_t i = 0; i <= side; ++i)
                places.emplace_back(i, bump * std::sin(37.0 * i + 91.0 * j * j), j);
        addGrid(indices, side, side, "acdadb");
        return meshOf(std::move(places), std::move(indices));
    };
    for (const Mesh& mesh : {plate(1e-5, 90), plate(0.02, 90), makeShape(Shape::Terrain, 70)}) {
        double last = 0;
        for (const LevelFigures& level : prepare(mesh).report.levels) {
            EXPECT_GE(1.02 * told(level.error), last) << "a bound is up to 2 % above what is reached (distance.h)";
            last = told(level.error);
        }
        EXPECT_GT(last, 0);
    }
}
