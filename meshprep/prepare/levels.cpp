// Simplification by meshoptimizer or on half-edges. docs/meshprep.md has both measured.

#include "meshprep/prepare/levels.h"

#include "host/support/parallel.h"
#include "meshprep/prepare/centre.h"
#include "meshprep/prepare/manifold_levels.h"
#include "meshprep/prepare/simplify.h"
#include "meshprep/prepare/vertices.h"
#include "meshprep/prepare/whole_mesh.h"

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

bool tooNear(std::size_t indices, std::size_t ofTheOneBefore) {
    return static_cast<double>(indices) > kLeastReduction * static_cast<double>(ofTheOneBefore);
}

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
constexpr std::size_t kMostMended = 12;          // weights whose levels are: those that were further off before seldom win
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
        float normals = 0; // the weight that it was made with
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
                made[begin + i] = judged(way.make(), way.normals);
            });
            std::stable_sort(made.begin(), made.begin() + static_cast<std::ptrdiff_t>(last),
                             [](const Made& a, const Made& b) { return a.apart.greatest < b.apart.greatest; });
            for (std::size_t i = 0; i < last; ++i)
                take(made[i]);
        }
        for (const Made& one : made)
            if (std::ranges::find(promising_, one.normals) == promising_.end()) promising_.push_back(one.normals);
    }

    /// Where the level is furthest off, vertices of the full mesh are kept, and it is made again, as often as tries are left: first by the
    /// weights that came nearest, in turn of all such places and of the furthest alone.
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
        const bool asOne = whole_.mayBeOne(count);
        if (count == 0 || (count == target_ && !asOne)) return; // that was tried
        std::vector<Made> made(kPlain * (asOne ? 2 : 1));
        forEachInParallel(made.size(), [&](std::size_t i) {
            const float by = kNormalWeights[i % kPlain];
            made[i] = judged(i < kPlain ? whole_.simplified(whole_.full(), count, by) : whole_.simplifiedAsOne(count, by), by);
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
        float normals = 0;
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

    [[nodiscard]] Made judged(Indices level, float normals, TooFar tooFar = TooFar::IsLeft) const {
        RoughDistance apart = distance_.roughly(level, mostPeaks_, best_.apart.greatest, tooFar);
        return {.level = std::move(level), .apart = std::move(apart), .normals = normals};
    }

    /// Those that are worth a look.
    [[nodiscard]] std::vector<Made> mended(float normals, std::size_t rounds, std::size_t most) const {
        std::vector<Made> better;
        std::set<std::uint32_t> locked = cause(best_, most, false);
        double last = best_.apart.greatest;
        std::size_t before = 0;
        for (std::size_t i = 0; i < rounds && locked.size() > before && 4 * locked.size() <= target_ + 64; ++i) {
            before = locked.size();
            Made made = judged(whole_.simplified(whole_.full(), target_, normals, locked), normals,
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
    std::vector<float> promising_; // the one that came nearest first
    Made best_{.apart = {.greatest = std::numeric_limits<double>::infinity()}};
};

/// The first is likely to be the nearest, and the last the least likely.
std::vector<LevelChoice::Way> waysOf(const Mesh& mesh, const WholeMesh& whole, const Indices& last, std::size_t triangles) {
    std::vector<LevelChoice::Way> ways;
    const auto add = [&](float normals, const Indices& from) {
        ways.push_back({[=, &whole, &from] { return whole.simplified(from, triangles, normals); }, normals});
    };
    add(kNormalWeights[0], whole.full());
    if (!last.empty()) add(kNormalWeights[0], last);
    for (const float normals : std::span(kNormalWeights).subspan(1))
        add(normals, whole.full());
    if (mesh.parts.size() == 1 || mesh.parts.size() > kMostPartsForChoice) return ways;
    ways.push_back({[=, &whole] { return whole.partByPart(triangles); }, {}});
    if (!whole.mayBeOne(triangles)) return ways;
    for (const float normals : kNormalWeights)
        ways.push_back({[=, &whole] { return whole.simplifiedAsOne(triangles, normals); }, normals});
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

/// Each level of the one before: a third of the time, and on scans of a million triangles as near to the full surface. The first takes
/// longest: `besideFirst` is done at the same time, and `besideOthers`, which may look at it, beside the others. Whoever makes those helps
/// with that afterwards, so that it is begun by this thread, which could not.
std::vector<MeshLevel> chainedLevels(const WholeMesh& whole, const std::vector<std::size_t>& targets,
                                     const std::function<void()>& besideFirst, const std::function<void(const MeshLevel&)>& besideOthers) {
    std::vector<MeshLevel> levels(targets.size());
    Indices last;
    const auto make = [&](std::size_t i, const Indices& from) {
        last = whole.simplified(from, targets[i], kNormalWeights[0]);
        levels[i] = whole.level(last);
    };
    forEachInParallel(2, [&](std::size_t item) {
        if (item == 0) make(0, whole.full());
        if (item == 1) besideFirst();
    });
    forEachInParallel(2, [&](std::size_t item) {
        if (item == 0) besideOthers(levels[0]);
        for (std::size_t i = 1; item == 1 && i < targets.size(); ++i)
            make(i, Indices(last));
    });
    return levels;
}

std::vector<MeshLevel> levelsByHalfEdges(const Mesh& mesh, const std::vector<std::size_t>& targets, std::size_t& leftOver) {
    std::vector<MeshLevel> levels;
    ByHalfEdges simplifier(mesh);
    leftOver = simplifier.leftOver();
    for (const std::size_t target : targets)
        levels.push_back(simplifier.simplified(target));
    return levels;
}

/// The levels, and how far each is from the full surface.
class LevelsAndErrors {
public:
    LevelsAndErrors(const Mesh& mesh, const std::vector<std::size_t>& targets, LevelMethod method) : mesh_(mesh) {
        if (method == LevelMethod::OpenMesh)
            besideDistance([&] { levels = levelsByHalfEdges(mesh, targets, leftOver); });
        else
            byMeshoptimizer(WholeMesh(mesh), targets);
    }

    std::vector<MeshLevel> levels;
    std::vector<SurfaceDistance> errors; // of each level
    std::size_t leftOver = 0;

private:
    void byMeshoptimizer(const WholeMesh& whole, const std::vector<std::size_t>& targets) {
        const std::size_t tries = triesFor(mesh_.indices.size() / 3);
        if (tries > 1) return besideDistance([&] { levels = bestLevels(mesh_, whole, targets, tries); });
        errors.resize(1);
        levels = chainedLevels(
            whole, targets, [&] { distance_.emplace(mesh_.positions, mesh_.indices); },
            [&](const MeshLevel& first) { errors[0] = distance_->to(first.indices); });
        measure(1);
    }

    /// Levels from this one on.
    void measure(std::size_t first) {
        errors.resize(levels.size());
        forEachInParallel(levels.size() - first, [&](std::size_t i) { errors[first + i] = distance_->to(levels[first + i].indices); });
    }

    void besideDistance(const std::function<void()>& make) {
        forEachInParallel(2, [&](std::size_t item) {
            if (item == 0) make();
            if (item == 1) distance_.emplace(mesh_.positions, mesh_.indices);
        });
        measure(0);
    }

    const Mesh& mesh_;
    std::optional<DistanceFrom> distance_;
};

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
    LevelsAndErrors made(mesh, targets, method);
    std::vector<MeshLevel>& levels = made.levels;
    result.leftOver = made.leftOver;
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
    for (std::size_t i = 0; i < levels.size(); ++i) {
        levels[i].errorMm = told(made.errors[i]);
        result.levels.push_back({.mesh = std::move(levels[i]), .error = made.errors[i]});
    }
    return result;
}

} // namespace tegument::prep
