// Files of grooms: what is written comes back; files that others write are read; what is wrong is one error.

#include "tests/meshprep/groom/grooms.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

using namespace tegument;
using namespace tegument::test;

namespace {

struct Kept {
    const char* ending;
    bool widths, colors, uvs, numbers;
};
constexpr std::array<Kept, 7> kKept = {{{".abc", true, true, true, true},
                                        {".usda", true, true, true, true},
                                        {".hair", true, true, false, false},
                                        {".tfx", false, true, true, false}, // one width a strand
                                        {".glb", true, true, true, true},
                                        {".ply", true, true, true, true},
                                        {".obj", false, true, true, false}}};

float lengthOf(const Groom& groom, std::size_t strand) {
    float length = 0;
    const auto points = groom.strand(strand);
    for (std::size_t k = 1; k < points.size(); ++k)
        length += glm::distance(points[k - 1], points[k]);
    return length;
}

void expectSame(const Groom& one, const Groom& two, const Kept& kept) {
    ASSERT_EQ(one.first, two.first) << kept.ending;
    for (std::size_t i = 0; i < one.strands(); ++i)
        for (std::size_t k = 0; k < one.length(i); ++k)
            ASSERT_LE(glm::distance(one.strand(i)[k], two.strand(i)[k]), 1e-5F * lengthOf(one, i)) << kept.ending << " strand " << i;
    const auto near = [&](const auto& a, const auto& b, bool held, const char* what) {
        EXPECT_EQ(b.size(), held ? a.size() : 0) << kept.ending << what;
        for (std::size_t i = 0; held && i < b.size(); ++i)
            ASSERT_LT(glm::distance(a[i], b[i]), 1e-5F) << kept.ending << what;
    };
    if (kept.widths) near(one.widths, two.widths, true, " widths");
    near(one.colors, two.colors, kept.colors, " colours");
    near(one.rootUvs, two.rootUvs, kept.uvs, " texture coordinates");
    EXPECT_EQ(two.ids, kept.numbers ? one.ids : std::vector<std::int32_t>()) << kept.ending;
    EXPECT_EQ(two.guides, kept.numbers ? one.guides : std::vector<std::int32_t>()) << kept.ending;
    EXPECT_EQ(two.clumps, kept.numbers ? one.clumps : std::vector<std::int32_t>()) << kept.ending;
}

Groom read(const std::string& name, const std::string& bytes, const GroomOptions& options = {}) {
    const auto groom = readGroom(groomFile(name, bytes), options);
    EXPECT_TRUE(groom) << format(groom.error());
    return groom ? *groom : Groom{};
}

int refused(const std::string& name, const std::string& bytes) {
    const auto groom = readGroom(groomFile(name, bytes));
    if (!groom) {
        EXPECT_EQ(groom.error().diagnostics.size(), 1U);
    }
    if (!groom) {
        EXPECT_FALSE(groom.error().diagnostics.front().hint.empty());
    }
    return codeOf(groom);
}

} // namespace

TEST(GroomFiles, come_back_with_all_that_their_format_holds) {
    for (const Kept& kept : kKept) {
        const Groom groom = madeGroom(40, std::string(kept.ending) == ".tfx" ? 16 : 0);
        const auto file = groomFile(std::string("again") + kept.ending);
        const auto lost = writeGroom(file, groom);
        ASSERT_TRUE(lost) << format(lost.error());
        const auto again = readGroom(file);
        ASSERT_TRUE(again) << format(again.error());
        expectSame(groom, inMillimetres(*again), kept);
        const bool all = kept.widths && kept.colors && kept.uvs && kept.numbers;
        EXPECT_EQ(lost->empty(), all) << kept.ending;
        if (!all) {
            EXPECT_EQ(lost->front().code, 5342);
        }
    }
}

