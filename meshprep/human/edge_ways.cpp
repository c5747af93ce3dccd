#include "meshprep/human/edge_ways.h"

#include <functional>
#include <queue>
#include <utility>

namespace tegument {

EdgeWays waysAlongEdges(const std::vector<glm::vec3>& positions, const std::vector<Quad>& quads, const std::vector<std::uint32_t>& sources,
                        float reach) {
    std::vector<std::vector<std::uint32_t>> neighbours(positions.size());
    for (const Quad& quad : quads)
        for (std::size_t c = 0; c < 4; ++c) {
            neighbours[quad.position[c]].push_back(quad.position[(c + 1) % 4]);
            neighbours[quad.position[(c + 1) % 4]].push_back(quad.position[c]);
        }
    EdgeWays ways{.length = std::vector<float>(positions.size(), reach), .source = std::vector<std::uint32_t>(positions.size(), 0)};
    using Step = std::pair<float, std::uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    for (const std::uint32_t v : sources) {
        ways.length[v] = 0;
        ways.source[v] = v;
        open.emplace(0.0f, v);
    }
    while (!open.empty()) {
        const auto [length, v] = open.top();
        open.pop();
        if (length > ways.length[v]) continue;
        for (const std::uint32_t next : neighbours[v]) {
            const float longer = length + glm::distance(positions[v], positions[next]);
            if (longer >= ways.length[next]) continue;
            ways.length[next] = longer;
            ways.source[next] = ways.source[v];
            open.emplace(longer, next);
        }
    }
    return ways;
}

} // namespace tegument
