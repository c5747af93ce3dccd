// A mesh of one's own and nothing else: fur, framing, unit, colour, no texture coordinates.

#include "host/image/dds.h"
#include "host/support/file.h"
#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

using namespace tegument::test;
using ::tegument::Image;
namespace fs = std::filesystem;

namespace {

const std::map<std::string, std::string>& freshCache() {
    static const std::map<std::string, std::string> kEnvironment = {{"TEGUMENT_CACHE", (scratch() / "fresh").string()}};
    return kEnvironment;
}

struct Drawn {
    Ran ran;
    Image image;
};

Drawn draw(const std::string& name, std::vector<std::string> arguments, const std::map<std::string, std::string>& environment = {}) {
    const fs::path path = scratch() / (name + ".exr");
    arguments.insert(arguments.begin(), {"render", "--size", "160x160", "--map-size", "128", "-o", path.string()});
    Drawn drawn{.ran = tegument::test::tegument(arguments, environment)};
    if (drawn.ran.code != 0) return drawn;
    if (auto image = tegument::loadImage(path)) drawn.image = std::move(*image);
    return drawn;
}

/// The pixels that show something.
struct Covered {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
    int count = 0;
};

Covered covered(const Image& image) {
    Covered c;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y, 3) <= 0) continue;
            c.left = std::min(c.left, x), c.right = std::max(c.right, x);
            c.top = std::min(c.top, y), c.bottom = std::max(c.bottom, y);
            ++c.count;
        }
    return c;
}

/// A closed cylinder without texture coordinates, its axis along `axis` (0 x, 1 y, 2 z), its middle at (5000, -300, 70).
std::string rod(int axis, double radius, double length) {
    std::string text;
    constexpr int kSides = 24;
    const auto vertex = [&](double along, double a, double b) {
        double p[3] = {0, 0, 0};
        p[axis] = along, p[(axis + 1) % 3] = a, p[(axis + 2) % 3] = b;
        text += fmt::format("v {} {} {}\n", p[0] + 5000, p[1] - 300, p[2] + 70);
    };
    for (const double end : {-0.5, 0.5})
        for (int i = 0; i < kSides; ++i)
            vertex(end * length, radius * std::cos(2 * M_PI * i / kSides), radius * std::sin(2 * M_PI * i / kSides));
    vertex(-0.5 * length, 0, 0), vertex(0.5 * length, 0, 0);
    for (int i = 0; i < kSides; ++i) {
        const int a = i + 1, b = (i + 1) % kSides + 1, c = a + kSides, d = b + kSides;
        text += fmt::format("f {0} {1} {3}\nf {0} {3} {2}\nf {4} {1} {0}\nf {5} {2} {3}\n", a, b, c, d, 2 * kSides + 1, 2 * kSides + 2);
    }
    return text;
}

/// Textures; beside each stands how long it took.
std::vector<fs::path> madeFiles() {
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(scratch() / "fresh" / "fur" / "made", none))
        if (entry.path().extension() == ".dds") files.push_back(entry.path().filename());
    std::ranges::sort(files);
    return files;
}

/// Share of the pixels in which two pictures differ by more than a hundredth.
double different(const Image& a, const Image& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4)
        count += std::abs(a.pixels[i] - b.pixels[i]) > 0.01F;
    return 4.0 * static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

/// A texture of one texel without strands.
std::string baldMap() {
    const fs::path path = scratch() / "bald.dds";
    tegument::DdsTexture cube{.format = tegument::DdsFormat::Rgba8, .faces = 6, .mips = 1};
    cube.images.assign(6, Image{.width = 1, .height = 1, .channels = 4, .pixels = {1, 1, 1, 0}});
    EXPECT_TRUE(tegument::writeDds(path, cube));
    return path.string();
}

} // namespace

TEST(OwnMesh, gets_fur_in_one_command_and_its_maps_once) {
    const Drawn first = draw("fur", {"effects/Fur.fx", "--mesh", ballMesh()}, freshCache());
    ASSERT_EQ(first.ran.code, 0) << first.ran.err;
    EXPECT_NE(first.ran.err.find("made fur cube map"), std::string::npos) << first.ran.err;
    const Drawn second = draw("fur2", {"effects/Fur.fx", "--mesh", ballMesh()}, freshCache());
    EXPECT_EQ(second.ran.err.find("made"), std::string::npos) << second.ran.err;
    EXPECT_EQ(first.image.pixels, second.image.pixels);
    const Drawn bald = draw("bald", {"effects/Fur.fx", "--mesh", ballMesh(), "--set", "gFurCubeMap=" + baldMap()}, freshCache());
    ASSERT_EQ(bald.ran.code, 0) << bald.ran.err;
    EXPECT_GT(different(first.image, bald.image), 0.3) << "the ball covers half of the picture, and a coat nearly all of the ball";
}

