#include "lab/reference/tissue.h"

#include "host/support/parallel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace tegument::reference {

namespace {

constexpr double kPerCentimetre = 0.1; // in 1/mm

struct Substance {
    std::array<double, 3> absorption; // 1/cm, red, green, blue
    std::array<double, 3> scattering;
    double index;
};
constexpr Substance kEpidermis = {{2.1, 2.1, 5.0}, {48, 60, 65}, 1.4};
constexpr Substance kUpperDermis = {{0.16, 0.19, 0.30}, {32, 40, 46}, 1.34};
constexpr Substance kBloodyDermis = {{0.085, 1.0, 25}, {4.5, 4.7, 4.8}, 1.4};
constexpr double kEpidermisThickness = 0.25;
constexpr double kUpperDermisThickness = 0.20;

Layer layerOf(const Substance& substance, int channel, double thickness) {
    const auto c = static_cast<std::size_t>(channel);
    return {substance.absorption.at(c) * kPerCentimetre, substance.scattering.at(c) * kPerCentimetre, thickness, substance.index};
}

/// What one block of photons leaves.
struct Tally {
    double mirrored = 0;
    double reflected = 0;
    double transmitted = 0;
    RingHistogram rings;
};

class Photon {
public:
    Photon(const Tissue& tissue, const std::vector<double>& tops, std::mt19937_64& random, Tally& tally)
        : tissue_(tissue), tops_(tops), random_(random), tally_(tally) {}

    void follow(Launch launch) {
        start(launch);
        while (weight_ > 0) {
            const Layer& layer = tissue_[layer_];
            const double extinction = layer.absorption + layer.scattering;
            const double border = borderDistance();
            if (depths_ / extinction < border)
                scatter(layer, depths_ / extinction);
            else
                cross(border, border * extinction);
        }
    }

private:
    double uniform() { return std::generate_canonical<double, 53>(random_); }
    double opticalDepth() { return -std::log(1 - uniform()); }

    void turn(double cosine) {
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        const double around = 2 * std::numbers::pi * uniform();
        direction_ = {sine * std::cos(around), sine * std::sin(around), cosine};
    }

    void start(Launch launch) {
        depths_ = opticalDepth();
        if (launch == Launch::Diffuse) return turn(std::sqrt(1 - uniform()));
        const double mirrored = fresnelShare(1, tissue_.front().index, 1).mirrored;
        tally_.mirrored += mirrored;
        weight_ = 1 - mirrored;
    }

    /// Down to the layer's border along the way.
    [[nodiscard]] double borderDistance() const {
        if (direction_.z == 0) return std::numeric_limits<double>::infinity();
        return (tops_[direction_.z > 0 ? layer_ + 1 : layer_] - position_.z) / direction_.z;
    }

    void scatter(const Layer& layer, double distance) {
        constexpr double kFaint = 1e-3; // below, one photon in ten goes on with ten times the weight (Russian roulette)
        constexpr double kSurvivors = 0.1;
        position_ += distance * direction_;
        weight_ *= layer.scattering / (layer.absorption + layer.scattering);
        turn(2 * uniform() - 1);
        depths_ = opticalDepth();
        if (weight_ < kFaint) weight_ = uniform() < kSurvivors ? weight_ / kSurvivors : 0;
    }

    void cross(double distance, double depths) {
        position_ += distance * direction_;
        depths_ = std::max(0.0, depths_ - depths);
        const bool down = direction_.z > 0;
        position_.z = tops_[down ? layer_ + 1 : layer_]; // exactly, so that nothing is left of the way to it
        const bool outside = down ? layer_ + 1 == tissue_.size() : layer_ == 0;
        const double here = tissue_[layer_].index;
        const double there = outside ? 1 : tissue_[down ? layer_ + 1 : layer_ - 1].index;
        const FresnelShare crossing = fresnelShare(here, there, std::abs(direction_.z));
        if (outside) {
            leave(down, weight_ * (1 - crossing.mirrored));
            weight_ *= crossing.mirrored;
            direction_.z = -direction_.z;
        } else if (uniform() < crossing.mirrored) {
            direction_.z = -direction_.z;
        } else {
            const double eta = here / there;
            direction_ = {direction_.x * eta, direction_.y * eta, down ? crossing.cosine : -crossing.cosine};
            layer_ = down ? layer_ + 1 : layer_ - 1;
        }
    }

