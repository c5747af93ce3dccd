#include "meshprep/skin/skin_links.h"

#include "host/support/parallel.h"
#include "meshprep/skin/link_cells.h"
#include "meshprep/skin/link_receiver.h"
#include "meshprep/skin/wide_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace tegument {

namespace {

struct LinkTreeCell {
    std::uint8_t level = 0;
    std::uint16_t x = 0;
    std::uint16_t y = 0;
};

class LinkTree {
public:
    /// A ball that holds cells. Nodes stand in order: the first half of a node's cells is the next node.
    struct Node {
        glm::vec3 place{0};
        float radius = 0;
        float area = 0;
        std::uint32_t first = 0; // of cells()
        std::uint32_t end = 0;
        std::uint32_t largest = 0; // the cell with the most area
        std::uint32_t second = 0;  // the node of the second half; 0 for one cell
    };

    /// Of the largest cells of at most this extent, and those of the finest level.
    LinkTree(const LinkCells& cells, float extent);

    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<LinkTreeCell>& cells() const { return cells_; }

private:
    void collect(const LinkCells& cells, int level, int x, int y, float extent);
    void build(const LinkCells& cells, std::uint32_t first, std::uint32_t end);

    std::vector<LinkTreeCell> cells_;
    std::vector<Node> nodes_;
};

const LinkCell& cellIn(const LinkCells& cells, const LinkTreeCell& at) {
    return cells.at(at.level, at.x, at.y);
}

LinkTree::LinkTree(const LinkCells& cells, float extent) {
    const int top = kLinkLevels - 1;
    for (int i = 0; i < LinkCells::side(top) * LinkCells::side(top); ++i)
        collect(cells, top, i % LinkCells::side(top), i / LinkCells::side(top), extent);
    nodes_.reserve(2 * cells_.size());
    if (!cells_.empty()) build(cells, 0, static_cast<std::uint32_t>(cells_.size()));
}

void LinkTree::collect(const LinkCells& cells, int level, int x, int y, float extent) {
    const LinkCell& cell = cells.at(level, x, y);
    if (!(cell.area > 0)) return;
    if (level == 0 || std::numbers::sqrt2_v<float> * cell.radius <= extent) {
        cells_.push_back(
            {.level = static_cast<std::uint8_t>(level), .x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y)});
        return;
    }
    for (int i = 0; i < 4; ++i)
        collect(cells, level - 1, 2 * x + i % 2, 2 * y + i / 2, extent);
}

void LinkTree::build(const LinkCells& cells, std::uint32_t first, std::uint32_t end) {
    Node node{.first = first, .end = end, .largest = first};
    glm::vec3 low(INFINITY), high(-INFINITY), sum(0);
    for (std::uint32_t i = first; i < end; ++i) {
        const LinkCell& cell = cellIn(cells, cells_[i]);
        node.area += cell.area;
        sum += cell.area * cell.place;
        low = glm::min(low, cell.place);
        high = glm::max(high, cell.place);
        if (cell.area > cellIn(cells, cells_[node.largest]).area) node.largest = i;
    }
    node.place = sum / node.area;
    for (std::uint32_t i = first; i < end; ++i) {
        const LinkCell& cell = cellIn(cells, cells_[i]);
        node.radius = std::max(node.radius, glm::length(cell.place - node.place) + cell.radius);
    }
    const std::size_t index = nodes_.size();
    nodes_.push_back(node);
    if (end - first == 1) return;
    const glm::vec3 size = high - low;
    const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(
        cells_.begin() + first, cells_.begin() + middle, cells_.begin() + end,
        [&](const LinkTreeCell& a, const LinkTreeCell& b) { return cellIn(cells, a).place[axis] < cellIn(cells, b).place[axis]; });
    build(cells, first, middle);
    nodes_[index].second = static_cast<std::uint32_t>(nodes_.size());
    build(cells, middle, end);
    // Cells have moved since the largest was found.
    const std::uint32_t a = nodes_[index + 1].largest, b = nodes_[nodes_[index].second].largest;
    nodes_[index].largest = cellIn(cells, cells_[a]).area >= cellIn(cells, cells_[b]).area ? a : b;
}

/// A cell of the hierarchy: its texel of the pyramid.
struct LinkSource {
    int level = 0;
    int x = 0;
    int y = 0;
};

