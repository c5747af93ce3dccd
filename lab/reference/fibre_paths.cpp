#include "lab/reference/fibre_paths.h"

#include "host/support/parallel.h"
#include "meshprep/rays/curve_tree.h"
#include "meshprep/rays/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace tegument::reference {

namespace {

using std::numbers::pi;
constexpr int kBeforeRoulette = 16;  // bounces
constexpr int kMostBounces = 4096;   // of a path that roulette has spared
constexpr double kOffFibre = 1e-2;   // how far from the surface rays start, radii of the fibre
constexpr double kOffSkin = 1e-4;    // mm
constexpr double kLongestChord = 30; // radii, of light that runs within a fibre along it

/// Numbers in [0, 1) of a path: SplitMix64 (G. Steele et al. 2014) from a start that mixes its number.
class PathRandom {
public:
    explicit PathRandom(std::uint64_t path) : state_(path * 0xD1342543DE82EF95ULL + 1) { next(); }
    double next() {
        state_ += 0x9E3779B97F4A7C15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

/// Any frame about an axis, unit.
struct Frame3 {
    glm::dvec3 x, y, z;
    explicit Frame3(const glm::dvec3& axis)
        : x(axis), y(glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)))),
          z(glm::cross(x, y)) {}
    [[nodiscard]] glm::dvec3 inside(const glm::dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
    [[nodiscard]] glm::dvec3 outside(const glm::dvec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Pieces between neighbouring joints: collinear, evenly spaced control points make a cubic the straight piece itself.
struct Controls {
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> starts;

    explicit Controls(const std::vector<FibreAxis>& strands) {
        for (const FibreAxis& axis : strands)
            for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
                const glm::vec4 step = axis[i + 1] - axis[i];
                starts.push_back(static_cast<std::uint32_t>(points.size()));
                for (glm::vec4 point : {axis[i] - step, axis[i], axis[i + 1], axis[i + 1] + step}) {
                    constexpr float kThinnest = 1e-5F;
                    point.w = std::max(point.w, kThinnest);
                    points.push_back(point);
                }
            }
    }
};

/// A ray, and how far along it no fibre is met: within the one that it leaves. Skin may be nearer.
struct PathRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
    double within = 0;
};

/// Where a path is.
struct Vertex {
    glm::dvec3 place{0};
    glm::dvec3 normal{0};
    std::optional<CurveHit> fibre; // none: skin
};

/// I0(x) / e^x to 2e-7: M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 9.8.1 and 9.8.2.
double scaledBessel(double x) {
    constexpr double kSplit = 3.75;
    if (x < kSplit) {
        const double t = x * x / (kSplit * kSplit);
        const double sum = 1 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813)))));
        return sum * std::exp(-x);
    }
    const double t = kSplit / x;
    const double low = 0.39894228 + t * (0.01328592 + t * (0.00225319 + t * (-0.00157565 + t * 0.00916281)));
    const double high = -0.02057706 + t * (0.02635537 + t * (-0.01647633 + t * 0.00392377));
    return (low + std::pow(t, 5) * high) / std::sqrt(x);
}

double longitudinal(double sineLight, double cosineLight, double sineEye, double cosineEye, double v) {
    const double x = cosineLight * cosineEye / v;
    return std::exp((cosineLight * cosineEye - sineLight * sineEye - 1) / v) * scaledBessel(x) / (v * (1 - std::exp(-2 / v)));
}

double fresnel(double cosine, double eta) {
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
    const double s = (cosine - eta * inside) / (cosine + eta * inside);
    const double p = (eta * cosine - inside) / (eta * cosine + inside);
    return (s * s + p * p) / 2;
}

double logisticShare(double x, double scale) {
    return 1 / (1 + std::exp(-x / scale));
}

double fromMinusPi(double angle) {
    return angle - 2 * pi * std::floor(angle / (2 * pi) + 0.5);
}

double powerOf(double x, int exponent) {
    return std::pow(x, exponent);
}

} // namespace

struct FibrePaths::State {
    FibreScene scene;
    glm::dvec3 absorption;
    CurveTree curves;
    std::unique_ptr<RayScene> skin;

