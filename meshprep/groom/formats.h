#pragma once
// Inside meshprep/groom only: the readers and writers behind readGroom and writeGroom, and what they share. They are given files of any
// bytes: every count, offset and number is held against what is really there.

#include "host/mesh/mesh_file.h"
#include "meshprep/groom/groom.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument::groomfile {

using meshfile::Source;

/// Of the memory that a file may take: so many points for each of its bytes, however often it names the same ones.
inline constexpr std::size_t kPointsOfByte = 2;

/// What a file says of its strands besides what every file says. What a format does not hold is lost, and said.
struct Holds {
    bool widths = false;
    bool colors = false;
    bool rootUvs = false;
    bool numbers = false; // ids, guides and clumps
    bool splines = false;
    bool units = false; // and the axis that is up
};

struct GroomFormat {
    std::string_view extension; // ".hair"
    std::string_view name;
    Result<Groom> (*read)(const Source& source, std::size_t frame);
    std::string (*write)(const Groom& groom); // in the format's unit, y up, unless it holds units; empty: beyond what it can count
    double unitMm;                            // of a file that does not say
    Holds holds;
};

[[nodiscard]] Result<Groom> readHair(const Source& source, std::size_t frame);
[[nodiscard]] Result<Groom> readTfx(const Source& source, std::size_t frame);
[[nodiscard]] Result<Groom> readGltfLines(const Source& source, std::size_t frame);
[[nodiscard]] Result<Groom> readObjLines(const Source& source, std::size_t frame);
[[nodiscard]] Result<Groom> readPlyEdges(const Source& source, std::size_t frame);
[[nodiscard]] Result<Groom> readUsda(const Source& source, std::size_t frame);
[[nodiscard]] Result<Groom> readAlembic(const Source& source, std::size_t frame);

[[nodiscard]] std::string writeHair(const Groom& groom);
[[nodiscard]] std::string writeTfx(const Groom& groom);
[[nodiscard]] std::string writeGltfLines(const Groom& groom);
[[nodiscard]] std::string writeObjLines(const Groom& groom);
[[nodiscard]] std::string writePlyEdges(const Groom& groom);
[[nodiscard]] std::string writeUsda(const Groom& groom);
[[nodiscard]] std::string writeAlembic(const Groom& groom);

/// A warning that something of the file is not read: TG5323.
void ignored(Groom& groom, const Source& source, std::string text, std::string hint = {});

/// A number of a binary file, little-endian as this machine is. The caller has seen that it is there.
template <class T>
T numberAt(std::string_view bytes, std::size_t offset) {
    T value{};
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// So many from there on; TG5303 where the file does not hold them.
template <class T>
Result<std::vector<T>> arrayAt(const Source& source, std::size_t offset, std::size_t count, const char* what) {
    const std::size_t left = offset < source.bytes.size() ? source.bytes.size() - offset : 0;
    if (count > left / sizeof(T))
        return meshfile::overclaimed(source.atByte(std::min(offset, source.bytes.size())),
                                     std::to_string(count) + " " + what + " cannot be held by the " + std::to_string(left) +
                                         " bytes that are left");
    std::vector<T> values(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), source.bytes.data() + offset, count * sizeof(T));
    return values;
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Edges between vertices, in any order, to chains of vertices: `visit(chain)` for each, from the end with the lower number, in the order
/// of these. At a vertex of more than two edges chains end. Returns how many edges stand in rings, of which nothing is visited.
template <class Visit>
std::size_t chains(std::span<const std::pair<std::uint32_t, std::uint32_t>> edges, std::size_t vertices, Visit&& visit) {
    std::vector<std::uint32_t> firstEdge(vertices + 1, 0); // of each vertex, in `edgesOf`
    for (const auto& [a, b] : edges) {
        ++firstEdge[a];
        ++firstEdge[b];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& count : firstEdge)
        sum += std::exchange(count, sum);
    std::vector<std::uint32_t> edgesOf(2 * edges.size());
    std::vector<std::uint32_t> next(firstEdge.begin(), firstEdge.end() - 1);
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        edgesOf[next[edges[i].first]++] = i;
        edgesOf[next[edges[i].second]++] = i;
    }
    const auto degree = [&](std::uint32_t v) { return firstEdge[v + 1] - firstEdge[v]; };
    std::vector<bool> taken(edges.size(), false);
    std::size_t left = edges.size();
    std::vector<std::uint32_t> chain;
    for (std::uint32_t start = 0; start < vertices; ++start) {
        if (degree(start) == 2) continue;
        for (std::uint32_t at = firstEdge[start]; at < firstEdge[start + 1]; ++at) {
            std::uint32_t edge = edgesOf[at];
            if (taken[edge]) continue;
            chain.assign(1, start);
            while (true) {
                taken[edge] = true;
                --left;
                const std::uint32_t here = edges[edge].first == chain.back() ? edges[edge].second : edges[edge].first;
                chain.push_back(here);
                if (degree(here) != 2) break;
                edge = edgesOf[firstEdge[here]] == edge ? edgesOf[firstEdge[here] + 1] : edgesOf[firstEdge[here]];
                if (taken[edge]) break;
            }
            visit(std::span<const std::uint32_t>(chain));
        }
    }
    return left;
}

