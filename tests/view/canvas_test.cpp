// Pictures one after another take no memory, as a viewer that stays open shows them.
// How a mesh lies on its texture: figures by hand.

#include "host/run/pixels.h"
#include "tests/gpu/with_device.h"
#include "tests/run/fixture.h"
#include "tools/view/canvas.h"
#include "tools/view/mesh_figures.h"
#include "tools/view/panel.h"
#include "tools/view/unfold.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace tegument::view {

namespace {

using Canvases = test::WithDevice;

constexpr int kFirst = 100; // shaders are compiled, pools and caches grow
constexpr int kMore = 100;
/// What caches still grow, 12 KB as measured. A command buffer for each submission kept 11 KB a picture in the validation layer, a shader
/// for each picture 1.1 MB in the driver.
constexpr std::size_t kMostBytes = std::size_t{64} << 10;

gpu::Texture target(gpu::Device& device, std::uint32_t side) {
    auto made = device.createTexture({.name = "t", .format = gpu::Format::RGBA8, .width = side, .height = side, .renderTarget = true});
    EXPECT_TRUE(made);
    return std::move(*made);
}

/// Where a driver that compiles for the processor keeps what it has compiled.
int madeCode() {
    std::ifstream maps("/proc/self/maps");
    int count = 0;
    for (std::string line; std::getline(maps, line);)
        if (line.find(" r-xp ") != std::string::npos && line.find('/') == std::string::npos && line.find('[') == std::string::npos) ++count;
    return count;
}

void showPictures(Canvas& canvas, gpu::Texture& window, gpu::Texture& picture, int count) {
    for (int i = 0; i < count; ++i) // as the viewer: the picture on a texture, that in the window
        ASSERT_TRUE(canvas.show(window, picture, {.channel = i % 5, .toneMap = i % 2 == 0, .encode = i % 3 == 0}));
}

constexpr double kNear = 1e-6; // of floats

/// 20 x 20 mm, over the whole texture.
Mesh plainSquare() {
    return test::square();
}

/// Its two triangles with vertices of their own.
Mesh splitSquare() {
    Mesh mesh = plainSquare();
    mesh.positions = {mesh.positions[0], mesh.positions[1], mesh.positions[2], mesh.positions[2], mesh.positions[1], mesh.positions[3]};
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 0}, {0, 1}, {1, 1}};
    mesh.normals.assign(6, {0, 0, 1});
    mesh.indices = {0, 1, 2, 3, 4, 5};
    return mesh;
}

/// Side by side squares of 2 mm, of two triangles each; the triangle 2 i lies in square i.
Mesh meadow(std::uint32_t squares) {
    Mesh mesh;
    for (std::uint32_t i = 0; i <= squares; ++i)
        for (const float y : {0.0F, 2.0F})
            mesh.positions.emplace_back(2.0F * static_cast<float>(i), y, 0);
    for (std::uint32_t i = 0; i < squares; ++i)
        for (const std::uint32_t corner : {0U, 2U, 1U, 1U, 2U, 3U})
            mesh.indices.push_back(2 * i + corner);
    mesh.parts = {{.name = "meadow", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    return mesh;
}

} // namespace

TEST_F(Canvases, pictures_in_a_row_make_no_code_and_take_no_memory) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    gpu::Texture window = target(*device_, 32);
    gpu::Texture picture = target(*device_, 16);
    showPictures(*canvas, window, picture, kFirst);
    const int code = madeCode();
    const std::size_t bytes = mallinfo2().uordblks;
    showPictures(*canvas, window, picture, kMore);
    EXPECT_EQ(madeCode(), code) << "the driver compiled shaders anew";
    EXPECT_LT(mallinfo2().uordblks, bytes + kMostBytes);
}

TEST_F(Canvases, what_is_enlarged_stays_in_its_area_of_the_window) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    constexpr std::uint32_t kSide = 40;
    gpu::Texture picture = target(*device_, 20);
    gpu::Texture window = target(*device_, kSide);
    std::vector<std::byte> columns; // red goes from 0 to 190 in steps of 10
    for (int i = 0; i < 20 * 20; ++i)
        for (const int value : {i % 20 * 10, 255, 255, 255})
            columns.push_back(static_cast<std::byte>(value));
    ASSERT_TRUE(device_->upload(picture, columns));
    const Canvas::Fit fit{.area = {0.25, 0, 0.75, 0.5}, .fill = false, .closer = {.zoom = 4, .at = {1, 0}}};
    ASSERT_TRUE(canvas->show(window, picture, {}, fit));
    const auto seen = device_->readback(window);
    ASSERT_TRUE(seen);
    const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
        return std::to_integer<int>(seen->at(4 * (y * kSide + x) + channel));
    };
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x)
            EXPECT_EQ(at(x, y, 1), x >= 10 && x < 30 && y < 20 ? 255 : 0) << x << ", " << y;
    EXPECT_EQ(at(29, 3, 0), 190) << "the right end stays";
    EXPECT_EQ(at(10, 3, 0), 150) << "a quarter of its columns is seen";
}

