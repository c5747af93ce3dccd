// Simplification by meshoptimizer or on half-edges. docs/meshprep.md has both measured.

#include "meshprep/prepare/levels.h"

#include "host/support/parallel.h"
#include "meshprep/prepare/local_vertices.h"
#include "meshprep/prepare/manifold_levels.h"
#include "meshprep/prepare/simplify.h"
#include "meshprep/prepare/unit_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>

namespace tegument::prep {

namespace {

constexpr std::size_t kStep = 4;         // as the levels of the Stanford scans, 4.2 on average
constexpr double kLeastReduction = 0.75; // a level that keeps more of the one before is not worth its bytes

using Indices = std::vector<std::uint32_t>;

constexpr std::size_t kMostMatched = 4'000'000; // parts times triangles: 16 MB

bool tooNear(std::size_t indices, std::size_t ofTheOneBefore) {
    return static_cast<double>(indices) > kLeastReduction * static_cast<double>(ofTheOneBefore);
}

/// Where each part's triangles end in a list that has lost some and kept their order: so that as many corners as can be are vertices of
/// their part.
std::vector<std::size_t> endsOfParts(const Mesh& mesh, const Indices& coarse) {
    const std::size_t count = coarse.size() / 3;
    std::vector<Indices> begins;                     // of each part, by where it ends: where it begins at best
    std::vector<std::int64_t> corners(count + 1, 0); // that are right of so many triangles, at best
    std::vector<std::uint8_t> has(mesh.positions.size());
    for (const MeshPart& part : mesh.parts) {
        std::ranges::fill(has, 0);
        for (const std::uint32_t index : std::span(mesh.indices).subspan(part.firstIndex, part.indexCount))
            has[index] = 1;
        Indices& begin = begins.emplace_back(count + 1, 0);
        std::int64_t own = 0; // of the part's, from the first triangle on
        std::int64_t best = 0;
        for (std::uint32_t end = 1; end <= count; ++end) {
            const std::uint32_t* t = &coarse[3 * std::size_t{end - 1}];
            own += has[t[0]] + has[t[1]] + has[t[2]];
            begin[end] = begin[end - 1];
            if (begins.size() > 1 && corners[end] - own > best) { // the first part begins at the first triangle
                best = corners[end] - own;
                begin[end] = end;
            }
            corners[end] = best + own;
        }
    }
    std::vector<std::size_t> ends(mesh.parts.size(), count);
    for (std::size_t part = ends.size() - 1; part > 0; --part)
        ends[part - 1] = begins[part][ends[part]];
    return ends;
}

/// Every part's vertices are its own for the simplifier: where parts meet it sees a seam, moves both sides at once and opens no gap. So all
/// parts are simplified together, and each loses what it can spare.
class WholeMesh {
public:
    explicit WholeMesh(const Mesh& mesh) : mesh_(mesh) {
        const std::vector<glm::vec3> unit = atUnitSize(mesh.positions);
        LocalVertices local(mesh.positions.size());
        for (std::uint32_t part = 0; part < mesh.parts.size(); ++part) {
            const auto own = std::span(mesh.indices).subspan(mesh.parts[part].firstIndex, mesh.parts[part].indexCount);
            const auto first = static_cast<std::uint32_t>(original_.size());
            for (const std::uint32_t index : local.enter(own))
                indices_.push_back(first + index);
            original_.insert(original_.end(), local.global().begin(), local.global().end());
            part_.resize(original_.size(), part);
        }
        for (const std::uint32_t vertex : original_) {
            positions_.push_back(unit[vertex]);
            if (!mesh.normals.empty()) attributes_.push_back(attributesOf(vertex));
        }
        std::vector<std::uint8_t> seen(mesh.positions.size(), 0);
        for (const std::uint32_t vertex : original_)
            shares_ = shares_ || seen[vertex]++ != 0;
    }

    /// Whether parts have vertices in common, and few enough triangles would be left to find theirs again.
    [[nodiscard]] bool mayBeOne(std::size_t triangles) const { return shares_ && mesh_.parts.size() * triangles <= kMostMatched; }

