#include "meshprep/light/environment.h"

#include "host/support/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace tegument {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSourceSide = 64;
constexpr int kBlockSide = 8; // of cells whose cone is asked first
constexpr int kBlocksAcross = kSourceSide / kBlockSide;
constexpr float kRounding = 1e-5F;        // of cosines in single precision
constexpr float kLargestRadiance = 64512; // hlsl/settings.fxh: kTgLargestHalf
constexpr double kFresnel0 = 0.04;        // hlsl/constants.fxh: kTgFresnel0
/// Samples of the panorama across, at least: some for each texel of the cube map.
constexpr int kSamplesAcross = 4096;
constexpr double kLobeEnd = 9; // exp(-kLobeEnd) of a lobe's height is nothing

/// Direct3D's faces, s and t from -1 to 1, t down. Not of unit length.
glm::dvec3 facePoint(int face, double s, double t) {
    switch (face) {
    case 0: return {1, -t, -s};
    case 1: return {-1, -t, s};
    case 2: return {s, 1, t};
    case 3: return {s, -1, -t};
    case 4: return {s, -t, 1};
    default: return {-s, -t, -1};
    }
}

struct FacePlace {
    int face = 0;
    double s = 0;
    double t = 0;
};

FacePlace facePlace(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x > 0 ? FacePlace{0, -d.z / a.x, -d.y / a.x} : FacePlace{1, d.z / a.x, -d.y / a.x};
    if (a.y >= a.z) return d.y > 0 ? FacePlace{2, d.x / a.y, d.z / a.y} : FacePlace{3, d.x / a.y, -d.z / a.y};
    return d.z > 0 ? FacePlace{4, d.x / a.z, -d.y / a.z} : FacePlace{5, -d.x / a.z, -d.y / a.z};
}

std::size_t cellOf(int face, int x, int y, int side) {
    return (static_cast<std::size_t>(face) * static_cast<std::size_t>(side) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x);
}

double fresnel(double cosine) {
    return kFresnel0 + (1 - kFresnel0) * std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5);
}

/// Kelemen and Szirmay-Kalos's lobe, N.L included, with the eye on the normal; `cosine`: between the normal and the light.
double lobe(double cosine, double roughness) {
    const double half2 = 0.5 * (1 + cosine); // squared cosine of the half vector
    const double m2 = roughness * roughness;
    const double half = std::sqrt(half2);
    return std::max(cosine, 0.0) * std::exp((half2 - 1) / (half2 * m2)) / (m2 * half2 * half2) * fresnel(half) / (4 * half2);
}

} // namespace

/// The lobe between its end and its middle, read a thousand million times: straight lines between so many points.
class LobeTable {
public:
    explicit LobeTable(double roughness) {
        const double tan2 = kLobeEnd * roughness * roughness;
        least_ = std::max((1 - tan2) / (1 + tan2), 0.0);
        for (int i = 0; i <= kSteps + 1; ++i)
            values_.push_back(lobe(least_ + (1 - least_) * i / kSteps, roughness));
    }
    /// Least cosine between normal and light that the lobe sees.
    [[nodiscard]] double least() const { return least_; }
    [[nodiscard]] double operator()(double cosine) const {
        const double at = std::clamp((cosine - least_) / (1 - least_), 0.0, 1.0) * kSteps;
        const auto i = static_cast<std::size_t>(at);
        const double share = at - static_cast<double>(i);
        return values_[i] * (1 - share) + values_[i + 1] * share;
    }

private:
    static constexpr int kSteps = 4096;
    double least_ = 0;
    std::vector<double> values_;
};

namespace {

/// Every sample of the panorama: visit(direction, solid angle, radiance).
template <class Visit>
void eachSample(const Image& panorama, Visit visit) {
    const int finer = std::max(1, (kSamplesAcross + panorama.width - 1) / panorama.width);
    const int rows = panorama.height * finer;
    const int columns = panorama.width * finer;
    for (int y = 0; y < rows; ++y) {
        const double angle = 2 * kPi / columns * (std::cos(kPi * y / rows) - std::cos(kPi * (y + 1) / rows));
        for (int x = 0; x < columns; ++x) {
            glm::dvec3 radiance(0);
            for (int c = 0; c < 3; ++c) {
                const auto value = static_cast<double>(panorama.at(x / finer, y / finer, c));
                radiance[c] = std::isfinite(value) ? std::max(value, 0.0) : 0;
            }
            visit(panoramaDirection((x + 0.5) / columns, (y + 0.5) / rows), angle, radiance);
        }
    }
}

/// Texels of different faces that lie in one direction become one: sums of their light and of their solid angle.
class SharpLevel {
public:
    explicit SharpLevel(int side) : side_(side), group_(cellOf(6, 0, 0, side)) {
        std::map<std::tuple<long, long, long>, std::size_t> known;
        const auto key = [](double v) { return std::lround(v * 1e6); };
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    std::size_t& group = group_[cellOf(face, x, y, side)];
                    group = light_.size();
                    if (x == 0 || y == 0 || x == side - 1 || y == side - 1) {
                        const glm::dvec3 d = environmentDirection(face, x, y, side);
                        group = known.try_emplace({key(d.x), key(d.y), key(d.z)}, light_.size()).first->second;
                    }
                    if (group == light_.size()) light_.emplace_back(0);
                }
    }
    void add(const glm::dvec3& direction, double angle, const glm::dvec3& radiance) {
        const FacePlace at = facePlace(direction);
        const auto texel = [&](double v) { return static_cast<int>(std::lround((v + 1) / 2 * (side_ - 1))); };
        light_[group_[cellOf(at.face, texel(at.s), texel(at.t), side_)]] += glm::dvec4(radiance * angle, angle);
    }
    [[nodiscard]] glm::dvec3 at(int face, int x, int y) const {
        const glm::dvec4& sum = light_[group_[cellOf(face, x, y, side_)]];
        return sum.w > 0 ? glm::dvec3(sum) / sum.w : glm::dvec3(0);
    }

private:
    int side_;
    std::vector<std::size_t> group_; // of each texel
    std::vector<glm::dvec4> light_;  // of each group; w: solid angle
};