    State(FibreScene given, Controls controls)
        : scene(std::move(given)), absorption(fibreAbsorption(scene.colour, scene.fibre.around)),
          curves(std::move(controls.points), controls.starts, 0), skin(scene.skin ? std::make_unique<RayScene>(*scene.skin) : nullptr) {}

    [[nodiscard]] std::optional<Vertex> meet(const PathRay& ray) const {
        const auto fibre = curves.nearest(glm::vec3(ray.origin), glm::vec3(ray.direction), {.first = static_cast<float>(ray.within)});
        const auto hit = skin ? skin->nearest(ray.origin, ray.direction) : std::nullopt;
        if (hit && (!fibre || hit->distance < static_cast<double>(fibre->distance))) {
            const glm::dvec3 normal = glm::normalize(interpolate(*scene.skin, hit->place).normal);
            return Vertex{ray.origin + hit->distance * ray.direction, glm::dot(normal, ray.direction) > 0 ? -normal : normal, std::nullopt};
        }
        if (!fibre) return std::nullopt;
        return Vertex{ray.origin + static_cast<double>(fibre->distance) * ray.direction, fibre->normal, fibre};
    }

    [[nodiscard]] bool open(const PathRay& ray, double distance) const {
        const RayRange range{.first = static_cast<float>(ray.within), .last = static_cast<float>(distance)};
        if (curves.meetsAny(glm::vec3(ray.origin), glm::vec3(ray.direction), range)) return false;
        const auto hit = skin ? skin->nearest(ray.origin, ray.direction) : std::nullopt;
        return !hit || hit->distance > distance;
    }

    /// A ray that leaves a fibre in this direction: from this side, or through it to the other one.
    static PathRay leave(const Vertex& at, const glm::dvec3& direction) {
        const CurveHit& fibre = *at.fibre;
        const double cosine = glm::dot(at.normal, direction);
        const glm::dvec3 origin = at.place + (kOffFibre * fibre.radius) * at.normal;
        if (cosine >= 0) return {origin, direction};
        const double along = glm::dot(direction, fibre.axis);
        const double chord = std::min(-2 * cosine / std::max(1 - along * along, 1e-6), kLongestChord) * fibre.radius;
        return {origin, direction, chord * (1 + 3 * kOffFibre)};
    }

    /// From a place to a light: where to, unit, and how far.
    struct ToLight {
        glm::dvec3 direction;
        double distance;
    };
    static ToLight towards(const FibreLight& light, const glm::dvec3& from, PathRandom& random) {
        if (light.kind == FibreLight::Kind::Parallel) return {light.place, std::numeric_limits<double>::infinity()};
        const glm::dvec3 way = light.place - from;
        const double distance = glm::length(way);
        if (light.kind == FibreLight::Kind::Point) return {way / distance, distance};
        // Evenly over the cone that the sphere fills.
        const double sine2 = std::min(light.radius * light.radius / (distance * distance), 1.0);
        const double cosine = 1 - random.next() * (1 - std::sqrt(1 - sine2));
        const double turn = 2 * pi * random.next();
        const double aside = std::sqrt(std::max(1 - cosine * cosine, 0.0));
        const glm::dvec3 direction = Frame3(way / distance).outside({cosine, aside * std::cos(turn), aside * std::sin(turn)});
        return {direction, std::max(distance - light.radius, 0.0)};
    }

