#include "meshprep/fur/roots/root_texture.h"

#include "host/support/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace tegument {

namespace {

constexpr std::size_t kHeaderTexels = 8;
constexpr std::size_t kMostTexels = std::size_t{kRootColumns} * kRootColumns;
constexpr int kSmallestShift = 2;   // bricks of 4 x 4 x 4 cells ...
constexpr int kLargestShift = 6;    // ... to 64 x 64 x 64
constexpr int kMostCells = 1 << 20; // along a side: cell numbers stay far below the 2^24 that a float counts to

/// The texels of one root lie in one row: a row's last texel, 4096 = 3 * 1365 + 1, stays empty.
constexpr std::size_t kRootsOfRow = kRootColumns / kRootTexels;

std::size_t rootAddress(std::size_t first, std::size_t number) {
    return first + number / kRootsOfRow * kRootColumns + number % kRootsOfRow * kRootTexels;
}

Error tooLarge(std::size_t roots, double texels) {
    return usageError(7107, fmt::format("{} roots would need {:.3g} texels, more than 4096 x 4096", roots, texels),
                      "ask for fewer roots, a smaller --reach, or a larger --cell");
}

/// Cells of cubes, gathered into bricks. Cell numbers count through the bricks that hold something.
class Grid {
public:
    explicit Grid(const RootSet& set) : cell_(static_cast<float>(set.cell)), reach_(static_cast<float>(set.reach)) {
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high(-low);
        const auto enclose = [&](const glm::vec3& place) {
            low = glm::min(low, glm::dvec3(place));
            high = glm::max(high, glm::dvec3(place));
        };
        for (const Root& root : set.roots)
            enclose(root.position);
        for (const CoatSample& sample : set.coat)
            enclose(sample.position);
        // Half a cell of air: places beside the outermost roots lie inside in spite of rounding.
        origin_ = glm::vec3(low - set.reach - 0.5 * set.cell);
        size_ = (high - low + 2.0 * set.reach + set.cell) / set.cell;
    }

    [[nodiscard]] bool tooFine() const { return !(std::max({size_.x, size_.y, size_.z}) < kMostCells); }

    /// The smallest bricks whose top level is no larger than the roots themselves.
    void choose(std::size_t roots) {
        for (shift_ = kSmallestShift;; ++shift_) {
            bricks_ = glm::ivec3(glm::ceil(size_ / static_cast<double>(brick())));
            if (shift_ == kLargestShift || topCount() <= kRootTexels * roots + 65536) return;
        }
    }

    [[nodiscard]] const glm::ivec3& bricks() const { return bricks_; }
    [[nodiscard]] std::size_t topCount() const {
        const glm::dvec3 n(bricks_);
        return static_cast<std::size_t>(std::min(n.x * n.y * n.z, 1e12));
    }
    [[nodiscard]] int brick() const { return 1 << shift_; }
    [[nodiscard]] std::size_t cellsOfBrick() const { return std::size_t{1} << (3 * shift_); }
    [[nodiscard]] glm::vec3 origin() const { return origin_; }
    [[nodiscard]] float cell() const { return cell_; }

    [[nodiscard]] std::size_t texelsOfBrick() const { return cellsOfBrick() / 4 + nodesOfBrick(); }
    [[nodiscard]] std::size_t nodesOfBrick() const { return nodesAlong() * nodesAlong() * nodesAlong(); }
    [[nodiscard]] std::size_t nodesAlong() const { return static_cast<std::size_t>(brick() / kNodeCells + 1); }

    [[nodiscard]] glm::ivec3 cellOf(const glm::vec3& point) const { return glm::ivec3(glm::floor((point - origin_) / cell_)); }
    /// Number of a cell, counted brick after brick, empty ones too.
    [[nodiscard]] std::uint64_t placeOf(const glm::ivec3& cell) const {
        const auto n = [](int i) { return static_cast<std::uint64_t>(i); };
        const glm::ivec3 k(cell.x >> shift_, cell.y >> shift_, cell.z >> shift_);
        const glm::ivec3 l = cell & (brick() - 1);
        const std::uint64_t brickNumber = n(k.x) + n(bricks_.x) * (n(k.y) + n(bricks_.y) * n(k.z));
        return (brickNumber << (3 * shift_)) + n(l.x + ((l.y + (l.z << shift_)) << shift_));
    }

    /// Its place by number in the top level.
    [[nodiscard]] glm::ivec3 brickAt(std::size_t number) const {
        const glm::uvec3 n(bricks_);
        const auto i = static_cast<std::uint32_t>(number);
        return {i % n.x, i / n.x % n.y, i / n.x / n.y};
    }