    /// In the vertices' own numbers, as what follows.
    [[nodiscard]] const Indices& full() const { return indices_; }

    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }

    [[nodiscard]] Indices simplified(std::span<const std::uint32_t> from, std::size_t triangles, Simplifier simplifier = {},
                                     std::set<std::uint32_t> locked = {}) const {
        return simplify({.from = from,
                         .positions = positions_,
                         .attributes = attributes_,
                         .counted = mesh_.uvs.empty() ? 3u : 5u,
                         .triangles = triangles,
                         .locked = std::move(locked)},
                        simplifier);
    }

    /// As users of the library have it who do not know of parts: a vertex of several is one, and borders of parts hold nothing. What is
    /// left is in the order in which it came, so that the parts are found again.
    [[nodiscard]] Indices simplifiedAsOne(std::size_t triangles, Simplifier simplifier) const {
        const std::vector<glm::vec3> unit = atUnitSize(mesh_.positions);
        std::vector<SimplifiedAttributes> attributes;
        for (std::uint32_t vertex = 0; vertex < mesh_.normals.size(); ++vertex)
            attributes.push_back(attributesOf(vertex));
        const Indices coarse = simplify({.from = mesh_.indices,
                                         .positions = unit,
                                         .attributes = attributes,
                                         .counted = mesh_.uvs.empty() ? 3u : 5u,
                                         .triangles = triangles},
                                        simplifier);
        return toParts(coarse);
    }

    /// Each part loses the same share, and keeps its borders.
    [[nodiscard]] Indices partByPart(std::size_t triangles) const {
        Indices coarse;
        std::size_t first = 0;
        for (const MeshPart& part : mesh_.parts) {
            const auto own = std::span(indices_).subspan(first, part.indexCount);
            first += part.indexCount;
            const std::size_t target = part.indexCount / 3 * triangles / (indices_.size() / 3);
            const Indices simple = simplify({.from = own, .positions = positions_, .triangles = target, .keepBorders = true});
            coarse.insert(coarse.end(), simple.begin(), simple.end());
        }
        return coarse;
    }

    [[nodiscard]] MeshLevel level(const Indices& coarse) const {
        std::vector<Indices> ofPart(mesh_.parts.size());
        for (std::size_t i = 0; i < coarse.size(); i += 3)
            for (std::size_t k = i; k < i + 3; ++k)
                ofPart[part_[coarse[i]]].push_back(original_[coarse[k]]);
        MeshLevel level;
        for (std::size_t part = 0; part < ofPart.size(); ++part)
            addPart(level, mesh_.parts[part], ofPart[part]);
        return level;
    }

    static void addPart(MeshLevel& level, const MeshPart& from, const Indices& own) {
        if (own.empty()) return;
        level.parts.push_back({.name = from.name,
                               .firstIndex = static_cast<std::uint32_t>(level.indices.size()),
                               .indexCount = static_cast<std::uint32_t>(own.size()),
                               .material = from.material});
        level.indices.insert(level.indices.end(), own.begin(), own.end());
    }

private:
    [[nodiscard]] SimplifiedAttributes attributesOf(std::uint32_t vertex) const {
        const glm::vec3& n = mesh_.normals[vertex];
        const glm::vec2 uv = mesh_.uvs.empty() ? glm::vec2(0) : mesh_.uvs[vertex];
        return {n.x, n.y, n.z, uv.x, uv.y};
    }

    /// Own numbers of triangles in the mesh's, which are in the order of its parts: a triangle's first corner is one of its part, and those
    /// that its part does not have are another one's.
    [[nodiscard]] Indices toParts(const Indices& coarse) const {
        const std::vector<std::size_t> ends = endsOfParts(mesh_, coarse);
        std::vector<std::uint32_t> number(mesh_.positions.size(), 0);
        for (std::uint32_t own = 0; own < original_.size(); ++own)
            number[original_[own]] = own;
        Indices out;
        std::uint32_t own = 0;
        for (std::uint32_t part = 0, triangle = 0; part < ends.size(); ++part) {
            for (; own < original_.size() && part_[own] == part; ++own)
                number[original_[own]] = own;
            for (; triangle < ends[part]; ++triangle) {
                std::array<std::uint32_t, 3> t{};
                std::ranges::transform(std::span(coarse).subspan(3 * std::size_t{triangle}, 3), t.begin(),
                                       [&](std::uint32_t corner) { return number[corner]; });
                const auto first = std::ranges::find(t, part, [&](std::uint32_t corner) { return part_[corner]; });
                if (first != t.end()) std::rotate(t.begin(), first, t.end());
                out.insert(out.end(), t.begin(), t.end());
            }
        }
        return out;
    }

