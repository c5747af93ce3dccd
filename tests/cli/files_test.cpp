// What the program writes for engines and for pages: DDS, several formats at once, scenes of objects, labelled sheets.
// `tegument info` is to be read: in 100 columns, what can be turned first.

#include "host/image/dds.h"
#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

std::string objectsWorkspace(const std::string& name, const std::string& placements) {
    std::string text = "{\"objects\": [";
    text += placements;
    text += "], \"camera\": {\"frame\": \"world\", \"position\": [0, 0, 900], \"horizontal_fov\": 40, \"near\": 200, \"far\": 2000},"
            " \"light\": {\"frame\": \"world\", \"position\": [300, 300, 900]}}";
    return write(name, text);
}

std::string placed(const std::string& where) {
    return "{\"mesh\": \"" + ballMesh() + "\", " + where + "}";
}

const std::string kBoth = placed("\"position\": [-150, 0, 0]") + ", " + placed("\"position\": [150, 0, 0], \"rotation\": [0, 90, 0]");

TEST(Files, a_precomputed_texture_comes_as_exr_and_dds_with_equal_values) {
    const Picture picture =
        render("tables", {"effects/Beckmann.fx", "--size", "32x32", "--dump", "gBeckmannMap", "--dump-format", "exr,dds", "--mips"});
    const fs::path exr = picture.report["dumped"]["gBeckmannMap"].get<std::string>();
    const auto floats = loadImage(exr);
    const auto dds = loadDds(fs::path(exr).replace_extension(".dds"));
    ASSERT_TRUE(floats && dds);
    EXPECT_EQ(dds->format, DdsFormat::Rgba16F) << "as the target is declared";
    EXPECT_EQ(dds->mips, 10) << "512 texels a side";
    EXPECT_EQ(dds->at(0, 0).pixels, floats->pixels);
    EXPECT_EQ(picture.report["files"].size(), 3u);
}

TEST(Files, a_dds_picture_is_the_exr_picture) {
    const std::string out = (scratch() / "picture.dds").string();
    ASSERT_EQ(tegument({"render", "effects/Beckmann.fx", "--size", "32x32", "-o", out}).code, 0);
    const Picture exr = render("picture", {"effects/Beckmann.fx", "--size", "32x32"});
    const auto dds = loadImage(out);
    ASSERT_TRUE(dds);
    EXPECT_EQ(dds->pixels, exr.image.pixels);
}

TEST(Files, direct3d_9_s_header_has_no_dx10_part) {
    const std::string out = (scratch() / "old.dds").string();
    ASSERT_EQ(tegument({"render", "effects/Beckmann.fx", "--size", "32x32", "--dds-header", "d3d9", "-o", out}).code, 0);
    EXPECT_EQ(fs::file_size(out), 128u + 32 * 32 * 16);
}

TEST(SceneFiles, two_objects_are_the_single_renders_laid_together) {
    const std::vector<std::string> common = {"effects/Main.fx", "--size", "64x64", "--map-size", "128"};
    const auto draw = [&](const std::string& name, const std::string& objects) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"-w", objectsWorkspace(name + ".json", objects)});
        return render(name, arguments);
    };
    const Picture both = draw("both", kBoth);
    const Picture left = draw("left", placed("\"position\": [-150, 0, 0]"));
    const Picture right = draw("right", placed("\"position\": [150, 0, 0], \"rotation\": [0, 90, 0]"));
    std::size_t drawn = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool ofRight = right.image.at(x, y, 3) > 0;
            drawn += ofRight || left.image.at(x, y, 3) > 0 ? 1 : 0;
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(both.image.at(x, y, c), (ofRight ? right : left).image.at(x, y, c)) << x << ", " << y;
        }
    EXPECT_GT(drawn, 400u);
}

TEST(SceneFiles, the_report_lists_objects_and_their_passes) {
    const Picture both = render("listed", {"effects/OriginalTexture.fx", "--size", "32x32", "-w", objectsWorkspace("listed.json", kBoth)});
    ASSERT_EQ(both.report["objects"].size(), 2u);
    EXPECT_EQ(both.report["objects"][1]["rotation"], (std::vector<double>{0, 90, 0}));
    ASSERT_EQ(both.report["passes"].size(), 2u);
    EXPECT_EQ(both.report["passes"][1]["object"], 1);
}

TEST(SceneFiles, more_objects_need_no_more_memory) {
    const auto bytes = [](const std::string& name, const std::string& objects) {
        const Picture picture =
            render(name, {"effects/Main.fx", "--size", "32x32", "--map-size", "64", "-w", objectsWorkspace(name + ".json", objects)});
        return picture.report["device_bytes"].get<std::uint64_t>();
    };
    const std::uint64_t one = bytes("one", placed("\"position\": [-150, 0, 0]"));
    EXPECT_GT(one, 0u);
    EXPECT_EQ(bytes("three", kBoth + ", " + placed("\"position\": [0, 200, 0]")), one);
}

