#include "tests/mesh/files.h"

#include <cctype>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Off = SceneFiles;

const std::string kPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

using Stl = SceneFiles;

constexpr std::string_view kFacet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string text(int facets, std::string_view end = "endsolid thing\n") {
    std::string bytes = "solid thing\n";
    for (int i = 0; i < facets; ++i)
        bytes += kFacet;
    return bytes + std::string(end);
}

std::string binary(std::uint32_t announced, std::uint32_t facets, std::string start = {}) {
    start.resize(80, ' ');
    append(start, std::vector<std::uint32_t>{announced});
    for (std::uint32_t i = 0; i < facets; ++i) {
        append(start, std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0});
        append(start, std::vector<std::uint16_t>{0});
    }
    return start;
}

} // namespace

TEST_F(Off, polygons_comments_and_face_colours_are_read) {
    const auto mesh = load("a.off", "OFF # a square\n# made by hand\n4 1 4\n0 0 0\n1 0 0\n1 1 0 # corner\n0 1 0\n4 0 1 2 3 255 0 0\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST_F(Off, counts_may_stand_beside_the_keyword) {
    EXPECT_TRUE(load("a.off", "OFF 3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n"));
}

TEST_F(Off, the_keyword_may_be_missing_as_in_geomview_s_own_files) {
    const auto mesh = load("a.off", "# a triangle\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3u);
}

TEST_F(Off, normals_colours_and_texture_coordinates_are_told_by_the_keyword) {
    const auto mesh = load("a.off", "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 1 0\n0 1 0 0 0 1 1 1 1 1 0 1\n3 0 1 2\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh->uvs[0], glm::vec2(0, 1)) << "v points up in the file";
    EXPECT_EQ(mesh->positions[1], glm::vec3(1, 0, 0));
}

TEST_F(Off, bad_input_is_one_error_with_its_line) {
    const std::vector<Fault> faults = {
        {"MOFF\n3 1 0\n", 5302, 1},
        {"4OFF\n3 1 0\n", 5302, 1},
        {"OFF\n-3 1 0\n", 5302, 2},
        {"OFF\n4000000000 1 0\n0 0 0\n", 5303, 2},
        {"OFF\n3 2000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 5303, 2},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 5304, 6},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", 5304, 6},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2147483647 0 1 2\n", 5303, 6},
        {"OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", 5305, 4},
        {"OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", 5302, 4},
        {"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", 5306, 0},
    };
    expectFaults("a.off", faults);
}

TEST_F(Off, every_truncation_is_an_error) {
    const std::string whole = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (std::size_t size = 0; size + 1 < whole.size(); ++size)
        EXPECT_FALSE(load("a.off", whole.substr(0, size))) << size;
}

TEST_F(Off, the_number_of_edges_may_be_absent_and_the_keyword_glued) {
    for (const std::string head : {"OFF\n4 2\n", "OFF4 2 0\n", "OFF 4 2\n", "OFF\n4 2\n0\n", "OFF\n4\n2 0 # edges are not counted\n"}) {
        const auto mesh = load("a.off", head + kPoints + "3 0 1 2\n3 0 2 3\n");
        ASSERT_TRUE(mesh) << head << format(mesh.error());
        EXPECT_EQ(mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3})) << head;
        EXPECT_TRUE(mesh->warnings.empty()) << head;
    }
}

TEST_F(Off, faces_behind_the_last_are_kept_with_a_warning_and_what_is_no_face_is_an_error) {
    const auto mesh = load("a.off", "OFF\n4 1 0\n" + kPoints + "3 0 1 2\n3 0 2 3\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 6U);
    EXPECT_TRUE(hasWarning(*mesh, 5323));
    const auto point = load("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n0.5 1 0\n3 0 1 2\n"); // a vertex more than announced
    ASSERT_FALSE(point);
    EXPECT_FALSE(load("a.off", "OFF\n4 1 0\n" + kPoints + "3 0 1 2\nthe end\n"));
}

TEST_F(Off, colours_of_vertices_are_kept_where_they_are_named_and_told_where_not) {
    const auto rgb = load("a.off", "COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n");
    ASSERT_TRUE(rgb) << format(rgb.error());
    ASSERT_EQ(rgb->colors.size(), 3U);
    EXPECT_EQ(rgb->colors[1], glm::vec4(0, 1, 0, 1));
    for (const char* more : {" 1 0 0", " 0 0 0 1", " 200 10 10 255"}) {
        std::string text = "OFF\n3 1 0\n";
        for (const char* place : {"0 0 0", "1 0 0", "0 1 0"})
            text += std::string(place) + more + "\n";
        const auto unnamed = load("a.off", text + "3 0 1 2\n");
        ASSERT_TRUE(unnamed) << more << format(unnamed.error());
        EXPECT_EQ(unnamed->positions[1], glm::vec3(1, 0, 0)) << more;
        EXPECT_TRUE(hasWarning(*unnamed, 5331)) << more;
    }
}

TEST_F(Off, binary_files_are_named_as_such) {
    for (const std::string word : {"OFF BINARY", "COFF BINARY", "STOFF  BINARY"}) {
        const auto mesh = load("a.off", word + std::string("\n\0\0\0\3", 5));
        ASSERT_EQ(codeOf(mesh), 5307) << word;
    }
}

TEST_F(Stl, text_and_binary_give_the_same_triangles) {
    const auto a = load("a.stl", text(2));
    const auto b = load("b.stl", binary(2, 2));
    ASSERT_TRUE(a) << format(a.error());
    ASSERT_TRUE(b) << format(b.error());
    EXPECT_EQ(a->positions, b->positions);
    EXPECT_EQ(a->indices, b->indices);
    EXPECT_EQ(a->positions[1], glm::vec3(1, 0, 0));
}

TEST_F(Stl, a_binary_file_that_starts_with_solid_is_read_as_binary) {
    const auto mesh = load("a.stl", binary(1, 1, "solid and yet binary"));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3u);
}

TEST_F(Stl, keywords_of_any_case_and_several_solids_are_read) {
    const auto mesh = load("a.stl", "solid A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\n"
                                    "ENDSOLID A\n" +
                                        text(1));
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 6u);
}