template <class Value>
std::array<Image, 6> drawLevel(int side, Value value) {
    std::array<Image, 6> faces;
    for (Image& face : faces)
        face = {.width = side, .height = side, .channels = 4, .pixels = std::vector<float>(cellOf(1, 0, 0, side) * 4, 1.0F)};
    forEachInParallel(static_cast<std::size_t>(6 * side), [&](std::size_t row) {
        const int face = static_cast<int>(row) / side;
        const int y = static_cast<int>(row) % side;
        for (int x = 0; x < side; ++x) {
            const glm::dvec3 light = value(face, x, y);
            for (int c = 0; c < 3; ++c)
                faces.at(static_cast<std::size_t>(face)).at(x, y, c) = std::min(static_cast<float>(light[c]), kLargestRadiance);
        }
    });
    return faces;
}

/// Real spherical harmonics of orders 0 to 2 at a unit vector.
std::array<double, 9> harmonicsAt(const glm::dvec3& d) {
    return {0.282095,
            0.488603 * d.y,
            0.488603 * d.z,
            0.488603 * d.x,
            1.092548 * d.x * d.y,
            1.092548 * d.y * d.z,
            0.315392 * (3 * d.z * d.z - 1),
            1.092548 * d.x * d.z,
            0.546274 * (d.x * d.x - d.y * d.y)};
}

} // namespace

glm::dvec3 panoramaDirection(double u, double v) {
    const double around = 2 * kPi * (u - 0.5);
    const double down = kPi * v;
    return {std::sin(around) * std::sin(down), std::cos(down), -std::cos(around) * std::sin(down)};
}

EnvironmentLight::EnvironmentLight(const Image& panorama) {
    struct Cell {
        glm::dvec3 towards{0};
        glm::dvec3 light{0};
        double weight = 0;
        double angle = 0;
    };
    std::vector<Cell> cells(cellOf(6, 0, 0, kSourceSide));
    eachSample(panorama, [&](const glm::dvec3& direction, double angle, const glm::dvec3& radiance) {
        const FacePlace at = facePlace(direction);
        const auto texel = [](double v) { return std::clamp(static_cast<int>((v + 1) / 2 * kSourceSide), 0, kSourceSide - 1); };
        Cell& cell = cells[cellOf(at.face, texel(at.s), texel(at.t), kSourceSide)];
        // A cell without light still has its place in lobes.
        const double weight = angle * (radiance.x + radiance.y + radiance.z + 1e-30);
        cell.towards += direction * weight;
        cell.weight += weight;
        cell.light += radiance * angle;
        cell.angle += angle;
    });
    for (int face = 0; face < 6; ++face)
        for (int block = 0; block < kBlocksAcross * kBlocksAcross; ++block) {
            const std::size_t first = sources_.size();
            for (int i = 0; i < kBlockSide * kBlockSide; ++i) {
                const int x = block % kBlocksAcross * kBlockSide + i % kBlockSide;
                const int y = block / kBlocksAcross * kBlockSide + i / kBlockSide;
                const Cell& cell = cells[cellOf(face, x, y, kSourceSide)];
                if (cell.angle > 0)
                    sources_.push_back({glm::vec3(glm::normalize(cell.towards)), static_cast<float>(cell.angle), cell.light});
            }
            if (sources_.size() > first) addBlock(first);
        }
}

void EnvironmentLight::addBlock(std::size_t first) {
    Block block{.axis = glm::vec3(0), .cosine = 1, .end = sources_.size()};
    for (std::size_t i = first; i < block.end; ++i)
        block.axis += sources_[i].direction;
    block.axis = glm::normalize(block.axis);
    for (std::size_t i = first; i < block.end; ++i)
        block.cosine = std::min(block.cosine, glm::dot(block.axis, sources_[i].direction));
    blocks_.push_back(block);
}