TEST_F(Canvases, a_picture_that_is_copied_is_as_one_that_has_levels) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    gpu::Texture picture = target(*device_, 20);
    std::vector<std::byte> texels;
    for (int i = 0; i < 4 * 20 * 20; ++i)
        texels.push_back(static_cast<std::byte>(i * 37 % 256));
    ASSERT_TRUE(device_->upload(picture, texels));
    for (const bool fill : {false, true})
        for (const std::uint32_t side : {20U, 33U}) {
            gpu::Texture window = target(*device_, side);
            const auto seen = [&](const Levels& levels) {
                EXPECT_TRUE(canvas->show(window, picture, levels, {.fill = fill}));
                const auto bytes = device_->readback(window);
                return bytes ? *bytes : std::vector<std::byte>();
            };
            const std::vector<std::byte> copied = seen({});
            EXPECT_FALSE(copied.empty());
            EXPECT_EQ(copied, seen({.offset = {0, 0, 0, 1}})) << "alpha is not shown: the same, by the long way";
        }
}

TEST_F(Canvases, a_cube_unfolds_into_a_cross_of_its_faces_level_by_level) {
    auto cube = device_->createTexture({.name = "c", .format = gpu::Format::R32F, .width = 4, .height = 4, .mips = 3, .cube = true});
    ASSERT_TRUE(cube);
    for (std::uint32_t level = 0; level < 3; ++level)
        for (std::uint32_t face = 0; face < 6; ++face) {
            const std::vector<float> texels(std::size_t{4U >> level} * (4U >> level), static_cast<float>(10 * (face + 1) + level));
            ASSERT_TRUE(device_->upload(*cube, std::as_bytes(std::span(texels)), level, face));
        }
    auto flat = unfolded(*device_, *cube);
    ASSERT_TRUE(flat);
    EXPECT_EQ(flat->desc().mips, 3U);
    for (int level = 0; level < 3; ++level) {
        const auto image = run::readBack(*device_, *flat, static_cast<std::uint32_t>(level));
        ASSERT_TRUE(image);
        const int side = 4 >> level;
        ASSERT_EQ(image->width, 4 * side);
        ASSERT_EQ(image->height, 3 * side);
        const std::array<std::array<int, 4>, 3> faces{{{0, 3, 0, 0}, {2, 5, 1, 6}, {0, 4, 0, 0}}}; // +X is 1, -Z is 6
        for (int y = 0; y < 3 * side; ++y)
            for (int x = 0; x < 4 * side; ++x) {
                const int face = faces.at(static_cast<std::size_t>(y / side)).at(static_cast<std::size_t>(x / side));
                EXPECT_EQ(image->at(x, y, 0), face == 0 ? 0 : static_cast<float>(10 * face + level)) << level << ": " << x << ", " << y;
            }
    }
}

TEST_F(Canvases, what_is_drawn_together_is_what_is_drawn_one_after_another) {
    auto canvas = Canvas::create(*device_, Compiler::Dxc);
    ASSERT_TRUE(canvas) << format(canvas.error());
    gpu::Texture picture = target(*device_, 16);
    ASSERT_TRUE(device_->upload(picture, std::vector<std::byte>(std::size_t{16} * 16 * 4, std::byte{90})));
    // A small picture of the picture, that on the window, and a half transparent triangle on top: each reads what is before it.
    const auto drawAll = [&](gpu::Texture& small, gpu::Texture& window) -> Result<void> {
        const std::array<CanvasVertex, 3> corners{
            {{-1, 1, 0, 0, {1, 0, 0, 0.5F}}, {1, 1, 1, 0, {0, 1, 0, 0.5F}}, {-1, -1, 0, 1, {1, 1, 1, 1}}}};
        const std::array<std::uint32_t, 3> order{0, 1, 2};
        const Canvas::Mesh mesh{.vertices = corners, .indices = order, .texture = &small, .clip = {0, 0, 20, 32}};
        if (auto shown = canvas->show(small, picture, {.encode = true}); !shown) return shown;
        if (auto shown = canvas->show(window, small, {}); !shown) return shown;
        return canvas->blend(window, std::span(&mesh, 1));
    };
    std::array<gpu::Texture, 2> small{target(*device_, 8), target(*device_, 8)}, window{target(*device_, 32), target(*device_, 32)};
    ASSERT_TRUE(drawAll(small[0], window[0]));
    ASSERT_TRUE(canvas->together([&] { return drawAll(small[1], window[1]); }));
    const auto apart = device_->readback(window[0]);
    const auto together = device_->readback(window[1]);
    ASSERT_TRUE(apart && together);
    EXPECT_EQ(*apart, *together);
    EXPECT_GT(std::ranges::count_if(*apart, [](std::byte value) { return value != std::byte{0}; }), 32 * 32) << "there is a picture";

    ASSERT_FALSE(canvas->together([&]() -> Result<void> {
        if (auto shown = canvas->show(window[1], picture, {}); !shown) return shown;
        return inputError(4029, {}, "no");
    }));
    ASSERT_TRUE(canvas->show(small[1], picture, {}));
    const auto still = device_->readback(window[1]);
    ASSERT_TRUE(still);
    EXPECT_EQ(*still, *together) << "what failed was drawn later";
}

