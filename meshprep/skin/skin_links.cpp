#include "meshprep/skin/skin_links.h"

#include "host/support/parallel.h"
#include "meshprep/skin/link_cells.h"
#include "meshprep/skin/link_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace tegument {

namespace {

/// Variance along each axis in squares of a texel's side: a texel's light is interpolated between texels by a quadratic B-spline.
constexpr double kReceived = 0.25;
/// What the above leaves of a Gaussian: at least this share.
constexpr double kLeast = 0.35;
/// Widths of the widest Gaussian within which sources count: 3.5 leave out 0.2 %.
constexpr double kReach = 3.5;
/// A source is taken apart to find its weight where its side is more than this share of the narrower Gaussian's width.
constexpr double kFineShare = 0.75;
/// No Gaussian is narrower, in squares of a finest cell's side: what it gives to the cells of a grid is then within 1.1 % of 1 wherever it
/// stands (Poisson's sum: 4 exp(-2 pi^2 kFelt)). Below that it would fall between their middles, and large bodies would lose light.
constexpr double kFelt = 0.3;
/// Sources that a pyramid misses for the fourth Gaussian by more than this share of its peak are at most so many of its widths large.
constexpr float kMissed = 0.05F;
constexpr double kMissedSource = 1.0;
/// Every so manieth texel is asked for it, and so much more is to be sent than taken back.
constexpr int kProbes = 8;
constexpr double kSentOverTaken = 10;
/// Texels beside the charts that have lists too, as if the surface went on: as far as interpolation asks.
constexpr int kBeside = 2;
/// A texel counts as at most so many usual ones along a side; for kFelt, which loses light where it is less, twice as many.
constexpr double kMostSide = 1.5;
constexpr double kMostFelt = 3;
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
};

/// A Gaussian for links: narrower along the receiver's plane, in which a spline reads what it receives, than through it, mm^2.
struct Spread {
    float along = 0;
    float through = 0;
};

/// Where light arrives, and what is left of the Gaussians for links there.
struct Receiver {
    LinkCells::Middle middle;
    glm::vec3 normal{0}; // unit, either way
    std::array<Spread, 2> spreads;
    Spread fourth;
    float fourthReach = 0;
    float reach = 0; // mm: sources farther away do not count

    /// Of the way to a source, 1/mm^2.
    [[nodiscard]] float sent(const glm::vec3& way, const Spread& spread) const {
        const float height = glm::dot(way, normal);
        const float squared = glm::dot(way, way) - height * height;
        return std::exp(-0.5F * (squared / spread.along + height * height / spread.through)) /
               (2 * std::numbers::pi_v<float> * spread.along);
    }
    [[nodiscard]] float peak(const Spread& spread) const { return sent(glm::vec3(0), spread); }
    /// The same of its distance in the map.
    [[nodiscard]] float sentAlong(const LinkCell& cell, const Spread& spread) const {
        const float distance = flat(cell);
        return std::exp(-0.5F * distance * distance / spread.along) / (2 * std::numbers::pi_v<float> * spread.along);
    }

    /// Distance in the map, mm in the receiver's own plane.
    [[nodiscard]] float flat(const LinkCell& cell) const {
        const glm::vec2 way = cell.uv - middle.uv;
        return glm::length(way.x * middle.alongU + way.y * middle.alongV);
    }
};