    [[nodiscard]] glm::dvec3 radiance(PathRay ray, PathRandom random) const {
        glm::dvec3 sum(0);
        glm::dvec3 throughput(1);
        for (int bounce = 0; bounce < kMostBounces; ++bounce) {
            const auto at = meet(ray);
            if (!at) return scene.environment ? sum + throughput * scene.environment(ray.direction) : sum;
            const glm::dvec3 scattered = at->fibre ? fibre(*at, ray, throughput, random) : dull(*at, ray, throughput, random);
            sum += scattered;
            if (bounce < kBeforeRoulette) continue;
            const double goesOn = std::min(std::max({throughput.x, throughput.y, throughput.z}), 1.0);
            if (random.next() >= goesOn) return sum;
            throughput /= goesOn;
        }
        return sum;
    }

private:
    /// Both: light that comes straight here, times the throughput before; then the path goes on.
    glm::dvec3 fibre(const Vertex& at, PathRay& ray, glm::dvec3& throughput, PathRandom& random) const {
        const Frame3 frame(at.fibre->axis);
        const glm::dvec3 toEye = frame.inside(-ray.direction);
        const glm::dvec3 normal = frame.inside(at.normal);
        const double aside = std::hypot(toEye.y, toEye.z) * std::hypot(normal.y, normal.z);
        const double offset = (normal.y * toEye.z - normal.z * toEye.y) / std::max(aside, 1e-12);
        const FibreScattering scattering(scene.fibre, absorption, toEye, offset);
        glm::dvec3 sum(0);
        for (const FibreLight& light : scene.lights) {
            const ToLight to = towards(light, at.place, random);
            if (open(leave(at, to.direction), to.distance)) sum += pi * light.colour * scattering.evaluate(frame.inside(to.direction));
        }
        sum *= throughput;
        const double a = random.next(), b = random.next(), c = random.next(), d = random.next();
        const auto sampled = scattering.sample({a, b, c, d});
        throughput *= sampled.weight;
        ray = leave(at, frame.outside(sampled.toLight));
        return sum;
    }

    glm::dvec3 dull(const Vertex& at, PathRay& ray, glm::dvec3& throughput, PathRandom& random) const {
        const glm::dvec3 origin = at.place + kOffSkin * at.normal;
        throughput *= scene.skinColour;
        glm::dvec3 sum(0);
        for (const FibreLight& light : scene.lights) {
            const ToLight to = towards(light, at.place, random);
            const double cosine = glm::dot(at.normal, to.direction);
            if (cosine > 0 && open({origin, to.direction}, to.distance)) sum += cosine * light.colour;
        }
        sum *= throughput;
        const double square = random.next();
        const double turn = 2 * pi * random.next();
        const double aside = std::sqrt(square);
        ray = {origin, Frame3(at.normal).outside({std::sqrt(1 - square), aside * std::cos(turn), aside * std::sin(turn)})};
        return sum;
    }
};

FibrePaths::FibrePaths(FibreScene scene) {
    Controls controls(scene.strands);
    state_ = std::make_unique<State>(std::move(scene), std::move(controls));
}

FibrePaths::~FibrePaths() = default;

glm::dvec3 FibrePaths::radiance(const glm::dvec3& origin, const glm::dvec3& direction, std::uint64_t path) const {
    return state_->radiance({origin, direction}, PathRandom(path));
}

void FibrePaths::trace(const Pinhole& camera, std::uint64_t samples, FibreSums& sums) const {
    const std::size_t pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    if (sums.sum.size() != pixels) {
        sums = {.width = camera.width, .height = camera.height, .samples = 0};
        sums.sum.resize(pixels, glm::dvec3(0));
        sums.square.resize(pixels, glm::dvec3(0));
        sums.covered.resize(pixels, 0);
    }
    const auto columns = static_cast<std::size_t>(camera.width);
    forEachInParallel(static_cast<std::size_t>(camera.height), [&](std::size_t y) {
        for (std::size_t x = 0; x < columns; ++x)
            for (std::uint64_t sample = sums.samples; sample < samples; ++sample) {
                const std::size_t pixel = y * columns + x;
                PathRandom random(sample * pixels + pixel);
                const double u = 2 * (static_cast<double>(x) + random.next()) / camera.width - 1;
                const double v = 1 - 2 * (static_cast<double>(y) + random.next()) / camera.height;
                const glm::dvec3 aside = u * camera.tangentX * camera.right + v * camera.tangentY * camera.up;
                const glm::dvec3 origin = camera.parallel ? camera.eye + aside : camera.eye;
                const glm::dvec3 direction = camera.parallel ? camera.forward : glm::normalize(camera.forward + aside);
                const glm::dvec3 seen = state_->radiance({origin, direction}, random);
                sums.sum[pixel] += seen;
                sums.square[pixel] += seen * seen;
                sums.covered[pixel] += state_->meet({origin, direction}) ? 1 : 0;
            }
    });
    sums.samples = std::max(sums.samples, samples);
}