template <class Weight>
glm::dvec3 EnvironmentLight::sum(const glm::dvec3& axis, double least, Weight weight, double& total) const {
    const glm::vec3 towards(axis);
    const auto end = static_cast<float>(least);
    glm::dvec3 light(0);
    const float sine = std::sqrt(1 - end * end);
    std::size_t i = 0;
    for (const Block& block : blocks_) {
        // cos(a + b): beyond it the cones of lobe and block do not meet.
        const float apart = end * block.cosine - sine * std::sqrt(std::max(1 - block.cosine * block.cosine, 0.0F));
        if (glm::dot(towards, block.axis) < apart - kRounding) i = block.end;
        for (; i < block.end; ++i) {
            const Source& source = sources_[i];
            const float cosine = glm::dot(towards, source.direction);
            if (cosine <= end) continue;
            const double w = weight(static_cast<double>(cosine));
            light += w * source.light;
            total += w * static_cast<double>(source.solidAngle);
        }
    }
    return light;
}

glm::dvec3 EnvironmentLight::irradiance(const glm::dvec3& normal) const {
    double total = 0;
    return sum(
               normal, 0, [](double cosine) { return cosine; }, total) /
           kPi;
}

glm::dvec3 EnvironmentLight::reflected(const glm::dvec3& direction, double roughness) const {
    return reflectedBy(direction, LobeTable(roughness));
}

glm::dvec3 EnvironmentLight::reflectedBy(const glm::dvec3& direction, const LobeTable& lobe) const {
    double total = 0;
    const glm::dvec3 light = sum(direction, lobe.least(), lobe, total);
    return total > 0 ? light / total : light;
}

std::array<glm::dvec3, 9> EnvironmentLight::harmonics() const {
    std::array<glm::dvec3, 9> result{};
    for (const Source& source : sources_) {
        const auto basis = harmonicsAt(source.direction);
        for (std::size_t i = 0; i < 9; ++i)
            result.at(i) += basis.at(i) * source.light;
    }
    return result;
}

glm::dvec3 harmonicIrradiance(const std::array<glm::dvec3, 9>& harmonics, const glm::dvec3& normal) {
    // The cosine lobe's own coefficients over pi: 1, 2/3, 1/4 by order.
    constexpr std::array<double, 9> kCosine = {1, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25};
    const auto basis = harmonicsAt(normal);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 9; ++i)
        sum += kCosine.at(i) * basis.at(i) * harmonics.at(i);
    return sum;
}

glm::dvec3 environmentDirection(int face, int x, int y, int side) {
    const auto at = [&](int i) { return side > 1 ? 2.0 * i / (side - 1) - 1 : 0.0; };
    return glm::normalize(facePoint(face, at(x), at(y)));
}

Result<DdsTexture> makeEnvironment(const Image& panorama, const std::string& nameForMessages) {
    if (panorama.width != 2 * panorama.height || panorama.channels < 3)
        return inputError(7060, {.file = nameForMessages},
                          fmt::format("the picture is {} x {} with {} channels", panorama.width, panorama.height, panorama.channels),
                          "surroundings are an equirectangular picture in colour, twice as wide as high");
    SharpLevel sharp(kEnvironmentSide);
    eachSample(panorama, [&](const glm::dvec3& d, double angle, const glm::dvec3& radiance) { sharp.add(d, angle, radiance); });
    const EnvironmentLight light(panorama);
    DdsTexture texture{.format = DdsFormat::Rgba16F, .faces = 6, .mips = 0};
    std::vector<std::array<Image, 6>> levels;
    for (int side = kEnvironmentSide; side > 0; side /= 2) {
        const int level = texture.mips++;
        const LobeTable lobe(std::max(level, 1) * kEnvironmentRoughnessStep);
        levels.push_back(drawLevel(side, [&](int face, int x, int y) {
            if (level == 0) return sharp.at(face, x, y);
            const glm::dvec3 d = environmentDirection(face, x, y, side);
            return level < kEnvironmentLobes ? light.reflectedBy(d, lobe) : light.irradiance(d);
        }));
    }
    for (std::size_t face = 0; face < 6; ++face)
        for (auto& level : levels)
            texture.images.push_back(std::move(level.at(face)));
    return texture;
}

double harmonicError(const EnvironmentLight& light) {
    const auto harmonics = light.harmonics();
    constexpr int kSide = 8;
    double worst = 0;
    double largest = 1e-30;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const glm::dvec3 normal = environmentDirection(face, x, y, kSide);
                const glm::dvec3 exact = light.irradiance(normal);
                const glm::dvec3 apart = glm::abs(harmonicIrradiance(harmonics, normal) - exact);
                worst = std::max({worst, apart.x, apart.y, apart.z});
                largest = std::max({largest, exact.x, exact.y, exact.z});
            }
    return worst / largest;
}

} // namespace tegument
