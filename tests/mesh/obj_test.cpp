#include "host/mesh/read_mesh.h"
#include "tests/mesh/files.h"

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Obj = SceneFiles;

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string positionsOf(const Mesh& mesh) {
    std::string text;
    for (const std::uint32_t index : mesh.indices) {
        const glm::vec3& p = mesh.positions[index];
        text += "(" + std::to_string(static_cast<int>(p.x)) + std::to_string(static_cast<int>(p.y)) +
                std::to_string(static_cast<int>(p.z)) + ")";
    }
    return text;
}

} // namespace

TEST_F(Obj, a_triangle_is_read_in_file_units) {
    const auto mesh = load("a.obj", kTriangle);
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(positionsOf(*mesh), "(000)(100)(010)");
    EXPECT_EQ(mesh->unitMm, 1);
    EXPECT_EQ(mesh->name, "a");
}

TEST_F(Obj, unit_multiplies_every_length) {
    const auto mesh = load("a.obj", kTriangle, {.unitMm = 25.0});
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->positions[1], glm::vec3(25, 0, 0));
    EXPECT_EQ(mesh->unitMm, 25);
}

TEST_F(Obj, v_is_turned_to_point_down) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->uvs[0], glm::vec2(0, 1));
    EXPECT_EQ(mesh->uvs[2], glm::vec2(0, 0));
}

TEST_F(Obj, flip_v_turns_it_again) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n", {.flipV = true});
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->uvs[2], glm::vec2(0, 1));
}

TEST_F(Obj, polygons_become_fans) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(positionsOf(*mesh), "(000)(100)(110)(000)(110)(010)");
}

TEST_F(Obj, negative_indices_count_back_from_the_latest) {
    const auto mesh = load("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(positionsOf(*mesh), "(000)(100)(010)");
}

TEST_F(Obj, windows_line_ends_comments_continuations_and_byte_order_marks_are_read) {
    const auto mesh = load("a.obj", "\xef\xbb\xbf# head\r\nv 0 0 0 # first\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 \\\r\n 2 3\r\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->indices.size(), 3u);
}

TEST_F(Obj, vertices_are_shared_only_where_position_uv_and_normal_agree) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt .5 .5\nvn 0 0 1\n"
                                    "f 1/1/1 2/1/1 3/1/1\nf 2/1/1 4/1/1 3/2/1\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->positions.size(), 5u); // 2/1/1 shared, 3 split by its UV
}

TEST_F(Obj, groups_objects_and_materials_become_parts_that_hold_together) {
    const auto mesh =
        load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no head\nf 1 2 3\ng eye\nf 1 2 3\ng skin\nusemtl red\nf 1 2 3\nf 2 3 1\ng eye\n"
                      "usemtl red\nf 3 2 1\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    std::string text;
    for (const MeshPart& part : mesh->parts)
        text += part.name + " " + std::to_string(part.firstIndex) + "+" + std::to_string(part.indexCount) + ";";
    EXPECT_EQ(text, "head 0+3;eye 3+3;skin:red 6+6;eye:red 12+3;");
}

TEST_F(Obj, missing_normals_of_some_corners_renew_all) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2//1 3\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->normals[0], glm::vec3(0, 0, 1));
}

TEST_F(Obj, missing_uvs_of_some_corners_are_warned_of) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 0\nf 1/1 2/1 3\n");
    ASSERT_TRUE(mesh);
    EXPECT_TRUE(hasWarning(*mesh, 5325));
}

TEST_F(Obj, unknown_statements_are_ignored_with_a_warning_that_names_the_line) {
    const auto mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ncurv2 1 2\nf 1 2 3\n");
    ASSERT_TRUE(mesh);
    ASSERT_TRUE(hasWarning(*mesh, 5323));
    EXPECT_EQ(mesh->warnings[0].at.line, 4);
}

TEST_F(Obj, bad_input_is_one_error_with_its_line) {
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::vector<Fault> faults = {
        {three + "f 1 2 9\n", 5304, 4},  // beyond the last vertex
        {three + "f 0 1 2\n", 5304, 4},  // OBJ counts from 1
        {three + "f -4 1 2\n", 5304, 4}, // before the first
        {three + "f 1 2 x\n", 5302, 4},
        {three + "f 1/2/3/4 2 3\n", 5302, 4},
        {three + "f 99999999999999999999 1 2\n", 5302, 4},
        {"v 0 0\n", 5302, 1},
        {"v 0 0,5 0\n", 5302, 1}, // decimal comma
        {"v 0 0 nan\n", 5305, 1},
        {"v 0 0 1e39\n", 5305, 1}, // beyond float
        {"v 0 0 1e999\n", 5305, 1},
        {"v inf 0 0\n", 5305, 1},
        {"v 0 -1.#IND 0 # as older programs print it\n", 5305, 1},
        {three, 5306, 0},
        {three + "f 1 2\n", 5306, 0},
        {three + "f 1 1 2\n", 5306, 0}, // nothing but a degenerate triangle
        {"", 5300, 0},
    };
    expectFaults("a.obj", faults);
}