/// What the sources of a list gather from: cells of their own level, three along each side, as far as these lie on charts. Made once for a
/// list, for any function.
class LinkFit {
public:
    LinkFit(const LinkCells& cells, std::span<const LinkSource> sources);

    /// Cells that sources gather from, each once.
    [[nodiscard]] const std::vector<LinkSource>& nodes() const { return nodes_; }

    /// Improves weights towards the least squares over the surface between what the sources send, spread as they gather it, and a function:
    /// `means`, its mean over each node, 1/mm^2. No weight falls below 0. `weights`: one for each source.
    void improve(std::span<const float> means, std::span<float> weights) const;

private:
    struct Share {
        std::uint32_t source = 0;
        std::uint32_t node = 0;
        float share = 0;
    };
    void gather(const LinkCells& cells, std::span<const LinkSource> sources);
    void findOverlaps(const LinkCells& cells);

    std::size_t count_ = 0;
    std::vector<LinkSource> nodes_;
    std::vector<std::uint32_t> keys_; // of the nodes, ascending
    std::vector<Share> shares_;       // what sources take of nodes, 1 in all of each source; by nodes
    std::vector<std::size_t> ends_;   // where those of each node end
    std::vector<float> overlap_;      // source by source: the integral of the product of the two, 1/mm^2
};

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
    std::array<std::size_t, kLinkLevels + 1> begins{}; // of the nodes of each level: keys ascend by levels
    for (const LinkSource& node : nodes_)
        ++begins[static_cast<std::size_t>(node.level) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        LinkSource outer = nodes_[i];
        for (; outer.level < kLinkLevels; outer = {.level = outer.level + 1, .x = outer.x / 2, .y = outer.y / 2}) {
            const std::size_t begin = begins[static_cast<std::size_t>(outer.level)];
            const auto all = std::span(keys_).subspan(begin, begins[static_cast<std::size_t>(outer.level) + 1] - begin);
            const auto found = std::ranges::lower_bound(all, keyOf(outer));
            if (found == all.end() || *found != keyOf(outer)) continue;
            const std::size_t other = begin + static_cast<std::size_t>(found - all.begin());
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

/// A source is taken apart to find its weight where its side is more than this share of the narrower Gaussian's width.
constexpr double kFineShare = 0.75;
/// Sources that a pyramid misses for the fourth Gaussian by more than this share of its peak are at most so many of its widths large.
constexpr float kMissed = 0.05F;
constexpr double kMissedSource = 1.0;
/// Every so manieth texel is asked for it, and so much more is to be sent than taken back.
constexpr int kProbes = 8;
constexpr double kSentOverTaken = 10;
/// Cells that a receiver may visit, in the mean: above, the map is of so many charts that cells are found in space.
constexpr std::size_t kMostVisits = 4096;
/// Half floats below this are 0.
constexpr float kTinyWeight = 1e-7F;

struct Link {
    std::uint8_t level = 0;
    std::uint32_t index = 0;
    std::array<float, 2> weight{};
};

/// Light that reaches one place: its links, and the sum of their weights by each Gaussian.
struct Gathered {
    std::vector<Link> links;
    std::array<double, 2> whole{};
    std::size_t visits = 0;
};

/// What a pyramid does not know of the fourth Gaussian: light from where space is near and the map is not, and the reverse.
struct Missed {
    double sent = 0;
    double taken = 0;
};

class Gatherer {
public:
    Gatherer(const LinkCells& cells, const LinkOptions& options) : cells_(cells), options_(options) {
        fine_ = static_cast<float>(kFineShare * std::sqrt(std::min(options.variances[0], options.variances[1])));
        finest_ = static_cast<float>(kFineShare * std::sqrt(options.fourth));
    }

    /// Whether the fourth Gaussian comes along: texels are no wider than it is, or they would blur it, and most of what pyramids do not
    /// know of it is light to be sent, for what they take too much weights that are not below 0 do not give back.
    void decide(const Mesh& mesh) {
        if (static_cast<double>(cells_.usualSide(kDestinationLevel)) > std::sqrt(options_.fourth)) return;
        Missed missed;
        const int top = kLinkLevels - 1;
        for (int y = kProbes / 2; y < kLinkSide; y += kProbes)
            for (int x = kProbes / 2; x < kLinkSide; x += kProbes) {
                const auto middle = cells_.middle(mesh, kDestinationLevel, x, y, 0);
                if (!middle) continue;
                const LinkReceiver receiver = linkReceiver(cells_, *middle, options_);
                for (int i = 0; i < LinkCells::side(top) * LinkCells::side(top); ++i)
                    addMissed(receiver, top, i % LinkCells::side(top), i / LinkCells::side(top), missed);
            }
        brings_ = missed.sent > kSentOverTaken * missed.taken;
    }
    [[nodiscard]] bool bringsFourth() const { return brings_; }

    /// Whether cells are found through the map or in space: by what some receivers would visit in the map.
    void chooseWay(const Mesh& mesh) {
        std::size_t visits = 0;
        std::size_t receivers = 0;
        for (int y = kProbes / 2; y < kLinkSide; y += 2 * kProbes)
            for (int x = kProbes / 2; x < kLinkSide; x += 2 * kProbes)
                if (const auto middle = cells_.middle(mesh, kDestinationLevel, x, y, kLinksBeside)) {
                    visits += at(linkReceiver(cells_, *middle, options_)).visits;
                    ++receivers;
                }
        if (visits > kMostVisits * receivers) tree_.emplace(cells_, static_cast<float>(options_.nearest));
    }

    /// Means of the Gaussians over a cell, 1/mm^2.
    [[nodiscard]] std::array<double, 2> means(const LinkReceiver& receiver, const LinkSource& cell) const {
        std::array<double, 2> sum{};
        add(receiver, cell.level, cell.x, cell.y, sum);
        const auto area = static_cast<double>(cells_.at(cell.level, cell.x, cell.y).area);
        return {sum[0] / area, sum[1] / area};
    }

    [[nodiscard]] Gathered at(const LinkReceiver& receiver) const {
        Gathered gathered;
        if (tree_) {
            visit(receiver, 0, gathered);
            return gathered;
        }
        const int top = kLinkLevels - 1;
        for (int y = 0; y < LinkCells::side(top); ++y)
            for (int x = 0; x < LinkCells::side(top); ++x)
                visit(receiver, top, x, y, gathered);
        return gathered;
    }

private:
    /// How large a source may be whose nearest point is so far away, mm.
    [[nodiscard]] float allowed(float away) const {
        return static_cast<float>(options_.nearest) + static_cast<float>(options_.growth) * std::max(away, 0.0F);
    }

    /// What lies together in space is one source where it may: its largest cell sends for all of it.
    void visit(const LinkReceiver& receiver, std::uint32_t index, Gathered& gathered) const {
        const LinkTree::Node& node = tree_->nodes()[index];
        const float away = glm::length(node.place - receiver.middle.place) - node.radius;
        if (away > receiver.reach) return;
        float most = allowed(away);
        if (brings_) most = std::min(most, static_cast<float>(kMissedSource) * std::sqrt(receiver.fourth.along));
        if (node.second != 0 && std::numbers::sqrt2_v<float> * node.radius > most) {
            visit(receiver, index + 1, gathered);
            visit(receiver, node.second, gathered);
            return;
        }
        const LinkTreeCell& cell = tree_->cells()[node.largest];
        std::array<double, 2> sum{};
        if (node.second == 0)
            add(receiver, cell.level, cell.x, cell.y, sum);
        else
            addAll(receiver, node, sum);
        put(cell.level, cell.x, cell.y, sum, gathered);
    }

    void addAll(const LinkReceiver& receiver, const LinkTree::Node& node, std::array<double, 2>& sum) const {
        for (std::size_t i = 0; i < 2; ++i)
            sum[i] = node.area * receiver.sentBy(node.place, i);
        if (!brings_) return;
        Missed missed;
        for (std::uint32_t i = node.first; i < node.end; ++i)
            addMissed(receiver, tree_->cells()[i].level, tree_->cells()[i].x, tree_->cells()[i].y, missed);
        sum[0] += options_.fourthShare * (missed.sent - missed.taken);
    }

    void visit(const LinkReceiver& receiver, int level, int x, int y, Gathered& gathered) const {
        ++gathered.visits;
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        const glm::vec3 way = cell.place - receiver.middle.place;
        const float distance = glm::length(way);
        if (distance - cell.radius > receiver.reach) return;
        const float extent = std::numbers::sqrt2_v<float> * cell.radius;
        float most = allowed(distance - cell.radius);
        if (brings_ && misses(receiver, cell, way))
            most = std::min(most, static_cast<float>(kMissedSource) * std::sqrt(receiver.fourth.along));
        if (level > 0 && extent > most) {
            for (int i = 0; i < 4; ++i)
                visit(receiver, level - 1, 2 * x + i % 2, 2 * y + i / 2, gathered);
            return;
        }
        std::array<double, 2> sum{};
        add(receiver, level, x, y, sum);
        put(level, x, y, sum, gathered);
    }

    static void put(int level, int x, int y, const std::array<double, 2>& sum, Gathered& gathered) {
        for (std::size_t i = 0; i < 2; ++i)
            gathered.whole[i] += sum[i];
        gathered.links.push_back({.level = static_cast<std::uint8_t>(level),
                                  .index = static_cast<std::uint32_t>(y * LinkCells::side(level) + x),
                                  .weight = {static_cast<float>(sum[0]), static_cast<float>(sum[1])}});
    }

    /// The cell, or its parts where it is large: all as fine as each other, for a Gaussian's sum over a grid is exact, over a mixed one
    /// not.
    void add(const LinkReceiver& receiver, int level, int x, int y, std::array<double, 2>& sum) const {
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        const bool reaches = glm::length(cell.place - receiver.middle.place) - cell.radius < receiver.reach;
        if (reaches && level > 0 && cell.radius * std::numbers::sqrt2_v < float >> fine_) {
            for (int i = 0; i < 4; ++i)
                add(receiver, level - 1, 2 * x + i % 2, 2 * y + i / 2, sum);
            return;
        }
        for (std::size_t i = 0; reaches && i < 2; ++i)
            sum[i] += cell.area * receiver.sentBy(cell.place, i);
        if (!brings_) return;
        Missed missed;
        addMissed(receiver, level, x, y, missed);
        sum[0] += options_.fourthShare * (missed.sent - missed.taken);
    }

    /// What a pyramid misses of the fourth Gaussian from a cell, and takes from it that it should not.
    void addMissed(const LinkReceiver& receiver, int level, int x, int y, Missed& missed) const {
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        const glm::vec3 way = cell.place - receiver.middle.place;
        const float apart = std::min(glm::length(way), receiver.flat(cell)) - 2 * cell.radius;
        if (apart > receiver.fourthReach) return;
        if (level == 0 || cell.radius * std::numbers::sqrt2_v<float> <= finest_) {
            const double light = cell.area * unseen(receiver, cell, way);
            (light > 0 ? missed.sent : missed.taken) += std::abs(light);
            return;
        }
        for (int i = 0; i < 4; ++i)
            addMissed(receiver, level - 1, 2 * x + i % 2, 2 * y + i / 2, missed);
    }

    static bool misses(const LinkReceiver& receiver, const LinkCell& cell, const glm::vec3& way) {
        return std::abs(unseen(receiver, cell, way)) > kMissed * receiver.peak(receiver.fourth);
    }

    /// What a pyramid misses of the fourth Gaussian, 1/mm^2: it takes the distance in the map, in the receiver's own plane, for that in
    /// space. Below 0 for what is near in the map only.
    [[nodiscard]] static double unseen(const LinkReceiver& receiver, const LinkCell& cell, const glm::vec3& way) {
        return receiver.sent(way, receiver.fourth) - receiver.sentAlong(cell, receiver.fourth);
    }

    const LinkCells& cells_;
    const LinkOptions& options_;
    std::optional<LinkTree> tree_;
    bool brings_ = false;
    float fine_ = 0;
    float finest_ = 0; // the same of the fourth Gaussian
};

/// Leaves out the least links.
void leaveOut(std::vector<Link>& links, const LinkOptions& options, std::size_t most) {
    const auto worth = [&](const Link& link) {
        return std::max(options.weights[0] * link.weight[0] + options.weights[1] * link.weight[1], 0.0);
    };
    std::ranges::sort(links, [&](const Link& a, const Link& b) { return worth(a) > worth(b); });
    double all = 0;
    for (const Link& link : links)
        all += worth(link);
    double left = all;
    std::size_t count = 0;
    while (count < links.size() && count < most && left > options.lost * all)
        left -= worth(links[count++]);
    links.resize(count);
    // Neighbouring texels then read neighbouring sources at the same time.
    std::ranges::sort(links, [](const Link& a, const Link& b) { return std::pair(a.level, a.index) < std::pair(b.level, b.index); });
}

LinkSource sourceOf(const Link& link) {
    const int side = LinkCells::side(link.level);
    return {.level = link.level, .x = static_cast<int>(link.index) % side, .y = static_cast<int>(link.index) / side};
}

/// The links that are kept, so weighed that their sources, as wide as they are, make the Gaussians, and each list has all of its light.
std::vector<Link> weighed(const LinkCells& cells, const Gatherer& gatherer, const LinkReceiver& receiver, const LinkOptions& options,
                          std::size_t most) {
    Gathered gathered = gatherer.at(receiver);
    std::vector<Link>& links = gathered.links;
    leaveOut(links, options, most);
    std::vector<LinkSource> sources;
    for (const Link& link : links)
        sources.push_back(sourceOf(link));
    const LinkFit fit(cells, sources);
    std::array<std::vector<float>, 2> wanted;
    for (const LinkSource& node : fit.nodes()) {
        const auto means = gatherer.means(receiver, node);
        for (std::size_t i = 0; i < 2; ++i)
            wanted[i].push_back(static_cast<float>(means[i]));
    }
    for (std::size_t i = 0; i < 2; ++i) {
        std::vector<float> weights;
        for (const Link& link : links)
            weights.push_back(std::max(link.weight[i], kTinyWeight));
        fit.improve(wanted[i], weights);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        const auto scale = sum > 0 ? static_cast<float>(gathered.whole[i] / sum) : 0.0F; // a Gaussian that does not get here sends nothing
        for (std::size_t k = 0; k < links.size(); ++k)
            links[k].weight[i] = std::max(weights[k] * scale, kTinyWeight);
    }
    return {links.begin(), links.end()}; // without the room that all candidates took
}

using Lists = std::vector<std::vector<Link>>;

Lists gatherAll(const Mesh& mesh, const LinkCells& cells, const Gatherer& gatherer, const LinkOptions& options, std::size_t most) {
    Lists lists(static_cast<std::size_t>(kLinkSide) * kLinkSide);
    forEachInParallel(
        kLinkSide,
        [&](std::size_t y) {
            for (std::size_t x = 0; x < kLinkSide; ++x) {
                const auto middle = cells.middle(mesh, kDestinationLevel, static_cast<int>(x), static_cast<int>(y), kLinksBeside);
                if (!middle) continue;
                lists[y * kLinkSide + x] = weighed(cells, gatherer, linkReceiver(cells, *middle, options), options, most);
            }
        },
        {}, options.threads);
    return lists;
}

/// Of the quarters of wide texels, four by four in the order of WideTexels::blocks(). Each sends on what the spline through the whole
/// texels around it, those that are not wide, leaves of it.
Lists gatherQuarters(const Mesh& mesh, const LinkCells& cells, const Gatherer& gatherer, const LinkOptions& options, const WideTexels& wide,
                     std::size_t most) {
    Lists lists(4 * wide.blocks().size());
    forEachInParallel(
        lists.size(),
        [&](std::size_t i) {
            const glm::ivec2 texel = 2 * wide.blocks()[i / 4] + glm::ivec2(i % 2, i / 2 % 2);
            const auto share = static_cast<float>(wide.share(texel));
            if (!(share > 0)) return;
            const auto receiver = linkReceiverAmong(mesh, cells, kDestinationLevel - 1, texel, options);
            if (!receiver) return;
            lists[i] = weighed(cells, gatherer, *receiver, options, most);
            for (Link& link : lists[i])
                for (float& weight : link.weight)
                    weight = std::max(share * weight, kTinyWeight);
        },
        {}, options.threads);
    return lists;
}

/// As effects/passes/pyramid_links.fxh reads it.
std::array<float, 4> texelOf(const Link& link) {
    const int side = LinkCells::side(link.level);
    const auto at = [&](int texel) { return (static_cast<float>(texel) + 0.5F) / static_cast<float>(side); };
    const int index = static_cast<int>(link.index);
    return {link.level % 2 == 1 ? -at(index % side) : at(index % side), link.level / 2 % 2 == 1 ? -at(index / side) : at(index / side),
            link.weight[0], link.level / 4 % 2 == 1 ? -link.weight[1] : link.weight[1]};
}

/// Where a tile of the sheet holds what.
class Sheet {
public:
    Sheet(SkinLinks& links, int tiles, int rows) : sheet_(links.sheet), tiles_(tiles), rows_(rows) {
        sheet_ = {.width = tiles * kLinkSide, .height = tiles * rows, .channels = 4, .pixels = {}, .metadata = {}};
        sheet_.pixels.assign(static_cast<std::size_t>(sheet_.width) * static_cast<std::size_t>(sheet_.height) * 4, 0.0F);
    }

    void put(int tile, const glm::ivec2& slot, const std::array<float, 4>& texel) {
        for (int c = 0; c < 4; ++c)
            sheet_.at(tile % tiles_ * kLinkSide + slot.x, tile / tiles_ * rows_ + slot.y, c) = texel[static_cast<std::size_t>(c)];
    }
    void put(const glm::ivec2& slot, const std::vector<Link>& list) {
        for (std::size_t k = 0; k < list.size(); ++k)
            put(static_cast<int>(k), slot, texelOf(list[k]));
    }

private:
    Image& sheet_;
    int tiles_;
    int rows_;
};

void count(const Lists& lists, SkinLinks& links) {
    for (const auto& list : lists) {
        links.lists += list.empty() ? 0 : 1;
        links.links += list.size();
        links.longest = std::max(links.longest, list.size());
    }
}

void draw(const Lists& lists, const Lists& quarters, const WideTexels& wide, SkinLinks& links) {
    count(lists, links);
    count(quarters, links);
    links.quarters = quarters.size();
    const std::size_t most = links.longest + (quarters.empty() ? 0 : 1); // the last tile says where quarters are
    links.tiles = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(most)))));
    const int rows = kLinkSide + wide.rows();
    Sheet sheet(links, links.tiles, rows);
    for (std::size_t i = 0; i < lists.size(); ++i)
        sheet.put(glm::ivec2(i % kLinkSide, i / kLinkSide), lists[i]);
    const int last = links.tiles * links.tiles - 1;
    for (std::size_t i = 0; i < wide.blocks().size(); ++i) {
        const glm::ivec2 place = WideTexels::placeOf(i);
        for (std::size_t k = 0; k < 4; ++k)
            sheet.put(glm::ivec2(0, kLinkSide) + 2 * place + glm::ivec2(k % 2, k / 2), quarters[4 * i + k]);
        sheet.put(last, wide.blocks()[i],
                  {0, static_cast<float>(place.x + 1), static_cast<float>(place.y), wide.isWide(wide.blocks()[i]) ? 1.0F : 0.0F});
    }
    // The last texel of all says how many tiles there are, whether the fourth Gaussian comes along, and how high tiles are in maps of
    // kLinkSide, in place of the last link of a corner.
    const float high = static_cast<float>(rows) / kLinkSide;
    sheet.put(last, {kLinkSide - 1, rows - 1}, {static_cast<float>(links.tiles), links.fourth ? 1.0F : 0.0F, high, 0});
}