    /// Split at the outer surfaces: what passes is counted at once, the rest goes on, so that no photon's fate is left to chance there.
    void leave(bool down, double energy) {
        if (down) {
            tally_.transmitted += energy;
            return;
        }
        tally_.reflected += energy;
        tally_.rings.add(std::hypot(position_.x, position_.y), energy);
    }

    const Tissue& tissue_;
    const std::vector<double>& tops_;
    std::mt19937_64& random_;
    Tally& tally_;
    glm::dvec3 position_{0}; // z down
    glm::dvec3 direction_{0, 0, 1};
    double weight_ = 1;
    double depths_ = 0; // optical depth left to the next event
    std::size_t layer_ = 0;
};

std::vector<double> topsOf(const Tissue& tissue) {
    std::vector<double> tops = {0};
    for (const Layer& layer : tissue)
        tops.push_back(tops.back() + layer.thickness);
    return tops;
}

/// Standard error of the mean of equal blocks.
double errorOf(const std::vector<Tally>& blocks, double Tally::*share, double mean, double perBlock) {
    double squares = 0;
    for (const Tally& block : blocks)
        squares += (block.*share / perBlock - mean) * (block.*share / perBlock - mean);
    const auto count = static_cast<double>(blocks.size());
    return std::sqrt(squares / (count * (count - 1)));
}

} // namespace

FresnelShare fresnelShare(double from, double to, double cosine) {
    const double eta = from / to;
    const double sine2 = eta * eta * (1 - cosine * cosine);
    if (sine2 >= 1) return {};
    const double other = std::sqrt(1 - sine2);
    const double s = (from * cosine - to * other) / (from * cosine + to * other);
    const double p = (from * other - to * cosine) / (from * other + to * cosine);
    return {0.5 * (s * s + p * p), other};
}

Tissue layeredSkin(int channel) {
    return {layerOf(kEpidermis, channel, kEpidermisThickness), layerOf(kUpperDermis, channel, kUpperDermisThickness),
            layerOf(kBloodyDermis, channel, std::numeric_limits<double>::infinity())};
}

Tissue skinSlab(int channel, double bloody) {
    const Layer epidermis = layerOf(kEpidermis, channel, kEpidermisThickness);
    const Layer dermis = layerOf(kUpperDermis, channel, kUpperDermisThickness);
    return {epidermis, dermis, layerOf(kBloodyDermis, channel, bloody), dermis, epidermis};
}

Photons followPhotons(const Tissue& tissue, const PhotonOptions& options) {
    constexpr std::size_t kBlocks = 64;
    assert(!tissue.empty());
    const std::vector<double> tops = topsOf(tissue);
    const std::size_t perBlock = std::max<std::size_t>(1, options.photons / kBlocks);
    std::vector<Tally> blocks(kBlocks);
    forEachInParallel(kBlocks, [&](std::size_t block) {
        std::seed_seq seed{options.seed, static_cast<std::uint64_t>(block)};
        std::mt19937_64 random(seed);
        for (std::size_t i = 0; i < perBlock; ++i)
            Photon(tissue, tops, random, blocks[block]).follow(options.launch);
    });
    Photons all;
    const auto count = static_cast<double>(perBlock);
    for (const Tally& block : blocks) {
        all.mirrored += block.mirrored / (count * kBlocks);
        all.reflected += block.reflected / (count * kBlocks);
        all.transmitted += block.transmitted / (count * kBlocks);
        all.rings.add(block.rings);
    }
    all.rings.scale(1 / (count * kBlocks));
    all.reflectedError = errorOf(blocks, &Tally::reflected, all.reflected, count);
    all.transmittedError = errorOf(blocks, &Tally::transmitted, all.transmitted, count);
    return all;
}

} // namespace tegument::reference
