#include "meshprep/fur/ribbons/rooted.h"

#include "host/support/parallel.h"
#include "meshprep/fur/roots/root_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

/// Ten bits, two zeros behind each.
std::uint32_t spread(std::uint32_t v) {
    v = (v | (v << 16U)) & 0x030000ffU;
    v = (v | (v << 8U)) & 0x0300f00fU;
    v = (v | (v << 4U)) & 0x030c30c3U;
    return (v | (v << 2U)) & 0x09249249U;
}

/// Of a place in the unit ball.
std::uint32_t zOrder(const glm::vec3& place) {
    const glm::uvec3 cell(glm::clamp((place + 1.0F) * 512.0F, 0.0F, 1023.0F));
    return spread(cell.x) | spread(cell.y) << 1U | spread(cell.z) << 2U;
}

bool usable(const RootedPlace& root) {
    const float length = glm::length(root.normal);
    return std::isfinite(root.position.x + root.position.y + root.position.z) && std::abs(length - 1) < 1e-3F;
}

} // namespace

Result<RootedMesh> readRooted(const Mesh& mesh, const Image& texture, unsigned threads) {
    const auto header = rootHeader(texture);
    if (!header) return inputError(7109, {}, "this is no texture of roots", "make one with: tegument fur roots MESH -o FILE.dds");
    RootedMesh rooted{.mesh = mesh, .roots = std::vector<RootedPlace>(header->count)};
    const auto radius = static_cast<float>(header->ballRadius);
    inChunks(header->count, threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const Root root = rootAt(texture, i);
            rooted.roots[i] = {.position = (root.position - glm::vec3(header->centre)) / radius,
                               .normal = root.normal,
                               .address = static_cast<float>(header->addressOf(i)),
                               .number = static_cast<std::uint32_t>(i)};
        }
    });
    std::erase_if(rooted.roots, [](const RootedPlace& root) { return !usable(root); });
    if (rooted.roots.empty()) return inputError(7109, {}, "none of the texture's roots has a place", "make it again: tegument fur roots");
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(rooted.roots.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = {zOrder(rooted.roots[i].position), i};
    std::ranges::sort(order);
    std::vector<RootedPlace> sorted;
    sorted.reserve(order.size());
    for (const auto& [curve, i] : order)
        sorted.push_back(rooted.roots[i]);
    rooted.roots = std::move(sorted);
    rooted.spacing = static_cast<float>(1 / std::sqrt(header->density) / header->ballRadius);
    return rooted;
}

} // namespace tegument
