// Every target that a Direct3D engine has drawn against the one that Vulkan drew.

#include "host/image/compare.h"
#include "host/support/file.h"
#include "tests/d3d/difference.h"
#include "tools/direct3d9/job.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <ostream>

namespace tegument::test {
namespace {

struct Comparison {
    std::size_t drawn = 0; // index into allCases()
    Engine engine = Engine::Direct3D9;
};

/// Instead of the bytes.
void PrintTo(const Comparison& comparison, std::ostream* out) {
    *out << allCases().at(comparison.drawn).name() << " on " << engineName(comparison.engine);
}

std::vector<Comparison> comparisons() {
    std::vector<Comparison> all;
    for (std::size_t i = 0; i < allCases().size(); ++i)
        for (const Engine engine : kDirect3D)
            if (drawnBy(allCases()[i], engine)) all.push_back({i, engine});
    return all;
}

class Drawn : public testing::TestWithParam<Comparison> {};

TEST_P(Drawn, as_vulkan_draws_it) {
    const Case& drawn = allCases().at(GetParam().drawn);
    const Engine engine = GetParam().engine;
    if (const auto missing = readFile(missingFile())) GTEST_SKIP() << *missing;
    const auto status = readFile(statusFile(drawn, engine));
    if (!status) GTEST_SKIP() << "not drawn: run the tests of label d3d through ctest, which draws first";
    ASSERT_EQ(*status, "ok");
    for (const DrawnTarget& target : targetsOf(drawn)) {
        if (!readable(engine, target)) continue;
        const auto found = distance(drawn, engine, target);
        ASSERT_TRUE(found) << format(found.error());
        const Exception* exception = exceptionFor(drawn, engine, target);
        const std::string where =
            fmt::format("{}: {} of {} pixels beyond {:g}; largest {:g} at ({}, {}), 99.9 % within {:g}", target.name, found->beyond,
                        found->pixels, tolerance(target.kind), found->largest, found->x, found->y, found->p999);
        const auto pixels = static_cast<double>(found->pixels);
        EXPECT_TRUE(std::isfinite(found->largest)) << where;
        EXPECT_LE(static_cast<double>(found->farther), kFew * pixels) << where;
        if (exception) {
            EXPECT_LE(static_cast<double>(found->beyond), exception->beyond * pixels) << where;
        }
    }
}

/// The picture of the client of the library against that of Main.fx, by the same engine. The formulas are the same, the compilers order
/// sums as they find them: what rounds differently by one step turns a comparison at the edge of shadow here and there.
class LibrarySkin : public testing::TestWithParam<Engine> {};

TEST_P(LibrarySkin, is_that_of_the_effect) {
    const Engine engine = GetParam();
    if (const auto missing = readFile(missingFile())) GTEST_SKIP() << *missing;
    const auto library = readFloats(drawing(libraryCase(), engine, "picture"));
    const auto effect = readFloats(drawing({.effect = "effects/Main.fx", .technique = "DEonLuebke"}, engine, "picture"));
    if (!library || !effect) GTEST_SKIP() << "not drawn: run the tests of label d3d through ctest, which draws first";
    const auto found = compareImages(*library, *effect);
    ASSERT_TRUE(found) << format(found.error());
    constexpr double kPixels = kPictureWidth * kPictureHeight;
    EXPECT_LT(found->relativeL2, 1e-3);
    EXPECT_LE(found->beyond, 1e-3) << found->pixelsBeyond << " pixels beyond 1e-3 of the mean";
    double lit = 0;
    for (std::size_t i = 0; i < library->pixels.size(); i += static_cast<std::size_t>(library->channels))
        lit += library->pixels[i] > 0.1F ? 1 : 0;
    EXPECT_GT(lit / kPixels, 0.05) << "a head fills more than a twentieth of the picture";
}

/// tests/d3d/CMakeLists.txt reads the part.
std::string comparisonName(const Case& drawn, Engine engine) {
    return fmt::format("part_{}_{}_on_{}", partOf(drawn), drawn.name(), engineName(engine));
}

INSTANTIATE_TEST_SUITE_P(Engines, Drawn, testing::ValuesIn(comparisons()),
                         [](const auto& tested) { return comparisonName(allCases().at(tested.param.drawn), tested.param.engine); });
INSTANTIATE_TEST_SUITE_P(Engines, LibrarySkin, testing::Values(Engine::Vulkan, Engine::Direct3D11),
                         [](const auto& tested) { return comparisonName(libraryCase(), tested.param); });

} // namespace
} // namespace tegument::test