TEST(GroomFiles, of_formats_with_splines_keep_them_and_others_get_chains) {
    for (const Spline spline : {Spline::Bezier, Spline::BSpline, Spline::CatmullRom})
        for (const Kept& kept : kKept) {
            const Groom groom = madeGroom(10, 7, spline);
            const auto file = groomFile(std::string("spline") + kept.ending);
            ASSERT_TRUE(writeGroom(file, groom));
            const auto again = readGroom(file);
            ASSERT_TRUE(again) << format(again.error());
            const bool holds = std::string(kept.ending) == ".abc" || std::string(kept.ending) == ".usda";
            EXPECT_EQ(again->spline, holds ? spline : Spline::Linear);
            const Groom right = evaluated(groom), chain = inMillimetres(evaluated(*again));
            for (std::size_t i = 0; i < right.strands(); ++i) {
                EXPECT_LT(glm::distance(right.strand(i).front(), chain.strand(i).front()), 1e-5F * lengthOf(right, i)) << kept.ending;
                EXPECT_LT(glm::distance(right.strand(i).back(), chain.strand(i).back()), 1e-5F * lengthOf(right, i)) << kept.ending;
            }
        }
}

TEST(GroomFiles, say_unit_and_axis_where_they_can_and_take_others) {
    Groom groom = madeGroom();
    for (const Kept& kept : kKept) {
        const auto file = groomFile(std::string("unit") + kept.ending);
        ASSERT_TRUE(writeGroom(file, groom, {.unitMm = 25.4, .zIsUp = true}));
        const bool said = std::string(kept.ending) == ".usda";
        const auto again = said ? readGroom(file) : readGroom(file, {.unitMm = 25.4, .zIsUp = true});
        ASSERT_TRUE(again);
        EXPECT_NEAR(again->unitMm, 25.4, 1e-6);
        EXPECT_TRUE(again->zIsUp);
        EXPECT_LT(glm::distance(inMillimetres(*again).points.front(), groom.points.front()), 1e-3F) << kept.ending;
        EXPECT_LT(std::abs(again->points.front().z * 25.4F - groom.points.front().y), 1e-3F) << "y up has become z up";
    }
    EXPECT_EQ(codeOf(readGroom(groomFile("unit.obj"), {.unitMm = 0})), 5312);
}

TEST(GroomFiles, of_hair_are_read_by_their_description) {
    std::string bytes = "HAIR"; // two strands of 2 and 1 segments
    for (const std::uint32_t v : {2U, 5U, 1U | 2U | 4U | 8U | 16U, 0U})
        put(bytes, v);
    bytes.resize(128);
    for (const std::uint16_t segments : {std::uint16_t{2}, std::uint16_t{1}})
        put(bytes, segments);
    for (int i = 0; i < 15; ++i)
        put(bytes, static_cast<float>(i));
    for (int i = 0; i < 5; ++i)
        put(bytes, 0.01F * static_cast<float>(i + 1));
    bytes.append(20, '\0'); // transparency
    for (int i = 0; i < 15; ++i)
        put(bytes, 0.05F * static_cast<float>(i));
    const Groom groom = read("made.hair", bytes);
    EXPECT_EQ(groom.first, (std::vector<std::uint32_t>{0, 3, 5}));
    EXPECT_EQ(groom.points[4], glm::vec3(12, 13, 14));
    EXPECT_FLOAT_EQ(groom.widths[4], 0.05F);
    EXPECT_FLOAT_EQ(groom.colors[1].y, 0.2F);
    ASSERT_EQ(groom.warnings.size(), 1U);
    EXPECT_EQ(groom.warnings.front().code, 5323) << "transparency";
    EXPECT_EQ(groom.unitMm, 10);

    std::string plain = "HAIR"; // two strands of the same 2 segments, one width, one colour
    for (const std::uint32_t v : {2U, 6U, 2U, 2U})
        put(plain, v);
    for (const float v : {0.5F, 0.0F, 0.25F, 0.5F, 0.75F})
        put(plain, v);
    plain.resize(128);
    for (int i = 0; i < 18; ++i)
        put(plain, static_cast<float>(i * i));
    const Groom even = read("even.hair", plain);
    EXPECT_EQ(even.first, (std::vector<std::uint32_t>{0, 3, 6}));
    EXPECT_EQ(even.widths, std::vector<float>(6, 0.5F));
    EXPECT_EQ(even.colors[5], glm::vec3(0.25F, 0.5F, 0.75F));

    EXPECT_EQ(refused("cut.hair", bytes.substr(0, 250)), 5303);
    EXPECT_EQ(refused("head.hair", bytes.substr(0, 100)), 5301);
    EXPECT_EQ(refused("other.hair", "HARE" + bytes.substr(4)), 5302);
    std::string more = bytes;
    more[8] = 6; // points
    EXPECT_EQ(refused("more.hair", more), 5303);
}