TEST_F(Obj, utf16_is_named) {
    EXPECT_EQ(codeOf(load("a.obj", std::string_view("\xff\xfev\0 \0", 6))), 5302);
}

TEST_F(Obj, degenerate_triangles_are_left_out_with_a_count) {
    const auto mesh = load("a.obj", std::string(kTriangle) + "f 1 1 2\nf 2 3 3\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->indices.size(), 3u);
    ASSERT_TRUE(hasWarning(*mesh, 5322));
    EXPECT_NE(mesh->warnings[0].text.find("2 triangles"), std::string::npos);
}

TEST_F(Obj, an_unreferenced_vertex_does_not_stretch_the_bounds) {
    const auto mesh = load("a.obj", "v 1e30 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->positions.size(), 3u);
    EXPECT_LT(mesh->bounds.radius, 1);
}

namespace {

/// A triangle with texture coordinates, of one material or of two.
constexpr std::string_view kMaterialObj =
    "mtllib my scan.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl skin\nf 1/1 2/2 3/3\n";

} // namespace

TEST_F(Obj, brings_the_colour_map_that_its_material_names) {
    Image red{.width = 2, .height = 1, .channels = 3, .pixels = {1, 0, 0, 1, 0, 0}};
    ASSERT_TRUE(writePng(folder_ / "red.png", red, PngEncoding::Raw));
    for (const std::string_view line : {"map_Kd red.png", "\tmap_Kd -s 1 1 1 red.png \r", "MAP_KD .\\red.png"}) {
        write("my scan.mtl", "newmtl other\nmap_Kd none.png\nnewmtl skin\nKd 1 1 1\n" + std::string(line) + "\n");
        const auto mesh = load("a.obj", std::string(kMaterialObj));
        ASSERT_TRUE(mesh) << line;
        ASSERT_EQ(mesh->textures.size(), 1U) << line;
        EXPECT_EQ(mesh->textures[0].role, "color");
        EXPECT_EQ(mesh->textures[0].image.at(1, 0, 0), 1);
    }
}

TEST_F(Obj, lays_out_several_colours_in_a_sheet_or_keeps_the_first_where_coordinates_must_stay) {
    for (const auto& [name, colour] :
         {std::pair("red.png", std::vector<float>{1, 0, 0}), std::pair("eye.png", std::vector<float>{0, 0, 1})})
        ASSERT_TRUE(writePng(folder_ / name, {.width = 1, .height = 1, .channels = 3, .pixels = colour}, PngEncoding::Raw));
    write("my scan.mtl", "newmtl skin\nmap_Kd red.png\nKd 0 0 0\nnewmtl eye\nmap_Kd eye.png\nnewmtl lip\nKd 0 .25 0\n");
    const std::string text = std::string(kMaterialObj) + "usemtl eye\nf 3/3 2/2 1/1\nusemtl lip\nf 1/1 2/2 3/3\n"; // of the same corners
    const auto sheet = load("a.obj", text);
    ASSERT_TRUE(sheet) << format(sheet.error());
    ASSERT_EQ(sheet->textures.size(), 1U);
    EXPECT_EQ(sheet->positions.size(), 9U) << "a vertex for each colour";
    const Image& image = sheet->textures[0].image;
    const std::vector<glm::vec3> colours = {{1, 0, 0}, {0, 0, 1}, {0, linearToSrgb(0.25F), 0}};
    for (std::size_t i = 0; i < sheet->indices.size(); ++i) {
        const glm::ivec2 texel = glm::clamp(glm::ivec2(sheet->uvs[sheet->indices[i]] * glm::vec2(image.width, image.height)), 0, 4096);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.at(texel.x, texel.y, c), colours[i / 3][c], 1e-3) << i;
    }
    const auto two = load("a.obj", text, {.ownCoordinates = true});
    ASSERT_TRUE(two);
    EXPECT_EQ(two->textures.size(), 1U);
    EXPECT_EQ(two->uvs[two->indices[1]], glm::vec2(1, 1));
    ASSERT_FALSE(two->warnings.empty());
    EXPECT_EQ(two->warnings[0].code, 5326);
    write("my scan.mtl", "newmtl skin\nmap_Kd gone.png\n");
    const auto gone = load("a.obj", std::string(kMaterialObj));
    ASSERT_TRUE(gone);
    EXPECT_TRUE(gone->textures.empty());
    ASSERT_EQ(gone->warnings.size(), 1U);
    EXPECT_EQ(gone->warnings[0].code, 5328);
    std::filesystem::remove(folder_ / "my scan.mtl");
    EXPECT_TRUE(load("a.obj", std::string(kMaterialObj))->warnings.empty()) << "materials are often left behind";
}

TEST_F(Obj, finds_libraries_and_pictures_that_were_named_on_another_machine) {
    ASSERT_TRUE(writePng(folder_ / "Bunny Col.png", {.width = 1, .height = 1, .channels = 3, .pixels = {1, 0, 0}}, PngEncoding::Raw));
    const std::string body = "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl skin\nf 1/1 2/2 3/3\n";
    const auto picturesOf = [&](const std::string& library, const std::string& map) {
        write("bunny.mtl", map);
        const auto mesh = load("a.obj", "mtllib " + library + body);
        return mesh ? mesh->textures.size() : 0;
    };
    const std::string map = "newmtl skin\nmap_Kd Bunny Col.png\n";
    EXPECT_EQ(picturesOf("bunny.mtl", map), 1U) << "as it is";
    EXPECT_EQ(picturesOf("C:\\Users\\Bob\\My Scans\\bunny.mtl", map), 1U) << "a place of Windows";
    EXPECT_EQ(picturesOf("/srv/scans/Bunny.MTL", map), 1U) << "a place of Linux, in other letters";
    EXPECT_EQ(picturesOf("\"bunny.mtl\"", map), 1U) << "in quotes";
    EXPECT_EQ(picturesOf("none.mtl bunny.mtl", map), 1U) << "several";
    write("-bunny.png", *readFile(folder_ / "Bunny Col.png"));
    EXPECT_EQ(picturesOf("bunny.mtl", "newmtl skin\nmap_Kd -bunny.png\n"), 1U) << "a name that begins as an option does";
    EXPECT_EQ(picturesOf("bunny.mtl", "newmtl skin\nmap_Kd C:\\Textures\\BUNNY COL.PNG\n"), 1U);
    EXPECT_EQ(picturesOf("bunny.mtl", "newmtl skin\nmap_Kd -s 2 2 1 -bm 0.5 -o 0.1 Bunny Col.png\n"), 1U) << "spaces behind options";
    EXPECT_EQ(picturesOf("bunny.mtl", "\xef\xbb\xbfnewmtl skin\rmap_Kd Bunny Col.png\r"), 1U) << "a mark, and old Macintosh lines";
}

TEST_F(Obj, says_which_picture_is_not_there) {
    write("my scan.mtl", "newmtl skin\nmap_Kd textures/gone.png\n");
    const auto mesh = load("a.obj", std::string(kMaterialObj));
    ASSERT_EQ(mesh->warnings.size(), 1U);
    EXPECT_NE(mesh->warnings[0].text.find("gone.png"), std::string::npos) << mesh->warnings[0].text;
}

TEST_F(Obj, brings_a_picture_for_each_tile_of_the_plane) {
    std::filesystem::create_directory(folder_ / "maps");
    for (const auto& [number, pixel] : {std::pair(1001, std::vector<float>{1, 0, 0}), std::pair(1012, std::vector<float>{0, 0, 1})})
        ASSERT_TRUE(writePng(folder_ / "maps" / ("skin." + std::to_string(number) + ".png"),
                             {.width = 1, .height = 1, .channels = 3, .pixels = pixel}, PngEncoding::Raw));
    write("my scan.mtl", "newmtl skin\nmap_Kd maps/skin.<UDIM>.png\n");
    const std::string text = std::string(kMaterialObj) + "v 5 0 0\nv 6 0 0\nv 5 1 0\nvt 1.25 1.5\nvt 2 1\nvt 1 2\nf 4/4 5/5 6/6\n";
    const auto mesh = load("a.obj", text);
    ASSERT_TRUE(mesh) << format(mesh.error());
    ASSERT_EQ(mesh->textures.size(), 1U);
    const Image& sheet = mesh->textures[0].image;
    ASSERT_EQ(sheet.width, 2);
    EXPECT_EQ(sheet.at(0, 0, 0), 1);
    EXPECT_EQ(sheet.at(1, 0, 2), 1);
    EXPECT_EQ(mesh->uvs, (std::vector<glm::vec2>{{0, 1}, {0.5F, 1}, {0, 0}, {0.625F, 0.5F}, {1, 1}, {0.5F, 0}}));
    const auto carried = readMesh(folder_ / "a.obj", {.carryMaterials = true});
    ASSERT_TRUE(carried);
    EXPECT_EQ(carried->mesh.textures.size(), 1U) << "prepared meshes keep it";
}

namespace {

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

} // namespace

TEST_F(Obj, positions_are_divided_by_their_weight) {
    const auto mesh = load("a.obj", "v 0 0 0 4\nv 4 0 0 4\nv 0 -3 0 -1\nf 1 2 3\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_EQ(mesh->positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh->positions[2], glm::vec3(0, 3, 0));
    EXPECT_EQ(load("b.obj", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n")->positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(codeOf(load("c.obj", "v 0 0 0 1\nv 1 0 0 0\nv 0 1 0 1\nf 1 2 3\n")), 5302);
}

TEST_F(Obj, old_words_and_capitals_are_read) {
    for (const std::string& text : {kThree + "fo 1 2 3\n", std::string("V 0 0 0\nV 1 0 0\nV 0 1 0\nF 1 2 3\n"),
                                    std::string("V 0 0 0\nv 1 0 0\nV 0 1 0\nVT 0 0\nVT 1 0\nVT 0 1\nUSEMTL skin\nFO 1/1 2/2 3/3\n")}) {
        const auto mesh = load("a.obj", text);
        ASSERT_TRUE(mesh) << text << format(mesh.error());
        EXPECT_EQ(mesh->indices.size(), 3U) << text;
        EXPECT_FALSE(hasWarning(*mesh, 5323)) << text;
    }
}

TEST_F(Obj, painted_colours_in_comments_are_kept_or_told) {
    const auto mesh = load("a.obj", kThree + "#MRGB ffff0000ff00ff00\n#MRGB ff0000ff\nf 1 2 3\n");
    ASSERT_TRUE(mesh) << format(mesh.error());
    ASSERT_EQ(mesh->colors.size(), 3U);
    EXPECT_EQ(mesh->colors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(mesh->colors[2], glm::vec4(0, 0, 1, 1));
    const auto few = load("a.obj", kThree + "#MRGB ffff0000\nf 1 2 3\n");
    ASSERT_TRUE(few);
    EXPECT_TRUE(few->colors.empty());
    EXPECT_TRUE(hasWarning(*few, 5323)) << "one colour for three vertices";
    EXPECT_FALSE(hasWarning(*load("a.obj", kThree + "#MRGB is what ZBrush writes\nf 1 2 3\n"), 5323)) << "a comment";
}

TEST_F(Obj, names_of_normals_that_are_absent_are_told_and_made_anew) {
    for (const char* face : {"f 1//1 2//1 3//1\n", "vn 0 0 -1\nf 1//1 2//2 3//1\n", "f 1//-1 2//-1 3//-1\n"}) {
        const auto mesh = load("a.obj", kThree + face);
        ASSERT_TRUE(mesh) << face << format(mesh.error());
        EXPECT_TRUE(hasWarning(*mesh, 5324)) << face;
        EXPECT_EQ(mesh->normals[0], glm::vec3(0, 0, 1)) << face;
    }
}

TEST_F(Obj, names_of_texture_coordinates_that_are_absent_are_told_and_the_shape_is_kept) {
    for (const char* face : {"f 1/1 2/1 3/1\n", "f 1/0 2/0 3/0\n", "f 1/-1 2/-1 3/-1\n", "vt .5 .25\nf 1/1 2/2 3/3\n"}) {
        const auto mesh = load("a.obj", kThree + face);
        ASSERT_TRUE(mesh) << face << format(mesh.error());
        EXPECT_TRUE(hasWarning(*mesh, 5325)) << face;
        EXPECT_EQ(mesh->positions.size(), 3U) << face;
        if (std::string_view(face).starts_with("vt"))
            EXPECT_EQ(mesh->uvs, (std::vector<glm::vec2>{{0.5F, 0.75F}, {0, 0}, {0, 0}})) << "those that are there are kept";
        else
            EXPECT_TRUE(mesh->uvs.empty()) << face;
    }
}
