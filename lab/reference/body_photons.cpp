#include "lab/reference/body_photons.h"

#include "host/support/cache.h"
#include "host/support/parallel.h"
#include "lab/reference/tissue.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

namespace tegument::reference {

namespace fs = std::filesystem;

namespace {

constexpr double kFarthestStep = 1e30;
constexpr double kShortestStep = 2e-4; // mm: a border between layers is known so well
constexpr double kLongestWay = 400;    // mm: what has gone so far is given up, for without absorption a photon may stay for ever
constexpr double kInset = 2e-5;        // mm below the surface: rays start in 32-bit floats

class Walk {
public:
    Walk(const Body& body, const Flesh& flesh, const Uniform& uniform, const std::function<void(const LeavingPhoton&)>& leave)
        : body_(body), flesh_(flesh), uniform_(uniform), leave_(leave) {}

    double follow(const glm::dvec3& place, const glm::dvec3& direction, double energy) {
        place_ = place;
        direction_ = direction;
        energy_ = energy;
        start_ = energy;
        depths_ = opticalDepth();
        while (energy_ > 0 && !outside_ && inEpidermis_ + inDermis_ < kLongestWay)
            step();
        return energy_;
    }

private:
    double opticalDepth() { return -std::log(1 - uniform_()); }

    /// No more than the depth, and exact below `deep`: what is left of a depth on a way is known without asking.
    double depthHere() {
        if (known_ <= flesh_.deep) known_ = body_.depth(place_, std::min(2 * flesh_.deep, kFarthestStep));
        return known_;
    }

    void step() {
        const double depth = depthHere();
        const bool deep = depth > flesh_.deep;
        const bool outer = depth < flesh_.thickness;
        const LayerOptics& layer = outer ? flesh_.epidermis : flesh_.dermis;
        const double scattering = deep ? layer.scattering : layer.scattering / (1 - flesh_.anisotropy);
        const double free = outer  ? std::min(depth, flesh_.thickness - depth)
                            : deep ? depth - flesh_.deep
                                   : std::min(depth - flesh_.thickness, flesh_.deep - depth);
        const double toEvent = scattering > 0 ? depths_ / scattering : kFarthestStep;
        double way = std::min(toEvent, std::max(free, kShortestStep));
        std::optional<Body::Border> border;
        if (depth <= way) border = body_.border(place_, direction_, way);
        if (border) way = border->distance;
        place_ += way * direction_;
        known_ -= way;
        depths_ = std::max(0.0, depths_ - way * scattering);
        energy_ *= std::exp(-layer.absorption * way);
        (outer ? inEpidermis_ : inDermis_) += way;
        if (border)
            meet(*border);
        else if (way >= toEvent)
            scatter(deep ? 0 : flesh_.anisotropy);
    }

    void meet(const Body::Border& border) {
        const double cosine = glm::dot(direction_, border.normal);
        known_ = 0;
        if (cosine <= 0) {
            outside_ = true;
            return;
        }
        const FresnelShare share = fresnelShare(flesh_.index, 1, cosine);
        if (share.mirrored < 1) leave_({place_, border.triangle, energy_ * (1 - share.mirrored), inEpidermis_, inDermis_});
        energy_ *= share.mirrored;
        direction_ -= 2 * cosine * border.normal;
        place_ -= kInset * border.normal;
        roulette();
    }

    void scatter(double g) {
        const double u = uniform_();
        double cosine = 2 * u - 1;
        if (g > 0) {
            const double part = (1 - g * g) / (1 - g + 2 * g * u);
            cosine = (1 + g * g - part * part) / (2 * g);
        }
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        const double around = 2 * std::numbers::pi * uniform_();
        const glm::dvec3 aside = glm::normalize(std::abs(direction_.z) < 0.9 ? glm::cross(direction_, glm::dvec3(0, 0, 1))
                                                                             : glm::cross(direction_, glm::dvec3(1, 0, 0)));
        direction_ =
            glm::normalize(cosine * direction_ + sine * (std::cos(around) * aside + std::sin(around) * glm::cross(direction_, aside)));
        depths_ = opticalDepth();
        roulette();
    }