/// Seconds since it was asked last.
class Watch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace

Result<SkinLinks> makeSkinLinks(const Mesh& mesh, const LinkOptions& options) {
    Watch watch;
    SkinLinks links;
    const LinkCells cells(mesh, skinMask(mesh));
    links.seconds.cells = watch.lap();
    if (!(cells.usualSide(0) > 0))
        return inputError(7044, {.file = mesh.name, .byte = {}}, "links need texture coordinates in the unit square, and there are none",
                          "tegument prep MESH --unwrap makes them");
    Gatherer gatherer(cells, options);
    gatherer.decide(mesh);
    gatherer.chooseWay(mesh);
    const WideTexels wide(mesh, cells);
    const std::size_t most = kMostLinks - (wide.blocks().empty() ? 0 : 1);
    const Lists lists = gatherAll(mesh, cells, gatherer, options, most);
    const Lists quarters = gatherQuarters(mesh, cells, gatherer, options, wide, most);
    links.seconds.links = watch.lap();
    if (wide.from() > kWideFrom)
        links.warnings.push_back(inputWarning(
            7045, {.file = mesh.name, .byte = {}},
            fmt::format(
                "the texture is of so many scattered charts that texels of {:.2g} to {:.2g} mm bring less exact light through thin skin",
                kWideFrom, wide.from()),
            "tegument prep MESH --unwrap -o NEW.glb makes fewer, larger charts"));
    links.fourth = gatherer.bringsFourth();
    links.sideMm = static_cast<double>(cells.usualSide(kDestinationLevel));
    draw(lists, quarters, wide, links);
    links.seconds.sheet = watch.lap();
    return links;
}

} // namespace tegument