    /// Calls visit(cell) for every cell that the root's reach touches.
    template <class Visit>
    void around(const Root& root, Visit&& visit) const {
        const float reach = reach_ * (1 + 1e-4F); // for the rounding of the look-up
        const glm::vec3 at = (root.position - origin_) / cell_;
        const float radius = reach / cell_;
        const glm::ivec3 low(glm::floor(at - radius));
        const glm::ivec3 high(glm::floor(at + radius));
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    const glm::vec3 corner(x, y, z);
                    const glm::vec3 gap = glm::max(glm::max(corner - at, at - corner - 1.0F), glm::vec3(0));
                    if (glm::dot(gap, gap) <= radius * radius) visit(glm::ivec3(x, y, z));
                }
    }

private:
    glm::vec3 origin_{0};
    glm::dvec3 size_{0}; // in cells
    float cell_ = 1;
    float reach_ = 0;
    int shift_ = kSmallestShift;
    glm::ivec3 bricks_{1};
};

class Builder {
public:
    Builder(RootSet& set, const Grid& grid, unsigned threads) : set_(set), grid_(grid), threads_(threads) {}

    Result<RootTexture> build() {
        sortRoots();
        findCells();
        numberBricks();
        addBricksOfCoat();
        countLists();
        if (const auto checked = layOut(); !checked) return checked.error();
        writeHeader();
        writeLists();
        writeRoots();
        writeNodes();
        return std::move(texture_);
    }

private:
    static constexpr std::uint32_t kNone = UINT32_MAX;

    /// Cells as root after root touches them, for a run of roots.
    struct Touched {
        std::vector<std::uint64_t> cells;   // first by place in the grid, later by number among the bricks that hold something
        std::vector<std::uint32_t> perRoot; // how many of them
    };

    /// Roots of one cell lie beside each other, and cells of one brick: what is read together is stored together.
    void sortRoots() {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
        order.reserve(set_.roots.size());
        for (std::uint32_t i = 0; i < set_.roots.size(); ++i)
            order.emplace_back(grid_.placeOf(grid_.cellOf(set_.roots[i].position)), i);
        std::ranges::sort(order);
        std::vector<Root> sorted;
        sorted.reserve(order.size());
        for (const auto& entry : order)
            sorted.push_back(set_.roots[entry.second]);
        set_.roots = std::move(sorted);
    }

    void findCells() {
        touched_.resize(chunkCount(set_.roots.size()));
        inChunks(set_.roots.size(), threads_, [&](std::size_t first, std::size_t last, std::size_t chunk) {
            Touched& own = touched_[chunk];
            own.perRoot.reserve(last - first);
            for (std::size_t i = first; i < last; ++i) {
                const std::size_t before = own.cells.size();
                grid_.around(set_.roots[i], [&](const glm::ivec3& cell) { own.cells.push_back(grid_.placeOf(cell)); });
                own.perRoot.push_back(static_cast<std::uint32_t>(own.cells.size() - before));
            }
        });
    }

    /// Bricks count in the order in which roots touch them.
    void numberBricks() {
        brickOf_.assign(grid_.topCount(), kNone);
        std::uint32_t bricks = 0;
        for (Touched& run : touched_)
            for (std::uint64_t& cell : run.cells) {
                std::uint32_t& brick = brickOf_[cell / grid_.cellsOfBrick()];
                if (brick == kNone) brick = bricks++;
                cell = brick * grid_.cellsOfBrick() + cell % grid_.cellsOfBrick();
            }
        texture_.usedBricks = bricks;
        texture_.bricks = grid_.bricks();
        texture_.brick = grid_.brick();
    }

    /// Bald skin has a lean and a density, too: of 0.
    void addBricksOfCoat() {
        for (const CoatSample& sample : set_.coat) {
            const glm::ivec3 cell = grid_.cellOf(sample.position);
            std::uint32_t& brick = brickOf_[grid_.placeOf(cell) / grid_.cellsOfBrick()];
            if (brick == kNone) brick = static_cast<std::uint32_t>(texture_.usedBricks++);
        }
    }

    void countLists() {
        lists_.assign(texture_.usedBricks * grid_.cellsOfBrick(), 0);
        for (const Touched& run : touched_)
            for (const std::uint64_t cell : run.cells)
                ++lists_[cell];
        std::size_t texels = 0;
        for (std::uint32_t& count : lists_) {
            texture_.usedCells += count > 0;
            texture_.listed += count;
            texture_.mostListed = std::max<std::size_t>(texture_.mostListed, count);
            const std::size_t own = (std::size_t{count} + 3) / 4;
            texture_.mostTexels = std::max(texture_.mostTexels, own);
            count = own > 0 ? static_cast<std::uint32_t>(texels) : kNone; // from here on: where the list starts
            texels += own;
        }
        listTexels_ = texels;
    }