TEST(SceneFiles, a_mesh_beside_several_objects_is_a_question) {
    const Ran ran = tegument({"render", "effects/OriginalTexture.fx", "-w", objectsWorkspace("q.json", kBoth), "--mesh", ballMesh()});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("TG8017"), std::string::npos) << ran.err;
}

TEST(SceneFiles, an_effect_is_shown_on_the_workspace_that_it_names) {
    const std::map<std::string, std::string> bare = {{"TEGUMENT_CACHE", (scratch() / "no-cache").string()}};
    const Ran fur = tegument({"render", "effects/Fur.fx", "-o", (scratch() / "fur.exr").string()}, bare);
    EXPECT_NE(fur.code, 0);
    EXPECT_NE(fur.err.find("bunny.glb"), std::string::npos) << fur.err;
    const Ran skin = tegument({"render", "effects/OriginalTexture.fx", "-o", (scratch() / "skin.exr").string()}, bare);
    EXPECT_NE(skin.code, 0);
    EXPECT_NE(skin.err.find("human.glb"), std::string::npos) << skin.err;
}

TEST(SceneFiles, a_mesh_for_fur_need_not_be_as_large_as_a_head) {
    const std::string ball = write("small.obj", ballObj(24, 1.5));
    const Ran ran = tegument({"render", "effects/Fur.fx", "--mesh", ball, "--size", "32x32", "--map-size", "64", "--set", "gFurLayers=2",
                              "-o", (scratch() / "small.exr").string()});
    EXPECT_EQ(ran.code, 0) << ran.err;
}

// ---- Sheets

std::string grey(const std::string& name, float value, int side = 100) {
    Image image = plainImage(side, side, 3, value);
    image.metadata["attribution"] = name;
    const std::string path = (scratch() / (name + ".png")).string();
    EXPECT_TRUE(writePng(path, image, PngEncoding::Raw));
    return path;
}

/// Sum of 1 - value over a rectangle: how many pixels of black lie there.
double ink(const Image& image, int left, int top, int right, int bottom) {
    double sum = 0;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            sum += 1 - image.at(x, y, 0);
    return sum;
}

/// A sheet of two grey pictures of 100 x 100 side by side, 4 pixels apart, with one label of the row.
Image labelled(const std::string& columns, const std::string& row) {
    const std::string out = (scratch() / "labelled.png").string();
    const Ran ran = tegument({"sheet", grey("a", 0.5F), grey("b", 0.5F), "--columns", "2", "--gap", "4", "--column-labels", columns,
                              "--row-labels", row, "-o", out});
    EXPECT_EQ(ran.code, 0) << ran.err;
    auto sheet = loadImage(out);
    EXPECT_TRUE(sheet);
    return sheet ? *sheet : Image{};
}

TEST(Sheet, labels_stand_above_columns_and_before_rows) {
    const Image sheet = labelled("I,HH", "-");
    const int top = sheet.height - 100;
    const int left = sheet.width - 204;
    EXPECT_GE(top, 18) << "the line holds text of 18 pixels";
    EXPECT_GT(left, 8) << "the row's label and its margins";
    // DejaVu Sans (2048 to the em) draws I as one stem of 201 x 1493, and H as two with a bar of 170 x 1098 between them less the stems'
    // parts: in pixels of an em of 18, 23.2 and 2 x 23.2 + 14.4. Anti-aliasing keeps the area but for hinting, which moves edges by up to
    // half a pixel: a fifth.
    const double stem = 201.0 * 1493 * 18 * 18 / 2048 / 2048;
    const double bar = 170.0 * 938 * 18 * 18 / 2048 / 2048;
    EXPECT_NEAR(ink(sheet, left, 0, left + 100, top), stem, stem / 5);
    EXPECT_NEAR(ink(sheet, left + 104, 0, left + 204, top), 2 * (2 * stem + bar), (2 * stem + bar) * 2 / 5);
    EXPECT_GT(ink(sheet, 0, top, left, sheet.height), 4) << "the minus sign before the row";
    EXPECT_EQ(ink(sheet, 0, 0, left, top), 0) << "nothing in the corner";
    EXPECT_NEAR(ink(sheet, left + 30, 0, left + 70, top), stem, stem / 5) << "centred";
    EXPECT_EQ(sheet.metadata.at("attribution"), "a; b");
}

TEST(Sheet, labels_are_utf_8) {
    const Image degree = labelled("10\xc2\xb0,\xff", "-"); // a degree sign is one glyph; bytes that are no UTF-8 become a question mark
    const Image letters = labelled("10oo,?", "-");
    const int left = degree.width - 204;
    const int top = degree.height - 100;
    EXPECT_LT(ink(degree, left, 0, left + 100, top), ink(letters, left, 0, left + 100, top));
    EXPECT_EQ(ink(degree, left + 104, 0, left + 204, top), ink(letters, left + 104, 0, left + 204, top));
}

