// Light along links (effects/passes/pyramid_links.fxh) against what docs/design/modules/Pyramid.md says of a sheet of links: tile k holds
// link k of each texel of a map of 256 x 256, the last tile where the lists of a texel's quarters are, the last texel how many tiles there
// are. Sheets are filled with numbers that no mesh would give.

#include "tests/hlsl/pyramid_pass_scene.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr int kSide = 256;    // texels of the links' map
constexpr int kQuarters = 16; // rows of quarters below it
constexpr int kTileRows = kSide + kQuarters;
constexpr int kTiles = 2; // along a side
constexpr double kHigh = double{kTileRows} / kSide;

std::uint32_t bitsOf(int x, int y, int k) {
    auto h = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ static_cast<std::uint32_t>(y) * 0x85ebca77U ^
             static_cast<std::uint32_t>(k) * 0xc2b2ae3dU;
    h ^= h >> 15U;
    h *= 0x2c1b3c6dU;
    return h ^ (h >> 12U);
}

/// Link k of a list, (0, 0, 0, 0) at its end. coarse: maps of 64 to 16 texels send, too.
dvec4 linkIn(int x, int y, int k, bool coarse) {
    const std::uint32_t bits = bitsOf(x, y, k);
    if (k > 2 || bits % 5 == 0) return dvec4(0);
    const auto part = [&](int shift) { return 0.05 + 0.9 * static_cast<double>(bits >> shift & 255U) / 255; };
    const std::uint32_t map = bits / 5 % (coarse && y < kSide ? 6 : 3); // halves, quarters, a sixteenth
    return {(map & 1U) != 0 ? -part(4) : part(4), (map & 2U) != 0 ? -part(8) : part(8), 0.3 * part(12),
            (map & 4U) != 0 ? -part(16) : part(16)};
}

/// Where the quarters of a texel are in the rows below, and whether their lists serve instead.
dvec4 quartersAt(int x, int y) {
    const std::uint32_t bits = bitsOf(x, y, 9);
    if (bits % 3 == 0) return dvec4(0);
    return {0, 1 + static_cast<int>(bits >> 3U) % (kSide / 2), static_cast<int>(bits >> 11U & 1023U) % (kQuarters / 2),
            bits % 3 == 1 ? 1 : 0};
}

TestMap sheetOf(bool coarse, double fourth) {
    TestMap sheet = mapOf(kTiles * kSide, kTiles * kTileRows, [=](int x, int y) {
        const int k = y / kTileRows * kTiles + x / kSide;
        if (k < kTiles * kTiles - 1) return texelOf(linkIn(x % kSide, y % kTileRows, k, coarse));
        return y % kTileRows < kSide ? texelOf(quartersAt(x % kSide, y % kTileRows)) : texelOf(0);
    });
    sheet.texels.back() = texelOf(kTiles, fourth, kHigh);
    return sheet;
}

dvec4 fullLink(int x, int y, int k) {
    return {0.5, 0.5, 0.001 * (1 + bitsOf(x, y, k) % 100), 0.002 * (1 + bitsOf(y, x, k) % 50)};
}

TestMap fullSheet() {
    TestMap sheet = mapOf(kTiles * kSide, kTiles * kSide,
                          [](int x, int y) { return texelOf(fullLink(x % kSide, y % kSide, y / kSide * kTiles + x / kSide)); });
    sheet.texels.back() = {kTiles, 0, 1, 0};
    return sheet;
}

/// Of maps of 512 to 16 texels the level that is as large, or the nearest one that there is.
int levelOfSize(int size, int mapSize) {
    return std::clamp(static_cast<int>(std::lround(log2(double(mapSize) / size))), 0, 6);
}

int sizeOf(const dvec4& link) {
    return 512 / (link.x < 0 ? 2 : 1) / (link.y < 0 ? 4 : 1) / (link.w < 0 ? 16 : 1);
}

dvec3 sentBy(const dvec4& link, const dvec4& source, double fifth) {
    const dvec3 share = fifth * abs(link.z) * dvec3(kSkinGaussians[4]) + abs(link.w) * dvec3(kSkinGaussians[5]);
    return share * dvec3(source) / max(source.w, 1e-4);
}

