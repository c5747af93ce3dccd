#pragma once
// The triangles of a mesh in an order that lets the GPU reuse transformed vertices. docs/design/orders.md.

#include "meshprep/order/cache.h"

#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tegument::order {

enum class Method {
    LinYu,   // G. Lin, T. P.-Y. Yu, An improved vertex caching scheme for 3D mesh rendering, TVCG 12(4), 2006
    Hoppe,   // H. Hoppe, Optimization of mesh locality for transparent vertex caching, SIGGRAPH 1999, in the form that D3DX ships
    Tipsify, // P. Sander, D. Nehab, J. Barczak, Fast triangle reordering for vertex locality and reduced overdraw, SIGGRAPH 2007
    Meshopt, // meshoptimizer's vertex-cache optimiser
    Best     // for each component the best of those that suit the cache, and never worse than what came in
};

/// "lin-yu", "hoppe", "tipsify", "meshopt" or "best"; TG7041 otherwise.
[[nodiscard]] Result<Method> parseMethod(std::string_view text);
[[nodiscard]] std::string_view name(Method method);

/// The same triangles, each with its winding, in a new order; a triangle's first corner may change. Any triangles are taken: degenerate,
/// repeated, many to an edge, unconnected; vertices that no triangle names are ignored. Time grows linearly with the triangles, whatever
/// the vertices' valences. Fails with TG7042 when an index is not below `vertexCount` or the list is no list of triangles, and with TG7043
/// when there is not enough memory or there are more than 2^30 triangles. `places`: three coordinates of each vertex, or none; with them
/// `Method::Best` tries an order of what is sorted by place, too.
[[nodiscard]] Result<std::vector<std::uint32_t>> reorder(std::span<const std::uint32_t> indices, std::size_t vertexCount, Method method,
                                                         const CacheModel& cache, std::span<const float> places = {});

/// `reorder` for the parts of one mesh. Machines have the same screw many times: of lists that are equal the first alone is ordered,
/// and where sorting by place may help that is tried for each. May be called from several threads.
class PartsReorder {
public:
    /// `triangles`: of the whole mesh. Where these are many, chance evens out over the parts and second tries are not worth their time.
    PartsReorder(Method method, const CacheModel& cache, std::size_t triangles = 0)
        : method_(method), cache_(cache), triangles_(triangles) {}

    [[nodiscard]] Result<std::vector<std::uint32_t>> operator()(std::span<const std::uint32_t> indices, std::size_t vertexCount,
                                                                std::span<const float> places = {});

private:
    /// Of equal lists that come at the same time one is ordered, the others wait.
    struct Done {
        std::once_flag once;
        std::vector<std::uint32_t> corners;
        bool sortedToo = false; // places may make a better one
    };

    Done& of(const std::string& key);

    Method method_;
    CacheModel cache_;
    std::size_t triangles_;
    std::mutex mutex_;
    std::map<std::string, Done> done_; // by the list's hash
};

/// Whether both lists hold the same triangles with the same winding, each as often: first corners and order may differ.
[[nodiscard]] bool samePermutation(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);

} // namespace tegument::order