TEST(OwnMesh, gets_roots_of_its_own_for_those_techniques_that_read_them) {
    ASSERT_EQ(draw("cellular", {"effects/FurRoots.fx", "-t", "Cellular", "--mesh", ballMesh()}, freshCache()).ran.code, 0);
    const auto before = madeFiles();
    const Drawn roots = draw("roots", {"effects/FurRoots.fx", "-t", "Roots", "--mesh", ballMesh()}, freshCache());
    ASSERT_EQ(roots.ran.code, 0) << roots.ran.err;
    EXPECT_EQ(madeFiles().size(), before.size() + 1) << "Cellular makes none, Roots one";
    const std::string other = write("egg.obj", ballObj(48, 90));
    ASSERT_EQ(draw("egg", {"effects/FurRoots.fx", "-t", "Roots", "--mesh", other}, freshCache()).ran.code, 0);
    EXPECT_EQ(madeFiles().size(), before.size() + 2) << "another mesh has roots of its own";
    const Drawn again = draw("roots2", {"effects/FurRoots.fx", "-t", "Roots", "--mesh", ballMesh()}, freshCache());
    EXPECT_EQ(again.ran.err.find("made"), std::string::npos) << again.ran.err;
    EXPECT_EQ(roots.image.pixels, again.image.pixels);
}

TEST(OwnMesh, is_refused_roots_of_another_mesh_with_the_reason) {
    const std::string roots = (scratch() / "of_rod.dds").string();
    const std::string thin = write("thin.obj", rod(1, 40, 300));
    ASSERT_EQ(tegument::test::tegument({"fur", "roots", thin, "-o", roots, "--count", "2000"}).code, 0);
    const std::vector<std::string> own = {"effects/FurRoots.fx", "-t", "Roots", "--mesh", thin, "--set", "gFurRootsMap=" + roots};
    EXPECT_EQ(draw("thin", own).ran.code, 0);
    auto inches = own;
    inches.insert(inches.end(), {"--unit-mm", "25.4"});
    EXPECT_EQ(draw("inches", inches).ran.code, 0) << "the same mesh in another unit";
    const std::string fat = write("fat.obj", rod(1, 50, 300));
    const Ran refused = draw("fat", {"effects/FurRoots.fx", "-t", "Roots", "--mesh", fat, "--set", "gFurRootsMap=" + roots}).ran;
    EXPECT_EQ(refused.code, 1);
    for (const char* text : {"TG4055", "another mesh than fat", "area", "gFurRootsMap", "--set"})
        EXPECT_NE(refused.err.find(text), std::string::npos) << text << " in " << refused.err;
    EXPECT_EQ(draw("cell", {"effects/FurRoots.fx", "-t", "Cellular", "--mesh", fat, "--set", "gFurRootsMap=" + roots}).ran.code, 0)
        << "a technique that does not read them has nothing to say of them";
}

