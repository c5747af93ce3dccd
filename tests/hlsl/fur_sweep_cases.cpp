// Sweeps through strands (effects/passes/fur_strands.fxh, fur_cellular.fxh, fur_rooted.fxh) in double precision: cones by search, cells by
// trying all of a neighbourhood, the ray's way by a linear system.

#include "tests/hlsl/fur_cone.h"
#include "tests/hlsl/fur_light.h"
#include "tests/hlsl/fur_numbers.h"
#include "tests/hlsl/maps.h"

#include <algorithm>

namespace tegument::test {

namespace {

constexpr double kShortest = 0.55;
constexpr double kLayers = 32;
constexpr double kNearEnd = 0.01; // 1 / distance of the coat's end

FunctionCase sweepCase(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    const Globals more = {
        {"gFurRadius", {kFurRootRadius}}, {"gFurShortest", {kShortest}}, {"gFurVariation", {0.4}}, {"gFurLayers", {kLayers}}};
    FunctionCase made =
        passCase("FurRoots.fx", with(furScene(), more), std::move(call), std::move(arguments), std::move(tolerance), std::move(expected));
    made.maps = {{"gCoatEndMap", oneTexel(kNearEnd)}};
    return made;
}

/// Arguments: normal, way over the skin, top, drop; `first` is the number of the first.
MetPiece pieceAt(In x, std::size_t first) {
    MetPiece piece;
    piece.normal = x.vec3(first);
    piece.along = x.vec3(first + 1);
    piece.top = x.scalar(first + 2);
    piece.low = piece.top - x.scalar(first + 3);
    return piece;
}

constexpr const char* kPieceBody = "FurSweep s = (FurSweep)0; s.normal = a0; s.width = 0.3; FurPiece p = furFirstPiece(); "
                                   "p.top = a2; p.low = a2 - a3; ";

FunctionCase meeting() {
    const auto pieceOf = [](In x) {
        MetPiece piece = pieceAt(x, 0);
        piece.bend = x.vec2(4);
        piece.bendLow = x.vec2(5);
        return piece;
    };
    const auto coneOf = [=](In x) { return pieceOf(x).cone(x.vec3(6), x[7], kFurRootRadius, x[8], x.vec3(9)); };
    FunctionCase made = sweepCase(
        {"furMeet", std::string(kPieceBody) + "p.along = a1; p.bend = a4; p.bendLow = a5; return furMeet(a10, s, p, a6, a7, 0.3, a8, a9);"},
        {unit(), vector(3, 0.2, 2), linear(0.3, 1), linear(0.02, 0.3), linear(-0.3, 0.3, 2), linear(-0.3, 0.3, 2), vector(3, 0.05, 1),
         linear(0.5, 1.2), linear(-1, 1), linear(0, 1, 3), linear(0, 0.9, 4)},
        {16, 4, 2e-3, "roots of differences, as tgFurCone"}, [=](In x) { return pieceOf(x).meet(x.vec4(10), coneOf(x), x[7], x.vec3(9)); });
    made.domain = [=](In x) { // not where a graze or a side of no length decides
        const dvec3 r = x.vec3(9) - 0.5;
        const MetCone cone = coneOf(x);
        return isUnit(x.vec3(0)) && length(r - x.vec3(0) * dot(r, x.vec3(0))) > 0.05 && length(cone.along) > 0.1 &&
               cone.section(0, 0.3) < 0.9 && abs(cone.inside(cone.nearest())) > 0.02;
    };
    return made;
}

/// Two rounds of whole numbers, then a third for the strand.
struct CellPoint {
    dvec3 place, random;

    explicit CellPoint(const std::array<std::int64_t, 3>& cell) {
        const auto unitOf = [](const Residues& v) {
            return (dvec3(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])) + 0.5) / 1019.0;
        };
        const Residues mixed = mixedWhole(mixedWhole(cell));
        place = unitOf(mixed) + dvec3(static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2]));
        random = unitOf(mixedWhole(mixed));
    }
};

