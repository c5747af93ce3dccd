// The tables of docs/design/orders.md: what each order reaches on each mesh, and its time against meshoptimizer's, all in one run.
//
//     order_table [--seed N] [--repeat N] MESH...     MESH: sphere, terrain, sphere:N, terrain:N, or a file
//
// Times are processor time of one thread, the least of --repeat runs (default 3), interleaved; seed 0 is the file's order.

#include "meshprep/order/order.h"
#include "tests/order/meshes.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <sys/resource.h>

namespace tegument::order {
namespace {

using testing_order::loadTriangles;
using testing_order::shuffled;
using testing_order::Triangles;
using Indices = std::vector<std::uint32_t>;

struct Row {
    std::string name;
    CacheModel model;
    std::function<Indices(const Triangles&)> order;
    Indices out;
    double seconds = std::numeric_limits<double>::infinity();
};

double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Indices meshoptimizer(const Triangles& mesh) {
    Indices out(mesh.indices.size());
    meshopt_optimizeVertexCache(out.data(), mesh.indices.data(), out.size(), mesh.positions.size());
    return out;
}

std::vector<Row> rows() {
    std::vector<Row> all = {{"meshoptimizer itself", fifo(16), meshoptimizer, {}},
                            {"as it comes", fifo(16), [](const Triangles& m) { return m.indices; }, {}}};
    const auto add = [&](Method method, const CacheModel& model) {
        all.push_back({fmt::format("{}, {}", name(method), name(model)),
                       model,
                       [=](const Triangles& m) { return *reorder(m.indices, m.positions.size(), method, model); },
                       {}});
    };
    for (const unsigned entries : {16u, 24u, 32u})
        for (const Method method : {Method::Tipsify, Method::Hoppe, Method::LinYu, Method::Best})
            add(method, fifo(entries));
    add(Method::Best, lru(16));
    add(Method::Best, kWarp);
    return all;
}

void print(const Triangles& mesh, const std::vector<Row>& all, std::uint32_t seed) {
    fmt::print("\n{}, {} vertices, {} triangles, {}\n\n| order | FIFO 16 | 24 | 32 | LRU 16 | warp, ATVR | ms | against meshoptimizer |\n"
               "|---|---|---|---|---|---|---|---|\n",
               mesh.name, mesh.positions.size(), mesh.faces(),
               seed == 0 ? std::string("in the file's order") : fmt::format("shuffled, seed {}", seed));
    for (const Row& row : all) {
        const auto acmr = [&](const CacheModel& model) { return measure(model, row.out, mesh.positions.size()).acmr(); };
        fmt::print("| {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.3f} | {:.0f} | {:.2f} |\n", row.name, acmr(fifo(16)), acmr(fifo(24)),
                   acmr(fifo(32)), acmr(lru(16)), measure(kWarp, row.out, mesh.positions.size()).atvr(), 1e3 * row.seconds,
                   row.seconds / all.front().seconds);
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("\nMost memory so far: {:.0f} MiB\n", static_cast<double>(usage.ru_maxrss) / 1024);
}

void tabulate(const Triangles& mesh, std::uint32_t seed, int repeat) {
    std::vector<Row> all = rows();
    for (int i = 0; i < repeat; ++i)
        for (Row& row : all) {
            const double start = processorSeconds();
            row.out = row.order(mesh);
            row.seconds = std::min(row.seconds, processorSeconds() - start);
        }
    print(mesh, all, seed);
    std::fflush(stdout);
}

int tabulateAll(const std::vector<std::string>& arguments) {
    std::uint32_t seed = 0;
    int repeat = 3;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (i + 1 < arguments.size() && (arguments[i] == "--seed" || arguments[i] == "--repeat")) {
            const int value = std::max(std::atoi(arguments[i + 1].c_str()), 0);
            if (arguments[i++] == "--seed")
                seed = static_cast<std::uint32_t>(value);
            else
                repeat = std::max(value, 1);
            continue;
        }
        const auto mesh = loadTriangles(arguments[i]);
        if (!mesh) {
            fmt::print(stderr, "{}\n", format(mesh.error()));
            return 1;
        }
        tabulate(shuffled(*mesh, seed), seed, repeat);
    }
    return arguments.empty() ? 2 : 0;
}

} // namespace
} // namespace tegument::order

int main(int argc, char** argv) {
    return tegument::order::tabulateAll({argv + 1, argv + argc});
}