    Result<void> layOut() {
        firstTop_ = kHeaderTexels;
        firstBrick_ = firstTop_ + grid_.topCount();
        firstList_ = firstBrick_ + texture_.usedBricks * grid_.texelsOfBrick();
        firstRoot_ = (firstList_ + listTexels_ + kRootColumns - 1) / kRootColumns * kRootColumns;
        texture_.texels = rootAddress(firstRoot_, set_.roots.size());
        if (texture_.texels > kMostTexels) return tooLarge(set_.roots.size(), static_cast<double>(texture_.texels));
        const std::size_t rows = (texture_.texels + kRootColumns - 1) / kRootColumns;
        texture_.image = {.width = kRootColumns, .height = static_cast<int>(rows), .channels = 4};
        texture_.image.pixels.assign(rows * kRootColumns * 4, 0.0F);
        return {};
    }

    void put(std::size_t texel, const glm::vec3& xyz, double w) {
        float* to = &texture_.image.pixels[4 * texel];
        to[0] = xyz.x;
        to[1] = xyz.y;
        to[2] = xyz.z;
        to[3] = static_cast<float>(w);
    }

    void writeHeader() {
        put(0, grid_.origin(), static_cast<double>(grid_.cell()));
        put(1, glm::vec3(grid_.bricks()), grid_.brick());
        put(2, glm::vec3(texture_.image.height, firstTop_, set_.roots.size()), static_cast<double>(texture_.mostTexels));
        put(3, glm::vec3(set_.reach, set_.radius, set_.distance), set_.density);
        put(4, glm::vec3(set_.centre), set_.ballRadius);
        const SurfaceFigures& figures = set_.figures;
        double sum = 0;
        float least = 1;
        float lean = 0;
        for (const Root& root : set_.roots) {
            sum += static_cast<double>(root.share);
            least = std::min(least, root.share);
            lean = std::max(lean, glm::length(root.lean));
        }
        put(5, glm::vec3(least, sum / static_cast<double>(set_.roots.size()), lean), figures.spread.x);
        put(6, glm::vec3(firstRoot_, kNodeCells, figures.spread.y), figures.spread.z);
        put(7, glm::vec3(figures.middle), figures.area);
    }

    void writeLists() {
        float* pixels = texture_.image.pixels.data();
        for (std::size_t i = 0; i < brickOf_.size(); ++i)
            if (brickOf_[i] != kNone) pixels[4 * (firstTop_ + i)] = static_cast<float>(brickAddress(brickOf_[i]));
        for (std::size_t i = 0; i < lists_.size(); ++i)
            if (lists_[i] != kNone)
                pixels[4 * brickAddress(i / grid_.cellsOfBrick()) + i % grid_.cellsOfBrick()] = static_cast<float>(firstList_ + lists_[i]);
        std::vector<std::uint32_t> filled(lists_.size(), 0);
        std::size_t root = 0;
        for (const Touched& run : touched_) {
            const std::uint64_t* cell = run.cells.data();
            for (const std::uint32_t count : run.perRoot) {
                const auto address = static_cast<float>(rootAddress(firstRoot_, root++));
                for (const std::uint64_t* end = cell + count; cell != end; ++cell)
                    pixels[4 * (firstList_ + lists_[*cell]) + filled[*cell]++] = address;
            }
        }
        for (std::size_t i = 0; i < lists_.size(); ++i)
            if (lists_[i] != kNone) {
                float& last = pixels[4 * (firstList_ + lists_[i] + (filled[i] - 1) / 4)];
                last = -last; // marks a list's last texel
            }
    }

    [[nodiscard]] std::size_t brickAddress(std::size_t brick) const { return firstBrick_ + brick * grid_.texelsOfBrick(); }

    /// A node of one brick: where it is in the lattice of all, and where its texel. Nodes at the sides of bricks have several.
    struct Node {
        std::uint64_t place = 0;
        std::size_t texel = 0;
        // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 reads the defaulted operator's comparison with a literal 0 as a pointer
        auto operator<=>(const Node&) const = default;
    };