/// Every cell of a neighbourhood, in rows along x, then y, then z. `edge`: how near anything is to where it would count or not.
dvec4 metCells(const MetPiece& piece, double reach, double& edge) {
    dvec4 met(0);
    const dvec3 middle = floor(piece.begin + piece.along / 2.0);
    constexpr int kAround = 4;
    for (int z = -kAround; z <= kAround; ++z)
        for (int y = -kAround; y <= kAround; ++y)
            for (int x = -kAround; x <= kAround; ++x) {
                const dvec3 cell = middle + dvec3(x, y, z);
                const CellPoint point({std::llround(cell.x), std::llround(cell.y), std::llround(cell.z)});
                dvec3 root = piece.begin - point.place;
                const double distance = dot(root, piece.normal);
                root -= piece.normal * distance;
                const double away = length(root + piece.along / 2.0);
                const double share = max(mix(kShortest, 1.0, point.random.y) * saturate(4 - 8 * abs(distance)), 0.01);
                if (abs(distance) < 0.52 && away < reach + 0.02)
                    edge = min({edge, abs(0.5 - abs(distance)), abs(away - reach), abs(share - piece.low)});
                if (abs(distance) >= 0.5 || away >= reach || share <= piece.low) continue;
                const MetCone cone = piece.cone(root, share, kFurRootRadius, 1, point.random);
                edge = min(edge, abs(cone.inside(cone.nearest())) / 20);
                met = piece.meet(met, cone, share, point.random);
            }
    return met;
}

/// Of a way along the skin. Cases ask for reaches that are shorter than what a ray meets, so that what counts as near decides.
MetPiece flatPiece(In x) {
    MetPiece piece = pieceAt(x, 0);
    piece.along -= piece.normal * dot(piece.along, piece.normal);
    piece.begin = x.vec3(4);
    return piece;
}

/// A pixel this wide, so that strands are met from further away.
FunctionCase cells(double width, const Argument& top, const Argument& reach) {
    const auto metAt = [=](In x, double& edge) {
        MetPiece piece = flatPiece(x);
        piece.width = width;
        return metCells(piece, x[5], edge);
    };
    FunctionCase made =
        sweepCase({"furCells", std::string(kPieceBody) + "s.width = " + std::to_string(width) +
                                   "; p.along = a1 - a0 * dot(a0, a1); p.begin = a4; p.reach = a5; return furCells(0.0, s, p);"},
                  {unit(), vector(3, 0.4, 1.6), top, linear(0.02, 0.2), linear(-20, 20, 3), reach},
                  {16, 0, 5e-3, "roots of differences, of several strands"}, [=](In x) {
                      double edge = 1;
                      return metAt(x, edge);
                  });
    made.domain = [=](In x) {
        double edge = 1;
        if (!isUnit(x.vec3(0)) || length(flatPiece(x).along) < 0.1) return false;
        metAt(x, edge);
        return edge > 1e-3 / (1 + width); // of more strands some are always near
    };
    return made;
}

/// A texture of roots: its header, a list of two texels, six roots, and the coat around them.
constexpr std::size_t kRootsWidth = 4096;
constexpr std::size_t kListAt = 100;
constexpr std::size_t kBrickAt = 200;
constexpr std::size_t kRootCount = 6;
constexpr double kRootsSpacing = 2.5; // mm
constexpr double kRootsBall = 90;     // radius of the roots' mesh, mm

/// Numbers of a root that follow no rule: places within a few spacings, lengths about 1.
std::array<std::array<float, 4>, 3> rootOf(std::size_t index) {
    const auto i = static_cast<double>(index);
    return {texelOf(2.1 * sin(1.3 * i + 1), 1.9 * sin(2.7 * i), 2.0 * sin(0.7 * i + 2), 0.2 + 0.03 * i),
            texelOf(0.8 * cos(i), 0.8 * sin(i), 0.5, 4.5 + 0.2 * i),
            texelOf(0.4 * sin(3.1 * i), 0.3, 0.5 * cos(1.7 * i), 0.37 + 0.0931 * i)};
}

