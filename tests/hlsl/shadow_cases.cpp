// hlsl/shadow against the definitions of docs/design/modules/TSM.md.

#include "tests/hlsl/maps.h"

namespace tegument::test {

namespace {

constexpr double kTexel = 1.0 / kTestMapSize;
constexpr double kUvSlack = 3e-7; // a coordinate near 1, rounded a few times

Argument mapUv() {
    return linear(0.02, 0.98, 2, kUvSlack);
}

constexpr double kNoSurface = 1e9; // what a cleared texel, 0, stands for

double stored(double depth) {
    return depth <= 0 ? kNoSurface + depth : depth;
}

double depthAt(dvec2 uv) {
    return stored(shadowMap().at(uv).x);
}

dvec3 normalOfLitSide(dvec2 uv, const dvec3& axisX, const dvec3& axisY, const dvec3& toLight, double footprint, double range,
                      bool corrected) {
    const double dx = depthAt(uv + dvec2(kTexel, 0)) - depthAt(uv - dvec2(kTexel, 0));
    const double dy = depthAt(uv - dvec2(0, kTexel)) - depthAt(uv + dvec2(0, kTexel)); // up is towards smaller v
    const auto across = [&](const dvec3& axis) {
        const dvec3 back = cross(axisX, axisY);
        return corrected ? axis - back * (dot(toLight, axis) / max(dot(toLight, back), 1e-3)) : axis;
    };
    const dvec3 n = 2 * footprint * toLight + range * (dx * across(axisX) + dy * across(axisY));
    return n / max(length(n), 1e-10);
}

struct Corner {
    int x, y;
    double fx, fy;