    /// One faint photon in ten goes on, with ten times the energy.
    void roulette() {
        constexpr double kFaint = 1e-3;
        constexpr double kSurvivors = 0.1;
        if (energy_ < kFaint * start_) energy_ = uniform_() < kSurvivors ? energy_ / kSurvivors : 0;
    }

    const Body& body_;
    const Flesh& flesh_;
    const Uniform& uniform_;
    const std::function<void(const LeavingPhoton&)>& leave_;
    glm::dvec3 place_{0};
    glm::dvec3 direction_{0};
    double energy_ = 0;
    double start_ = 0;
    double depths_ = 0; // optical depth left to the next event
    double known_ = 0;  // mm: no less than so deep, where that is below `deep`
    double inEpidermis_ = 0;
    double inDermis_ = 0;
    bool outside_ = false;
};

/// What a block of photons leaves, triangle by triangle; the last two: what entered in all, what was lost.
using Block = std::vector<double>;

/// Where the blocks of this light are kept.
fs::path blockFolder(const RayScene& surface, const Flesh& flesh, const glm::dvec3& toLight, const BodyPhotonOptions& options) {
    CacheKey key("body photons 2"); // take another number with every change of what is computed
    key.add(surface.mesh().positions).add(surface.mesh().indices).add(flesh).add(toLight).add(options.photons).add(options.seed);
    return fs::path("photons") / key.text();
}

/// Parallel light on a mesh: where it enters.
class Sun {
public:
    Sun(const RayScene& surface, const glm::dvec3& toLight) : surface_(surface), toLight_(toLight) {
        const std::size_t count = surface.mesh().indices.size() / 3;
        double sum = 0;
        for (std::uint32_t t = 0; t < count; ++t) {
            const std::array<glm::dvec3, 3> corner = corners(t);
            const glm::dvec3 twice = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
            sum += 0.5 * std::max(0.0, glm::dot(twice, toLight));
            upTo_.push_back(sum);
        }
    }

    /// mm^2 across the light's way, what is in shadow included.
    [[nodiscard]] double power() const { return upTo_.back(); }

    struct Ray {
        std::uint32_t triangle = 0;
        glm::dvec3 place{0};
    };
    [[nodiscard]] Ray draw(const Uniform& uniform) const {
        const auto at = std::ranges::upper_bound(upTo_, uniform() * upTo_.back());
        const auto triangle = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(at - upTo_.begin(), std::ssize(upTo_) - 1));
        const std::array<glm::dvec3, 3> corner = corners(triangle);
        const double root = std::sqrt(uniform());
        const double part = uniform();
        return {triangle, (1 - root) * corner[0] + root * (1 - part) * corner[1] + root * part * corner[2]};
    }
    [[nodiscard]] bool lit(const Ray& ray) const {
        constexpr double kAbove = 1e-3; // mm
        return !surface_.nearest(ray.place + kAbove * faceNormal(surface_.mesh(), ray.triangle), toLight_);
    }

private:
    [[nodiscard]] std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const {
        const Mesh& mesh = surface_.mesh();
        const std::size_t first = 3 * static_cast<std::size_t>(triangle);
        return {mesh.positions[mesh.indices[first]], mesh.positions[mesh.indices[first + 1]], mesh.positions[mesh.indices[first + 2]]};
    }

    const RayScene& surface_;
    glm::dvec3 toLight_;
    std::vector<double> upTo_;
};

Block followBlock(const RayScene& surface, const Sun& sun, const Flesh& flesh, const glm::dvec3& toLight, std::size_t photons,
                  std::uint64_t seed, std::size_t block) {
    const std::size_t triangles = surface.mesh().indices.size() / 3;
    Block result(2 * triangles + 1, 0.0);
    std::seed_seq seeds{seed, static_cast<std::uint64_t>(block)};
    std::mt19937_64 random(seeds);
    const Uniform uniform = [&] { return std::generate_canonical<double, 53>(random); };
    const MeshBody body(surface);
    const double each = sun.power() / static_cast<double>(photons);
    for (std::size_t i = 0; i < photons; ++i) {
        const Sun::Ray ray = sun.draw(uniform);
        if (!sun.lit(ray)) continue;
        const glm::dvec3 normal = faceNormal(surface.mesh(), ray.triangle);
        const Entering inside = entering(-toLight, normal, flesh.index);
        const double energy = each * (1 - inside.mirrored);
        result[triangles + ray.triangle] += energy;
        result.back() += followInBody(body, flesh, ray.place - kInset * normal, inside.direction, energy, uniform,
                                      [&](const LeavingPhoton& photon) { result[photon.triangle] += photon.energy; });
    }
    return result;
}

} // namespace