    const Mesh& mesh_;
    Indices indices_;
    bool shares_ = false;
    std::vector<std::uint32_t> original_; // vertex of the mesh
    std::vector<std::uint32_t> part_;     // of each vertex
    std::vector<glm::vec3> positions_;
    std::vector<SimplifiedAttributes> attributes_;
};

/// Part by part on half-edges, which know the full surface from level to level; parts that are no manifold go to meshoptimizer.
class ByHalfEdges {
public:
    explicit ByHalfEdges(const Mesh& mesh) : mesh_(mesh), positions_(atUnitSize(mesh.positions)), part_(positions_.size()) {
        for (const MeshPart& part : mesh.parts) {
            const Indices& indices = part_.enter(trianglesOf(part));
            simplifiers_.push_back(ManifoldSimplifier::make(indices, part_.gathered(positions_), mesh.parts.size() > 1));
            global_.push_back(simplifiers_.back() ? part_.global() : Indices());
            leftOver_ += !simplifiers_.back();
        }
    }

    /// Of each part the same share; in the order from fine to coarse.
    MeshLevel simplified(std::size_t triangles) {
        MeshLevel level;
        const double share = static_cast<double>(triangles) / (static_cast<double>(mesh_.indices.size()) / 3);
        for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
            const auto target = static_cast<std::size_t>(share * mesh_.parts[i].indexCount / 3);
            WholeMesh::addPart(level, mesh_.parts[i],
                               simplifiers_[i] ? inMesh(simplifiers_[i]->reduceTo(target), global_[i]) : simplifyPart(i, target));
        }
        return level;
    }

    [[nodiscard]] std::size_t leftOver() const { return leftOver_; }

private:
    [[nodiscard]] std::span<const std::uint32_t> trianglesOf(const MeshPart& part) const {
        return std::span(mesh_.indices).subspan(part.firstIndex, part.indexCount);
    }

    Indices simplifyPart(std::size_t part, std::size_t target) {
        const Indices& indices = part_.enter(trianglesOf(mesh_.parts[part]));
        const std::vector<glm::vec3> positions = part_.gathered(positions_);
        Indices coarse = simplify({.from = indices, .positions = positions, .triangles = target, .keepBorders = mesh_.parts.size() > 1});
        return inMesh(std::move(coarse), part_.global());
    }

    static Indices inMesh(Indices indices, const std::vector<std::uint32_t>& global) {
        for (std::uint32_t& index : indices)
            index = global[index];
        return indices;
    }

    const Mesh& mesh_;
    std::vector<glm::vec3> positions_;
    LocalVertices part_;
    std::vector<std::unique_ptr<ManifoldSimplifier>> simplifiers_; // null: left to meshoptimizer
    std::vector<std::vector<std::uint32_t>> global_;               // vertex of the mesh, by the simplifier's number
    std::size_t leftOver_ = 0;
};

/// For each level so many triangles are simplified and judged, that is in some two seconds of one processor. Small meshes are tried
/// often.
constexpr std::size_t kTrianglesTried = 1'000'000;
constexpr std::size_t kMostTries = 90;
constexpr std::size_t kLeastWays = 5;            // before the first is mended
constexpr std::size_t kLikeliest = 4;            // of the ways
constexpr std::size_t kMostMended = 12;          // simplifiers whose levels are: those that were further off before seldom win
constexpr std::size_t kMostPartsForChoice = 256; // part by part, the time grows with parts times vertices

