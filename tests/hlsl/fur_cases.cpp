// hlsl/fur against Kajiya and Kay (1989) and the formulas in the heads of its files.

#include "tests/hlsl/function_case.h"

#include <numbers>

namespace tegument::test {

namespace {

constexpr double kPi = std::numbers::pi;

double sineFrom(double cosine) {
    return sqrt(saturate(1 - cosine * cosine));
}

dvec3 normalised(const dvec3& v) {
    return v / max(length(v), 1e-10);
}

/// Normalised Kajiya-Kay lobe: sin(l) cos^p(mirror angle) / 2 sqrt((p + 2/3) / (2 pi)).
double specular(const dvec3& strand, const dvec3& toLight, const dvec3& toEye, double exponent) {
    const double l = dot(strand, toLight);
    const double e = dot(strand, toEye);
    const double cosine = saturate(sineFrom(l) * sineFrom(e) - l * e);
    return sineFrom(l) * pow(max(cosine, 1e-6), exponent) * 0.5 * sqrt((exponent + 2.0 / 3) / (2 * kPi));
}

/// Along a ray from a point in the coat of a ball of radius 1, by the ray's two crossings with the coat's outside.
double wayOut(double height, double cosine, double thickness) {
    const double coat = max(thickness, 1e-3);
    const dvec2 from(0, 1 + height * coat);
    const dvec2 direction(sineFrom(cosine), cosine);
    const double middle = -dot(from, direction); // of the two crossings
    const double half = sqrt(middle * middle + (1 + coat) * (1 + coat) - dot(from, from));
    return (middle + half) / coat;
}

double transmittance(double height, double cosine, double density, double thickness) {
    return exp(-density * wayOut(height, cosine, thickness) * sineFrom(cosine));
}

/// Piece by piece: still in the nearest coat, well behind it, or on the quarter of a thickness between.
double foreignCoat(double place, double front, double back, double own, double coat) {
    const double inside = (place - front) / coat - 1.25 * own - 0.25;
    const double through = (back - front) / coat;
    if (place <= back) return max(inside, 0.0);
    if (place >= back + coat / 4) return max(through, 0.0);
    return max(std::lerp(inside, through, 4 * (place - back) / coat), 0.0);
}

dvec3 combined(const dvec3& position, const dvec3& normal) {
    const dvec3 n = normalised(normal);
    const dvec3 sum = normalised(position) + n;
    return dot(sum, sum) > 1e-8 ? normalize(sum) : n;
}

dvec3 curled(const dvec3& v, double height, double radius) {
    const dvec3 axis = abs(v.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const dvec3 side = normalised(cross(v, axis));
    const double angle = 2 * kPi * height;
    return normalised(v + radius * height * (cos(angle) * side + sin(angle) * cross(v, side)));
}

/// Of unit vectors whose direction has not been lost to a special value.
void shells(Cases& cases) {
    cases.add("tgFurLayerHeight(a0, a1, a2)", {whole(0, 255), whole(0, 256), whole(0, 1)}, {4, 0, 0, "a quotient of whole numbers"},
              [](In x) {
                  const double n = max(x[1], 1.0);
                  return saturate((x[2] > 0.5 ? n - x[0] : x[0] + 1) / n);
              });
    cases.add("tgFurSpread(a0, a1)", {linear(0.001, 1), linear(0.25, 4)}, {120, 4, 1e-6, "exp2 of a product up to 40: 3 + 2|x| ULP"},
              [](In x) { return pow(x[0], x[1]); });
    cases.add("tgFurDistance(a0, a1, a2)", {linear(0, 0.5), logarithmic(1, 1e3), linear(0, 1)},
              {2, 0, 1e-35, "two products, of which a denormal one is flushed to 0"}, [](In x) { return x[0] * x[1] * x[2]; });
    cases.add("tgFurNearDepth(a0, a1)", {linear(-50, 100), linear(1, 1000)}, {180, 4, 1e-6, "exp: 3 + 2|x| ULP with |x| up to 80"},
              [](In x) {
                  const double margin = 0.01 * x[1];
                  return x[0] < margin ? margin * exp(max(x[0] / margin - 1, -80.0)) : x[0];
              });
    cases.back().domain = [](In x) { return x[1] >= 1; };
    cases.add("tgFurStrand(a0, a1, a2)", {unit(), vector(3, 0.01, 2), linear(0, 1)}, {2, 1, 0, "a product and a sum"},
              [](In x) { return x.vec3(0) + x[2] * x.vec3(1); });
    cases.add("tgFurTangent(a0, a1, a2)", {unit(), vector(3, 0.01, 2), linear(0, 1)},
              {8, 4, 1e-6, "normalised: an inverse square root; the sum may cancel"},
              [](In x) { return normalised(x.vec3(0) + 2 * x[2] * x.vec3(1)); });
    cases.back().domain = [](In x) { return length(x.vec3(0) + 2 * x[2] * x.vec3(1)) > 0.1; };
    cases.add("tgFurCoverage(a0, a1, a2, a3)", {linear(0, 1), linear(0, 1), linear(0, 1), linear(0, 0.5)},
              {8, 4, 1e-6, "a quotient by as little as 1e-4, interpolated"}, [](In x) {
                  const double alpha = x[0];
                  const double standing = saturate((alpha - x[1]) / max(x[3], 1e-4) + 0.5);
                  return std::lerp(alpha, min(standing, saturate(alpha * 1e4)), x[2]);
              });
    cases.add("tgFurLayerCoverage(a0, a1)", {linear(0, 1), whole(1, 512)},
              {8, 4, 2e-6, "1 less a power: 3 + 2|x| ULP, which cancels where little is covered"},
              [](In x) { return 1 - pow(1 - x[0], 32 / x[1]); });
    cases.back().domain = [](In x) { return x[1] >= 1 && x[0] <= 1 && (x[0] == 1 || x[0] < 0.999); };
}

/// docs/design/fur.md, "Seen from afar", as its formulas stand there.
double meanCoverage(double mean, double height, double above, double variance, double softness, double slope) {
    const double scale = sqrt(3 * variance) / kPi;
    const double tip = mean + softness * (0.5 - min(0.2 / sqrt(softness), 1.0));
    const auto taller = [&](double h) { return 1 / (1 + exp((h - tip) / scale)); };
    const double rate = 0.5 + hypot(0.5, slope / kPi);
    const double share = taller(height);
    const double entered = 1 - pow((1 - share) / (1 - taller(above)), rate);
    return pow(pow(entered, -3) + pow(share, -3), -1.0 / 3);
}

void afar(Cases& cases) {
    cases.add("tgFurHeightVariance(a0, a1, a2, a3)", {linear(0, 0.5), logarithmic(1e-4, 0.2), logarithmic(1e-4, 1), linear(0, 1)},
              {8, 4, 1e-35, "products and a quotient"}, [](In x) {
                  const double share = 1 / (1 + pow(x[1] / x[2], 2));
                  return min(pow(x[0], 2) * share, pow(x[3], 2));
              });
    cases.back().domain = [](In x) { return x[1] >= 1e-4 && x[2] >= 1e-4; };
    cases.add("tgFurHeightSlope(a0, a1)", {linear(0, 0.5), logarithmic(1e-4, 0.2)}, {4, 0, 1e-35, "a product and a quotient"},
              [](In x) { return 2.8 * x[0] / x[1]; });
    cases.back().domain = [](In x) { return x[1] >= 1e-4; };
    cases.add("tgFurWayOver(a0, a1, a2)", {unit(), unit(), vector(3, 0.1, 2)}, {64, 4, 1e-4, "a quotient by a cosine of 0.1 and more"},
              [](In x) {
                  // From a point of the layer to where the ray meets the one that is 1 lower, seen from the strand's point
                  // there.
                  const dvec3 normal = x.vec3(1);
                  const double far = dot(x.vec3(2), normal) / -dot(x.vec3(0), normal);
                  return length(far * x.vec3(0) + x.vec3(2));
              });
    cases.back().domain = [](In x) {
        return isUnit(x.vec3(0)) && isUnit(x.vec3(1)) && dot(x.vec3(0), x.vec3(1)) < -0.1 && length(x.vec3(2)) < 10;
    };
    cases.add("tgFurAfar(a0, a1)", {linear(0, 0.25), linear(0.01, 1)}, {8, 4, 5e-3, "1e-8 beside the square of a softness of 0.01"},
              [](In x) { return 1 / (1 + 0.03 * pow(x[1], 2) / x[0]); });
    cases.back().domain = [](In x) { return x[0] > 1e-6 && x[1] >= 0.01; };
    cases.add("tgFurMeanCoverage(a0, float2(a1, a1 + a2), a3, a4, a5)",
              {linear(0, 1), linear(0, 1), linear(0.01, 0.5), linear(0.01, 0.2), linear(0.01, 1), linear(0, 50)},
              {200, 4, 3e-3, "1e-4 is added to a scale of 0.055 and more; 1 less powers of what is near 1"},
              [](In x) { return meanCoverage(x[0], x[1], x[1] + x[2], x[3], x[4], x[5]); });
    cases.back().domain = [](In x) { return x[2] >= 0.01 && x[3] >= 0.01 && x[4] >= 0.01; };
}

void vectors(Cases& cases) {
    // near cancellation the sum's direction is the rounding's
    cases.add("tgFurCombinedVector(a0, a1)", {vector(3, 0.1, 1000), unit()},
              {8, 4, 2e-6, "three times normalised; nearly opposite vectors cancel"}, [](In x) { return combined(x.vec3(0), x.vec3(1)); });
    cases.back().domain = [](In x) { return length(normalised(x.vec3(0)) + normalised(x.vec3(1))) > 0.05; };
    cases.add("tgFurDirection(a0)", {vector(3, 0.1, 1000)}, {4, 2, 1e-6, "one normalisation"}, [](In x) {
        const dvec3 v = x.vec3(0);
        return v == dvec3(0) ? dvec3(0, 0, 1) : normalised(v);
    });
    cases.back().domain = [](In x) { return x.vec3(0) == dvec3(0) || length(x.vec3(0)) > 1e-3; };
    cases.add("tgFurCurled(a0, a1, a2)", {unit(), linear(0, 1), linear(0, 1)},
              {8, 4, 2e-6, "sine and cosine: 2^-11 absolute in Vulkan, measured far better"},
              [](In x) { return curled(x.vec3(0), x[1], x[2]); });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)) && abs(abs(x.scalar(0, 1)) - 0.9) > 1e-6; };
    cases.add("tgFurSphereCoordinate(a0)", {unit()}, {8, 4, 2e-6, "twice normalised"}, [](In x) {
        const dvec3 n = normalised(normalised(x.vec3(0)) + dvec3(0, 0, 1));
        return values(0.5 + 0.5 * n.x, 0.5 - 0.5 * n.y);
    });
    cases.back().domain = [](In x) { return isUnit(x.vec3(0)) && x.scalar(0, 2) > -0.99; }; // v = -z is the whole rim
}