dvec3 listAt(int x, int y, bool coarse, int mapSize, double density) {
    dvec3 sum(0);
    for (int k = 0; k < kTiles * kTiles; ++k) {
        const dvec4 link = linkIn(x, y, k, coarse);
        if (link.x == 0) break;
        sum += sentBy(link, entryOf(levelOfSize(sizeOf(link), mapSize)), 1 - fifthBrought(density, mapSize));
    }
    return sum;
}

/// Of a texel's own list; where there are quarters, they may serve instead.
dvec3 ownList(int x, int y, bool coarse, int mapSize, double density) {
    const bool replaced = mapSize >= 512 && quartersAt(x, y).w > 0.5;
    return replaced ? dvec3(0) : listAt(x, y, coarse, mapSize, density);
}

dvec3 quarterList(int x, int y, int mapSize, double density) { // of the map's quarters, 512 x 512
    const dvec4 at = quartersAt(x / 2, y / 2);
    if (at.y < 0.5) return dvec3(0);
    return listAt(2 * (static_cast<int>(at.y) - 1) + x % 2, kSide + 2 * static_cast<int>(at.z) + y % 2, false, mapSize, density);
}

/// The published profile with other variances for its last two Gaussians.
std::vector<double> widened(double fifth, double sixth) {
    std::vector<double> numbers;
    for (const dvec4& gaussian : kSkinGaussians)
        for (int c = 0; c < 4; ++c)
            numbers.push_back(gaussian[c]);
    numbers[19] = fifth;
    numbers[23] = sixth;
    return numbers;
}

double gaussianAt(double variance, double squared) {
    return exp(-squared / (2 * variance)) / (2 * 3.141592653589793 * variance);
}

/// What a profile makes of links that were made for another one.
Cases profiles(const Tolerance& exact) {
    Cases cases;
    struct Known {
        double fifth, sixth;
        bool made, bringsFifth, bringsSixth;
        double melanin = 0; // of a tone, which sets the numbers aside
    };
    for (const Known& known :
         {Known{1.99, 7.41, true, true, true}, Known{2.5, 11, false, true, true}, Known{0.6, 3.3, false, false, true},
          Known{1.99, 12.5, false, true, false}, Known{17.91, 66.69, false, false, false}, Known{17.91, 66.69, true, false, true, 0.1}}) {
        cases += pyramidCase(
            {"sixthLinked",
             "return float4(linksAsMade() ? 1.0 : 0.0, fifthLinked() ? 1.0 : 0.0, sixthLinked() ? 1.0 : 0.0, fifthByLevels(1000.0));"},
            {linear(0, 1)}, [=](In) {
                return values(known.made ? 1 : 0, known.bringsFifth ? 1 : 0, known.bringsSixth ? 1 : 0, known.bringsFifth ? 0 : 1);
            });
        cases.back().globals["gGaussianWeight"] = widened(known.fifth, known.sixth);
        cases.back().globals["gMelanin"] = {known.melanin};
        cases.back().tolerance = exact;
        cases.back().samples = 4;
        cases += pyramidCase("linkSheet() + a0", {linear(0, 1)}, [=](In x) {
            if (!known.bringsSixth) return values(x[0], x[0], 1 + x[0]);
            return values(kTiles + x[0], (known.bringsFifth ? 1 : 0) + x[0], kHigh + x[0]);
        });
        cases.back().globals["gGaussianWeight"] = widened(known.fifth, known.sixth);
        cases.back().globals["gMelanin"] = {known.melanin};
        cases.back().maps["gLinksMap"] = sheetOf(false, 1);
        cases.back().tolerance = exact;
    }
    // A source of area a1, mm^2, sqrt(a0) mm away.
    const char* link = "float2 g = a1 * exp(-a0 / float2(3.98, 14.82)) / (6.2831853 * float2(1.99, 7.41)); ";
    for (const auto& [fifth, sixth] : {std::pair{1.99, 7.41}, std::pair{2.5, 11.0}, std::pair{3.3, 5.0}}) {
        cases +=
            pyramidCase({"linkWeights", std::string(link) + "return float4(linkWeights(float4(0.5, -0.5, g * float2(1.0, -1.0))), 0, 0);"},
                        {linear(0, 30), linear(0.1, 2)}, [fifth = fifth, sixth = sixth](In x) {
                            return values(x[1] * gaussianAt(fifth, x[0]), x[1] * gaussianAt(sixth, x[0]));
                        });
        cases.back().globals["gGaussianWeight"] = widened(fifth, sixth);
        cases.back().tolerance = {256, 16, 1e-6, "powers of 2 of logarithms of up to 20"};
    }
    // Lists made anew add up to what theirs do, between the two in the logarithm of the variance.
    cases += pyramidCase("linkScale((float2(a0, a1) + 0.5) / float2(256, 272), 2.0, 2.0)", {whole(0, 255), whole(0, 255)}, [](In x) {
        dvec2 stored(0);
        dvec2 anew(0);
        const dvec2 v(2.5, 11);
        for (int k = 0; k < 3; ++k) {
            const dvec4 one = linkIn(static_cast<int>(x[0]), static_cast<int>(x[1]), k, false);
            if (one.x == 0) break;
            const dvec2 own = abs(dvec2(one.z, one.w));

            // Area and squared distance of a source that weighs as much by both.
            const double squared = log(own.y * 7.41 / (own.x * 1.99)) / (0.5 / 1.99 - 0.5 / 7.41);
            const double area = own.x / gaussianAt(1.99, squared);
            stored += own;
            anew += area * dvec2(gaussianAt(v.x, squared), gaussianAt(v.y, squared));
        }
        if (stored.x == 0) return values(0, 0);
        const dvec2 place = log(v / 1.99) / log(7.41 / 1.99);
        return values(stored.x * pow(stored.y / stored.x, place.x) / anew.x, stored.x * pow(stored.y / stored.x, place.y) / anew.y);
    });
    cases.back().globals["gGaussianWeight"] = widened(2.5, 11);
    cases.back().maps["gLinksMap"] = sheetOf(false, 0);
    cases.back().filtered = false;
    cases.back().tolerance = {512, 0, 1e-5, "powers of 2 of logarithms, sums of three"};
    cases.back().domain = [](In x) { return linkIn(static_cast<int>(x[0]), static_cast<int>(x[1]), 0, false).x != 0; };
    return cases;
}

