#include "meshprep/skin/link_fit.h"

#include <algorithm>
#include <array>

namespace tegument {

namespace {

/// Shares of the cells that a source gathers from, along each axis: with the square's own 1/12 variances of 0.48 and, of the finest level,
/// 0.25 squares of a side. Reductions by 1 3 3 1 tend to 0.5; the finest level is the base of maps of 512 texels, 1/12, and the first
/// reduction of larger ones, 0.40.
constexpr std::array kGathered = {0.2F, 0.6F, 0.2F};
constexpr std::array kFinestGathered = {1 / 12.0F, 5 / 6.0F, 1 / 12.0F};
/// More of them change no picture.
constexpr int kSweeps = 8;

constexpr int kKeyBits = 10; // of a coordinate
static_assert(kFinestLinkCells <= 1 << kKeyBits);

std::uint32_t keyOf(const LinkSource& cell) {
    return static_cast<std::uint32_t>(((cell.level << kKeyBits) + cell.y) << kKeyBits | cell.x);
}

LinkSource cellOf(std::uint32_t key) {
    constexpr std::uint32_t kMask = (1U << kKeyBits) - 1;
    return {.level = static_cast<int>(key >> (2 * kKeyBits)),
            .x = static_cast<int>(key & kMask),
            .y = static_cast<int>(key >> kKeyBits & kMask)};
}

struct Taken {
    std::uint32_t key = 0;
    std::uint32_t source = 0;
    float share = 0;
};

void take(const LinkCells& cells, const LinkSource& source, std::uint32_t index, std::vector<Taken>& taken) {
    const auto& shares = source.level == 0 ? kFinestGathered : kGathered;
    const int side = LinkCells::side(source.level);
    const std::size_t first = taken.size();
    float sum = 0;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const LinkSource at{.level = source.level, .x = source.x + i, .y = source.y + j};
            if (at.x < 0 || at.y < 0 || at.x >= side || at.y >= side) continue;
            const float covered = cells.at(at.level, at.x, at.y).covered;
            if (!(covered > 0)) continue;
            taken.push_back(
                {keyOf(at), index, shares[static_cast<std::size_t>(i + 1)] * shares[static_cast<std::size_t>(j + 1)] * covered});
            sum += taken.back().share;
        }
    for (std::size_t i = first; i < taken.size(); ++i)
        taken[i].share /= sum;
}

} // namespace

LinkFit::LinkFit(const LinkCells& cells, std::span<const LinkSource> sources) : count_(sources.size()) {
    gather(cells, sources);
    findOverlaps(cells);
}

void LinkFit::gather(const LinkCells& cells, std::span<const LinkSource> sources) {
    std::vector<Taken> taken;
    taken.reserve(9 * sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i)
        take(cells, sources[i], static_cast<std::uint32_t>(i), taken);
    std::ranges::sort(taken, {}, &Taken::key);
    for (const Taken& one : taken) {
        if (keys_.empty() || keys_.back() != one.key) {
            if (!keys_.empty()) ends_.push_back(shares_.size());
            keys_.push_back(one.key);
            nodes_.push_back(cellOf(one.key));
        }
        shares_.push_back({one.source, static_cast<std::uint32_t>(nodes_.size() - 1), one.share});
    }
    ends_.push_back(shares_.size());
}

// Nodes are the same, or one within the other, or apart.
void LinkFit::findOverlaps(const LinkCells& cells) {
    overlap_.assign(count_ * count_, 0.0F);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        LinkSource outer = nodes_[i];
        for (; outer.level < kLinkLevels; outer = {.level = outer.level + 1, .x = outer.x / 2, .y = outer.y / 2}) {
            const auto found = std::ranges::lower_bound(keys_, keyOf(outer));
            if (found == keys_.end() || *found != keyOf(outer)) continue;
            const auto other = static_cast<std::size_t>(found - keys_.begin());
            const float scale = 1 / cells.at(outer.level, outer.x, outer.y).area;
            for (std::size_t a = i > 0 ? ends_[i - 1] : 0; a < ends_[i]; ++a)
                for (std::size_t b = other > 0 ? ends_[other - 1] : 0; b < ends_[other]; ++b) {
                    const float both = shares_[a].share * shares_[b].share * scale;
                    overlap_[shares_[a].source * count_ + shares_[b].source] += both;
                    if (other != i) overlap_[shares_[b].source * count_ + shares_[a].source] += both;
                }
        }
    }
}

// Projected Gauss-Seidel: each weight in turn to where the error is least, or 0.
void LinkFit::improve(std::span<const float> means, std::span<float> weights) const {
    std::vector<float> missing(count_);
    for (const Share& share : shares_)
        missing[share.source] += share.share * means[share.node];
    const auto change = [&](std::size_t source, float by) {
        const float* row = &overlap_[source * count_];
        for (std::size_t i = 0; i < count_; ++i)
            missing[i] -= by * row[i];
    };
    for (std::size_t i = 0; i < count_; ++i)
        change(i, weights[i]);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t i = 0; i < count_; ++i) {
            const float better = std::max(weights[i] + missing[i] / overlap_[i * count_ + i], 0.0F);
            change(i, better - weights[i]);
            weights[i] = better;
        }
}

} // namespace tegument