const TestMap& rootsMap() {
    static const TestMap kMap = [] {
        TestMap map{.size = kRootsWidth, .texels = std::vector<std::array<float, 4>>(2 * kRootsWidth), .height = 2};
        map.texels[0] = {-400, -400, -400, 200};                                 // one brick around everything
        map.texels[1] = {1, 1, 1, 4};                                            // of 4 cells a side
        map.texels[2] = {2, 50, 0, 0};                                           // rows; address of the table of bricks
        map.texels[3] = texelOf(0, 0.4, 0, 1 / (kRootsSpacing * kRootsSpacing)); // radius of a root, mm; roots in a square mm
        map.texels[4] = texelOf(5, -6, 7, kRootsBall);                           // ball of the mesh
        map.texels[5] = {0.6F, 0, 0, 0};                                         // shortest
        map.texels[6] = {4100, 4, 0, 0};                                         // first root; cells between nodes
        map.texels[7] = {3, 2, 0, 0};
        map.texels[50] = {static_cast<float>(kBrickAt), 0, 0, 0};
        const auto address = [](std::size_t root) { return static_cast<float>(kRootsWidth + 3 * root); };
        map.texels[kListAt] = {address(0), address(1), address(2), address(3)};
        map.texels[kListAt + 1] = {-address(4), address(5), 0, 0}; // a negative one begins the last four
        for (std::size_t root = 0; root < kRootCount; ++root)
            std::ranges::copy(rootOf(root), map.texels.begin() + static_cast<std::ptrdiff_t>(kRootsWidth + 3 * root));
        for (std::size_t node = 0; node < 27; ++node) // of the coat, behind the brick's 64 cells, four to a texel
            map.texels[kBrickAt + 16 + node] = texelOf(0.1 * sin(static_cast<double>(node)), 0.2, 0.03 * static_cast<double>(node),
                                                       0.5 + 0.05 * static_cast<double>(node));
        return map;
    }();
    return kMap;
}

dvec4 in(const std::array<float, 4>& v) {
    return {v[0], v[1], v[2], v[3]};
}

/// All roots of the list; `edge` as in metCells.
dvec4 metRoots(const MetPiece& piece, double reach, double& edge) {
    dvec4 met(0);
    for (std::size_t index = 0; index < kRootCount; ++index) {
        const auto [place, up, lean] = rootOf(index);
        dvec3 root = piece.begin - dvec3(in(place)) * 0.4;
        root -= piece.normal * dot(root, piece.normal);
        const double away = length(root + piece.along / 2.0);
        edge = min(edge, abs(away - reach));
        if (away >= reach) continue;
        const double share = max(min(dot(dvec3(in(up)), piece.normal), static_cast<double>(up[3]) * 0.2), 0.01);
        const dvec3 random = fract(static_cast<double>(lean[3]) * dvec3(1, 256, 65536));
        const double stray = dot(dvec3(in(lean)), piece.normal);
        const MetCone cone = piece.cone(root, share, static_cast<double>(place[3]) * 0.75, stray, random);
        edge = min(edge, abs(cone.inside(cone.nearest())) / 20);
        met = piece.meet(met, cone, share, random);
    }
    return met;
}

void roots(Cases& cases) {
    cases += sweepCase({"furRoots", std::string(kPieceBody) +
                                        "p.along = a1 - a0 * dot(a0, a1); p.begin = a4; p.reach = a5; p.bend = float2(0.1, 0.05); "
                                        "p.bendLow = float2(0.02, -0.03); FurRootGrid grid = furRootGrid(); "
                                        "return furRoots(0.0, s, p, grid, float3(0.4, 0.75, -0.2), 100.0);"},
                       {unit(), vector(3, 0.2, 1), linear(0.2, 0.6), linear(0.02, 0.2), linear(-1, 1, 3), linear(0.2, 0.8)},
                       {16, 0, 5e-3, "roots of differences, of several strands"}, [](In x) {
                           double edge = 1;
                           MetPiece piece = flatPiece(x);
                           piece.bend = {0.1, 0.05};
                           piece.bendLow = {0.02, -0.03};
                           return metRoots(piece, x[5], edge);
                       });
    cases.back().map = &rootsMap();
    cases.back().domain = [](In x) {
        double edge = 1;
        if (!isUnit(x.vec3(0)) || length(flatPiece(x).along) < 0.1) return false;
        MetPiece piece = flatPiece(x);
        piece.bend = {0.1, 0.05};
        piece.bendLow = {0.02, -0.03};
        metRoots(piece, x[5], edge);
        return edge > 1e-3;
    };
    cases += sweepCase("furRootsHeader(a0)", {whole(0, 7)}, {0, 0, 0, "texels"},
                       [](In x) { return in(rootsMap().texels[static_cast<std::size_t>(std::llround(x[0]))]); });
    cases.back().map = &rootsMap();
}

