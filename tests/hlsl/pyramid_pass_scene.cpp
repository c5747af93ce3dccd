#include "tests/hlsl/pyramid_pass_scene.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr int kTable = 64; // rows, as the ladder has; columns, a fifth of its

dvec3 rowOfTable(double row) {
    return {0.3 + 0.4 * sin(2.1 * row), 0.3 + 0.4 * sin(1.3 * row + 1), 0.3 + 0.4 * cos(1.7 * row)};
}
const dvec3 kColumn = {0.004, -0.003, 0.002};

} // namespace

const TestMap& ladderTable() {
    static const TestMap kMade =
        mapOf(kTable, kTable, [](int column, int row) { return texelOf(dvec4(rowOfTable(row) + double(column) * kColumn, 1)); });
    return kMade;
}

dvec3 ladderAt(double row, double density) {
    const double column = (log2(density) + 6) * 8 / 160; // of all columns
    return rowOfTable(row) + std::clamp(column * kTable - 0.5, 0.0, kTable - 1.0) * kColumn;
}

const TestMap& metricRow() {
    static const TestMap kMade = rowOfTexels({{0, 0, 2e-5, 1},
                                              {0, 0, 0.01, 0},
                                              {0, 0, 0.08, 1},
                                              {0, 0, 0.11, 0},
                                              {0, 0, 0.13, 1},
                                              {0, 0, 0.6, 0},
                                              {0, 0, 9, 1},
                                              {0, 0, 70000, 0}});
    return kMade;
}

const TestMap& entryRow() {
    static const TestMap kMade = rowOfTexels({{0.1, 0.2, 0.3, 0.4},
                                              {0.5, 0.4, 0.2, 1},
                                              {0.3, 0.2, 0.1, 0.9},
                                              {0.05, 0.07, 0.1, 0.2},
                                              {0.8, 0.9, 0.7, 1},
                                              {0.2, 0.3, 0.1, 0.5},
                                              {0, 0, 0, 0},
                                              {0.6, 0.5, 0.3, 0.7}});
    return kMade;
}

dvec4 entryOf(int level) {
    return {0.1 + 0.07 * level, 0.6 - 0.06 * level, 0.2 + 0.05 * level * level, 0.95 - 0.1 * level};
}

dvec4 lightOf(int level) {
    return {0.31 + 0.11 * level, 0.9 - 0.1 * level, 0.05 + 0.03 * level * level, 3};
}

double fifthBrought(double density, int mapSize) {
    const double side = mapSize / 256.0 / sqrt(max(density, 1e-4));
    const double first = mapSize >= 512 ? 5.2 : 2.6;
    const double second = mapSize >= 512 ? 6.8 : 3.4;
    return saturate((side - first) / (second - first));
}

dvec3 weightBesideLinks(double step, double density, int mapSize) {
    return ladderAt(8 + step, density) + fifthBrought(density, mapSize) * ladderAt(24 + step, density);
}

dvec4 levelAlone(const dvec4& texel, double level, double density, bool linked, bool fourth, int mapSize) {
    const double d = std::clamp(density, 1e-4, 60000.0);
    dvec3 weight = linked ? weightBesideLinks(level + 1, d, mapSize) : ladderAt(level + 1, d);
    if (fourth && texel.w < 1)
        weight = max(weight - (1 - texel.w) * ladderAt(16 + level + 1, d), 0.0); // what other charts send comes along links
    const dvec3 light = texel.w > 0 ? dvec3(texel) / texel.w : dvec3(0);
    return {light * weight, linked ? -d : d};
}

double litAt(const dvec2& uv, double depth) {
    const double stored = shadowMap().at(uv).x;
    return stored <= 0 || depth <= stored ? 1 : 0;
}

double tapsLit(const dvec2& uv, double depth, double footprint, double apart) {
    double lit = 0;
    const double turn = atan(0.25);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const dvec2 square = apart * dvec2(i - 1.5, j - 1.5);
            const double right = cos(turn) * square.x - sin(turn) * square.y;
            const double up = sin(turn) * square.x + cos(turn) * square.y;
            lit += litAt(uv + dvec2(right, -up) / (footprint * kTestMapSize), depth) / 16;
        }
    return lit;
}

FunctionCase pyramidCase(Call call, Arguments arguments, int mapSize, Reference expected) {
    FunctionCase made = skinCase("Pyramid.fx", std::move(call), std::move(arguments),
                                 {32, 4, 4e-4, "weights of a linear filter have 8 bits"}, std::move(expected));
    made.filtered = true;
    made.defines = {{"TEGUMENT_MAP_SIZE", std::to_string(mapSize)}};
    made.maps["gLadderMap"] = ladderTable();
    made.maps["gAtlasMetricMap"] = metricRow();
    for (int level = 0; level < 7; ++level) {
        const dvec4 e = entryOf(level);
        const dvec4 l = lightOf(level);
        made.maps["gEntry" + std::to_string(level) + "Map"] = oneTexel(e.x, e.y, e.z, e.w);
        made.maps["gLight" + std::to_string(level) + "Map"] = oneTexel(l.x, l.y, l.z, l.w);
    }
    return made;
}

} // namespace tegument::test