TEST(GroomFiles, of_tress_fx_are_read_by_their_description) {
    std::string bytes;
    put(bytes, 4.0F);
    for (const std::uint32_t v : {2U, 4U, 160U, 160U + 128, 0U, 160U + 128 + 16, 0U})
        put(bytes, v);
    bytes.resize(160);
    for (int i = 0; i < 32; ++i)
        put(bytes, i % 4 == 3 ? 1.0F : static_cast<float>(i));
    for (const float v : {0.1F, 0.2F, 0.3F, 0.4F, 0.001F, 0.002F})
        put(bytes, v);
    const Groom groom = read("made.tfx", bytes);
    EXPECT_EQ(groom.first, (std::vector<std::uint32_t>{0, 4, 8}));
    EXPECT_EQ(groom.points[7], glm::vec3(28, 29, 30));
    EXPECT_EQ(groom.rootUvs[1], glm::vec2(0.3F, 0.4F));
    EXPECT_FLOAT_EQ(groom.widths[7], 0.002F);
    EXPECT_EQ(refused("cut.tfx", bytes.substr(0, 250)), 5303);
    EXPECT_EQ(refused("head.tfx", bytes.substr(0, 100)), 5301);
    groomFile("made.tfxbone", "x");
    EXPECT_EQ(read("made.tfx", bytes).warnings.size(), 1U) << "bones beside it are not read";
    EXPECT_EQ(refused("made.tfxbone", "x"), 5340);
}

TEST(GroomFiles, of_tress_fx_give_all_strands_as_many_points_on_their_course) {
    const Groom groom = madeGroom(20); // 4 to 19 points
    ASSERT_TRUE(writeGroom(groomFile("divided.tfx"), groom));
    const auto again = readGroom(groomFile("divided.tfx"));
    ASSERT_TRUE(again);
    const Groom divided = inMillimetres(*again);
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        EXPECT_EQ(divided.length(i), 32U);
        for (const glm::vec3& p : groom.strand(i))
            EXPECT_TRUE(std::ranges::any_of(divided.strand(i), [&](const glm::vec3& q) { return glm::distance(p, q) < 1e-3F; }));
    }
}