TEST(Sheet, without_a_typeface_labels_are_one_clear_error_and_pictures_are_laid_out_all_the_same) {
    const std::string out = (scratch() / "unlabelled.png").string();
    std::vector<std::string> arguments = {"sheet", grey("f", 0.5F), "--font", write("no.ttf", "no typeface"), "-o", out};
    EXPECT_EQ(tegument(arguments).code, 0);
    EXPECT_TRUE(fs::exists(out));
    arguments.insert(arguments.end(), {"--column-labels", "I"});
    const Ran ran = tegument(arguments);
    EXPECT_EQ(ran.code, 3);
    EXPECT_NE(ran.err.find("TG8033"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("fonts-dejavu-core"), std::string::npos) << ran.err;
}

TEST(Sheet, wrong_labels_are_refused) {
    const std::string picture = grey("c", 0.5F, 16);
    for (const std::vector<std::string>& labels :
         {std::vector<std::string>{"--column-labels", "one,two"}, {"--row-labels", "1,2"}, {"--column-labels", "too wide"}}) {
        std::vector<std::string> arguments = {"sheet", picture, "-o", (scratch() / "refused.png").string()};
        arguments.insert(arguments.end(), labels.begin(), labels.end());
        const Ran ran = tegument(arguments);
        EXPECT_EQ(ran.code, 2);
        EXPECT_NE(ran.err.find("TG8031"), std::string::npos) << ran.err;
    }
    EXPECT_FALSE(fs::exists(scratch() / "refused.png"));
}

TEST(Sheet, pictures_of_different_sizes_are_refused) {
    const Ran ran = tegument({"sheet", grey("g", 0.5F), grey("h", 0.5F, 90), "-o", (scratch() / "sizes.png").string()});
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.err.find("TG8030"), std::string::npos) << ran.err;
}

TEST(Sheet, another_ending_is_refused) {
    const Ran ran = tegument({"sheet", grey("d", 0.5F), "-o", (scratch() / "sheet.gif").string()});
    EXPECT_NE(ran.err.find("TG8032"), std::string::npos) << ran.err;
}

TEST(Sheet, a_jpeg_is_written_where_it_is_asked_for) {
    const std::string out = (scratch() / "sheet.jpg").string();
    ASSERT_EQ(tegument({"sheet", grey("e", 0.5F), "-o", out}).code, 0);
    const auto sheet = loadImage(out);
    ASSERT_TRUE(sheet);
    EXPECT_NEAR(sheet->at(50, 50, 0), 0.5F, 1.5F / 255);
}

std::string info(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"info"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = tegument(arguments);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
}

/// The first line that holds the word.
std::string lineOf(const std::string& text, const std::string& word) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        if (line.find(word) != std::string::npos) return line;
    return {};
}

TEST(Info, of_every_effect_fits_into_100_columns) {
    int effects = 0;
    for (const char* folder : {"effects", "effects/peers"})
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".fx") continue;
            ++effects;
            for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--all"}}) {
                std::vector<std::string> arguments = {entry.path().string()};
                arguments.insert(arguments.end(), more.begin(), more.end());
                std::istringstream in(info(arguments));
                for (std::string line; std::getline(in, line);)
                    EXPECT_LE(line.size(), 100U) << line;
            }
        }
    EXPECT_GE(effects, 16);
}

TEST(Info, shows_what_can_be_turned_with_range_default_and_unit) {
    const std::string text = info({"Main"});
    EXPECT_LT(text.find("gRoughness"), text.find("gSkinMap"));
    const std::string line = lineOf(text, "gRoughness");
    for (const char* word : {"float", "0.05..1", "0.3", "rms slope"})
        EXPECT_NE(line.find(word), std::string::npos) << line;
    EXPECT_NE(lineOf(text, "gShadowTolerance").find("mm"), std::string::npos) << text;
}

TEST(Info, keeps_internals_behind_all) {
    const std::string text = info({"Main"});
    for (const char* name : {"gWorldInverseTranspose", "gClearEmpty", "gTsmDepthMap", "IrradiancePS"}) {
        EXPECT_EQ(text.find(name), std::string::npos) << name;
        EXPECT_NE(info({"Main", "--all"}).find(name), std::string::npos) << name;
    }
    EXPECT_NE(text.find("--all"), std::string::npos) << "and says how to see them";
}

TEST(Info, counts_passes_as_the_documents_do) {
    const std::string text = info({"Main"});
    EXPECT_EQ(lineOf(text, "technique DEonLuebke:").find("technique DEonLuebke: 15 passes"), 0U) << text;
    EXPECT_EQ(lineOf(text, "technique Gosselin:").find("technique Gosselin: 8 passes"), 0U) << text;
    EXPECT_NE(lineOf(text, "technique Gosselin:").find("4 more for other values"), std::string::npos) << text;
    EXPECT_EQ(lineOf(info({"OriginalTexture"}), "technique"), "technique OriginalTexture: 1 pass");
}

} // namespace
} // namespace tegument::test
