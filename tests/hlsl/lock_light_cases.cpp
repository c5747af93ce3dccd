// Colour and light of a coat of locks, and what a vertex finds out about its strand (effects/passes/fur_locks.fxh), in double precision.

#include "tests/hlsl/function_case.h"
#include "tests/hlsl/fur_numbers.h"
#include "tests/hlsl/lock_scene.h"

namespace tegument::test {

namespace {

double share01(double x) {
    return saturate(x);
}

/// Arguments: along, below, under, variation; random, more, lock, waves, guard; shortness, colour.
dvec3 colour(In x) {
    const double along = x[0];
    const double under = x[2];
    const double guard = x[8];
    const double belly = 0.8 * share01(1.6 * (x[1] - 0.25) + 0.2 * x.scalar(7, 1));
    dvec3 tip = mix(kLockTip, 1.2 * kLockMid, 0.5 * share01(0.5 + 0.8 * x[7]));
    tip = mix(tip, kLockGuards, guard * (1 - belly));
    dvec3 albedo = mix(kLockRoot, mix(kLockMid, 0.75 * kLockPale, belly), share01(1.8 * along));
    albedo = mix(albedo, mix(tip, kLockPale, belly), share01(2.2 * along - 1));
    albedo = mix(albedo, mix(kLockUnder, 0.6 * kLockPale, belly), 0.7 * under);
    albedo = mix(albedo, x.vec3(10) * (0.35 + 0.65 * along), 0.3);
    albedo *= mix(dvec3(1), kLockShort, x[9]);
    const double vary = x[3];
    const double bright = (1 + vary * (x[5] - 0.5)) * (1 + vary * (x.scalar(6, 1) - 0.5));
    const double warm = 0.2 * vary * (x.scalar(4, 2) - 0.5); // takes blue, and half as much green
    return albedo * bright * dvec3(1, 1 + 0.5 * warm, 1 + warm);
}

FunctionCase colours() {
    FunctionCase made =
        lock({"lockAlbedo", "LockLooks l = (LockLooks)0; l.random = a4; l.more = a5; l.lock = a6; l.waves = a7; l.guard = a8; TgRibbon r; "
                            "r.along = 0; r.shortness = a9; r.color = a10; return float4(lockAlbedo(l, r, a0, a1, a2, a3), 0);"},
             {linear(0, 1), linear(-1, 1), whole(0, 1), linear(0, 1), linear(0, 1, 3), linear(0, 1, 3), linear(0, 1, 3), linear(-1, 1, 3),
              whole(0, 1), linear(0, 1), linear(0, 1, 3)},
             {16, 4, 1e-6, "nine mixtures of numbers up to 1.5"}, [](In x) { return colour(x); });
    return made;
}

constexpr const char* kPointBody = "LockPoint p; p.normal = a0; p.tangent = a1; p.toEye = a2; p.albedo = a3; p.along = a4.x; "
                                   "p.height = a4.y; p.shift = 0.12 * a4.z; ";

Arguments pointArguments() {
    return {unit(), unit(), unit(), linear(0, 1, 3), linear(0, 1, 3), unit()};
}

/// Of the angle between two directions that need not be unit.
double sineBetween(const dvec3& a, const dvec3& b) {
    return abs(sin(atan2(length(cross(a, b)), dot(a, b))));
}

double lobeOf(const dvec3& strand, const dvec3& halfway, double exponent) {
    return pow(max(sineBetween(strand, halfway), 1e-3), exponent);
}

dvec3 lockLit(In x, bool under) {
    const dvec3 light = x.vec3(5);
    const double wrap = share01((dot(x.vec3(0), light) + 0.4) / 1.4);
    const dvec3 diffuse = x.vec3(3) * sineBetween(x.vec3(1), light) * (0.2 + 0.8 * wrap);
    if (under) return diffuse;
    const double shift = 0.12 * x.scalar(4, 2);
    const dvec3 halfway = light + x.vec3(2);
    const double surface = lobeOf(x.vec3(1) + (-0.04 - shift) * x.vec3(0), halfway, 60);
    const double inside = lobeOf(x.vec3(1) + (0.26 - shift) * x.vec3(0), halfway, 14);
    const dvec3 shine = (0.07 * surface + 0.25 * inside * x.vec3(3)) * wrap * (0.25 + 0.75 * x[4]);
    return diffuse + shine + 0.5 * pow(share01(-dot(x.vec3(2), light)), 4) * x.vec3(3);
}

void lights(Cases& cases) {
    const dvec3 colour(0.9, 0.8, 0.7);
    cases += lock({"lockLight", std::string(kPointBody) + "return float4(lockLight(p, a5, float3(0.9, 0.8, 0.7), 0.6, 0.0), 0);"},
                  pointArguments(), {64, 8, 1e-5, "the 60th power of a sine, by its square"},
                  [=](In x) { return 0.6 * colour * lockLit(x, false); });
    cases.back().domain = [](In x) { return length(x.vec3(2) + x.vec3(5)) > 0.01; };
    // The sine is the root of a difference that is 1e-7 off: 3e-4 where light runs along the strand.
    cases.back().tolerance.absolute = 4e-4;
    cases += lock({"lockLight", std::string(kPointBody) + "return float4(lockLight(p, a5, float3(0.9, 0.8, 0.7), 0.6, 1.0), 0);"},
                  pointArguments(), {16, 8, 4e-4, "a sine is the root of a difference that is 1e-7 off"},
                  [=](In x) { return 0.6 * colour * lockLit(x, true); });
    cases += lock({"lockSurroundings", std::string(kPointBody) + "return float4(lockSurroundings(p, a5), 0);"}, pointArguments(),
                  {16, 4, 4e-7, "sums of up to 1.3"}, [](In x) {
                      const double up = dot(0.9 * x.vec3(0) + 0.36 * x.vec3(1), x.vec3(5));
                      const double gap = (0.2 + 0.8 * share01(1.1 * x.scalar(4, 1))) * (0.55 + 0.45 * share01(1.4 * x[4]));
                      return x.vec3(3) * mix(kLockGround, kLockSky, 0.5 + 0.5 * up) * gap * gap;
                  });
    cases += lock({"lockRim", std::string(kPointBody) + "return float4(lockRim(p, a5), 0);"}, pointArguments(),
                  {16, 4, 1e-6, "the square of a difference of numbers up to 1"}, [](In x) {
                      const double edge = 1 - share01(dot(x.vec3(0), x.vec3(2)));
                      const double above = share01(0.6 + 0.4 * dot(x.vec3(0), x.vec3(5)));
                      return kLockRim * (0.05 + x.vec3(3)) * edge * edge * x[4] * above;
                  });
}

/// The texture of roots is one texel here: root, its length in mm, noise, and the header that says how many roots there are, all alike.
constexpr std::array<float, 4> kTexel = {0.5F, -3.0F, 2.0F, 0.07032865F};

/// A strand as the vertex shader makes it. Arguments: normal, flow, position, address and child, shortness and underfur.
struct Looks {
    dvec3 random, more, noise, waved, normal, aside, across;
    double under = 0;
    double guard = 0;
    double spacing = 0;
    double height = 0;
    double lie = 0;

