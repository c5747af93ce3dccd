#include "meshprep/skin/skin_links.h"

#include "host/support/parallel.h"
#include "meshprep/skin/link_cells.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace tegument {

namespace {

/// Variances along each axis in squares of a texel's side: a texel's light is interpolated between texels by a quadratic B-spline; a source
/// is a texel of the pyramid, whose light comes from its square and somewhat beyond (docs/modules/Pyramid.md has both measured).
constexpr double kReceived = 0.25;
constexpr double kSent = 0.6;
/// What the above leaves of a Gaussian: at least this share.
constexpr double kLeast = 0.35;
/// Widths of the widest Gaussian within which sources count: 3 leave out 1.1 %.
constexpr double kReach = 3.0;
/// A source is taken apart to find its weight where its side is more than this share of the narrower Gaussian's width.
constexpr double kFineShare = 0.75;
/// Texels beside the charts that have lists too, as if the surface went on: as far as interpolation asks.
constexpr int kBeside = 2;
/// A texel counts as at most so many usual ones along a side.
constexpr double kMostSide = 1.5;
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

class Gatherer {
public:
    Gatherer(const LinkCells& cells, const LinkOptions& options) : cells_(cells), options_(options) {
        reach_ = static_cast<float>(kReach * std::sqrt(std::max(options.variances[0], options.variances[1])));
        for (int level = 0; level < kLinkLevels; ++level)
            if (level == 0 || static_cast<double>(cells.usualSide(level)) <= options.nearest)
                sent_ = static_cast<double>(cells.usualSide(level));
        fine_ = static_cast<float>(kFineShare * std::sqrt(std::min(options.variances[0], options.variances[1])));
    }

    /// `side`: of the texel that receives, mm.
    [[nodiscard]] Gathered at(const glm::vec3& place, double side) const {
        Gathered gathered;
        const int top = kLinkLevels - 1;
        for (int y = 0; y < LinkCells::side(top); ++y)
            for (int x = 0; x < LinkCells::side(top); ++x)
                visit(place, side, top, x, y, gathered);
        return gathered;
    }

private:
    void visit(const glm::vec3& place, double side, int level, int x, int y, Gathered& gathered) const {
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        const float distance = glm::length(cell.place - place);
        if (distance - cell.radius > reach_) return;
        const float extent = std::numbers::sqrt2_v<float> * cell.radius;
        const float allowed =
            static_cast<float>(options_.nearest) + static_cast<float>(options_.growth) * std::max(distance - cell.radius, 0.0F);
        if (level > 0 && extent > allowed) {
            for (int i = 0; i < 4; ++i)
                visit(place, side, level - 1, 2 * x + i % 2, 2 * y + i / 2, gathered);
            return;
        }
        emit(place, side, level, x, y, gathered);
    }

    void emit(const glm::vec3& place, double side, int level, int x, int y, Gathered& gathered) const {
        Link link{
            .level = static_cast<std::uint8_t>(level), .index = static_cast<std::uint32_t>(y * LinkCells::side(level) + x), .weight = {}};
        std::array<double, 2> narrower{};
        for (std::size_t i = 0; i < 2; ++i)
            narrower[i] = std::max(options_.variances[i] - kReceived * side * side - kSent * sent_ * sent_, kLeast * options_.variances[i]);
        std::array<double, 2> sum{};
        add(place, level, x, y, narrower, sum, gathered.whole);
        link.weight = {static_cast<float>(sum[0]), static_cast<float>(sum[1])};
        gathered.links.push_back(link);
    }

    /// The cell, or its parts where it is large.
    void add(const glm::vec3& place, int level, int x, int y, const std::array<double, 2>& narrower, std::array<double, 2>& sum,
             std::array<double, 2>& whole) const {
        const LinkCell& cell = cells_.at(level, x, y);
        if (!(cell.area > 0)) return;
        if (level > 0 && cell.radius * std::numbers::sqrt2_v < float >> fine_) {
            for (int i = 0; i < 4; ++i)
                add(place, level - 1, 2 * x + i % 2, 2 * y + i / 2, narrower, sum, whole);
            return;
        }
        const glm::vec3 offset = cell.place - place;
        const float squared = glm::dot(offset, offset);
        for (std::size_t i = 0; i < 2; ++i) {
            sum[i] += cell.area * gaussian(squared, narrower[i]);
            whole[i] += cell.area * gaussian(squared, narrower[i]);
        }
    }

    static float gaussian(float squared, double variance) {
        const auto v = static_cast<float>(2 * variance);
        return std::exp(-squared / v) / (std::numbers::pi_v<float> * v);
    }

    const LinkCells& cells_;
    const LinkOptions& options_;
    float reach_ = 0;
    float fine_ = 0;
    double sent_ = 0; // side of the sources that are near, mm
};

/// Leaves out the least links, and scales the rest up to the whole; of the wider Gaussian with what lies beyond the reach.
std::vector<Link> kept(Gathered gathered, const LinkOptions& options) {
    const auto worth = [&](const Link& link) { return options.weights[0] * link.weight[0] + options.weights[1] * link.weight[1]; };
    std::vector<Link>& links = gathered.links;
    std::ranges::sort(links, [&](const Link& a, const Link& b) { return worth(a) > worth(b); });
    double all = 0;
    for (const Link& link : links)
        all += worth(link);
    double left = all;
    std::size_t count = 0;
    while (count < links.size() && count < kMostLinks && left > options.lost * all)
        left -= worth(links[count++]);
    links.resize(count);
    for (std::size_t i = 0; i < 2; ++i) {
        double sum = 0;
        for (const Link& link : links)
            sum += link.weight[i];
        const double reached = i == 1 ? 1 - std::exp(-kReach * kReach / 2) : 1;
        const auto scale = static_cast<float>(sum > 0 ? gathered.whole[i] / (sum * reached) : 0);
        for (Link& link : links)
            link.weight[i] = std::max(link.weight[i] * scale, kTinyWeight);
    }
    // Neighbouring texels then read neighbouring sources at the same time.
    std::ranges::sort(links, [](const Link& a, const Link& b) { return std::pair(a.level, a.index) < std::pair(b.level, b.index); });
    return std::move(links);
}

using Lists = std::vector<std::vector<Link>>;

Lists gatherAll(const Mesh& mesh, const LinkCells& cells, const LinkOptions& options) {
    const Gatherer gatherer(cells, options);
    Lists lists(static_cast<std::size_t>(kLinkSide) * kLinkSide);
    const auto usual = static_cast<double>(cells.usualSide(kDestinationLevel));
    forEachInParallel(
        kLinkSide,
        [&](std::size_t y) {
            for (std::size_t x = 0; x < kLinkSide; ++x) {
                const auto middle = cells.middle(mesh, kDestinationLevel, static_cast<int>(x), static_cast<int>(y), kBeside);
                if (!middle) continue;
                const double side = std::min(static_cast<double>(middle->side), kMostSide * usual);
                lists[y * kLinkSide + x] = kept(gatherer.at(middle->place, side), options);
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
    // The last texel of all says how many tiles there are, in place of the last link of a corner.
    const std::array<float, 4> last = {static_cast<float>(links.tiles), 0, 0, 0};
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
    const Lists lists = gatherAll(mesh, cells, options);
    links.seconds.links = watch.lap();
    links.sideMm = static_cast<double>(cells.usualSide(kDestinationLevel));
    draw(lists, links);
    links.seconds.sheet = watch.lap();
    return links;
}

} // namespace tegument