    explicit Corner(dvec2 uv) {
        const dvec2 place = uv * double{kTestMapSize} - 0.5;
        x = static_cast<int>(floor(place.x));
        y = static_cast<int>(floor(place.y));
        fx = place.x - x;
        fy = place.y - y;
    }
};

/// Interpolated where u, v and coverage of the four texels lie within 0.03, else the nearest.
dvec4 entry(dvec2 uv, const TestMap& map) {
    const Corner c(uv);
    dvec4 four[2][2];
    dvec4 low(1e30);
    dvec4 high(-1e30);
    dvec4 mean(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            four[j][i] = map.texel(c.x + i, c.y + j);
            low = min(low, four[j][i]);
            high = max(high, four[j][i]);
            mean += (i == 0 ? 1 - c.fx : c.fx) * (j == 0 ? 1 - c.fy : c.fy) * four[j][i];
        }
    const dvec4 spread = high - low;
    return max({spread.y, spread.z, spread.w}) < 0.03 ? mean : four[c.fy >= 0.5][c.fx >= 0.5];
}

/// Mean over 3 x 3 texels of bilinear comparisons; every texel is compared with the receiver's plane at its own place.
double filtered(dvec2 uv, double depth, dvec2 slope) {
    const Corner c(uv);
    const auto lit = [&](int dx, int dy) {
        const double plane = depth + slope.x * (dx - c.fx) + slope.y * (dy - c.fy);
        const int x = c.x + dx;
        const int y = c.y + dy;
        if (x < 0 || y < 0 || x >= kTestMapSize || y >= kTestMapSize) return 1.0;
        return plane <= stored(shadowMap().texel(c.x + dx, c.y + dy).x) ? 1.0 : 0.0;
    };
    double sum = 0;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            sum += (1 - c.fx) * (1 - c.fy) * lit(i, j) + c.fx * (1 - c.fy) * lit(i + 1, j) + (1 - c.fx) * c.fy * lit(i, j + 1) +
                   c.fx * c.fy * lit(i + 1, j + 1);
    return sum / 9;
}

/// Pieces of a surface side by side: of eight columns each, and rows, one is another by u, by v, or by what it covers.
const TestMap& piecesMap() {
    static const TestMap kMap = [] {
        TestMap map{.size = kTestMapSize};
        for (int y = 0; y < kTestMapSize; ++y)
            for (int x = 0; x < kTestMapSize; ++x)
                map.texels.push_back({600 + 0.25F * static_cast<float>(x % 16), x / 8 % 3 == 0 ? 0.2F : 0.3F, x / 8 % 3 == 1 ? 0.4F : 0.5F,
                                      y / 8 % 2 == 0 ? 1.0F : 0.5F});
        return map;
    }();
    return kMap;
}

void arithmetic(Cases& cases) {
    cases.add("tgShadowCoordinate(a0)", {vector(4, 1, 1000)}, {4, 4, 1e-7, "a quotient of 2.5 ULP and a sum with 0.5"}, [](In x) {
        const dvec4 clip = x.vec4(0);
        return values(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
    });
    cases.back().domain = [](In x) { return x.scalar(0, 3) > 1e-3; };
    cases.add("tgShadowDepth(a0, a1)", {vector(4, 1, 1000), vector(3, 1e-3, 1e4)},
              {6, 1, 1e-19, "length or a quotient; squares of 1e-19 mm are denormal"}, {.settings = {0, 2}}, [](In x) {
                  if (x.scalar(0, 2) <= 0) return 0.0;
                  return x.seed() ? x.scalar(0, 2) / x.scalar(0, 3) : length(x.vec3(1));
              });
    cases.back().domain = [](In x) { return x.scalar(0, 3) > 1e-3; };
    cases.add("tgShadowFootprint(a0, a1)", {logarithmic(1, 1e4), logarithmic(1e-3, 1e3)},
              {4, 1, 1e-37, "three products; denormal ones may be 0"}, [](In x) { return 2 * x[0] * x[1] * kTexel; });
    cases.add("tgShadowSlope(a0, a1, a2, a3, a4)", {unit(), unit(), unit(), unit(), linear(0.01, 10)},
              {8, 4, 2e-5, "dot products of up to 70 that may cancel"}, {.settings = {0, 2}}, [](In x) {
                  const dvec3 n = x.vec3(0);
                  const double cosine = dot(n, x.vec3(3));
                  if (!x.corrected() || cosine <= 0) return values(0);
                  const dvec3 across = x[4] * (n / max(cosine, 0.15) - x.vec3(3));
                  return values(dot(across, x.vec3(1)), -dot(across, x.vec3(2)));
              });
    // exact: two rays a texel apart, and where they meet the plane through the first one's end
    cases.add("tgShadowSlope(a0, float3(1, 0, 0), float3(0, 1, 0), normalize(float3(a1, 1)), 1e-3 * a2)",
              {unit(), linear(-1.5, 1.5, 2), linear(100, 700)}, {16, 4, 1e-5, "the difference of places 2e-4 texels apart"}, [](In x) {
                  const dvec3 ray = -dvec3(x.vec2(1), 1); // the light looks along -z; w = a2, a texel is 1e-3 of it
                  const dvec3 place = x[2] * ray;
                  const auto distance = [&](const dvec2& texels) {
                      const dvec3 next = ray + 1e-3 * dvec3(texels.x, -texels.y, 0);
                      return length(next) * dot(x.vec3(0), place) / dot(x.vec3(0), next);
                  };
                  const double step = 1e-4;
                  return values((distance({step, 0}) - distance({-step, 0})) / (2 * step),
                                (distance({0, step}) - distance({0, -step})) / (2 * step));
              });
    cases.back().domain = [](In x) { return dot(x.vec3(0), normalize(dvec3(x.vec2(1), 1))) > 0.2; };
    cases.add("tgShadowStored(a0)", {linear(-1, 1000, 4)}, {1, 0, 0, "one sum"},
              [](In x) { return values(stored(x[0]), stored(x.scalar(0, 1)), stored(x.scalar(0, 2)), stored(x.scalar(0, 3))); });
    cases.add("tgShadowHorizon(a0)", {cosine()}, {4, 0, 0, "a product with a rounded constant"}, {.settings = {0, 2}},
              [](In x) { return x.corrected() ? saturate(x[0] / 0.05) : 1; });
    cases.add("tgShadowBeyond(a0)", {linear(-2, 3, 2)}, {4, 2, 1e-12, "squares and a sum"}, [](In x) {
        const dvec2 beyond = x.vec2(0) - clamp(x.vec2(0), 0.0, 1.0);
        return dot(beyond, beyond);
    });
    cases.add("tgShadowOnMap(a0)", {whole(-9, kTestMapSize + 5)}, {0, 0, 0, "comparisons of whole numbers"}, [](In x) {
        const auto on = [&](int i) { return x[0] + i >= 0 && x[0] + i < kTestMapSize ? 1.0 : 0.0; };
        return values(on(0), on(1), on(2), on(3));
    });
    cases.add("tgTsmAcross(a0, a1, a2)", {unit(), unit(), unit()}, {8, 4, 1e-5, "a quotient of dot products, at most 10"},
              {.settings = {0, 2}}, [](In x) {
                  if (!x.corrected()) return x.vec3(0);
                  return x.vec3(0) - x.vec3(1) * (dot(x.vec3(2), x.vec3(0)) / dot(x.vec3(2), x.vec3(1)));
              });
    cases.back().domain = [](In x) { return dot(x.vec3(2), x.vec3(1)) > 0.1; };
}

void lookups(Cases& cases) {
    cases.add("tgTsmNormal(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, a3, a4, a5)",
              {mapUv(), unit(), unit(), unit(), linear(0.01, 2), linear(0.5, 2)},
              {8, 4, 2e-6, "sums of three vectors that may cancel, normalised"}, {.settings = {0, 2}, .map = &shadowMap()},
              [](In x) { return normalOfLitSide(x.vec2(0), x.vec3(1), x.vec3(2), x.vec3(3), x[4], x[5], x.corrected()); });
    cases.back().domain = [](In x) { // the unnormalised sum must not vanish: it does where axes are not axes
        for (std::size_t i : {1U, 2U, 3U})
            if (length(x.vec3(i)) < 0.5) return false;
        if (dot(x.vec3(3), cross(x.vec3(1), x.vec3(2))) < 0.1) return false;
        return length(normalOfLitSide(x.vec2(0), x.vec3(1), x.vec3(2), x.vec3(3), x[4], x[5], x.corrected())) > 0.5;
    };
    cases.add("tgTsmEntry(TG_SAMPLER2D_ARG(gTest), a0)", {mapUv()}, {8, 2, 2e-7, "three interpolations"}, {.map = &shadowMap()},
              [](In x) { return entry(x.vec2(0), shadowMap()); });
    cases.push_back(cases.back()); // neighbours that differ by u alone, by v, or by their coverage
    cases.back().expected = [](In x) { return entry(x.vec2(0), piecesMap()); };
    cases.back().map = &piecesMap();
    cases.add("tgShadowLit(TG_SAMPLER2D_ARG(gTest), a0, a1)", {mapUv(), linear(590, 610)}, {0, 0, 0, "a comparison of given numbers"},
              {.map = &shadowMap()}, [](In x) { return x[1] <= depthAt(x.vec2(0)) ? 1 : 0; });
    for (const char* function : {"tgShadowLit", "tgShadowFiltered", "tgTsmEntry"}) { // beyond the map's border
        cases.add({function, std::string("return ") +
                                 (function == std::string("tgTsmEntry") ? "tgTsmEntry(TG_SAMPLER2D_ARG(gTest), a0)"
                                  : function == std::string("tgShadowLit")
                                      ? "float4(tgShadowLit(TG_SAMPLER2D_ARG(gTest), a0, 1000.0), 0, 0, 0)"
                                      : "float4(tgShadowFiltered(TG_SAMPLER2D_ARG(gTest), a0, 1000.0, float2(0, 0)), 0, 0, 0)") +
                                 ";"},
                  {linear(-3, 4, 2)}, {1, 0, 1e-6, "there is no map: lit, and no light entered"}, {.map = &shadowMap()},
                  [entry = function == std::string("tgTsmEntry")](In) { return entry ? 0 : 1; });
        cases.back().domain = [](In x) {
            const dvec2 beyond = abs(x.vec2(0) - 0.5) - 0.5;
            return max(beyond.x, beyond.y) > 2 * kTexel;
        };
    }
    // partly on the map
    cases.add("tgShadowFiltered(TG_SAMPLER2D_ARG(gTest), a0, 640.0, float2(0, 0))", {linear(-2 * kTexel, 2 * kTexel, 2, kUvSlack)},
              {16, 2, 1e-4, "weights from a fraction of a texel"}, {.map = &shadowMap()},
              [](In x) { return filtered(x.vec2(0), 640, dvec2(0)); });
    cases.add("tgShadowFiltered(TG_SAMPLER2D_ARG(gTest), a0, a1, a2)", {mapUv(), linear(590, 610), linear(-2, 2, 2, 1e-6)},
              {16, 2, 1e-6, "sixteen weights from a fraction of a texel that rounds at 3e-5"}, {.map = &shadowMap()},
              [](In x) { return filtered(x.vec2(0), x[1], x.vec2(2)); });
    cases.add("tgShadowTest(TG_SAMPLER2D_ARG(gTest), a0, a1, a2, a3)", {mapUv(), linear(590, 610), linear(0, 3), linear(-2, 2, 2, 1e-6)},
              {16, 2, 1e-6, "as tgShadowFiltered"}, {.settings = {0, 1, 2}, .map = &shadowMap()}, [](In x) {
                  const double depth = x[1] - x[2];
                  if (!x.corrected()) return depth <= depthAt(x.vec2(0)) ? 1.0 : 0.0;
                  const dvec2 slope = x.vec2(3);
                  return filtered(x.vec2(0), depth - abs(slope.x) - abs(slope.y), slope);
              });
}

} // namespace

Cases shadowCases() {
    return together(arithmetic, lookups);
}

} // namespace tegument::test