    [[nodiscard]] std::vector<Node> listNodes() const {
        std::vector<Node> nodes;
        nodes.reserve(texture_.usedBricks * grid_.nodesOfBrick());
        const auto along = static_cast<int>(grid_.nodesAlong());
        for (std::size_t i = 0; i < brickOf_.size(); ++i) {
            if (brickOf_[i] == kNone) continue;
            std::size_t texel = brickAddress(brickOf_[i]) + grid_.cellsOfBrick() / 4;
            const glm::ivec3 low = grid_.brickAt(i) * (along - 1);
            for (int z = 0; z < along; ++z)
                for (int y = 0; y < along; ++y)
                    for (int x = 0; x < along; ++x)
                        nodes.push_back({.place = packed(low + glm::ivec3(x, y, z)), .texel = texel++});
        }
        std::ranges::sort(nodes);
        return nodes;
    }

    static constexpr unsigned kBitsOfPlace = 21; // kMostCells and one
    static std::uint64_t packed(const glm::ivec3& place) {
        const auto word = [](int i) { return static_cast<std::uint64_t>(i); };
        return word(place.x) | word(place.y) << kBitsOfPlace | word(place.z) << (2 * kBitsOfPlace);
    }
    [[nodiscard]] glm::vec3 positionOf(std::uint64_t place) const {
        const auto part = [&](unsigned i) { return static_cast<float>(place >> (i * kBitsOfPlace) & ((1U << kBitsOfPlace) - 1)); };
        return grid_.origin() + glm::vec3(part(0), part(1), part(2)) * (kNodeCells * grid_.cell());
    }

    void writeNodes() {
        const std::vector<Node> nodes = listNodes();
        const float spacing = static_cast<float>(1 / std::sqrt(set_.density));
        // A place in a brick may be as far as the diagonal from a node that it reads, sqrt(3) of their distance.
        constexpr float kRadius = 1.8F;
        const CoatField field(set_.coat, std::max(kRadius * kNodeCells * grid_.cell(), 2 * spacing));
        inChunks(nodes.size(), threads_, [&](std::size_t first, std::size_t last, std::size_t) {
            glm::vec4 value(0, 0, 0, 1);
            for (std::size_t i = first; i < last; ++i) {
                const bool isNew = i == first || nodes[i].place != nodes[i - 1].place;
                if (isNew && !set_.coat.empty()) value = field.at(positionOf(nodes[i].place));
                put(nodes[i].texel, glm::vec3(value), static_cast<double>(value.w));
            }
        });
    }

    void writeRoots() {
        for (std::size_t i = 0; i < set_.roots.size(); ++i) {
            const Root& root = set_.roots[i];
            const std::size_t texel = rootAddress(firstRoot_, i);
            put(texel, root.position, root.radius);
            put(texel + 1, root.normal * root.share, root.limit);
            put(texel + 2, root.lean + root.normal * root.curl, root.random);
        }
    }

    RootSet& set_;
    const Grid& grid_;
    unsigned threads_;
    RootTexture texture_;
    std::vector<Touched> touched_;
    std::vector<std::uint32_t> brickOf_; // by place in the top level
    std::vector<std::uint32_t> lists_;   // by cell number
    std::size_t listTexels_ = 0;
    std::size_t firstTop_ = 0;
    std::size_t firstBrick_ = 0;
    std::size_t firstList_ = 0;
    std::size_t firstRoot_ = 0;
};

std::size_t rootNumber(std::size_t texelsAfterFirst) {
    return texelsAfterFirst / kRootColumns * kRootsOfRow + texelsAfterFirst % kRootColumns / kRootTexels;
}

/// What a shader does: texels by number, in floats.
class Reader {
public:
    explicit Reader(const Image& image) : image_(image) {}

    [[nodiscard]] glm::vec4 fetch(float number) const {
        const float row = std::floor(number / static_cast<float>(kRootColumns));
        const float column = number - static_cast<float>(kRootColumns) * row;
        const float* from = &image_.pixels[4 * (static_cast<std::size_t>(row) * kRootColumns + static_cast<std::size_t>(column))];
        return {from[0], from[1], from[2], from[3]};
    }

    [[nodiscard]] float entry(float first, float index) const {
        const float part = std::floor(index / 4);
        return fetch(first + part)[static_cast<glm::length_t>(index - 4 * part)];
    }

private:
    const Image& image_;
};

} // namespace