TEST(GroomFiles, of_usd_are_read_as_programs_write_them) {
    const std::string text = R"(#usda 1.0
(
    "by hand" metersPerUnit = 0.1
    upAxis = "Z"   # comment
    customLayerData = { string x = "}" }
)
def Xform "root" ( kind = "component" )
{
    double3 xformOp:translate = (1, 2, 3)
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    rel material:binding = <../m>
    def BasisCurves "hair" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        uniform token type = "cubic"
        uniform token basis = "bspline"
        uniform token wrap = "pinned"
        int[] curveVertexCounts = [4, 4]
        point3f[] points.timeSamples = {
            1: [(0,0,0), (1,0,0), (2,0,0), (3,0,0), (0,1,0), (1,1,0), (2,1,0), (3,1,0)],
            2: [(0,0,9), (1,0,9), (2,0,9), (3,0,9), (0,1,9), (1,1,9), (2,1,9), (3,1,9)],
        }
        float[] widths = [0.5, 0.25] ( interpolation = "uniform" )
        color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)] ( interpolation = "constant" )
        texCoord2f[] primvars:st = [(0.1, 0.2), (0.3, 0.4)] ( interpolation = "uniform" )
    }
    def Mesh "skin" { int[] faceVertexCounts = [3] }
}
)";
    const Groom groom = read("made.usda", text);
    EXPECT_EQ(groom.strands(), 2U);
    EXPECT_EQ(groom.spline, Spline::BSpline);
    EXPECT_TRUE(groom.pinned && groom.zIsUp);
    EXPECT_DOUBLE_EQ(groom.unitMm, 100);
    EXPECT_EQ(groom.points[7], glm::vec3(1 + 2 * 3, 2 + 2, 3));
    EXPECT_EQ(groom.widths, (std::vector<float>{1, 1, 1, 1, 0.5F, 0.5F, 0.5F, 0.5F})) << "scaled with the points";
    EXPECT_EQ(groom.colors.size(), 8U);
    EXPECT_EQ(groom.rootUvs[1], glm::vec2(0.3F, 0.4F));
    ASSERT_EQ(groom.warnings.size(), 1U);
    EXPECT_NE(groom.warnings.front().text.find("of 2 frames one"), std::string::npos);
    EXPECT_EQ(read("made.usda", text, {.frame = 1}).points[0].z, 3 + 2 * 9);

    EXPECT_EQ(refused("cut.usda", text.substr(0, 900)), 5301);
    std::string counts = text;
    counts.replace(counts.find("[4, 4]"), 6, "[4, 9]");
    EXPECT_EQ(refused("counts.usda", counts), 5303);
    std::string wrap = text;
    wrap.replace(wrap.find("pinned"), 6, "periodic");
    EXPECT_EQ(refused("wrap.usda", wrap), 5307);
    std::string turned = text;
    turned.replace(turned.find("\"xformOp:scale\""), 15, "\"xformOp:orient\"");
    EXPECT_EQ(refused("orient.usda", turned), 5307);
    EXPECT_EQ(refused(
                  "deep.usda", "#usda 1.0\n" +
                                   [] {
                                       std::string deep;
                                       for (int i = 0; i < 100'000; ++i)
                                           deep += "def \"a\" {";
                                       return deep;
                                   }()),
              5302);
    EXPECT_EQ(refused("empty.usda", "#usda 1.0\ndef Xform \"x\" {}\n"), 5341);
}