TEST(MeshInFigures, texels_per_mm_and_stretch_are_those_of_the_map) {
    Mesh mesh = plainSquare();
    const MeshFigures even = examineMesh(mesh);
    EXPECT_NEAR(1000 * even.scale.median, 50, 50 * kNear) << "1000 texels over 20 mm";
    EXPECT_NEAR(even.stretch.median, 1, kNear);
    for (glm::vec2& uv : mesh.uvs)
        uv.x = 0.25F * uv.x + 0.5F * uv.y; // sheared, too: the singular values of ((1/4, 1/2), (0, 1)) / 20
    const MeshFigures sheared = examineMesh(mesh);
    EXPECT_NEAR(1000 * sheared.scale.median, 25, 25 * kNear);
    const double sum = 0.5 * (1.0 / 16 + 1.0 / 4 + 1);
    const double root = std::sqrt(sum * sum - 1.0 / 16);
    EXPECT_NEAR(sheared.stretch.median, std::sqrt((sum + root) / (sum - root)), 10 * kNear);
}

TEST(MeshInFigures, borders_and_seams_are_as_long_as_they_are) {
    Mesh mesh = splitSquare();
    MeshFigures figures = examineMesh(mesh);
    EXPECT_NEAR(figures.borderLength, 80, 80 * kNear);
    EXPECT_EQ(figures.seamLength, 0) << "vertices of one place and one place on the texture";
    EXPECT_EQ(figures.components, 1U);
    for (std::size_t i = 3; i < 6; ++i)
        mesh.uvs[i] *= 0.5F;
    figures = examineMesh(mesh);
    EXPECT_NEAR(figures.seamLength, std::sqrt(800.0), 30 * kNear) << "the diagonal";
    std::size_t marked = 0;
    for (const MeshTriangle& triangle : figures.triangles)
        for (const bool seam : triangle.seam)
            marked += seam ? 1 : 0;
    EXPECT_EQ(marked, 2U) << "on both sides";
    for (std::size_t i = 3; i < 6; ++i)
        mesh.positions[i].x += 100;
    EXPECT_EQ(examineMesh(mesh).components, 2U);
}

TEST(MeshInFigures, what_is_flat_or_mirrored_on_the_texture_is_counted_and_shown) {
    Mesh mesh = splitSquare();
    EXPECT_EQ(examineMesh(mesh).mirrored, 0U);
    for (std::size_t i = 0; i < 3; ++i)
        mesh.uvs[i].x = -mesh.uvs[i].x;
    mesh.uvs[3] = mesh.uvs[4] = mesh.uvs[5];
    const MeshFigures figures = examineMesh(mesh);
    EXPECT_EQ(figures.mirrored, 1U);
    EXPECT_EQ(figures.flat, 1U);
    const std::array<float, 3> magenta{1, 0, 1};
    EXPECT_EQ(colorOf(MeshShow::Texels, figures.triangles[1], figures), magenta);
    EXPECT_NE(colorOf(MeshShow::Texels, figures.triangles[0], figures), magenta);
    EXPECT_EQ(legendOf(MeshShow::Texels, figures, 1024).back().color, magenta);
}

TEST(MeshInFigures, the_legend_s_colours_are_those_of_triangles_with_its_values) {
    const MeshFigures figures = examineMesh(plainSquare());
    const auto legend = legendOf(MeshShow::Texels, figures, 200); // 10 texels per mm
    ASSERT_EQ(legend.size(), 5U);
    EXPECT_EQ(legend[3].label, "20 texels per mm");
    MeshTriangle twice = figures.triangles.front();
    twice.scale *= 2;
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(colorOf(MeshShow::Texels, twice, figures).at(c), legend[3].color.at(c), kNear);
}