    explicit Looks(In x) : normal(x.vec3(0)), under(x[6]) {
        random = lockNumbers(x[3], x[4]);
        const auto fraction = [](const dvec3& v) { return v - floor(v); };
        more = fraction(13.37 * dvec3(random.z, random.x, random.y) + 7.91 * dvec3(random.y, random.z, random.x));
        noise = fraction(static_cast<double>(kTexel[3]) * dvec3(1, 256, 65536));
        const dvec3 place = (x.vec3(2) - kLockCentre) / kLockMesh;
        const dvec3 first = waves(1.25 * dvec3(place.z, place.x, place.y));
        waved = waves(2.6 * dvec3(place.y, place.z, place.x) + 0.3 + 0.35 * first) +
                0.5 * waves(13.0 * dvec3(place.z, place.x, place.y) + 0.1 + 0.5 * first);
        guard = under < 0.5 && random.z <= 0.16 ? 1 : 0;
        aside = normalize(cross(normal, abs(normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
        across = cross(normal, aside);
        const double perMm = kLockMesh / 40;
        spacing = perMm / sqrt(static_cast<double>(kTexel[3]));
        const double thickness = kLockLength * kLockMesh;
        const double long_ = min(length(dvec3(kTexel[0], kTexel[1], kTexel[2])), kTexel[3] * perMm / thickness);
        height = thickness * max(long_, 0.05) * (1 - 0.55 * x[5]) *
                 (under > 0.5 ? 0.55 * (0.85 + 0.3 * more.x) : 0.75 + 0.3 * more.x + 0.35 * guard);
        lie = 1.25 * 1.1 * (0.7 + 0.15 * waved.z + 0.5 * noise.z) * (1 - 0.25 * under);
    }

    [[nodiscard]] dvec3 onSkin(const dvec3& v) const { return v - normal * dot(v, normal); }
    [[nodiscard]] dvec3 offset() const {
        const double away = sqrt(random.y) * 0.9 * spacing;
        return away * (wave(random.x) * aside + wave(random.x + 0.75) * across);
    }
    [[nodiscard]] dvec3 flow(const dvec3& given) const {
        const dvec3 along = onSkin(given + 0.45 * 0.5 * waved + 0.5 * (noise - 0.5));
        return along * lie / sqrt(1 + dot(along, along));
    }
    [[nodiscard]] dvec3 stray(const dvec3& position) const {
        const dvec3 place = (position - kLockCentre) / kLockMesh;
        const double phase = 0.8 * (place.x + place.y + place.z) + 0.25 * noise.x - 0.7 * 1.7;
        const dvec3 wind = dvec3(0.3, -0.2, 0.1) * (1 + 0.5 * wave(phase));
        return onSkin((more - 0.5) * 0.2 * (1 + under) + wind) * height;
    }
};

constexpr const char* kLooksBody =
    "TgVertexInput v = (TgVertexInput)0; v.normal = a0; v.tangent.xyz = a1; v.position = a2; v.uv.y = a3; TgRibbon r; r.along = 0.5; "
    "r.shortness = a5; r.color = 0.5; RibbonFrame f = (RibbonFrame)0; f.perMm = 2.0; LockLooks l = lockLooks(v, f, r, 0.0, 1.0, a4, a6); ";

void looks(Cases& cases) {
    static const TestMap kRoots{.size = 1, .texels = {kTexel}};
    const Arguments arguments = {unit(),       linear(-1, 1, 3), linear(-80, 80, 3), whole(4096, 4000000),
                                 whole(0, 31), linear(0, 1),     whole(0, 1)};
    const auto add = [&](const char* returned, auto expected) {
        cases += lock({"lockLooks", std::string(kLooksBody) + "return float4(" + returned + ");"}, arguments,
                      {32, 4, 2e-4, "fractions of numbers up to 21, waves of waves"}, [=](In x) { return expected(x, Looks(x)); });
        cases.back().map = &kRoots;
        cases.back().domain = [](In x) { // from where something leaps
            const Looks l(x);
            const auto leaps = [](double v) { return min(v, 1 - v) < 1e-4; };
            return !leaps(l.more.x) && !leaps(l.more.y) && !leaps(l.more.z) && abs(abs(l.normal.y) - 0.9) > 1e-4 &&
                   abs(length(l.normal) - 1) < 1e-3;
        };
    };
    add("l.more, l.guard", [](In, const Looks& l) { return values(dvec4(l.more, l.guard)); });
    add("l.random, 0", [](In, const Looks& l) { return values(l.random); });
    add("l.lock, l.strand.height", [](In, const Looks& l) { return values(dvec4(l.noise, l.height)); });
    add("l.waves, l.strand.sink", [](In, const Looks& l) { return values(dvec4(l.waved, 0.304 * min(l.lie, 1.75))); });
    add("l.strand.offset, l.strand.phase", [](In, const Looks& l) { return values(dvec4(l.offset(), l.random.x)); });
    add("l.strand.base, l.strand.turns",
        [](In, const Looks& l) { return values(dvec4(0.15 * l.spacing * l.normal, 1.2 * (0.7 + 0.6 * l.more.y))); });
    add("l.strand.flow, l.strand.clump", [](In x, const Looks& l) {
        const double clump = 0.72 * (0.5 + 0.5 * l.noise.x) * (1 - 0.5 * max(l.guard, l.under));
        return values(dvec4(l.flow(x.vec3(1)), clump));
    });
    add("l.strand.stray, 0", [](In x, const Looks& l) { return values(l.stray(x.vec3(2))); });
    add("l.strand.side, 0", [](In, const Looks& l) { return values(0.05 * l.height * (1 + l.under) * l.aside); });
    add("l.strand.across, 0", [](In, const Looks& l) { return values(0.05 * l.height * (1 + l.under) * l.across); });
}

} // namespace

Cases lockLightCases() {
    return together(lights, colours(), looks);
}

} // namespace tegument::test