/// Between the eight nodes of the brick, 4 cells of 200 mm apart.
dvec4 coatOfRoots(const dvec3& place) {
    const dvec3 t = (place + 400.0) / 800.0;
    dvec4 sum(0);
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const dvec3 node(static_cast<double>(corner & 1U), static_cast<double>(corner >> 1U & 1U), static_cast<double>(corner >> 2U));
        const dvec3 weight = mix(1.0 - t, t, node);
        sum += weight.x * weight.y * weight.z * in(rootsMap().texels[kBrickAt + 16 + corner]);
    }
    return sum;
}

constexpr const char* kVertexBody = "TgVertexInput i = (TgVertexInput)0; i.normal = a0; i.position = a1; ";

void rootVertices(Cases& cases) {
    const Arguments arguments = {unit(), linear(-40, 40, 3), whole(0, 31)};
    const Tolerance plain{16, 4, 2e-5, "sums of up to 90"};
    const auto placeOf = [](In x) { // of the roots' mesh, whose ball is the other's
        return dvec3(5, -6, 7) + furTurnedBack(furWorld(x.vec3(1)) - kFurCentre) * (kRootsBall / kFurMesh);
    };
    const auto add = [&](const char* returned, Reference expected) {
        cases +=
            sweepCase({"rootsVarying", std::string(kVertexBody) + "StrandsVarying v = rootsVarying(i, a2, -1.0); return " + returned + ";"},
                      arguments, plain, std::move(expected));
        cases.back().map = &rootsMap();
        cases.back().domain = [](In x) { return isUnit(x.vec3(0)); };
    };
    add("v.lean", [=](In x) {
        const dvec4 coat = coatOfRoots(placeOf(x));
        const dvec3 flat = dvec3(coat) - x.vec3(0) * dot(dvec3(coat), x.vec3(0));
        return dvec4(flat + kFurLean * furTurnedBack(kFurDown), coat.w);
    });
    add("float4(v.rest.xyz, v.coat.z)", [=](In x) { return dvec4(placeOf(x) / kRootsSpacing, 0.6); });
    add("float4(strandsData(v), v.rest.w)",
        [=](In x) { return values(1 / kRootsSpacing, kFurRootRadius / 0.4, -1 / (kFurLength * kRootsBall), 31.5 - round(x[2])); });
    cases += sweepCase({"RootsEndVS", std::string(kVertexBody) + "StrandsVarying v = RootsEndVS(i); "
                                                                 "return float4(v.rest.w, v.normal.w, strandsRound(v) > 0.0, a2);"},
                       arguments, plain, [](In x) { return values(0.5, 1, 1, x[2]); });
    cases.back().map = &rootsMap();
}

/// A ray through a flat layer of upright strands, straight but for the least bow. Arguments: place, way of the ray (along the skin, and
/// down), height.
struct FlatSweep {
    static constexpr double kBow = 1e-3;
    static constexpr double kThick = 8; // of the coat, spacings
    dvec3 place, travel;
    double height, end, step, steps;

    explicit FlatSweep(In x) : place(x.vec3(0)), height(x[2]) {
        const dvec3 view = normalize(dvec3(x.vec2(1), -1));
        const double grazing = view.z * view.z / (view.z * view.z + 1e-4);
        travel = kThick * grazing * dvec3(view.x, view.y, 0) / -view.z;
        const double depth = min(height, 0.25); // of eight layers, for so many are one here
        end = (1 - sqrt(1 - 2 * kBow * depth)) / kBow;
        const double way = length(travel) * end;
        step = end / max(way, 1.0);
        steps = min(way, 7.0) + 1;
    }
    /// The piece that ends after so many steps.
    [[nodiscard]] MetPiece piece(double i) const {
        const auto dropAt = [&](double n) { return min(n * step, end); };
        const auto heightAt = [&](double drop) { return height - (drop - kBow * drop * drop / 2); };
        MetPiece piece;
        piece.normal = {0, 0, 1};
        piece.begin = place + travel * dropAt(i - 1);
        piece.along = travel * (dropAt(i) - dropAt(i - 1));
        piece.top = heightAt(dropAt(i - 1));
        piece.low = heightAt(dropAt(i));
        return piece;
    }
    [[nodiscard]] static double reach(const MetPiece& piece) { return kFurRootRadius * (1 - piece.low) + 0.3 + length(piece.along) / 2; }