Receiver receiverAt(const LinkCells& cells, const LinkCells::Middle& middle, const LinkOptions& options) {
    const auto usual = static_cast<double>(cells.usualSide(kDestinationLevel));
    const double side = std::min(static_cast<double>(middle.side), kMostSide * usual);
    const double finest = std::min(static_cast<double>(middle.side), kMostFelt * usual) / (1 << kDestinationLevel);
    const auto left = [&](double variance) {
        const double along = std::max({variance - kReceived * side * side, kLeast * variance, kFelt * finest * finest});
        return Spread{.along = static_cast<float>(along), .through = static_cast<float>(std::max(along, variance))};
    };
    const glm::vec3 across = glm::cross(middle.alongU, middle.alongV);
    const float length = glm::length(across);
    Receiver receiver{
        .middle = middle, .normal = length > 0 ? across / length : glm::vec3(0), .spreads = {}, .fourth = left(options.fourth)};
    receiver.fourthReach = static_cast<float>(kReach) * std::sqrt(receiver.fourth.through);
    float widest = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        receiver.spreads[i] = left(options.variances[i]);
        widest = std::max(widest, receiver.spreads[i].through);
    }
    receiver.reach = static_cast<float>(kReach) * std::sqrt(widest);
    return receiver;
}

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
                const Receiver receiver = receiverAt(cells_, *middle, options_);
                for (int i = 0; i < LinkCells::side(top) * LinkCells::side(top); ++i)
                    addMissed(receiver, top, i % LinkCells::side(top), i / LinkCells::side(top), missed);
            }
        brings_ = missed.sent > kSentOverTaken * missed.taken;
    }
    [[nodiscard]] bool bringsFourth() const { return brings_; }

    /// Means of the Gaussians over a cell, 1/mm^2.
    [[nodiscard]] std::array<double, 2> means(const Receiver& receiver, const LinkSource& cell) const {
        std::array<double, 2> sum{};
        add(receiver, cell.level, cell.x, cell.y, sum);
        const auto area = static_cast<double>(cells_.at(cell.level, cell.x, cell.y).area);
        return {sum[0] / area, sum[1] / area};
    }

    [[nodiscard]] Gathered at(const Receiver& receiver) const {
        Gathered gathered;
        const int top = kLinkLevels - 1;
        for (int y = 0; y < LinkCells::side(top); ++y)
            for (int x = 0; x < LinkCells::side(top); ++x)
                visit(receiver, top, x, y, gathered);
        return gathered;
    }

private:
    void visit(const Receiver& receiver, int level, int x, int y, Gathered& gathered) const {
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        const glm::vec3 way = cell.place - receiver.middle.place;
        const float distance = glm::length(way);
        if (distance - cell.radius > receiver.reach) return;
        const float extent = std::numbers::sqrt2_v<float> * cell.radius;
        float allowed = static_cast<float>(options_.nearest) + static_cast<float>(options_.growth) * std::max(distance - cell.radius, 0.0F);
        if (brings_ && misses(receiver, cell, way))
            allowed = std::min(allowed, static_cast<float>(kMissedSource) * std::sqrt(receiver.fourth.along));
        if (level > 0 && extent > allowed) {
            for (int i = 0; i < 4; ++i)
                visit(receiver, level - 1, 2 * x + i % 2, 2 * y + i / 2, gathered);
            return;
        }
        emit(receiver, level, x, y, gathered);
    }

    void emit(const Receiver& receiver, int level, int x, int y, Gathered& gathered) const {
        Link link{
            .level = static_cast<std::uint8_t>(level), .index = static_cast<std::uint32_t>(y * LinkCells::side(level) + x), .weight = {}};
        std::array<double, 2> sum{};
        add(receiver, level, x, y, sum);
        for (std::size_t i = 0; i < 2; ++i)
            gathered.whole[i] += sum[i];
        link.weight = {static_cast<float>(sum[0]), static_cast<float>(sum[1])};
        gathered.links.push_back(link);
    }

    /// The cell, or its parts where it is large: all as fine as each other, for a Gaussian's sum over a grid is exact, over a mixed one
    /// not.
    void add(const Receiver& receiver, int level, int x, int y, std::array<double, 2>& sum) const {
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        if (level > 0 && cell.radius * std::numbers::sqrt2_v < float >> fine_) {
            for (int i = 0; i < 4; ++i)
                add(receiver, level - 1, 2 * x + i % 2, 2 * y + i / 2, sum);
            return;
        }
        const glm::vec3 way = cell.place - receiver.middle.place;
        for (std::size_t i = 0; i < 2; ++i)
            sum[i] += cell.area * receiver.sent(way, receiver.spreads[i]);
        if (!brings_) return;
        Missed missed;
        addMissed(receiver, level, x, y, missed);
        sum[0] += options_.fourthShare * (missed.sent - missed.taken);
    }

    /// What a pyramid misses of the fourth Gaussian from a cell, and takes from it that it should not.
    void addMissed(const Receiver& receiver, int level, int x, int y, Missed& missed) const {
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

    static bool misses(const Receiver& receiver, const LinkCell& cell, const glm::vec3& way) {
        return std::abs(unseen(receiver, cell, way)) > kMissed * receiver.peak(receiver.fourth);
    }

    /// What a pyramid misses of the fourth Gaussian, 1/mm^2: it takes the distance in the map, in the receiver's own plane, for that in
    /// space. Below 0 for what is near in the map only.
    [[nodiscard]] static double unseen(const Receiver& receiver, const LinkCell& cell, const glm::vec3& way) {
        return receiver.sent(way, receiver.fourth) - receiver.sentAlong(cell, receiver.fourth);
    }

    const LinkCells& cells_;
    const LinkOptions& options_;
    bool brings_ = false;
    float fine_ = 0;
    float finest_ = 0; // the same of the fourth Gaussian
};