void parts(Cases& cases) {
    const Tolerance exact{8, 2, 1e-6, "a few products and a quotient"};
    cases += pyramidCase("linkMap(a0)", {linear(-1, 1, 4)},
                         // a bit for each sign
                         [](In x) { return (x[0] < 0 ? 1 : 0) + (x.scalar(0, 1) < 0 ? 2 : 0) + (x.scalar(0, 3) < 0 ? 4 : 0); });
    cases.back().tolerance = exact;
    cases += pyramidCase("linkSlot(a0, a1)", {linear(0, 1, 2), linear(1, 2)}, [](In x) { return values(x[0], x.scalar(0, 1) / x[1]); });
    cases.back().tolerance = exact;
    // An empty sheet: no list, no quarters, and a tile is as high as wide.
    cases += pyramidCase("linkSheet() + a0", {linear(0, 1)}, [](In x) { return values(x[0], x[0], 1 + x[0]); });
    cases.back().tolerance = exact;
    cases.back().maps["gLinksMap"] = oneTexel(0);
    cases += pyramidCase("linkOf((float2(a0, a1) + 0.5) / float2(256, 272), a2, 2.0)", {whole(0, 255), whole(0, 271), whole(0, 2)},
                         [](In x) { return linkIn(static_cast<int>(x[0]), static_cast<int>(x[1]), static_cast<int>(x[2]), true); });
    cases.back().maps["gLinksMap"] = sheetOf(true, 0);
    cases.back().filtered = false;
    cases.back().tolerance = exact;
    cases += pyramidCase("linkLight(float2(a3 * abs(a0.z), abs(a0.w)), linkColours(), float4(a1, a2))",
                         {linear(-1, 1, 4), linear(0, 1, 3), logarithmic(1e-5, 1), linear(0, 1)},
                         [](In x) { return sentBy(x.vec4(0), dvec4(x.vec3(1), x[2]), x[3]); });
    cases.back().tolerance = exact;
    for (FunctionCase& made : profiles(exact))
        cases.push_back(std::move(made));
    for (int size : {128, 256, 512, 1024, 2048}) {
        for (const char* of : {"anySource", "fineSource"}) {
            const bool fine = of[0] == 'f';
            cases +=
                pyramidCase({of, std::string("return ") + of + "(float4(a0, 0, a1));"}, {linear(-1, 1, 2), linear(-1, 1)}, size, [=](In x) {
                    const dvec4 link(x.vec2(0), 0, x[1]);
                    const int level = levelOfSize(max(sizeOf(link), fine ? 128 : 16), size);
                    return entryOf(level) * (1 + 0.1 * floor(8 * abs(link.x)) + floor(8 * abs(link.y)));
                });
            for (int level = 0; level < 7; ++level) { // 8 x 8 texels, each another light
                TestMap map{.size = 8};
                for (int i = 0; i < 64; ++i) {
                    const dvec4 t = entryOf(level) * (1 + 0.1 * (i % 8) + i / 8);
                    map.texels.push_back(
                        {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z), static_cast<float>(t.w)});
                }
                cases.back().maps["gEntry" + std::to_string(level) + "Map"] = std::move(map);
            }
            cases.back().filtered = false;
            cases.back().domain = [](In x) { // links name no map smaller than 16 texels; -0 is no sign
                const dvec2 within = fract(8.0 * abs(x.vec2(0)));
                return sizeOf({x.vec2(0), 0, x[1]}) >= 16 && min(within.x, within.y) > 1e-3 && max(within.x, within.y) < 0.999;
            };
        }
    }
}