Image FibreSums::picture() const {
    Image image{.width = width, .height = height, .channels = 3};
    image.pixels.reserve(3 * sum.size());
    for (const glm::dvec3& each : sum)
        for (int c = 0; c < 3; ++c)
            image.pixels.push_back(static_cast<float>(each[c] / static_cast<double>(samples)));
    return image;
}

double FibreSums::noise(int block) const {
    const auto n = static_cast<double>(samples);
    const std::size_t columns = static_cast<std::size_t>(width / block), rows = static_cast<std::size_t>(height / block);
    std::vector<glm::dvec3> means(columns * rows, glm::dvec3(0));
    glm::dvec3 variance(0); // of all blocks' sums together
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const std::size_t x = i % static_cast<std::size_t>(width) / static_cast<std::size_t>(block);
        const std::size_t y = i / static_cast<std::size_t>(width) / static_cast<std::size_t>(block);
        if (x >= columns || y >= rows) continue;
        means[y * columns + x] += sum[i] / n;
        variance += (square[i] / n - (sum[i] / n) * (sum[i] / n)) / std::max(n - 1, 1.0);
    }
    double all = 0;
    for (const glm::dvec3& mean : means)
        all += glm::dot(mean, mean);
    return std::sqrt((variance.x + variance.y + variance.z) / std::max(all, 1e-300));
}

std::vector<double> numbersOf(const FibreSums& sums) {
    std::vector<double> numbers = {static_cast<double>(sums.width), static_cast<double>(sums.height), static_cast<double>(sums.samples)};
    for (std::size_t i = 0; i < sums.sum.size(); ++i)
        for (const double number :
             {sums.sum[i].x, sums.sum[i].y, sums.sum[i].z, sums.square[i].x, sums.square[i].y, sums.square[i].z, sums.covered[i]})
            numbers.push_back(number);
    return numbers;
}

FibreSums sumsOf(const std::vector<double>& numbers) {
    if (numbers.size() < 3) return {};
    FibreSums sums{
        .width = static_cast<int>(numbers[0]), .height = static_cast<int>(numbers[1]), .samples = static_cast<std::uint64_t>(numbers[2])};
    for (std::size_t i = 3; i + 7 <= numbers.size(); i += 7) {
        sums.sum.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
        sums.square.emplace_back(numbers[i + 3], numbers[i + 4], numbers[i + 5]);
        sums.covered.push_back(numbers[i + 6]);
    }
    return sums;
}

glm::dvec3 fibreAbsorption(const glm::dvec3& colour, double around) {
    const double by = 5.969 - 0.215 * around + 2.532 * powerOf(around, 2) - 10.73 * powerOf(around, 3) + 5.574 * powerOf(around, 4) +
                      0.245 * powerOf(around, 5);
    const glm::dvec3 root = glm::log(glm::clamp(colour, 1e-6, 1 - 1e-12)) / by;
    return root * root;
}

FibreScattering::FibreScattering(const Fibre& fibre, const glm::dvec3& absorption, const glm::dvec3& toEye, double offset)
    : spread_(std::sqrt(pi / 8) * (0.265 * fibre.around + 1.194 * powerOf(fibre.around, 2) + 5.372 * powerOf(fibre.around, 22))),
      eye_(std::atan2(toEye.z, toEye.y)) {
    const double sine = std::clamp(toEye.x, -1.0, 1.0);
    const double cosine = std::max(std::sqrt(1 - sine * sine), 1e-6);
    const double h = std::clamp(offset, -1.0, 1.0);
    const double bent = std::sqrt(fibre.eta * fibre.eta - sine * sine) / cosine;
    const double outside = std::asin(h);
    const double inside = std::asin(h / bent);
    const double path = 2 * std::cos(inside) / std::sqrt(1 - sine * sine / (fibre.eta * fibre.eta));
    const glm::dvec3 left = glm::exp(-absorption * path);
    const double f = fresnel(cosine * std::sqrt(1 - h * h), fibre.eta);

    lobes_[0].share = glm::dvec3(f);
    lobes_[1].share = (1 - f) * (1 - f) * left;
    lobes_[2].share = lobes_[1].share * left * f;
    lobes_[3].share = lobes_[2].share * left * f / glm::max(1.0 - left * f, 1e-12);
    const double v = powerOf(0.726 * fibre.along + 0.812 * powerOf(fibre.along, 2) + 3.7 * powerOf(fibre.along, 20), 2);
    const std::array<double, kLobes> variances = {v, v / 4, 4 * v, 4 * v};
    const std::array<double, kLobes> tilts = {-2, 1, 4, 0};
    double sum = 0;
    for (std::size_t p = 0; p < kLobes; ++p) {
        Lobe& lobe = lobes_[p];
        const double tilt = glm::radians(fibre.tilt) * tilts[p];
        lobe.sine = sine * std::cos(tilt) + cosine * std::sin(tilt);
        lobe.cosine = std::abs(cosine * std::cos(tilt) - sine * std::sin(tilt));
        lobe.variance = variances[p];
        lobe.azimuth = static_cast<double>(p) * (2 * inside + pi) - 2 * outside;
        lobe.chance = (lobe.share.x + lobe.share.y + lobe.share.z) / 3;
        sum += lobe.chance;
    }
    for (Lobe& lobe : lobes_)
        lobe.chance /= sum;
}