std::size_t triesFor(std::size_t triangles) {
    return std::clamp(kTrianglesTried / std::max<std::size_t>(triangles, 1), std::size_t{1}, kMostTries);
}

/// One level of a mesh: the nearest to the full surface of those tried.
class LevelChoice {
public:
    /// `target`: triangles that can be had; what cannot is not forced, for that costs whole limbs.
    LevelChoice(const WholeMesh& whole, const DistanceFrom& distance, std::size_t target, std::size_t tries)
        : whole_(whole), distance_(distance), target_(target), tries_(tries), mostPeaks_(std::max<std::size_t>(4, target / 50)) {}

    struct Way {
        std::function<Indices()> make;
        Simplifier simplifier;
    };

    /// In parallel: the likeliest first, whose best then tells soon what is further off.
    void tryAll(std::vector<Way> all) {
        all.resize(std::min(all.size(), std::max(tries_ / 2, kLeastWays)), all[0]);
        all.resize(std::min(all.size(), tries_), all[0]);
        tries_ -= all.size();
        std::vector<Made> made(all.size());
        const std::size_t likeliest = std::min(kLikeliest, all.size());
        for (const auto& [first, last] : {std::pair(std::size_t{0}, likeliest), std::pair(likeliest, all.size())}) {
            forEachInParallel(last - first, [&, begin = first](std::size_t i) {
                const Way& way = all[begin + i];
                made[begin + i] = judged(way.make(), way.simplifier);
            });
            std::stable_sort(made.begin(), made.begin() + static_cast<std::ptrdiff_t>(last),
                             [](const Made& a, const Made& b) { return a.apart.greatest < b.apart.greatest; });
            for (std::size_t i = 0; i < last; ++i)
                take(made[i]);
        }
        for (const Made& one : made)
            if (std::ranges::find(promising_, one.simplifier) == promising_.end()) promising_.push_back(one.simplifier);
    }

    /// Where the level is furthest off, vertices of the full mesh are kept, and it is made again, as often as tries are left: first by the
    /// simplifiers that came nearest, in turn of all such places and of the furthest alone.
    void mend() {
        constexpr std::size_t kMostRounds = 5;
        if (tries_ == 0) return;
        const std::size_t rounds = std::clamp(tries_ / promising_.size(), std::min(tries_, std::size_t{2}), kMostRounds);
        std::vector<std::vector<Made>> better(std::min({tries_ / rounds, promising_.size(), kMostMended}));
        forEachInParallel(better.size(), [&](std::size_t i) { better[i] = mended(promising_[i], rounds, i % 2 == 0 ? mostPeaks_ : 1); });
        for (std::vector<Made>& all : better)
            for (Made& made : all)
                take(made);
    }

    /// As a user of the library would ask for as many triangles as the best has: what it gives then is never nearer than what is kept.
    void compareWithPlain() {
        const std::size_t count = best_.level.size() / 3;
        std::vector<Simplifier> plain;
        for (const Simplifier& simplifier : simplifiers())
            if (simplifier.version == simplifiers()[0].version && plain.size() < kPlain) plain.push_back(simplifier);
        const bool asOne = whole_.mayBeOne(count);
        if (count == 0 || (count == target_ && !asOne)) return; // that was tried
        std::vector<Made> made(plain.size() * (asOne ? 2 : 1));
        forEachInParallel(made.size(), [&](std::size_t i) {
            const Simplifier& by = plain[i % plain.size()];
            made[i] = judged(i < plain.size() ? whole_.simplified(whole_.full(), count, by) : whole_.simplifiedAsOne(count, by), by);
        });
        for (Made& one : made)
            take(one);
    }

    [[nodiscard]] const Indices& best() const { return best_.level; }

private:
    static constexpr std::size_t kPlain = 2; // with normals and texture coordinates as its documentation says, and by places alone

    struct Made {
        Indices level;
        RoughDistance apart;
        Simplifier simplifier;
    };