    /// By what `met` says of a piece: its own way to be nothing yet, then what is met. Coverage, or how near anything is to a leap.
    template <class Met>
    [[nodiscard]] double coverage(double& edge, Met met) const {
        double free = 1;
        edge = min(edge, abs(steps - round(steps)) < 1e-4 ? 0.0 : 1.0);
        for (double i = 1; i <= steps && free > 0.01; ++i) {
            free *= 1 - met(piece(i), edge).x;
            edge = min(edge, abs(free - 0.01));
        }
        edge = min(edge, abs(1 - free - 0.004));
        return 1 - free;
    }
};

/// The texture of roots with cells of 2 mm, of which those beyond 2 mm along x have no list.
const TestMap& narrowRoots() {
    static const TestMap kMap = [] {
        TestMap map = rootsMap();
        map.texels[0] = {-4, -4, -4, 2};
        const auto list = static_cast<float>(kListAt);
        for (std::size_t cells = 0; cells < 16; ++cells)
            map.texels[kBrickAt + cells] = {0, list, list, 0};
        return map;
    }();
    return kMap;
}

double coverageOf(const FlatSweep& sweep, bool roots, double& edge) {
    return sweep.coverage(edge, [&](const MetPiece& piece, double& near) {
        if (!roots) return metCells(piece, FlatSweep::reach(piece), near);
        const double mm = (piece.begin.x + piece.along.x / 2) * kRootsSpacing;
        near = min(near, abs(abs(mm) - 2));
        return abs(mm) < 2 ? metRoots(piece, FlatSweep::reach(piece), near) : dvec4(0);
    });
}

/// Pixels whose strands neither bend nor are expected beyond the sweep.
void pixels(Cases& cases) {
    for (const bool roots : {false, true}) {
        const std::string entry = roots ? "RootsPS" : "CellularPS";
        const double far = roots ? 1.5 : 20;
        cases += sweepCase(
            {entry.c_str(),
             "float2 q = fmod(pixel, 2.0); float3 slope = float3(0.05 * q, 0); StrandsVarying v = (StrandsVarying)0; v.position.xy = 3.5; "
             "v.rest = float4(a0, 8.5); v.normal = float4(0, 0, 1, a2); v.fromEye = float4(150.0 * float3(a1, -1), 0.3); "
             "v.toLight = float4(0, 0, 200, 3.5); v.lightClip = float4(2, 0, 0.5, 1); v.coat = float4(1e-4, 8, 0.5, 1); "
             "v.plainRest = float4(slope, 0.4); v.plainNormal.w = 0.75; v.plainFromEye = float4(slope, -0.2); return float4(" +
                 entry + "(v).w, 0, 0, 0);"},
            {linear(-far, far, 3), linear(-1.5, 1.5, 2), linear(0.2, roots ? 0.7 : 1)},
            {16, 0, 1e-2, "roots of differences, of many strands"}, [=](In x) {
                double edge = 1;
                const double covered = coverageOf(FlatSweep(x), roots, edge);
                return covered < 0.004 ? kDiscarded : values(covered);
            });
        cases.back().perQuad = true;
        cases.back().discards = true;
        cases.back().map = roots ? &narrowRoots() : cases.back().map;
        cases.back().domain = [=](In x) {
            double edge = 1;
            coverageOf(FlatSweep(x), roots, edge);
            return edge > 3e-4;
        };
        setAll(cases.back(), {"gFurScatter", "gFurCurls", "gFurTufts"}, {0});
        cases.back().globals["gFurTuftSize"] = {4};
        cases.back().globals["gFurTurns"] = {1};
    }
}

} // namespace

Cases furSweepCases() {
    return together(meeting(), cells(0.3, linear(0.2, 1), linear(0.3, 0.9)), cells(2, linear(0.2, 0.4), linear(1.5, 2.5)), roots,
                    rootVertices, pixels);
}

} // namespace tegument::test