double FibreScattering::around(std::size_t lobe, double azimuth) const {
    if (lobe + 1 == kLobes) return 1 / (2 * pi);
    const double x = std::abs(fromMinusPi(azimuth - lobes_[lobe].azimuth));
    const double e = std::exp(-x / spread_);
    const double whole = logisticShare(pi, spread_) - logisticShare(-pi, spread_);
    return e / (spread_ * (1 + e) * (1 + e) * whole);
}

glm::dvec3 FibreScattering::evaluate(const glm::dvec3& toLight) const {
    const double sine = std::clamp(toLight.x, -1.0, 1.0);
    const double cosine = std::sqrt(1 - sine * sine);
    const double azimuth = std::atan2(toLight.z, toLight.y) - eye_;
    glm::dvec3 sum(0);
    for (std::size_t p = 0; p < kLobes; ++p) {
        const Lobe& lobe = lobes_[p];
        sum += lobe.share * (longitudinal(sine, cosine, lobe.sine, lobe.cosine, lobe.variance) * around(p, azimuth));
    }
    return sum;
}

double FibreScattering::density(const glm::dvec3& toLight) const {
    const double sine = std::clamp(toLight.x, -1.0, 1.0);
    const double cosine = std::sqrt(1 - sine * sine);
    const double azimuth = std::atan2(toLight.z, toLight.y) - eye_;
    double sum = 0;
    for (std::size_t p = 0; p < kLobes; ++p) {
        const Lobe& lobe = lobes_[p];
        sum += lobe.chance * longitudinal(sine, cosine, lobe.sine, lobe.cosine, lobe.variance) * around(p, azimuth);
    }
    return sum;
}

FibreScattering::Sampled FibreScattering::sample(const std::array<double, 4>& random) const {
    std::size_t p = 0;
    for (double left = random[0]; p + 1 < kLobes && left >= lobes_[p].chance; ++p)
        left -= lobes_[p].chance;
    const Lobe& lobe = lobes_[p];
    // d'Eon et al. 2013, An Energy-Conserving Hair Reflectance Model, sampling.
    const double up = 1 + lobe.variance * std::log(std::max(random[1], 1e-300) + (1 - random[1]) * std::exp(-2 / lobe.variance));
    const double aside = std::sqrt(std::max(1 - up * up, 0.0));
    const double sine = std::clamp(-up * lobe.sine + aside * std::cos(2 * pi * random[2]) * lobe.cosine, -1.0, 1.0);
    double azimuth = 2 * pi * random[3];
    if (p + 1 < kLobes) {
        const double low = logisticShare(-pi, spread_);
        const double share = std::clamp(low + random[3] * (logisticShare(pi, spread_) - low), 1e-300, 1 - 1e-16);
        azimuth = lobe.azimuth - spread_ * std::log(1 / share - 1);
    }
    const double cosine = std::sqrt(1 - sine * sine);
    Sampled sampled;
    sampled.toLight = {sine, cosine * std::cos(eye_ + azimuth), cosine * std::sin(eye_ + azimuth)};
    sampled.weight = evaluate(sampled.toLight) / std::max(density(sampled.toLight), 1e-300);
    return sampled;
}

} // namespace tegument::reference