    /// Vertices that should have stayed: those far from the level; and where a triangle of the level lies far off, the nearest one.
    /// `most`: peaks, and bridges. `widely`: and all neighbours of that triangle's corners, one of which went too far.
    [[nodiscard]] std::set<std::uint32_t> cause(const Made& made, std::size_t most, bool widely) const {
        std::set<std::uint32_t> vertices;
        for (const std::uint32_t peak : std::span(made.apart.peaks).first(std::min(most, made.apart.peaks.size())))
            vertices.insert(peak);
        std::set<std::uint32_t> corners;
        for (const RoughDistance::Bridge& bridge : std::span(made.apart.bridges).first(std::min(most, made.apart.bridges.size()))) {
            vertices.insert(bridge.nearest);
            if (widely) corners.insert(&made.level[3 * std::size_t{bridge.triangle}], &made.level[3 * std::size_t{bridge.triangle}] + 3);
        }
        const Indices& full = whole_.full();
        for (std::size_t i = 0; !corners.empty() && i < full.size(); i += 3)
            if (corners.contains(full[i]) || corners.contains(full[i + 1]) || corners.contains(full[i + 2]))
                vertices.insert(&full[i], &full[i] + 3);
        return vertices;
    }

    [[nodiscard]] Made judged(Indices level, Simplifier simplifier, TooFar tooFar = TooFar::IsLeft) const {
        RoughDistance apart = distance_.roughly(level, mostPeaks_, best_.apart.greatest, tooFar);
        return {.level = std::move(level), .apart = std::move(apart), .simplifier = simplifier};
    }

    /// Those that are worth a look.
    [[nodiscard]] std::vector<Made> mended(Simplifier simplifier, std::size_t rounds, std::size_t most) const {
        std::vector<Made> better;
        std::set<std::uint32_t> locked = cause(best_, most, false);
        double last = best_.apart.greatest;
        std::size_t before = 0;
        for (std::size_t i = 0; i < rounds && locked.size() > before && 4 * locked.size() <= target_ + 64; ++i) {
            before = locked.size();
            Made made = judged(whole_.simplified(whole_.full(), target_, simplifier, locked), simplifier,
                               i + 1 < rounds ? TooFar::HasPeaks : TooFar::IsLeft);
            locked.merge(cause(made, most, made.apart.greatest >= last));
            last = made.apart.greatest;
            if (last < best_.apart.greatest) better.push_back(std::move(made));
        }
        return better;
    }

    void take(Made& made) {
        const bool fits = !made.level.empty() && made.level.size() <= 3 * target_ + 3 * target_ / 100;
        if (!fits || made.apart.greatest >= best_.apart.greatest) return;
        // Of many that are roughly known the least is likely to be one that was judged too well.
        made.apart.greatest = std::max(made.apart.greatest, distance_.reached(made.level, best_.apart.greatest));
        if (made.apart.greatest < best_.apart.greatest) best_ = made;
    }

    const WholeMesh& whole_;
    const DistanceFrom& distance_;
    std::size_t target_;
    std::size_t tries_; // that are left
    std::size_t mostPeaks_;
    std::vector<Simplifier> promising_; // the one that came nearest first
    Made best_{.level = {}, .apart = {.greatest = std::numeric_limits<double>::infinity(), .peaks = {}, .bridges = {}}, .simplifier = {}};
};

/// The first is likely to be the nearest, and the last the least likely.
std::vector<LevelChoice::Way> waysOf(const Mesh& mesh, const WholeMesh& whole, const Indices& last, std::size_t triangles) {
    std::vector<LevelChoice::Way> ways;
    const auto add = [&](Simplifier simplifier, const Indices& from) {
        ways.push_back({[=, &whole, &from] { return whole.simplified(from, triangles, simplifier); }, simplifier});
    };
    add(simplifiers()[0], whole.full());
    if (!last.empty()) add(simplifiers()[0], last);
    for (const Simplifier& simplifier : simplifiers().subspan(1))
        add(simplifier, whole.full());
    if (mesh.parts.size() == 1 || mesh.parts.size() > kMostPartsForChoice) return ways;
    ways.push_back({[=, &whole] { return whole.partByPart(triangles); }, {}});
    for (const Simplifier& simplifier : whole.mayBeOne(triangles) ? simplifiers() : simplifiers().first(0))
        ways.push_back({[=, &whole] { return whole.simplifiedAsOne(triangles, simplifier); }, simplifier});
    return ways;
}

