#include "meshprep/order/order.h"

#include "host/support/file.h"
#include "host/support/parallel.h"
#include "meshprep/order/portfolio.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>

namespace tegument::order {

namespace {

constexpr std::size_t kMostFaces = std::size_t{1} << 30; // three corners to a face are still counted in 32 bits

constexpr std::array<std::pair<std::string_view, Method>, 5> kMethods = {{{"lin-yu", Method::LinYu},
                                                                          {"hoppe", Method::Hoppe},
                                                                          {"tipsify", Method::Tipsify},
                                                                          {"meshopt", Method::Meshopt},
                                                                          {"best", Method::Best}}};

/// No branch in between: this goes over the list several indices at once.
std::size_t largest(std::span<const std::uint32_t> indices) {
    std::uint32_t largest = 0;
    for (const std::uint32_t index : indices)
        largest = std::max(largest, index);
    return largest;
}

std::optional<Error> refuse(std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    if (indices.size() % 3 != 0) return inputError(7042, {}, fmt::format("{} indices are no list of triangles", indices.size()));
    if (indices.size() / 3 > kMostFaces)
        return machineError(7043, fmt::format("{} triangles are too many to order", indices.size() / 3), "cut the mesh into parts");
    if (indices.empty() || largest(indices) < vertexCount) return std::nullopt;
    const auto bad = std::ranges::find_if(indices, [&](std::uint32_t index) { return index >= vertexCount; });
    return inputError(7042, {}, fmt::format("triangle {} names vertex {} of {}", (bad - indices.begin()) / 3, *bad, vertexCount));
}

std::vector<std::uint32_t> orderPieces(std::span<const std::uint32_t> indices, std::size_t vertexCount, Method method,
                                       const CacheModel& cache) {
    std::vector<std::uint32_t> out(indices.size());
    const Pieces pieces(indices, vertexCount, Pieces::Cut::Whole); // who names an order wants it as it is
    forEachInParallel(pieces.size(), [&](std::size_t i) { pieces.restore(i, orderPiece(pieces.piece(i), method, cache), out); });
    return out;
}

BestOrder orderedOf(std::span<const std::uint32_t> indices, std::size_t vertexCount, Method method, const CacheModel& cache,
                    std::size_t triangles = 0) {
    if (method == Method::Best) return bestOrder(indices, vertexCount, cache, triangles);
    return {.corners = orderPieces(indices, vertexCount, method, cache), .sortedToo = false};
}

Error noMemory(std::span<const std::uint32_t> indices) {
    return machineError(7043, fmt::format("not enough memory to order {} triangles", indices.size() / 3),
                        "close programs, or reduce the mesh");
}

/// Larger parts are seldom there twice, and would take memory.
constexpr std::size_t kMostKept = std::size_t{3} * 50'000;

/// The corner that a triangle's smallest index is at first, so that triangles that differ by their first corner alone become equal.
std::array<std::uint32_t, 3> canonical(std::span<const std::uint32_t, 3> t) {
    const std::array<std::array<std::uint32_t, 3>, 3> turns = {{{t[0], t[1], t[2]}, {t[1], t[2], t[0]}, {t[2], t[0], t[1]}}};
    return *std::ranges::min_element(turns);
}

std::vector<std::array<std::uint32_t, 3>> sortedTriangles(std::span<const std::uint32_t> indices) {
    std::vector<std::array<std::uint32_t, 3>> triangles(indices.size() / 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        triangles[f] = canonical(indices.subspan(3 * f).first<3>());
    std::ranges::sort(triangles);
    return triangles;
}

} // namespace

Result<Method> parseMethod(std::string_view text) {
    for (const auto& [label, method] : kMethods)
        if (label == text) return method;
    return usageError(7041, fmt::format("'{}' is no order of triangles", text), "write file, lin-yu, hoppe, tipsify, meshopt or best");
}

std::string_view name(Method method) {
    return std::ranges::find(kMethods, method, &std::pair<std::string_view, Method>::second)->first;
}

Result<std::vector<std::uint32_t>> reorder(std::span<const std::uint32_t> indices, std::size_t vertexCount, Method method,
                                           const CacheModel& cache, std::span<const float> places) try {
    if (auto refusal = refuse(indices, vertexCount)) return std::move(*refusal);
    BestOrder ordered = orderedOf(indices, vertexCount, method, cache);
    if (!ordered.sortedToo) return std::move(ordered.corners);
    return betterSorted(std::move(ordered.corners), indices, vertexCount, cache, places);
} catch (const std::bad_alloc&) {
    return noMemory(indices);
}

Result<std::vector<std::uint32_t>> PartsReorder::operator()(std::span<const std::uint32_t> indices, std::size_t vertexCount,
                                                            std::span<const float> places) try {
    if (indices.size() > kMostKept) return reorder(indices, vertexCount, method_, cache_, places);
    if (auto refusal = refuse(indices, vertexCount)) return std::move(*refusal);
    const std::string key =
        fmt::format("{} {}", vertexCount, contentHash({reinterpret_cast<const char*>(indices.data()), indices.size_bytes()}));
    Done& done = of(key);
    std::call_once(done.once, [&] {
        BestOrder ordered = orderedOf(indices, vertexCount, method_, cache_, triangles_);
        done.corners = std::move(ordered.corners);
        done.sortedToo = ordered.sortedToo;
    });
    if (!done.sortedToo) return done.corners;
    return betterSorted(done.corners, indices, vertexCount, cache_, places);
} catch (const std::bad_alloc&) {
    return noMemory(indices);
}

PartsReorder::Done& PartsReorder::of(const std::string& key) {
    const std::lock_guard lock(mutex_);
    return done_[key];
}

bool samePermutation(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    return a.size() == b.size() && sortedTriangles(a) == sortedTriangles(b);
}

} // namespace tegument::order