void lights(Cases& cases) {
    cases.add("tgFurSine(a0)", {cosine()}, {8, 2, 0, "the root of 1 - c^2, whose rounding the argument's ULP stands for"},
              [](In x) { return sineFrom(x[0]); });
    cases.add("tgFurDiffuse(a0, a1, a2)", {unit(), unit(), linear(0, 1)},
              {8, 4, 4e-4, "along the strand the sine is the root of what rounding leaves of 1 - c^2"},
              [](In x) { return sineFrom(dot(x.vec3(0), x.vec3(1))) * std::lerp(1 / kPi, 1.0, x[2]); });
    cases.add("tgFurSpecular(a0, a1, a2, a3)", {unit(), unit(), unit(), linear(1, 200)},
              {400, 4, 1e-4, "a power of up to 200: 3 + 2|x| ULP with |x| up to 126, and 200 times those of its base"},
              [](In x) { return specular(x.vec3(0), x.vec3(1), x.vec3(2), x[3]); });
    cases.add("tgFurWay(a0, a1, a2)", {linear(0, 1), cosine(), linear(0, 0.5)},
              {64, 4, 2e-3, "a way of up to 2,000 coats; the root near the horizon, where its argument cancels"},
              [](In x) { return wayOut(x[0], x[1], x[2]); });
    cases.add(
        "tgFurForeignCoat(a0, a1, a1 + a2, a3, a4)", {linear(0, 200), linear(0, 100), linear(0, 50), linear(0, 10), logarithmic(0.5, 20)},
        {32, 4, 1e-3, "differences of places up to 200, over 0.5"}, [](In x) { return foreignCoat(x[0], x[1], x[1] + x[2], x[3], x[4]); });
    cases.back().domain = [](In x) { return x[4] >= 0.5; };
    cases.add("tgFurTransmittance(a0, a1, a2, a3)", {linear(0, 1), cosine(), linear(0, 20), linear(0, 0.5)},
              {180, 4, 2e-5,
               "exp: 3 + 2|x| ULP with |x| up to 87; a way of up to 2,000 coats, whose rounding is what is left of light after more than "
               "ten of them"},
              [](In x) { return transmittance(x[0], x[1], x[2], x[3]); });
    cases.add("tgFurFill(a0, a1, a2)", {linear(0, 1), linear(0, 20), linear(0, 1)}, {48, 4, 1e-7, "exp: 3 + 2|x| ULP with |x| up to 20"},
              [](In x) { return exp(-x[1] * (1 - x[0])) * (0.5 + 0.5 * x[2]); });
}

} // namespace

Cases furCases() {
    return together(shells, afar, vectors, lights);
}

} // namespace tegument::test