TEST(MeshInFigures, a_mesh_without_texture_coordinates_and_one_of_ribbons_are_no_errors) {
    Mesh mesh = plainSquare();
    mesh.uvs.clear();
    EXPECT_EQ(examineMesh(mesh).flat, 2U);
    mesh.parts.front().expanded = true;
    EXPECT_EQ(examineMesh(mesh).triangles.size(), 0U);
    EXPECT_EQ(linesOf(MeshShow::Seams, examineMesh(mesh), 64).size(), 6U);
}

TEST(FurInFigures, where_roots_are_many_a_triangle_s_density_is_its_own_count_over_its_own_area) {
    const Mesh mesh = meadow(2); // four triangles of 2 mm2
    const std::array<std::size_t, 4> counts{50, 100, 0, 10};
    std::vector<std::uint32_t> onto;
    for (std::uint32_t t = 0; t < counts.size(); ++t)
        onto.insert(onto.end(), counts.at(t), t);
    MeshFigures figures = examineMesh(mesh);
    countRoots(figures, mesh, onto);
    EXPECT_EQ(figures.roots, 160U);
    EXPECT_NEAR(figures.furryArea, 6, kNear);
    for (std::size_t t = 0; t < counts.size(); ++t)
        EXPECT_NEAR(figures.triangles[t].fur, static_cast<double>(counts.at(t)) / 2, kNear) << t;
    EXPECT_NEAR(figures.fur.low, 5, kNear);
    EXPECT_NEAR(figures.fur.high, 50, kNear);
    const auto legend = legendOf(MeshShow::Fur, figures, 64);
    ASSERT_EQ(legend.size(), 6U);
    EXPECT_EQ(legend[3].label, "50 roots per mm2") << "twice the median, 25";
    EXPECT_EQ(colorOf(MeshShow::Fur, figures.triangles[2], figures), legend.back().color) << "bald";
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(colorOf(MeshShow::Fur, figures.triangles[1], figures).at(c), legend[3].color.at(c), kNear);
}

TEST(FurInFigures, few_roots_are_taken_together_and_none_is_lost_or_invented) {
    constexpr std::uint32_t kSquares = 200;
    const Mesh mesh = meadow(kSquares);
    std::vector<std::uint32_t> even; // one to each square: .25 per mm2, though half of the triangles have none
    for (std::uint32_t i = 0; i < kSquares; ++i)
        even.push_back(2 * i);
    MeshFigures figures = examineMesh(mesh);
    countRoots(figures, mesh, even);
    for (std::size_t t = 60; t + 60 < figures.triangles.size();
         ++t) // away from the ends, whose last triangles have half of a neighbourhood
        EXPECT_NEAR(figures.triangles[t].fur, 0.25, 0.25 * 0.1) << t << ": a density of some thirty roots, of which one is in or out";
    std::vector<std::uint32_t> half; // the left half has them, and twice as many
    for (std::uint32_t i = 0; i < kSquares / 2; ++i)
        half.insert(half.end(), 2, 2 * i);
    countRoots(figures, mesh, half);
    double sum = 0;
    for (const MeshTriangle& triangle : figures.triangles)
        sum += triangle.fur * triangle.area; // all triangles are equal, so that the areas taken together are
    EXPECT_NEAR(sum, static_cast<double>(half.size()), 0.02 * static_cast<double>(half.size())) << "but for the ends";
    EXPECT_NEAR(figures.triangles[80].fur, 0.5, 0.05);
    EXPECT_EQ(figures.triangles[2 * kSquares - 1].fur, 0);
}

TEST(FurInFigures, a_mesh_without_roots_is_no_error) {
    const Mesh mesh = meadow(3);
    MeshFigures figures = examineMesh(mesh);
    countRoots(figures, mesh, {});
    EXPECT_EQ(figures.roots, 0U);
    EXPECT_EQ(linesOf(MeshShow::Fur, figures, 64).size(), 3U);
    EXPECT_EQ(colorOf(MeshShow::Fur, figures.triangles[0], figures), legendOf(MeshShow::Fur, figures, 64).back().color);
}

TEST(Bakes, say_how_long_they_took_and_whether_they_were_there) {
    SessionTexture texture{.name = "gMap"};
    EXPECT_EQ(bakeText(texture), "") << "a file";
    texture.bake = Bake{.milliseconds = 12.34};
    EXPECT_EQ(bakeText(texture), "baked in 12.3 ms");
    texture.bake = Bake{.milliseconds = 2345};
    EXPECT_EQ(bakeText(texture), "baked in 2.3 s");
    texture.bake = Bake{.milliseconds = 0.5, .fromCache = true};
    EXPECT_EQ(bakeText(texture), "from the cache, found in 0.5 ms") << "made by a program that did not write down how long it took";
    texture.bake->once = 2345;
    EXPECT_EQ(bakeText(texture), "once baked in 2.3 s; from the cache now, found in 0.5 ms");
}

} // namespace tegument::view