/// Values of a strand's ends of spans, if its spline has them: a file may say them there alone.
[[nodiscard]] std::size_t spanEnds(const Groom& groom, std::size_t strand);

/// Values for each point of the groom, whatever they are told for: all of it, each strand, ends of spans, or points. Nothing where their
/// number fits none of these.
template <class Value>
std::optional<std::vector<Value>> toPoints(const Groom& groom, std::vector<Value> values) {
    if (values.size() == groom.points.size()) return values;
    std::size_t ends = 0;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        ends += spanEnds(groom, i);
    const bool varying = values.size() == ends && values.size() != groom.strands();
    if (values.size() != 1 && values.size() != groom.strands() && !varying) return std::nullopt;
    std::vector<Value> all;
    all.reserve(groom.points.size());
    std::size_t from = 0;
    for (std::size_t i = 0; i < groom.strands(); ++i) {
        const std::size_t count = varying ? spanEnds(groom, i) : 1;
        const float step = groom.spline == Spline::Bezier ? 1.0F / 3.0F : 1.0F;
        const float begin = groom.spline == Spline::BSpline || groom.spline == Spline::CatmullRom ? (groom.pinned ? 0.0F : -1.0F) : 0.0F;
        for (std::size_t k = 0; k < groom.length(i); ++k) {
            const float place = std::clamp(begin + step * static_cast<float>(k), 0.0F, static_cast<float>(count - 1));
            const auto before = std::min(static_cast<std::size_t>(place), count - 1);
            const Value& a = values[from + before];
            const Value& b = values[from + std::min(before + 1, count - 1)];
            all.push_back(a + (b - a) * (place - static_cast<float>(before)));
        }
        if (values.size() > 1) from += count;
    }
    return all;
}

/// Likewise for each strand: what is told for its points is the root's.
template <class Value>
std::optional<std::vector<Value>> toStrands(const Groom& groom, std::vector<Value> values) {
    if (values.size() == groom.strands()) return values;
    if (values.size() == 1) return std::vector<Value>(groom.strands(), values.front());
    if (values.size() != groom.points.size()) return std::nullopt;
    std::vector<Value> roots;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        roots.push_back(values[groom.first[i]]);
    return roots;
}

/// Moves a strand's points, and scales its widths likewise.
void transform(Groom& groom, const glm::dmat4& matrix);
/// Adds the strands of another: of different splines both become chains of points, and what one of them does not say goes, with a warning.
void merge(Groom& groom, Groom other, const Source& source);

} // namespace tegument::groomfile