/// Leaves out the least links.
void leaveOut(std::vector<Link>& links, const LinkOptions& options) {
    const auto worth = [&](const Link& link) {
        return std::max(options.weights[0] * link.weight[0] + options.weights[1] * link.weight[1], 0.0);
    };
    std::ranges::sort(links, [&](const Link& a, const Link& b) { return worth(a) > worth(b); });
    double all = 0;
    for (const Link& link : links)
        all += worth(link);
    double left = all;
    std::size_t count = 0;
    while (count < links.size() && count < kMostLinks && left > options.lost * all)
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
std::vector<Link> weighed(const LinkCells& cells, const Gatherer& gatherer, const LinkCells::Middle& middle, const LinkOptions& options) {
    const Receiver receiver = receiverAt(cells, middle, options);
    Gathered gathered = gatherer.at(receiver);
    std::vector<Link>& links = gathered.links;
    leaveOut(links, options);
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
    return std::move(links);
}

using Lists = std::vector<std::vector<Link>>;

Lists gatherAll(const Mesh& mesh, const LinkCells& cells, const Gatherer& gatherer, const LinkOptions& options) {
    Lists lists(static_cast<std::size_t>(kLinkSide) * kLinkSide);
    forEachInParallel(
        kLinkSide,
        [&](std::size_t y) {
            for (std::size_t x = 0; x < kLinkSide; ++x) {
                const auto middle = cells.middle(mesh, kDestinationLevel, static_cast<int>(x), static_cast<int>(y), kBeside);
                if (!middle) continue;
                lists[y * kLinkSide + x] = weighed(cells, gatherer, *middle, options);
            }
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

void draw(const Lists& lists, SkinLinks& links) {
    for (const auto& list : lists) {
        links.lists += list.empty() ? 0 : 1;
        links.links += list.size();
        links.longest = std::max(links.longest, list.size());
    }
    links.tiles = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(links.longest)))));
    const int side = links.tiles * kLinkSide;
    links.sheet = {.width = side, .height = side, .channels = 4, .pixels = {}, .metadata = {}};
    links.sheet.pixels.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4, 0.0F);
    for (int y = 0; y < kLinkSide; ++y)
        for (int x = 0; x < kLinkSide; ++x) {
            const auto& list = lists[static_cast<std::size_t>(y) * kLinkSide + static_cast<std::size_t>(x)];
            for (std::size_t k = 0; k < list.size(); ++k) {
                const int tile = static_cast<int>(k);
                const auto texel = texelOf(list[k]);
                for (int c = 0; c < 4; ++c)
                    links.sheet.at(tile % links.tiles * kLinkSide + x, tile / links.tiles * kLinkSide + y, c) =
                        texel[static_cast<std::size_t>(c)];
            }
        }
    // The last texel of all says how many tiles there are, and whether the fourth Gaussian comes along, in place of the last link of a
    // corner.
    const std::array<float, 4> last = {static_cast<float>(links.tiles), links.fourth ? 1.0F : 0.0F, 0, 0};
    for (int c = 0; c < 4; ++c)
        links.sheet.at(side - 1, side - 1, c) = last[static_cast<std::size_t>(c)];
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
    const Lists lists = gatherAll(mesh, cells, gatherer, options);
    links.seconds.links = watch.lap();
    links.fourth = gatherer.bringsFourth();
    links.sideMm = static_cast<double>(cells.usualSide(kDestinationLevel));
    draw(lists, links);
    links.seconds.sheet = watch.lap();
    return links;
}

} // namespace tegument