Result<RootTexture> buildRootTexture(RootSet& set, unsigned threads) {
    const auto start = std::chrono::steady_clock::now();
    if (set.roots.empty())
        return inputError(7105, {}, "no root stands on the mesh", "the length map or the density map may be 0 everywhere");
    // What a ball touches of a grid of unit cells on average: 1 + 6 r + 3 pi r^2 + 4/3 pi r^3 of them.
    const double r = set.reach / set.cell;
    const double touched = 1 + r * (6 + r * (9.42 + r * 4.19));
    const double texels = static_cast<double>(set.roots.size()) * (touched / 4 + kRootTexels);
    if (texels > 2.0 * static_cast<double>(kMostTexels)) return tooLarge(set.roots.size(), texels);
    Grid grid(set);
    grid.choose(set.roots.size());
    if (grid.tooFine() || grid.topCount() > kMostTexels)
        return usageError(
            7107, "the mesh is too large for the fineness of its fur: the grid of its roots would have more than 4096 x 4096 texels",
            "prepare far parts of the mesh on their own, or ask for fewer roots or a larger --cell");
    auto texture = Builder(set, grid, threads).build();
    if (texture) texture->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return texture;
}

namespace {

/// The brick of a point, as a shader finds it.
struct FoundBrick {
    float address = 0;  // 0: none
    glm::vec3 place{0}; // in the brick, in cells
    float side = 0;     // cells
};

FoundBrick brickAround(const Reader& reader, const glm::vec3& point) {
    const glm::vec4 grid = reader.fetch(0);
    const glm::vec4 size = reader.fetch(1);
    const glm::vec3 bricks(size);
    const glm::vec3 place = (point - glm::vec3(grid)) / grid.w;
    const glm::vec3 cell = glm::floor(place);
    if (glm::any(glm::lessThan(cell, glm::vec3(0))) || glm::any(glm::greaterThanEqual(cell, size.w * bricks))) return {};
    const glm::vec3 k = glm::floor(cell / size.w);
    return {.address = reader.fetch(reader.fetch(2).y + k.x + bricks.x * (k.y + bricks.y * k.z)).x,
            .place = place - size.w * k,
            .side = size.w};
}

} // namespace

glm::vec4 coatAround(const Image& image, const glm::vec3& point) {
    const Reader reader(image);
    const FoundBrick brick = brickAround(reader, point);
    if (brick.address == 0) return glm::vec4(0);
    const float b = brick.side;
    const float between = reader.fetch(6).y;
    const float along = b / between + 1;
    const float first = brick.address + b * b * b / 4;
    const glm::vec3 place = brick.place / between;
    const glm::vec3 low = glm::min(glm::floor(place), along - 2);
    glm::vec4 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 node = low + side;
        const glm::vec3 weight = 1.0F - glm::abs(place - node);
        sum += weight.x * weight.y * weight.z * reader.fetch(first + node.x + along * (node.y + along * node.z));
    }
    return sum;
}

std::vector<std::size_t> rootsAround(const Image& image, const glm::vec3& point) {
    const Reader reader(image);
    const FoundBrick brick = brickAround(reader, point);
    if (brick.address == 0) return {};
    const glm::vec3 l = glm::floor(brick.place);
    const float list = reader.entry(brick.address, l.x + brick.side * (l.y + brick.side * l.z));
    if (list == 0) return {};
    const float longest = reader.fetch(2).w;
    std::vector<std::size_t> found;
    const std::size_t firstRoot = static_cast<std::size_t>(reader.fetch(6).x);
    for (int step = 0; step < static_cast<int>(longest); ++step) {
        const glm::vec4 texel = reader.fetch(list + static_cast<float>(step));
        for (glm::length_t i = 0; i < 4; ++i)
            if (texel[i] != 0) found.push_back(rootNumber(static_cast<std::size_t>(std::abs(texel[i])) - firstRoot));
        if (texel.x < 0) break;
    }
    return found;
}

std::optional<SurfaceFigures> figuresIn(const Image& image) {
    if (image.width != kRootColumns || image.channels != 4) return std::nullopt;
    const Reader reader(image);
    const glm::dvec4 last(reader.fetch(7));
    if (!(last.w > 0)) return std::nullopt;
    const glm::dvec4 sixth(reader.fetch(6));
    return SurfaceFigures{.middle = glm::dvec3(last), .area = last.w, .spread = {static_cast<double>(reader.fetch(5).w), sixth.z, sixth.w}};
}

Root rootAt(const Image& image, std::size_t number) {
    const Reader reader(image);
    const auto first = static_cast<float>(rootAddress(static_cast<std::size_t>(reader.fetch(6).x), number));
    const glm::vec4 a = reader.fetch(first);
    const glm::vec4 b = reader.fetch(first + 1);
    const glm::vec4 c = reader.fetch(first + 2);
    Root root{.position = glm::vec3(a), .radius = a.w, .share = glm::length(glm::vec3(b)), .limit = b.w, .random = c.w};
    root.normal = glm::vec3(b) / root.share;
    root.curl = glm::dot(glm::vec3(c), root.normal);
    root.lean = glm::vec3(c) - root.normal * root.curl;
    return root;
}

} // namespace tegument