TEST(GroomFiles, of_meshes_are_lines_and_edges) {
    const Groom lines =
        read("made.obj", "v 0 0 0\nv 0 1 0\nv 0 2 0\nv 5 0 0\nv 5 1 0\nvt 0.5 0.25\nl 1/1 2 3\nl -2 -1\nl 9000000000 1\nl x\n");
    EXPECT_EQ(lines.first, (std::vector<std::uint32_t>{0, 3, 5})) << "a line that names what cannot be is none";
    EXPECT_EQ(lines.rootUvs[0], glm::vec2(0.5F, 0.25F));
    EXPECT_EQ(refused("behind.obj", "v 0 0 0\nv 0 1 0\nl 1 3\n"), 5304);
    EXPECT_EQ(refused("faces.obj", "v 0 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\n"), 5341);

    // Edges in any order and direction; a ring; a fork at vertex 4.
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 11\nproperty float x\nproperty float y\nproperty float z\nproperty float radius\n"
        "element edge 10\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    std::string rows;
    for (int i = 0; i < 11; ++i)
        rows += std::to_string(i) + " 0 0 0.5\n";
    const Groom edges = read("made.ply", head + rows + "2 1\n0 1\n2 3\n4 5\n4 6\n4 7\n8 9\n9 10\n10 8\n3 4\n");
    EXPECT_EQ(edges.first, (std::vector<std::uint32_t>{0, 5, 7, 9, 11}));
    EXPECT_EQ(edges.points[4].x, 4) << "from the end with the lower number to the fork";
    EXPECT_EQ(edges.widths[0], 1);
    ASSERT_EQ(edges.warnings.size(), 1U);
    EXPECT_NE(edges.warnings.front().text.find("3 edges of rings"), std::string::npos);
    EXPECT_EQ(refused("edge.ply", head + rows + "0 11\n0 1\n0 1\n0 1\n0 1\n0 1\n0 1\n0 1\n0 1\n0 1\n"), 5304);

    std::string binary;
    for (int i = 0; i < 15; ++i)
        put(binary, static_cast<float>(i));
    const nlohmann::json document = {
        {"asset", {{"version", "2.0"}}},
        {"nodes", {{{"mesh", 0}, {"translation", {10, 0, 0}}}}},
        {"scenes", {{{"nodes", {0}}}}},
        {"meshes",
         {{{"primitives", {{{"mode", 3}, {"attributes", {{"POSITION", 0}}}}, {{"mode", 0}, {"attributes", {{"POSITION", 0}}}}}}}}},
        {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 5}, {"type", "VEC3"}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", 60}}}},
        {"buffers", {{{"byteLength", 60}}}}};
    std::string json = document.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    for (const std::size_t v : {std::size_t{2}, 28 + json.size() + binary.size(), json.size()})
        put(glb, static_cast<std::uint32_t>(v));
    glb += "JSON" + json;
    put(glb, static_cast<std::uint32_t>(binary.size()));
    glb += std::string("BIN\0", 4) + binary;
    const Groom strip = read("made.glb", glb);
    EXPECT_EQ(strip.first, (std::vector<std::uint32_t>{0, 5}));
    EXPECT_EQ(strip.points[1], glm::vec3(13, 4, 5));
    EXPECT_EQ(strip.unitMm, 1000);
}

TEST(GroomFiles, that_are_none_say_what_is_read) {
    EXPECT_EQ(refused("groom.fbx", "Kaydara FBX"), 5340);
    EXPECT_EQ(refused("groom.usdc", "PXR-USDC"), 5340);
    EXPECT_EQ(codeOf(readGroom(groomFile("not_there.abc"))), 5001);
    EXPECT_EQ(refused("hdf.abc", "\x89HDF\r\n\x1a\n........"), 5307);
    EXPECT_EQ(refused("other.abc", "Ogaki............."), 5302);
    EXPECT_EQ(refused("nan.obj", "v 0 0 nan\nv 0 1 0\nl 1 2\n"), 5305);
    const Groom points = read("short.obj", "v 0 0 0\nv 0 1 0\nv 0 0 0\nl 1 2\nl 1\nl 1 3\n");
    EXPECT_EQ(points.strands(), 1U);
    ASSERT_EQ(points.warnings.size(), 1U);
    EXPECT_NE(points.warnings.front().text.find("2 strands"), std::string::npos);
}

TEST(GroomFiles, of_any_bytes_are_a_groom_or_one_error) {
    std::uint32_t state = 1;
    const auto next = [&] { return state = state * 1664525U + 1013904223U; };
    for (const Kept& kept : kKept) {
        const auto file = groomFile(std::string("whole") + kept.ending);
        ASSERT_TRUE(writeGroom(file, madeGroom(3, 4)));
        const std::string whole = readAll(file);
        for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 150) {
            const auto cut = readGroom(groomFile(std::string("cut") + kept.ending, whole.substr(0, size)));
            if (!cut) {
                EXPECT_EQ(cut.error().diagnostics.size(), 1U) << kept.ending << size;
            }
        }
        for (int i = 0; i < 300; ++i) {
            std::string bytes = whole;
            for (int k = 0; k < 1 + i % 3; ++k)
                bytes[next() / 7 % bytes.size()] = static_cast<char>(next() >> 24U);
            const auto groom = readGroom(groomFile(std::string("bent") + kept.ending, bytes));
            if (!groom) {
                EXPECT_EQ(groom.error().diagnostics.size(), 1U) << kept.ending << i;
            }
            if (groom) {
                EXPECT_GT(groom->strands(), 0U);
            }
        }
    }
}
