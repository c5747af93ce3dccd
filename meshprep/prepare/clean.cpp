#include "meshprep/prepare/clean.h"

#include "host/mesh/motion.h"
#include "host/mesh/triangles.h"
#include "host/mesh/welding.h"
#include "host/support/parallel.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace tegument::prep {

namespace {

using Triple = std::array<std::uint32_t, 3>;

Triple pointsOf(const Surface& surface, std::size_t triangle) {
    return {surface.pointAt(3 * triangle), surface.pointAt(3 * triangle + 1), surface.pointAt(3 * triangle + 2)};
}

/// Turned so that the smallest number comes first: equal for triangles that are seen from the same side.
Triple turned(const Triple& t) {
    if (t[0] <= t[1] && t[0] <= t[2]) return t;
    return t[1] <= t[2] ? Triple{t[1], t[2], t[0]} : Triple{t[2], t[0], t[1]};
}

/// Of a mesh that moves: equal where vertices move alike.
std::uint32_t movementOf(const Mesh& mesh, std::uint32_t vertex) {
    return mesh.motion->kinds[mesh.motionVertices[vertex]];
}

/// Numbers for what tells corners apart: place, texture coordinates where there are any, and movement.
std::vector<std::uint32_t> cornerKinds(const Surface& surface) {
    std::vector<std::uint32_t> kinds = surface.point;
    if (!surface.mesh.uvs.empty())
        kinds = firstEqual(kinds.size(), [&](std::uint32_t i) {
            const auto uv = floatKey<2>({surface.mesh.uvs[i].x, surface.mesh.uvs[i].y});
            return std::array{kinds[i], uv[0], uv[1]};
        });
    if (surface.mesh.motion)
        kinds = firstEqual(kinds.size(), [&](std::uint32_t i) { return std::array{kinds[i], movementOf(surface.mesh, i)}; });
    return kinds;
}

/// A triangle as its smallest point sees it.
struct Side {
    std::uint32_t second = 0, third = 0; // after the smallest point
    std::uint32_t triangle = 0;

    bool operator<(const Side& other) const {
        return std::tie(second, third, triangle) < std::tie(other.second, other.third, other.triangle);
    }
};

/// Visits those of each smallest point together, sorted, on all processors. `turnedAt`: a triangle's points, the smallest first.
template <class TurnedAt, class Visit>
void forSidesAtPoints(std::size_t triangles, std::size_t points, TurnedAt turnedAt, Visit visit) {
    const auto count = static_cast<std::uint32_t>(triangles);
    std::vector<std::uint32_t> last(points + 1, 0); // of the sides at each smallest point
    for (std::uint32_t i = 0; i < count; ++i)
        ++last[turnedAt(i)[0] + 1];
    for (std::size_t point = 1; point < last.size(); ++point)
        last[point] += last[point - 1];
    std::vector<Side> sides(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Triple t = turnedAt(i);
        sides[last[t[0]]++] = {.second = t[1], .third = t[2], .triangle = i};
    }
    inChunks(points, 0, [&](std::size_t first, std::size_t end, std::size_t) {
        for (std::size_t point = first; point < end; ++point) {
            const std::uint32_t begin = point == 0 ? 0 : last[point - 1];
            const auto here = std::span(sides).subspan(begin, last[point] - begin);
            std::sort(here.begin(), here.end());
            visit(std::span<const Side>(here));
        }
    });
}

} // namespace

void partOpening(Surface& surface) {
    const Mesh& mesh = surface.mesh;
    if (!mesh.motion) return;
    std::vector<std::uint8_t> opens(surface.pointCount, 0);
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t a = mesh.indices[corner], b = mesh.indices[corner % 3 == 2 ? corner - 2 : corner + 1];
        if (mesh.positions[a] == mesh.positions[b] && movementOf(mesh, a) != movementOf(mesh, b)) opens[surface.point[a]] = 1;
    }
    if (std::ranges::find(opens, 1) == opens.end()) return;
    const std::vector<std::uint32_t> first = firstEqual(surface.point.size(), [&](std::uint32_t i) {
        return std::array{surface.point[i], opens[surface.point[i]] != 0 ? movementOf(mesh, i) : 0U};
    });
    std::vector<bool> taken(surface.pointCount, false); // by the first movement there
    std::vector<std::uint32_t> point(surface.point.size());
    for (std::uint32_t i = 0; i < first.size(); ++i)
        if (first[i] != i) {
            point[i] = point[first[i]];
        } else {
            point[i] = taken[surface.point[i]] ? surface.pointCount++ : surface.point[i];
            taken[surface.point[i]] = true;
        }
    surface.point = std::move(point);
}

std::size_t dropCollapsed(Surface& surface) {
    return keepTriangles(surface.mesh, [&](std::span<const std::uint32_t, 3>, std::size_t triangle) {
        const Triple t = pointsOf(surface, triangle);
        return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    });
}

std::size_t dropDuplicates(Surface& surface) {
    const std::vector<std::uint32_t> kind = cornerKinds(surface);
    const auto turnedAt = [&](std::size_t triangle) {
        const std::uint32_t* t = &surface.mesh.indices[3 * triangle];
        return turned({kind[t[0]], kind[t[1]], kind[t[2]]});
    };
    std::vector<std::uint8_t> again(surface.triangles(), 0);
    forSidesAtPoints(surface.triangles(), surface.mesh.positions.size(), turnedAt, [&](std::span<const Side> here) {
        for (std::size_t i = 1; i < here.size(); ++i)
            again[here[i].triangle] = static_cast<std::uint8_t>(here[i].second == here[i - 1].second && here[i].third == here[i - 1].third);
    });
    return keepTriangles(surface.mesh, [&](std::span<const std::uint32_t, 3>, std::size_t triangle) { return again[triangle] == 0; });
}

std::size_t dropUnreferenced(Surface& surface) {
    const std::size_t before = surface.point.size();
    const std::vector<std::uint32_t> kept = keepReferenced(surface.mesh);
    if (kept.size() == before) return 0;
    std::vector<std::uint32_t> number(surface.pointCount, UINT32_MAX); // places stay numbered without gaps
    std::vector<std::uint32_t> point;
    point.reserve(kept.size());
    surface.pointCount = 0;
    for (const std::uint32_t vertex : kept) {
        std::uint32_t& place = number[surface.point[vertex]];
        if (place == UINT32_MAX) place = surface.pointCount++;
        point.push_back(place);
    }
    surface.point = std::move(point);
    return before - kept.size();
}

std::vector<std::uint32_t> backToBack(const Surface& surface) {
    std::vector<std::uint32_t> other(surface.triangles());
    const auto turnedAt = [&](std::size_t triangle) { return turned(pointsOf(surface, triangle)); };
    forSidesAtPoints(surface.triangles(), surface.pointCount, turnedAt, [&](std::span<const Side> here) {
        for (const Side& side : here) {
            const auto back = std::lower_bound(here.begin(), here.end(), Side{.second = side.third, .third = side.second, .triangle = 0});
            const bool found = back != here.end() && back->second == side.third && back->third == side.second;
            other[side.triangle] = found ? back->triangle : side.triangle;
        }
    });
    return other;
}

} // namespace tegument::prep