double PlateBody::depth(const glm::dvec3& place, double most) const {
    return std::min({place.z, thickness_ - place.z, most});
}

std::optional<Body::Border> PlateBody::border(const glm::dvec3& place, const glm::dvec3& direction, double most) const {
    if (direction.z == 0) return {};
    const bool down = direction.z > 0;
    const double distance = std::max(0.0, (down ? thickness_ - place.z : -place.z) / direction.z);
    if (distance > most) return {};
    return Border{distance, {0, 0, down ? 1 : -1}, down ? 1U : 0U};
}

double MeshBody::depth(const glm::dvec3& place, double most) const {
    return std::min(surface_.distance(place, most), most);
}

std::optional<Body::Border> MeshBody::border(const glm::dvec3& place, const glm::dvec3& direction, double most) const {
    const std::optional<Hit> hit = surface_.nearest(place, direction);
    if (!hit || hit->distance > most) return {};
    return Border{std::max(0.0, hit->distance), faceNormal(surface_.mesh(), hit->place.triangle), hit->place.triangle};
}

double followInBody(const Body& body, const Flesh& flesh, const glm::dvec3& place, const glm::dvec3& direction, double energy,
                    const Uniform& uniform, const std::function<void(const LeavingPhoton&)>& leave) {
    return Walk(body, flesh, uniform, leave).follow(place, direction, energy);
}

Entering entering(const glm::dvec3& direction, const glm::dvec3& normal, double index) {
    const double cosine = -glm::dot(direction, normal);
    if (cosine <= 0) return {};
    const FresnelShare share = fresnelShare(1, index, cosine);
    return {share.mirrored, (direction + cosine * normal) / index - share.cosine * normal};
}

BodyLight photonsInBody(const RayScene& surface, const Flesh& flesh, const glm::dvec3& toLight, const BodyPhotonOptions& options) {
    constexpr std::size_t kBlocks = BodyLight::kBlocks;
    const std::size_t triangles = surface.mesh().indices.size() / 3;
    const Sun sun(surface, toLight);
    const fs::path folder = options.cached ? blockFolder(surface, flesh, toLight, options) : fs::path();
    const std::size_t perBlock = std::max<std::size_t>(1, options.photons / kBlocks);
    std::vector<Block> blocks(kBlocks);
    const auto one = [&](std::size_t i) {
        const fs::path file = folder / (std::to_string(i) + ".bin");
        auto known = options.cached ? loadCachedList<double>(file) : std::nullopt;
        const bool whole = known && known->size() == 2 * triangles + 1;
        blocks[i] = whole ? std::move(*known) : followBlock(surface, sun, flesh, toLight, perBlock, options.seed, i);
        if (options.cached && !whole) storeCached(file, bytesOf(blocks[i]));
    };
    forEachInParallel(kBlocks, one, options.progress);
    BodyLight all{.entered = std::vector<double>(triangles, 0.0), .variance = std::vector<double>(triangles, 0.0)};
    for (auto& half : all.left)
        half.assign(triangles, 0.0);
    double in = 0;
    for (std::size_t i = 0; i < kBlocks; ++i) {
        for (std::size_t t = 0; t < triangles; ++t) {
            all.left[i % 2][t] += blocks[i][t] / (kBlocks / 2);
            all.entered[t] += blocks[i][triangles + t] / kBlocks;
            in += blocks[i][triangles + t];
        }
        all.lost += blocks[i].back();
    }
    all.lost = in > 0 ? all.lost / in : 0;
    for (std::size_t t = 0; t < triangles; ++t) {
        const double mean = all.leaving(static_cast<std::uint32_t>(t));
        for (const Block& block : blocks)
            all.variance[t] += (block[t] - mean) * (block[t] - mean) / (kBlocks * (kBlocks - 1.0));
    }
    return all;
}

} // namespace tegument::reference