TEST_F(Stl, bytes_behind_the_last_facet_do_no_harm) {
    const auto mesh = load("a.stl", binary(1, 1) + "made by hand");
    ASSERT_TRUE(mesh) << format(mesh.error());
}

TEST_F(Stl, a_count_beyond_the_file_is_named_with_its_byte) {
    const auto mesh = load("a.stl", binary(1000, 1));
    ASSERT_EQ(codeOf(mesh), 5303);
    EXPECT_EQ(mesh.error().diagnostics.front().at.byte, 80u);
    EXPECT_NE(format(mesh.error()).find("1000 facets are announced, the file holds 1"), std::string::npos);
}

TEST_F(Stl, bad_text_is_one_error_with_its_line) {
    const std::vector<Fault> faults = {
        {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nendloop\n", 5302, 6},
        {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0,5\n", 5302, 5},
        {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n", 5305, 4},
        {"solid\nfacet direction 0 0 1\n", 5302, 2},
        {"solid\nloop\n", 5302, 2},
        {"solid\nendsolid\n", 5306, 0},
    };
    expectFaults("a.stl", faults);
}

TEST_F(Stl, every_truncation_is_an_error) {
    const std::string bytes = binary(2, 2);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(load("a.stl", bytes.substr(0, size))) << size;
    const std::string whole = text(1);
    const std::size_t facets = text(1, "").size();
    for (std::size_t size = 0; size + sizeof(" thing\n") <= whole.size(); ++size) // "endsolid" alone is an end
        if (size < facets - 1 || size > facets) {
            EXPECT_FALSE(load("a.stl", whole.substr(0, size))) << size;
        }
}

TEST_F(Stl, text_is_text_also_indented_in_capitals_or_behind_a_mark) {
    for (const std::string& before : {std::string("  \n\t"), std::string("\xef\xbb\xbf"), std::string()}) {
        std::string capitals = before + text(40);
        for (char& letter : capitals)
            letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        for (const std::string& file : {before + text(40), capitals}) {
            const auto mesh = load("a.stl", file);
            ASSERT_TRUE(mesh) << format(mesh.error());
            EXPECT_EQ(mesh->indices.size(), 120U);
        }
    }
}

TEST_F(Stl, a_binary_file_without_a_count_is_read_to_its_end_with_a_warning) {
    for (const std::uint32_t unsaid : {0U, UINT32_MAX}) {
        const auto mesh = load("a.stl", binary(unsaid, 3));
        ASSERT_TRUE(mesh);
        EXPECT_EQ(mesh->indices.size(), 9U);
        ASSERT_FALSE(mesh->warnings.empty());
        EXPECT_EQ(mesh->warnings.front().code, 5323);
    }
}

TEST_F(Stl, ends_in_two_words_are_read) {
    const auto with = [](std::string bytes, std::string_view word, std::string_view words) {
        for (std::size_t at = bytes.find(word); at != std::string::npos; at = bytes.find(word, at + words.size()))
            bytes.replace(at, word.size(), words);
        return bytes;
    };
    const std::string plain = text(3);
    for (const std::string& spaced :
         {with(plain, "endloop", "end loop"), with(plain, "endfacet", "End\tFacet"), with(plain, "endsolid", "END SOLID"),
          with(with(with(plain, "endloop", " end  loop"), "endfacet", "end facet"), "endsolid thing", "end solid")}) {
        const auto mesh = load("a.stl", spaced);
        ASSERT_TRUE(mesh) << spaced << format(mesh.error());
        EXPECT_EQ(mesh->indices.size(), 9U) << spaced;
        EXPECT_FALSE(hasWarning(*mesh, 5323)) << spaced;
    }
    EXPECT_EQ(codeOf(load("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nend facet\n")), 5302);
}

TEST_F(Stl, a_missing_end_behind_whole_facets_is_told) {
    for (const int facets : {1, 2, 5}) {
        const auto mesh = load("a.stl", text(facets, ""));
        ASSERT_TRUE(mesh) << format(mesh.error());
        EXPECT_EQ(mesh->indices.size(), 3U * static_cast<unsigned>(facets));
        EXPECT_TRUE(hasWarning(*mesh, 5323)) << "the file may have been longer";
    }
    EXPECT_EQ(codeOf(load("a.stl", text(0, ""))), 5301);
}