std::vector<MeshLevel> bestLevels(const Mesh& mesh, const WholeMesh& whole, const std::vector<std::size_t>& targets, std::size_t tries) {
    const DistanceFrom distance(whole.positions(), whole.full());
    std::vector<MeshLevel> levels;
    Indices last;
    for (std::size_t target : targets) {
        const Indices least = whole.simplified(whole.full(), target);
        if (tooNear(least.size(), last.empty() ? whole.full().size() : last.size())) { // and so would be all that follow
            levels.push_back(whole.level(least));
            break;
        }
        if (least.size() / 3 > target + target / 50) target = least.size() / 3 + least.size() / 60;
        LevelChoice choice(whole, distance, target, tries);
        choice.tryAll(waysOf(mesh, whole, last, target));
        choice.mend();
        choice.compareWithPlain();
        last = choice.best();
        levels.push_back(whole.level(last));
    }
    return levels;
}

std::vector<MeshLevel> allLevels(const Mesh& mesh, const std::vector<std::size_t>& targets, LevelMethod method, std::size_t& leftOver) {
    std::vector<MeshLevel> levels(targets.size());
    if (method == LevelMethod::OpenMesh) {
        ByHalfEdges simplifier(mesh);
        leftOver = simplifier.leftOver();
        for (std::size_t i = 0; i < targets.size(); ++i)
            levels[i] = simplifier.simplified(targets[i]);
        return levels;
    }
    const WholeMesh whole(mesh);
    if (const std::size_t tries = triesFor(mesh.indices.size() / 3); tries > 1) return bestLevels(mesh, whole, targets, tries);
    // Each of the one before: a third of the time, and on scans of a million triangles as near to the full surface.
    // The newer one before the newest: nearer than meshoptimizer 1.3 at every level of the Dragon, the newest not at the first.
    const auto newer = std::ranges::find(simplifiers(), Simplifier::Version::Newer, &Simplifier::version);
    const Simplifier& simplifier = newer == simplifiers().end() ? simplifiers()[0] : *newer;
    Indices last = whole.full();
    for (std::size_t i = 0; i < targets.size(); ++i) {
        last = whole.simplified(last, targets[i], simplifier);
        levels[i] = whole.level(last);
    }
    return levels;
}

} // namespace

Levels makeLevels(const Mesh& mesh, int count, LevelMethod method) {
    Levels result;
    std::vector<std::size_t> targets;
    std::size_t target = mesh.indices.size() / 3 / kStep;
    for (int i = 1; i < count && target >= kLeastTriangles; ++i, target /= kStep)
        targets.push_back(target);
    if (static_cast<int>(targets.size()) + 1 < count)
        result.whyEarly = fmt::format("another would have fewer than {} triangles", kLeastTriangles);
    if (targets.empty()) return result;
    std::vector<MeshLevel> levels;
    std::optional<DistanceFrom> distance;
    forEachInParallel(2, [&](std::size_t i) {
        if (i == 0) levels = allLevels(mesh, targets, method, result.leftOver);
        if (i == 1) distance.emplace(mesh.positions, mesh.indices);
    });
    std::size_t last = mesh.indices.size();
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::size_t size = levels[i].indices.size();
        if (size == 0 || tooNear(size, last)) {
            result.whyEarly = size == 0
                                  ? std::string("nothing would be left")
                                  : fmt::format("{} triangles were wanted, {} is the least: the others hold borders, seams or places where "
                                                "several sheets meet",
                                                targets[i], size / 3);
            levels.resize(i);
            break;
        }
        last = size;
    }
    result.levels.resize(levels.size());
    forEachInParallel(levels.size(), [&](std::size_t i) {
        const SurfaceDistance error = distance->to(levels[i].indices);
        levels[i].errorMm = error.greatest;
        result.levels[i] = {.mesh = std::move(levels[i]), .error = error};
    });
    return result;
}

} // namespace tegument::prep