TEST(OwnMesh, has_fur_maps_with_the_figures_that_their_parameters_are_set_to) {
    const Ran ran = tegument::test::tegument({"fur", "texture", "-o", (scratch() / "maps").string(), "--size", "2048", "--density", "0.05",
                                              "--spacing", "2.8", "--radius", "3.4", "--shortest", "0.45", "--taper", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NEAR(ran.json()["height_deviation"], 0.194, 0.0005) << "gFurDeviation of meshprep/assets/generators.cpp";
    EXPECT_NEAR(ran.json()["height_grain"], 0.00473, 0.00001) << "gFurGrain";
    ASSERT_EQ(draw("maps", {"effects/Fur.fx", "--mesh", ballMesh()}, freshCache()).ran.code, 0);
    const auto made = tegument::loadDds(scratch() / "fresh/fur/made/cube_1.dds");
    const auto asked = tegument::loadDds(scratch() / "maps/fur_cube.dds");
    ASSERT_TRUE(made && asked);
    EXPECT_EQ(made->at(2, 0).pixels, asked->at(2, 0).pixels) << "what is made is what that command makes";
}

TEST(OwnMesh, is_framed_by_its_bounds_wherever_it_stands) {
    for (const int axis : {0, 1, 2}) {
        const std::string path = write(fmt::format("rod{}.obj", axis), rod(axis, 20, 400));
        const Drawn drawn = draw(fmt::format("rod{}", axis), {"effects/Fur.fx", "--mesh", path, "--set", "gFurLength=0"});
        ASSERT_EQ(drawn.ran.code, 0) << drawn.ran.err;
        const Covered c = covered(drawn.image);
        const int widest = std::max(c.right - c.left, c.bottom - c.top);
        EXPECT_NEAR(widest, 0.84 * 160, 2) << "axis " << axis;
        EXPECT_NEAR(c.left + c.right, 159, 2) << "axis " << axis;
        EXPECT_NEAR(c.top + c.bottom, 159, 2) << "axis " << axis;
    }
}

TEST(OwnMesh, keeps_the_camera_of_a_workspace_that_is_named) {
    const Drawn own = draw("own", {"effects/Specular.fx", "--mesh", ballMesh()});
    const Drawn placed = draw("placed", {"effects/Specular.fx", "--mesh", ballMesh(), "-w", ballWorkspace()});
    ASSERT_EQ(own.ran.code + placed.ran.code, 0) << own.ran.err << placed.ran.err;
    const Drawn without = draw("without", {"effects/Specular.fx", "-w", ballWorkspace()});
    EXPECT_EQ(placed.image.pixels, without.image.pixels);
    EXPECT_NE(own.image.pixels, placed.image.pixels);
}

TEST(OwnMesh, stands_upright_whichever_axis_is_up) {
    const std::string lying = write("lying.obj", rod(2, 20, 400));
    const Covered y = covered(draw("up_y", {"effects/Fur.fx", "--mesh", lying, "--set", "gFurLength=0"}).image);
    const Covered z = covered(draw("up_z", {"effects/Fur.fx", "--mesh", lying, "--up", "z", "--set", "gFurLength=0"}).image);
    EXPECT_GT(z.bottom - z.top, 3 * (z.right - z.left)) << "a rod along z stands where z is up";
    EXPECT_LT(y.bottom - y.top, 3 * (y.right - y.left));
}

TEST(OwnMesh, is_prepared_with_y_up_whichever_axis_was) {
    const std::string lying = write("rod_z.obj", rod(2, 60, 300));
    const std::string standing = (scratch() / "standing.glb").string();
    const Ran prep = tegument::test::tegument({"prep", lying, "--up", "z", "-o", standing});
    ASSERT_EQ(prep.code, 0) << prep.err;
    EXPECT_NE(prep.out.find("z is up in the file"), std::string::npos) << prep.out;
    const Covered upright = covered(draw("upright", {"effects/Specular.fx", "--mesh", standing}).image);
    EXPECT_GT(upright.bottom - upright.top, 2 * (upright.right - upright.left));
    const Covered from = covered(draw("from", {"effects/Specular.fx", "--mesh", lying, "--up", "z"}).image);
    EXPECT_NEAR(from.count, upright.count, 0.01 * from.count) << "the same view of the file itself";
}

TEST(OwnMesh, in_metres_is_taken_for_that_and_said_so) {
    const std::string metres = write("metres.obj", ballObj(32, 0.11));
    const Drawn guessed = draw("guessed", {"effects/Specular.fx", "--mesh", metres});
    ASSERT_EQ(guessed.ran.code, 0) << guessed.ran.err;
    for (const char* text : {"TG5327", "1000 mm per unit are taken", "--unit-mm"})
        EXPECT_NE(guessed.ran.err.find(text), std::string::npos) << text << " in " << guessed.ran.err;
    const Drawn said = draw("said", {"effects/Specular.fx", "--mesh", metres, "--unit-mm", "1000"});
    EXPECT_EQ(said.ran.err.find("TG5327"), std::string::npos) << said.ran.err;
    EXPECT_EQ(said.image.pixels, guessed.image.pixels);
    const Drawn small = draw("small", {"effects/Specular.fx", "--mesh", metres, "--unit-mm", "1"});
    EXPECT_EQ(small.ran.code, 0) << "what is said is done: " << small.ran.err;
    EXPECT_EQ(small.ran.err.find("TG5327"), std::string::npos) << small.ran.err;
}

TEST(OwnMesh, is_asked_for_the_size_of_a_head_only_where_it_is_one) {
    const std::string metres = write("metres.obj", ballObj(32, 0.11));
    EXPECT_EQ(draw("none", {"effects/Specular.fx", "--mesh", metres}).ran.code, 0);
    const Ran head = draw("head", {"effects/Specular.fx", "--mesh", metres, "--head"}).ran;
    EXPECT_EQ(head.code, 1);
    EXPECT_NE(head.err.find("TG5309"), std::string::npos) << head.err;
    const Ran asWorkspace = draw("asks", {"effects/Specular.fx", "--mesh", metres, "-w", ballWorkspace()}).ran;
    EXPECT_NE(asWorkspace.err.find("--no-head"), std::string::npos) << asWorkspace.err;
    EXPECT_EQ(draw("no_head", {"effects/Specular.fx", "--mesh", metres, "-w", ballWorkspace(), "--no-head"}).ran.code, 0);
}

TEST(OwnMesh, with_colours_of_vertices_alone_is_told_that_skin_does_not_show_them) {
    const std::string coloured = write("coloured.obj", "v 0 0 0 1 0 0\nv 90 0 0 0 1 0\nv 0 90 0 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                                       "f 1/1 2/2 3/3\n");
    const Ran ran = draw("coloured", {"effects/OriginalTexture.fx", "--mesh", coloured}).ran;
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("the colours of the mesh's vertices are not drawn; bake them into a picture"), std::string::npos) << ran.err;
}

TEST(OwnMesh, without_a_colour_map_has_the_colour_of_skin_and_one_line_says_so) {
    const Drawn plain = draw("plain", {"effects/OriginalTexture.fx", "--mesh", ballMesh()});
    ASSERT_EQ(plain.ran.code, 0) << plain.ran.err;
    EXPECT_NE(plain.ran.err.find("TG4056"), std::string::npos) << plain.ran.err;
    EXPECT_EQ(std::ranges::count(plain.ran.err, '\n'), 1) << plain.ran.err;
    const float expected[] = {0.53F, 0.34F, 0.27F}; // what the default human's colour map holds on average, linear
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(plain.image.at(80, 80, c), expected[c], 1e-6F);
    const Drawn lit = draw("lit", {"effects/Main.fx", "--mesh", ballMesh()});
    ASSERT_EQ(lit.ran.code, 0) << lit.ran.err;
    std::size_t clipped = 0;
    for (std::size_t i = 0; i < lit.image.pixels.size(); i += 4)
        clipped += lit.image.pixels[i] > 1;
    EXPECT_LT(static_cast<double>(clipped), 0.05 * 160 * 160) << "highlights alone are brighter than white";
}

TEST(OwnMesh, without_texture_coordinates_is_drawn_by_what_does_not_need_them) {
    const std::string bare = write("bare.obj", rod(1, 90, 250));
    const Ran refused = draw("refused", {"effects/Main.fx", "--mesh", bare}).ran;
    EXPECT_EQ(refused.code, 1);
    for (const char* text : {"TG4041", "--unwrap", "Lambert", "peers/Separable.fx", "Specular.fx"})
        EXPECT_NE(refused.err.find(text), std::string::npos) << text << " in " << refused.err;
    for (const char* effect : {"effects/peers/Separable.fx", "effects/peers/Burley.fx", "effects/Specular.fx"}) {
        const Drawn drawn = draw("bare", {effect, "--mesh", bare});
        ASSERT_EQ(drawn.ran.code, 0) << effect << ": " << drawn.ran.err;
        EXPECT_TRUE(std::ranges::all_of(drawn.image.pixels, [](float v) { return std::isfinite(v); })) << effect;
        EXPECT_GT(covered(drawn.image).count, 160 * 160 / 4) << effect;
    }
    EXPECT_EQ(draw("lambert", {"effects/Main.fx", "-t", "Lambert", "--mesh", bare}).ran.code, 0);
    static_cast<void>(ballWorkspace()); // writes grey.png
    EXPECT_EQ(draw("texture", {"effects/Specular.fx", "--mesh", bare, "--set", "gSkinMap=" + (scratch() / "grey.png").string()}).ran.code,
              1)
        << "a picture cannot lie on it";
}

#ifdef TEGUMENT_WITHOUT_XATLAS
constexpr bool kHasXatlas = false;
#else
constexpr bool kHasXatlas = true;
#endif

/// A build without xatlas says so, and what brings it.
void expectCharts(const Ran& prep) {
    ASSERT_EQ(prep.code, kHasXatlas ? 0 : 3) << prep.err;
    EXPECT_EQ(prep.err.find("TG7027") == std::string::npos, kHasXatlas) << prep.err;
    EXPECT_EQ(prep.err.find("./bootstrap build") == std::string::npos, kHasXatlas) << prep.err;
}

TEST(OwnMesh, without_texture_coordinates_is_skin_in_two_commands) {
    const std::string bare = write("bare.obj", rod(1, 90, 250));
    const std::string charted = (scratch() / "charted.glb").string();
    expectCharts(tegument::test::tegument({"prep", bare, "--unwrap", "-o", charted, "--json"}));
    if (!kHasXatlas) return;
    const Drawn skin = draw("charted", {"effects/Main.fx", "--mesh", charted});
    ASSERT_EQ(skin.ran.code, 0) << skin.ran.err;
    EXPECT_EQ(skin.ran.err.find("TG5320"), std::string::npos) << "nothing overlaps: " << skin.ran.err;
    EXPECT_GT(covered(skin.image).count, 160 * 160 / 4);
}

TEST(OwnMesh, is_told_of_a_generator_that_does_not_exist) {
    std::ifstream in(fs::path(TEGUMENT_PROGRAM).parent_path() / "../../effects/OriginalTexture.fx");
    std::string text((std::istreambuf_iterator<char>(in)), {});
    fs::create_directories(scratch() / "effects");
    fs::create_directory_symlink(fs::absolute(fs::path(TEGUMENT_PROGRAM).parent_path() / "../../hlsl"), scratch() / "hlsl");
    fs::create_directory_symlink(fs::absolute(fs::path(TEGUMENT_PROGRAM).parent_path() / "../../effects/passes"),
                                 scratch() / "effects" / "passes");
    const std::string include = "#include \"passes/materials.fxh\"";
    ASSERT_NE(text.find(include), std::string::npos);
    text.replace(text.find(include), include.size(),
                 "Texture2D gSkinMap : DIFFUSE < string Generator = \"moss\"; >;\nTG_SAMPLER2D_SRGB(gSkin, LINEAR, CLAMP);");
    const std::string effect = write("effects/Moss.fx", text);
    const Ran ran = draw("moss", {effect, "--mesh", ballMesh(), "--anywhere"}).ran;
    EXPECT_EQ(ran.code, 1);
    for (const char* expected : {"TG4054", "moss", "fur roots", "gSkinMap"})
        EXPECT_NE(ran.err.find(expected), std::string::npos) << expected << " in " << ran.err;
}

TEST(OwnMesh, is_turned_by_so_many_degrees_and_lit_from_where_it_was) {
    const std::string mesh = write(
        "lopsided.obj", "v 0 0 0\nv 60 0 0\nv 0 90 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"); // from no side as from another
    const auto drawn = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments = {"effects/Specular.fx", "--mesh", mesh};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Drawn result = draw(name, arguments);
        EXPECT_EQ(result.ran.code, 0) << result.ran.err;
        return result.image;
    };
    const Image front = drawn("front", {});
    EXPECT_LT(different(front, drawn("whole", {"--turn", "360"})), 0.001) << "a whole turn: the same, but for pixels at outlines";
    const Covered seen = covered(front), behind = covered(drawn("back", {"--turn", "180"}));
    EXPECT_GT(std::abs(seen.count - behind.count), seen.count / 50) << "the back has another outline";
    EXPECT_LT(different(drawn("right", {"--turn", "90"}), drawn("left", {"--turn", "-270"})), 0.001);
    // The turntable's second picture of four shows the same side: its camera stands farther off, for all sides, and so the mesh is smaller.
    const Ran turning = tegument::test::tegument({"render", "effects/Specular.fx", "--mesh", mesh, "--size", "160", "--turntable", "4",
                                                  "--turn", "90", "-o", (scratch() / "turning.exr").string()});
    ASSERT_EQ(turning.code, 0) << turning.err;
    ASSERT_EQ(tegument::test::tegument({"render", "effects/Specular.fx", "--mesh", mesh, "--size", "160", "--turntable", "4", "-o",
                                        (scratch() / "still.exr").string()})
                  .code,
              0);
    const auto first = tegument::loadImage(scratch() / "turning-001.exr");
    const auto second = tegument::loadImage(scratch() / "still-002.exr");
    ASSERT_TRUE(first && second);
    EXPECT_LT(different(*first, *second), 0.01) << "to begin at 90 degrees is to come there";
}

TEST(OwnMesh, of_a_workspace_is_turned_likewise) {
    const auto drawn = [&](const std::string& name, const std::string& degrees) {
        return draw(name, {"effects/Specular.fx", "-w", ballWorkspace(), "--turn", degrees}).image;
    };
    const Image still = drawn("ball0", "0");
    ASSERT_FALSE(still.pixels.empty());
    const auto apart = [&](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            sum += static_cast<double>(std::abs(image.pixels[i] - still.pixels.at(i)));
        return sum / static_cast<double>(image.pixels.size());
    };
    EXPECT_LT(apart(drawn("ball180", "180")), 1e-5) << "its bumps come twice in a turn";
    EXPECT_GT(apart(drawn("ball90", "90")), 1e-4) << "and are elsewhere after a quarter";
}

TEST(OwnMesh, its_size_is_said) {
    const std::string mesh = write("sized.obj", "v 0 0 0\nv 60 0 0\nv 0 90 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const Ran ran = tegument::test::tegument(
        {"render", "effects/Specular.fx", "--mesh", mesh, "--unit-mm", "2", "--size", "32", "-o", (scratch() / "sized.png").string()});
    EXPECT_NE(ran.out.find("the mesh is 120 x 180 x 80 mm (another size: --unit-mm"), std::string::npos) << ran.out << ran.err;
    const Ran ours = tegument::test::tegument(
        {"render", "effects/Specular.fx", "-w", ballWorkspace(), "--size", "32", "-o", (scratch() / "sized.png").string()});
    EXPECT_EQ(ours.out.find("the mesh is"), std::string::npos) << "a workspace knows its mesh";
}

TEST(OwnMesh, that_got_charts_is_shown_the_technique_without_seams) {
    const std::string mesh = write("charted.obj", "v 0 0 0\nv 60 0 0\nv 0 90 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const std::string charted = (scratch() / "named.glb").string();
    const Ran ran = tegument::test::tegument({"prep", mesh, "--unwrap", "-o", charted});
    expectCharts(ran);
    if (!kHasXatlas) return;
    EXPECT_NE(ran.out.find("PyramidLinked --mesh " + charted), std::string::npos) << ran.out;
}

TEST(OwnMesh, gets_no_credit_that_a_workspace_gives_to_another) {
    const std::string theirs = write("theirs.obj", rod(1, 60, 220)), own = write("own_credit.obj", rod(1, 60, 220));
    const std::string workspace = write("credit.json", R"({ "mesh": "theirs.obj", "attribution": "Someone Else" })");
    EXPECT_EQ(draw("uncredited", {"Specular", "-w", workspace, "--mesh", own}).image.metadata.count("attribution"), 0U);
    EXPECT_EQ(draw("credited", {"Specular", "-w", workspace, "--mesh", theirs}).image.metadata.at("attribution"), "Someone Else");
    EXPECT_EQ(draw("credited_too", {"Specular", "-w", workspace}).image.metadata.at("attribution"), "Someone Else");
}

TEST(Portrait, of_a_head_is_whole_and_lit_in_any_aspect) {
    const fs::path head = tegument::cacheFolder() / "human" / "human.glb";
    if (!fs::exists(head)) GTEST_SKIP() << "no default head: tegument prep human";
    for (const char* size : {"96x160", "160x96"}) {
        const fs::path path = scratch() / (std::string(size) + ".exr");
        const Ran ran = tegument::test::tegument(
            {"portrait", head.string(), "--size", size, "--map-size", "128", "--samples", "1", "-o", path.string()});
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_NE(ran.err.find("y is up and the face looks along z"), std::string::npos) << ran.err;
        const auto image = tegument::loadImage(path);
        ASSERT_TRUE(image);
        const Covered c = covered(*image);
        EXPECT_GT(c.top, 0) << size << ": the scalp is cut";
        EXPECT_LT(c.bottom, image->height - 1) << size << ": the neck is cut";
        EXPECT_GT(c.left, 0) << size;
        EXPECT_LT(c.right, image->width - 1) << size;
        EXPECT_GT(std::max((c.bottom - c.top) / double(image->height), (c.right - c.left) / double(image->width)), 0.7)
            << "fills the picture";
        int dark = 0;
        for (int y = c.top; y <= c.bottom; ++y)
            for (int x = c.left; x <= c.right; ++x)
                dark += image->at(x, y, 3) > 0 && image->at(x, y, 0) < 0.01F ? 1 : 0;
        EXPECT_LT(dark, c.count / 50) << size << ": a studio leaves no side black";
    }
}

TEST(Portrait, of_what_is_no_head_is_refused_with_the_options_to_give) {
    const Ran ran = tegument::test::tegument({"portrait", ballMesh(), "-o", out("ball.png")});
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.err.find("TG5336"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("--up="), std::string::npos) << ran.err;
    EXPECT_FALSE(fs::exists(out("ball.png")));
}

TEST(Switches, are_set_like_parameters) {
    const Drawn by = draw("by_set", {"Specular", "--mesh", ballMesh(), "--set", "TEGUMENT_LAMPS=1", "--set", "gLightColor=0,0,0"});
    const Drawn defined = draw("by_define", {"Specular", "--mesh", ballMesh(), "-D", "TEGUMENT_LAMPS=1", "--set", "gLightColor=0,0,0"});
    ASSERT_EQ(by.ran.code, 0) << by.ran.err;
    ASSERT_EQ(defined.ran.code, 0) << defined.ran.err;
    EXPECT_EQ(by.image.pixels, defined.image.pixels);
    const Ran near = tegument::test::tegument({"render", "Specular", "--mesh", ballMesh(), "--set", "TEGUMENT_LAMP=1", "-o", out("x.png")});
    EXPECT_NE(near.code, 0);
    EXPECT_NE(near.err.find("TEGUMENT_LAMPS"), std::string::npos) << near.err;
}

TEST(Switches, of_the_page_are_those_that_info_lists) {
    const auto page = tegument::readFile("docs/settings.md");
    ASSERT_TRUE(page);
    std::set<std::string> documented;
    std::istringstream lines(*page);
    const std::regex name("`(TEGUMENT_[A-Z_]+)`");
    for (std::string line; std::getline(lines, line);) {
        const std::size_t values = line.starts_with("| `TEGUMENT_") ? line.find(" | ") : std::string::npos;
        if (values == std::string::npos || std::isdigit(static_cast<unsigned char>(line[values + 3])) == 0) continue;
        const std::string names = line.substr(0, values);
        for (std::sregex_iterator one(names.begin(), names.end(), name), end; one != end; ++one)
            documented.insert((*one)[1]);
    }
    documented.erase("TEGUMENT_SETTING"); // which has names, and an option
    std::set<std::string> listed = {"TEGUMENT_MAP_SIZE", "TEGUMENT_SHADOW_SIZE", "TEGUMENT_RIBBON_ROWS"};
    documented.insert(listed.begin(), listed.end()); // texels
    const auto info = tegument::test::tegument({"info", "Main", "--json"}).json();
    for (const auto& one : info["switches"])
        listed.insert(one["name"].get<std::string>());
    EXPECT_EQ(listed, documented);
    EXPECT_GT(info["switches"].size(), 20U);
}

TEST(Switches, of_a_workspace_draw_what_those_of_the_command_line_draw) {
    const std::string ball = fs::path(ballMesh()).filename().string();
    const auto scene = [&](const char* lamps) {
        return write("lamps.json", fmt::format(R"({{"mesh": "{}", "head": false, "parameters": {{"TEGUMENT_LAMPS": {}}}}})", ball, lamps));
    };
    const std::string none = write("none.json", fmt::format(R"({{"mesh": "{}", "head": false}})", ball));
    const std::string one = scene("1");
    const Drawn by = draw("by_scene", {"Main", "-t", "Lambert", "-w", one});
    const Drawn set = draw("by_set", {"Main", "-t", "Lambert", "-w", none, "--set", "TEGUMENT_LAMPS=1"});
    const Drawn without = draw("without", {"Main", "-t", "Lambert", "-w", none});
    const Drawn off = draw("off", {"Main", "-t", "Lambert", "-w", one, "--set", "TEGUMENT_LAMPS=0"});
    const Drawn defined = draw("defined", {"Main", "-t", "Lambert", "-w", one, "-D", "TEGUMENT_LAMPS=0"});
    ASSERT_EQ(by.ran.code + set.ran.code + without.ran.code + off.ran.code + defined.ran.code, 0) << by.ran.err << off.ran.err;
    EXPECT_EQ(by.ran.err.find("TG8018"), std::string::npos) << by.ran.err;
    EXPECT_EQ(by.image.pixels, set.image.pixels);
    EXPECT_NE(by.image.pixels, without.image.pixels);
    EXPECT_EQ(off.image.pixels, without.image.pixels) << "the command line wins";
    EXPECT_EQ(defined.image.pixels, without.image.pixels);
    expectSaid(tegument::test::tegument({"render", "Main", "-w", scene("9"), "-o", out("x.png")}), kInput, {"TG8019", "0..7"});
    const std::string near =
        write("near.json", fmt::format(R"({{"mesh": "{}", "head": false, "parameters": {{"TEGUMENT_LAMP": 1}}}})", ball));
    EXPECT_NE(draw("near", {"Main", "-t", "Lambert", "-w", near}).ran.err.find("did you mean 'TEGUMENT_LAMPS'"), std::string::npos);
    const std::string object = write(
        "object.json", fmt::format(R"({{"objects": [{{"mesh": "{}", "head": false, "parameters": {{"TEGUMENT_LAMPS": 1}}}}]}})", ball));
    expectSaid(tegument::test::tegument({"render", "Main", "-w", object, "-o", out("x.png")}), kInput, {"TG8019", "whole scene"});
}

TEST(Switches, of_ours_do_nothing_in_effects_of_others_which_is_said) {
    const std::string effect = write("plain.fx", R"(float4x4 gAll : WORLDVIEWPROJECTION;
        float4 VS(float4 p : POSITION) : SV_Position { return mul(p, gAll); }
        float4 PS() : SV_Target { return 1; }
        technique T { pass P { VertexShader = compile vs_5_0 VS(); PixelShader = compile ps_5_0 PS(); } })");
    const Drawn drawn = draw("plain", {effect, "--mesh", ballMesh(), "--set", "TEGUMENT_LAMPS=1"});
    ASSERT_EQ(drawn.ran.code, 0) << drawn.ran.err;
    EXPECT_NE(drawn.ran.err.find("TG8029"), std::string::npos) << drawn.ran.err;
}

TEST(Scenes, say_technique_setting_size_and_samples) {
    const std::string ball = fs::path(ballMesh()).filename().string();
    const std::string scene = write("whole.json", fmt::format(R"({{"mesh": "{}", "head": false, "technique": "Gosselin", "setting": "seed",
        "size": [96, 64], "samples": 1, "parameters": {{"TEGUMENT_MAP_SIZE": 128}}}})",
                                                              ball));
    const Ran ran = tegument::test::tegument({"render", "Main", "-w", scene, "-o", out("whole.exr"), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = ran.json();
    EXPECT_EQ(json["technique"], "Gosselin");
    EXPECT_EQ(json["setting"], "seed");
    EXPECT_EQ(json["resolution"], (nlohmann::json{96, 64}));
    EXPECT_EQ(json["samples"], 1);
    EXPECT_EQ(json["map_size"], 128);
    const Ran line = tegument::test::tegument({"render", "Main", "-w", scene, "-t", "Lambert", "--setting", "corrected", "--size", "32",
                                               "--samples", "4", "--map-size", "64", "-o", out("line.exr"), "--json"});
    ASSERT_EQ(line.code, 0) << line.err;
    EXPECT_EQ(line.json()["technique"], "Lambert");
    EXPECT_EQ(line.json()["setting"], "corrected");
    EXPECT_EQ(line.json()["resolution"], (nlohmann::json{32, 32}));
    EXPECT_EQ(line.json()["samples"], 4);
    EXPECT_EQ(line.json()["map_size"], 64);
    const Ran other = tegument::test::tegument({"render", "Specular", "-w", scene, "-o", out("other.exr"), "--json"});
    ASSERT_EQ(other.code, 0) << other.err;
    EXPECT_NE(other.json()["technique"], "Gosselin");
    EXPECT_NE(other.err.find("has no technique 'Gosselin'"), std::string::npos) << other.err;
}