constexpr const char* kPlace = "float2 uv = (float2(a0, a1) + 0.5) / 512.0; ";

FunctionCase sheetCase(const char* function, const std::string& body, int size, bool coarse, double fourth,
                       std::function<Values(int x, int y, double density, In)> expected, Arguments more = {}) {
    Arguments arguments = {whole(0, 511), whole(0, 511)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    FunctionCase made = pyramidCase({function, kPlace + body}, arguments, size, [=](In x) {
        const auto column = static_cast<int>(round(x[0]));
        const auto row = static_cast<int>(round(x[1]));
        return expected(column, row, texelOfRow(metricRow(), column / 64).z, x);
    });
    made.maps["gLinksMap"] = sheetOf(coarse, fourth);
    made.filtered = false;
    // Steps of the metric are read at their nearest texel; the ladder's row at its middle, and its columns not between.
    made.tolerance.absolute = 1e-2;
    made.tolerance.why = "the ladder's nearest column is half of one away";
    return made;
}

/// A thread does not see the end that another has met: it begins behind it, and must meet one itself.
bool threadsMeetTheEnd(In x, bool coarse) {
    const auto column = static_cast<int>(round(x[0])) / 2;
    const auto row = static_cast<int>(round(x[1])) / 2;
    return linkIn(column, row, 0, coarse).x != 0 && linkIn(column, row, 1, coarse).x != 0;
}

Cases lists() {
    Cases cases;
    for (int size : {256, 512}) {
        for (const char* of : {"anyLinks", "fineLinks"}) {
            const bool any = of[0] == 'a';
            cases += sheetCase(of, std::string("return ") + of + "(uv, 0.0, 1.0);", size, any, 0,
                               [=](int x, int y, double density, In) { return values(ownList(x / 2, y / 2, any, size, density)); });
            // Threads that share a list take a part of it each.
            cases += sheetCase(of, std::string("return ") + of + "(uv, 0.0, 2.0) + " + of + "(uv, 1.0, 2.0);", size, any, 0,
                               [=](int x, int y, double density, In) { return values(ownList(x / 2, y / 2, any, size, density)); });
            cases.back().domain = [=](In x) { return threadsMeetTheEnd(x, any); };
        }
        cases += sheetCase("quarterLinks", "return quarterLinks(uv);", size, false, 0,
                           [=](int x, int y, double density, In) { return values(quarterList(x, y, size, density)); });
        cases += sheetCase("quartersOf", "return quartersOf(uv, linkSheet());", size, false, 0,
                           [](int x, int y, double, In) { return values(quartersAt(x / 2, y / 2)); });
        for (std::size_t i = cases.size() - 6; i < cases.size(); ++i)
            cases[i].tolerance = {16, 0, 1e-5, "a sum of three lights"};
    }
    // A sheet that is full: no list has an end in it, and none goes on beyond it.
    for (int parts : {1, 2, 4}) {
        std::string body = "float4 sum = 0.0; ";
        for (int first = 0; first < parts; ++first)
            body += "sum += anyLinks(uv, " + std::to_string(first) + ".0, " + std::to_string(parts) + ".0); ";
        cases += sheetCase("anyLinks", body + "return sum;", 256, true, 0, [](int x, int y, double density, In) {
            dvec3 sum(0);
            for (int k = 0; k < kTiles * kTiles; ++k)
                sum += sentBy(fullLink(x / 2, y / 2, k), entryOf(0), 1 - fifthBrought(density, 256));
            return values(sum);
        });
        cases.back().maps["gLinksMap"] = fullSheet();
        cases.back().domain = [](In x) { return x[0] < 509.5 || x[1] < 509.5; }; // what the last texel says instead
        cases.back().tolerance = {16, 0, 1e-5, "a sum of four lights"};
    }
    // A mesh without links: an empty sheet is one texel of zeros.
    for (const char* of : {"anyLinks(uv, 0.0, 1.0)", "fineLinks(uv, 0.0, 1.0)", "quarterLinks(uv)"}) {
        const std::string name(of, std::string(of).find('('));
        cases += sheetCase(name == "anyLinks"    ? "anyLinks"
                           : name == "fineLinks" ? "fineLinks"
                                                 : "quarterLinks",
                           std::string("return ") + of + ";", 512, false, 0, [](int, int, double, In) { return values(0); });
        cases.back().maps["gLinksMap"] = oneTexel(0);
    }
    return cases;
}

/// What an entry point of a level adds by links: at the level as large as their map, or the base where that is smaller, lists of texels;
/// at the next finer one those of quarters.
dvec3 linksOf(int level, int mapSize, bool fine, int x, int y, double density) {
    const int wide = levelOfSize(kSide, mapSize);
    if (level == wide) return ownList(x / 2, y / 2, !fine, mapSize, density);
    if (level == wide - 1) return quarterList(x, y, mapSize, density);
    return dvec3(0);
}

Values levelWithLinks(int level, int mapSize, bool top, bool fine, int x, int y, double density, double near) {
    if (level <= 2 && near < 0.5) return values(0);
    dvec4 light = levelAlone(entryOf(level), level, density, true, true, mapSize);
    if (!top) light += dvec4(dvec3(lightOf(level + 1)), 0);
    return values(light + dvec4(linksOf(level, mapSize, fine, x, y, density), 0));
}

void levels(Cases& cases) {
    const auto add = [&](const std::string& entry, int level, int size, bool top, bool fine) {
        cases += sheetCase("LINKED_LEVEL", "TgQuadVarying q = (TgQuadVarying)0; q.uv = uv; return " + entry + "(q);", size, !fine, 1,
                           [=](int x, int y, double density, In) {
                               return levelWithLinks(level, size, top, fine, x, y, density, texelOfRow(metricRow(), x / 64).w);
                           });
        cases.back().samples = 256;
    };
    for (int size : {256, 512, 1024, 2048}) {
        const int wide = levelOfSize(kSide, size);
        for (int level = 0; level < 7; ++level)
            if (size == 256 || abs(level - wide) <= 1) add("LinkedLight" + std::to_string(level) + "PS", level, size, level == 6, false);
        add("FineTopPS", max(wide, 2), size, true, true); // the last level without the coarse ones
        if (size <= 512) add("FineLightPS", wide, size, false, true);
    }
    // Four threads share a list, and the first adds them up.
    for (const bool fine : {false, true}) {
        const std::string entry = fine ? "FineTopCS" : "LinkedLight2CS";
        cases +=
            sheetCase("PYRAMID_LINKS_CS",
                      "[loop] for (int z = 3; z >= 0; z--) " + entry + "(uint3(uv * kPyramidSize2, z), 64 * z + 9); return gLight2Store;",
                      1024, !fine, 1, [=](int x, int y, double density, In) {
                          return levelWithLinks(2, 1024, fine, fine, x, y, density, texelOfRow(metricRow(), x / 64).w);
                      });
        cases.back().samples = 256;
        cases.back().domain = [=](In x) { return threadsMeetTheEnd(x, !fine); };
    }
    cases += sheetCase("linkedLevel", "return linkedLevel(gEntry3Map, gEntry3, uv, 32.0, 3.0);", 256, false, 0,
                       [](int, int, double density, In) { return values(levelAlone(entryOf(3), 3, density, true, false, 256)); });
}

} // namespace

Cases pyramidLinkCases() {
    return together(parts, lists(), levels);
}

} // namespace tegument::test
