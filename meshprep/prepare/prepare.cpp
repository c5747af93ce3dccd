#include "meshprep/prepare/prepare.h"

#include "host/mesh/extent.h"
#include "host/mesh/facing.h"
#include "host/mesh/motion.h"
#include "host/mesh/normals.h"
#include "host/support/parallel.h"
#include "meshprep/prepare/carry_textures.h"
#include "meshprep/prepare/clean.h"
#include "meshprep/prepare/unwrap.h"
#include "meshprep/prepare/vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <new>
#include <span>

namespace tegument::prep {

namespace {

using Clock = std::chrono::steady_clock;

/// Runs the steps and keeps the book.
class Preparation {
public:
    Preparation(const std::filesystem::path& path, const PrepOptions& options) : path_(path), options_(options) {}

    Result<Prepared> run() {
        if (auto error = readFile()) return *error;
        clean();
        if (surface_.mesh.indices.empty() && report_.input.faces > 0)
            return inputError(7020, {.file = path_.string()}, "no triangle is left", whereTheyWent());
        if (auto error = shape()) return *error;
        if (auto error = putInOrder()) return *error;
        if (auto error = pack()) return *error;
        return Prepared{.mesh = std::move(surface_.mesh), .glb = std::move(glb_), .report = std::move(report_)};
    }

private:
    void begin(const char* name) {
        if (options_.progress) options_.progress(name);
        started_ = Clock::now();
    }

    void end(std::string name, std::size_t changed, std::string text) {
        const double seconds = std::chrono::duration<double>(Clock::now() - started_).count();
        report_.steps.push_back({.name = std::move(name), .changed = changed, .text = std::move(text), .seconds = seconds});
    }

    /// A step that counts one thing.
    template <class Step>
    void count(const char* name, const char* what, Step step) {
        begin(name);
        const std::size_t changed = step();
        end(name, changed, fmt::format("{} {}", changed, what));
    }

    std::optional<Error> readFile() {
        begin("read");
        Result<ReadMesh> file = readMesh(path_, reading());
        if (file && options_.unwrap && !file->mesh.uvs.empty() && !file->mesh.materials.images.empty())
            file = readMesh(path_, reading(false)); // one sheet of all materials, to be drawn by the new coordinates
        if (!file) return file.error();
        surface_.mesh = std::move(file->mesh);
        const ReadCounts& counts = file->counts;
        report_.input = {.vertices = counts.vertices, .faces = counts.faces};
        report_.triangles = surface_.triangles();
        report_.warnings = surface_.mesh.warnings;
        if (counts.faces == 0)
            return inputError(7021, {.file = path_.string()}, fmt::format("{} vertices and no faces", counts.vertices), whyNoFaces(counts));
        reach_ = greatestCoordinate();
        end("read", counts.faces, fmt::format("{} vertices, {} faces", counts.vertices, counts.faces));
        if (options_.turnUp) {
            begin("up");
            turnUp();
            end("up", surface_.mesh.positions.size(), "z is up in the file, y in what is written");
        }
        if (options_.flipV && !surface_.mesh.uvs.empty()) {
            begin("flip v");
            for (glm::vec2& uv : surface_.mesh.uvs)
                uv.y = 1 - uv.y;
            surface_.mesh.tangents.clear();
            end("flip v", surface_.mesh.uvs.size(), "v is turned");
        }
        noteDropped("faces of fewer than three corners", "small faces", counts.smallFaces);
        noteDropped("faces that refer to no vertex", "bad faces", counts.badFaces);
        noteDropped("faces with a corner at NaN or infinity", "not finite", counts.notFiniteFaces);
        return std::nullopt;
    }

    /// Primitives of points or lines are left out with a warning.
    [[nodiscard]] std::string whyNoFaces(const ReadCounts& counts) const {
        for (const Diagnostic& warning : surface_.mesh.warnings)
            if (warning.code == 5323 && counts.vertices == 0) return warning.text + ": a cloud of points must be made a surface first";
        return counts.vertices > 0 ? "a cloud of points must be made a surface first" : "the file holds no mesh: export it again";
    }

    [[nodiscard]] ReadOptions reading(bool carryMaterials = true) const {
        ReadOptions read = options_.read;
        read.carryMaterials = carryMaterials;
        read.guessUnit = options_.guessUnit;
        return read;
    }

    [[nodiscard]] double greatestCoordinate() const {
        float greatest = 0;
        for (const std::uint32_t index : surface_.mesh.indices) {
            const glm::vec3 p = glm::abs(surface_.mesh.positions[index]);
            greatest = std::max({greatest, p.x, p.y, p.z});
        }
        return static_cast<double>(greatest);
    }

    /// A quarter of a turn about x: z goes to y, and y to -z.
    void turnUp() {
        Mesh& mesh = surface_.mesh;
        const auto turned = [](const auto& v) { return glm::vec3(v.x, v.z, -v.y); };
        for (glm::vec3& position : mesh.positions)
            position = turned(position);
        mesh.origin = {mesh.origin.x, mesh.origin.z, -mesh.origin.y};
        mesh.motionRoot = glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1) * mesh.motionRoot;
        for (glm::vec3& normal : mesh.normals)
            normal = turned(normal);
        for (glm::vec4& tangent : mesh.tangents)
            tangent = {turned(tangent), tangent.w};
    }

    void noteDropped(const char* what, const char* name, std::size_t dropped) {
        begin(name);
        if (dropped > 0) end(name, dropped, fmt::format("{} {} left out", dropped, what));
    }

    void clean() {
        begin("places");
        report_.places = findPlaces(surface_, options_.same, reach_);
        const Places& places = report_.places;
        end("places", places.joined,
            fmt::format("{} vertices at the place of an earlier one{}", places.joined,
                        places.cracks > 0
                            ? fmt::format(", {} of them across cracks of at most {:.2g} mm, the last digit of the file's numbers",
                                          places.cracks, places.crackWidth)
                            : ""));
        partOpening(surface_);
        count("collapsed", "triangles with two corners at one place left out", [&] { return dropCollapsed(surface_); });
        if (!options_.keepDuplicates)
            count("duplicates", "triangles that repeat another left out", [&] { return dropDuplicates(surface_); });
        count("unreferenced", "vertices of no triangle left out", [&] { return dropUnreferenced(surface_); });
        if (options_.orient) oriented();
    }

    void oriented() {
        begin("orient");
        const Oriented done = orient(surface_);
        if (done.doubles > 0) dropUnreferenced(surface_);
        const std::string over = done.turnedOver == surface_.triangles() ? "; then all of them, for the mesh was inside out"
                                 : done.turnedOver > 0
                                     ? fmt::format("; then {} of {} shells that were inside out", done.turnedOver, done.shells)
                                     : "";
        end("orient", std::max(done.turnedOver, done.turned + done.doubles),
            fmt::format("{}{} triangles turned to face as most of their component{}",
                        done.doubles > 0 ? fmt::format("{} triangles left out that were the other side of one; ", done.doubles) : "",
                        done.turned, over));
    }

    void warnOfFacing() {
        if (options_.orient) return;
        if (const auto fault = facingFault(examineFacing(surface_.mesh, surface_.point), path_.string()))
            report_.warnings.push_back(*fault);
        else if (const std::size_t shells = shellsInsideOut(surface_); shells > 0)
            warn(5332, fmt::format("{} closed shells of the mesh are inside out: their triangles face inwards", shells),
                 "fur grows and light falls on their front only: tegument prep MESH --orient -o NEW.glb turns them");
    }

    [[nodiscard]] std::string whereTheyWent() const {
        std::string text;
        for (const PrepStep& step : report_.steps)
            if (step.name != "read" && step.changed > 0) text += (text.empty() ? "" : "; ") + step.text;
        return text;
    }

    std::optional<Error> shape() {
        begin("topology");
        report_.topology = examine(surface_);
        const Topology& t = report_.topology;
        end("topology", 0,
            fmt::format("{} components, {} boundary edges, {} edges of more than two triangles, {} bow ties, {} opposed edges, "
                        "{} pairs back to back, {} triangles without area",
                        t.components, t.boundaryEdges, t.crowdedEdges, t.bowTies, t.opposedEdges, t.backToBackPairs, t.flatTriangles));
        warnOfFacing();
        begin("centre");
        report_.centring = centre(surface_, options_.centre);
        const Centring& c = report_.centring;
        end("centre", c.vertices,
            fmt::format("moved by ({:.6g}, {:.6g}, {:.6g}); radius {:.6g}, minimal {:.6g}", c.moved.x, c.moved.y, c.moved.z, c.radius,
                        c.minimalRadius));
        if (!hasArea(surface_.mesh)) return withoutArea();
        begin("normals");
        const NormalChanges changes = makeNormals(surface_, options_.normals);
        end("normals", changes.normals, fmt::format("{} normals made, {} vertices split for them", changes.normals, changes.split));
        count("weld", "vertices equal to an earlier one in all that is kept", [&] { return weldVertices(surface_); });
        if (options_.unwrap)
            if (auto error = unwrapped()) return error;
        if (options_.mappingReport) {
            begin("mapping");
            report_.mapping = examineMapping(surface_);
            report_.rootMapping = examineRoots(surface_);
            end("mapping", 0, fmt::format("{} ways examined", report_.mapping.size() + report_.rootMapping.size()));
        }
        if (!surface_.mesh.uvs.empty()) makeTangents();
        return std::nullopt;
    }

    /// Floats tell fewer places apart the farther they are from the origin, also from the new one.
    [[nodiscard]] Error withoutArea() const {
        const auto reach = static_cast<float>(greatestCoordinate());
        const bool never = report_.topology.flatTriangles == surface_.triangles();
        return inputError(7020, {.file = path_.string()}, "no triangle has an area",
                          never ? "the corners of each lie on one line"
                                : fmt::format("what is {} mm from the middle is told apart in steps of {:.1g} mm: leave out what lies far "
                                              "from the rest",
                                              lengthText(reach), std::nextafter(reach, INFINITY) - reach));
    }

    std::optional<Error> unwrapped() {
        begin("unwrap");
        if (!surface_.mesh.textures.empty() && !surface_.mesh.uvs.empty()) {
            before_ = surface_.mesh;
            computeTangents(*before_);
        }
        const auto made = unwrap(surface_);
        if (!made) return made.error();
        end("unwrap", made->charts,
            fmt::format("{} charts cover {:.0f} % of the square, {} vertices split for them", made->charts, 100 * made->covered,
                        made->split));
        return std::nullopt;
    }

    void makeTangents() {
        begin("tangents");
        const std::size_t before = surface_.mesh.positions.size();
        computeTangents(surface_.mesh);
        const std::size_t split = surface_.mesh.positions.size() - before;
        end("tangents", surface_.mesh.positions.size(), fmt::format("MikkTSpace, {} vertices split at mirror lines", split));
        if (!before_) return;
        begin("textures");
        const int side = carryTextures(*before_, surface_.mesh);
        end("textures", surface_.mesh.textures.size(),
            fmt::format("{} drawn anew for these charts, up to {} x {} texels", surface_.mesh.textures.size(), side, side));
        before_.reset();
    }

    std::optional<Error> putInOrder() {
        constexpr std::size_t kMostAtOnce = 4'000'000;
        surface_.point = {}; // vertices are numbered anew from here on
        measureReuse(&CacheComparison::before);
        Levels levels;
        double levelSeconds = 0;
        if (surface_.triangles() > kMostAtOnce) { // levels of what lies together in memory take less of it, and half the time
            if (auto error = orderBeside([] {})) return error;
            orderVerticesOf({});
            makeLevelsOf(levels, levelSeconds);
        } else { // levels are made of the surface, whatever its order: at the same time
            if (auto error = orderBeside([&] { makeLevelsOf(levels, levelSeconds); })) return error;
            orderVerticesOf(levels.levels);
        }
        return options_.levels > 1 ? addLevels(std::move(levels), levelSeconds) : std::nullopt;
    }

    void makeLevelsOf(Levels& levels, double& seconds) {
        if (options_.levels <= 1) return;
        const auto start = Clock::now();
        levels = makeLevels(surface_.mesh, options_.levels, options_.levelMethod);
        if (surface_.mesh.motion) keepApart(levels);
        seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }

    /// A triangle with vertices of several nodes cannot be written: such a level goes, with those that follow.
    void keepApart(Levels& levels) const {
        const Mesh& mesh = surface_.mesh;
        const auto runOf = [&](std::uint32_t vertex) { return &mesh.motion->runOf(mesh.motionVertices[vertex]); };
        const auto mixes = [&](const Level& level) {
            return std::ranges::any_of(level.mesh.parts, [&](const MeshPart& part) {
                const auto own = std::span(level.mesh.indices).subspan(part.firstIndex, part.indexCount);
                return std::ranges::any_of(own, [&](std::uint32_t vertex) { return runOf(vertex) != runOf(own.front()); });
            });
        };
        const auto first = std::ranges::find_if(levels.levels, mixes);
        if (first == levels.levels.end()) return;
        levels.levels.erase(first, levels.levels.end());
        levels.whyEarly = "it would join what moves apart";
    }

    std::optional<Error> orderBeside(const std::function<void()>& other) {
        Mesh& mesh = surface_.mesh;
        begin(options_.order ? "order" : "levels");
        std::vector<std::uint32_t> ordered = mesh.indices;
        std::optional<Error> error;
        double seconds = 0;
        forEachInParallel(2, [&](std::size_t i) {
            if (i == 0) other();
            if (i == 0 || !options_.order) return;
            const auto start = Clock::now();
            error = reorderParts(ordered, mesh.parts);
            seconds = std::chrono::duration<double>(Clock::now() - start).count();
        });
        if (error || !options_.order) return error;
        std::size_t moved = 0;
        for (std::size_t i = 0; i < ordered.size(); i += 3)
            moved += !std::equal(&ordered[i], &ordered[i] + 3, &mesh.indices[i]);
        mesh.indices = std::move(ordered);
        end("order", moved, fmt::format("{} triangles moved: {} for {}", moved, order::name(*options_.order), order::name(options_.cache)));
        report_.steps.back().seconds = seconds;
        return std::nullopt;
    }

    void orderVerticesOf(std::span<Level> levels) {
        if (options_.overdraw) orderByDepth();
        std::vector<std::vector<std::uint32_t>*> lists;
        for (Level& level : levels)
            lists.push_back(&level.mesh.indices);
        count("fetch order", "vertices moved to the order of their use", [&] { return orderVertices(surface_.mesh, lists); });
        measureReuse(&CacheComparison::after);
    }

    /// Each part is a draw of its own, which begins with an empty cache.
    void measureReuse(order::CacheCost CacheComparison::*figure) {
        const Mesh& mesh = surface_.mesh;
        if (report_.cache.empty())
            for (const NamedModel& model : kReportedModels)
                report_.cache.push_back({.model = model});
        forEachInParallel(report_.cache.size(), [&](std::size_t i) {
            order::CacheCost& sum = report_.cache[i].*figure;
            LocalVertices local(mesh.parts.size() > 1 ? mesh.positions.size() : 0);
            for (const MeshPart& part : mesh.parts) {
                const auto own = std::span(mesh.indices).subspan(part.firstIndex, part.indexCount);
                const bool alone = mesh.parts.size() == 1;
                const std::span<const std::uint32_t> indices = alone ? std::span<const std::uint32_t>(own) : local.enter(own);
                const std::size_t vertices = alone ? mesh.positions.size() : local.global().size();
                const order::CacheCost cost = order::measure(report_.cache[i].model.model, indices, vertices);
                sum.misses += cost.misses;
                sum.faces += cost.faces;
                sum.vertices += cost.vertices;
            }
        });
    }

    /// Parts are drawn one by one, so each is ordered by itself.
    std::optional<Error> reorderParts(std::vector<std::uint32_t>& indices, const std::vector<MeshPart>& parts) const {
        order::PartsReorder reorder(*options_.order, options_.cache, indices.size() / 3);
        std::mutex mutex;
        std::vector<LocalVertices> idle; // as many as work at once: each has a number for every vertex
        const auto done = tryEachInParallel(parts.size(), [&](std::size_t i) -> Result<void> {
            std::optional<LocalVertices> local;
            {
                const std::lock_guard lock(mutex);
                if (!idle.empty()) {
                    local = std::move(idle.back());
                    idle.pop_back();
                }
            }
            if (!local) local.emplace(surface_.mesh.positions.size());
            const auto own = std::span(indices).subspan(parts[i].firstIndex, parts[i].indexCount);
            auto reordered = reorderPart(own, *local, reorder);
            const std::lock_guard lock(mutex);
            idle.push_back(std::move(*local));
            return reordered;
        });
        return done ? std::nullopt : std::optional<Error>(done.error());
    }

    Result<void> reorderPart(std::span<std::uint32_t> own, LocalVertices& local, order::PartsReorder& reorder) const {
        const auto& triangles = local.enter(own);
        const std::vector<glm::vec3> positions = local.gathered(surface_.mesh.positions);
        const auto ordered =
            reorder(triangles, local.global().size(), {positions.empty() ? nullptr : &positions[0].x, 3 * positions.size()});
        if (!ordered) return ordered.error();
        assert(order::samePermutation(triangles, *ordered));
        std::ranges::transform(*ordered, own.begin(), [&](std::uint32_t corner) { return local.global()[corner]; });
        return {};
    }

    void orderByDepth() {
        begin("overdraw");
        report_.overdraw = orderForOverdraw(surface_.mesh);
        end("overdraw", surface_.triangles(),
            fmt::format("{:.3f} fragments per pixel before, {:.3f} after", report_.overdraw->before, report_.overdraw->after));
    }

    std::optional<Error> addLevels(Levels made, double seconds) {
        begin("levels");
        std::string text = fmt::format("{} coarser", made.levels.size());
        if (made.leftOver > 0) text += fmt::format("; {} parts with seams or of no manifold went to meshoptimizer", made.leftOver);
        const auto ordered = tryEachInParallel(options_.order ? made.levels.size() : 0, [&](std::size_t i) -> Result<void> {
            MeshLevel& level = made.levels[i].mesh;
            if (auto error = reorderParts(level.indices, level.parts)) return std::move(*error);
            return {};
        });
        if (!ordered) return ordered.error();
        for (Level& level : made.levels) {
            const std::size_t triangles = level.mesh.indices.size() / 3;
            report_.levels.push_back({.triangles = triangles, .error = level.error});
            const bool bound = told(level.error) == level.error.greatest;
            text += fmt::format("; {} triangles, {} {:.4g} mm off, {:.4g} rms", triangles, bound ? "at most" : "as measured by samples",
                                told(level.error), level.error.rms);
            glb_.levels.push_back(std::move(level.mesh));
        }
        if (!made.whyEarly.empty()) text += "; no more: " + made.whyEarly;
        end("levels", made.levels.size(), std::move(text));
        report_.steps.back().seconds += seconds;
        return std::nullopt;
    }

    /// What is left is how the numbers are stored.
    std::optional<Error> pack() {
        Mesh& mesh = surface_.mesh;
        const std::size_t bytes = vertexBytes(mesh, options_.precision);
        const bool moves = mesh.motion != nullptr;
        if (moves && options_.precision != VertexPrecision::Float)
            warn(5331, "a mesh that moves keeps its floats: --vertex is for those that stand still");
        if (options_.precision != VertexPrecision::Float && !moves) {
            begin("precision");
            const auto error = reducePrecision(mesh, options_.precision);
            if (!error) return error.error();
            report_.precision = *error;
            end("precision", mesh.positions.size(),
                fmt::format("positions at most {:.3g} mm off, normals {:.3g} degrees, texture coordinates {:.3g}", error->positionMm,
                            error->normalDegrees, error->uv));
            if (!hasArea(mesh))
                return inputError(
                    7020, {.file = path_.string()}, "no triangle has an area",
                    fmt::format("positions are up to {:.3g} mm off with so few bits: --vertex float keeps them", error->positionMm));
            glb_.format = options_.precision == VertexPrecision::Unorm16 ? VertexFormat::Unorm16 : VertexFormat::Float;
        }
        report_.output = {.vertices = mesh.positions.size(), .faces = mesh.indices.size() / 3};
        const bool chunked = options_.chunk16 && mesh.positions.size() > kMost16BitVertices;
        if (chunked) cutUp();
        const bool small = chunked || report_.output.vertices <= kMost16BitVertices;
        const std::size_t stored = report_.output.vertices + report_.chunks.duplicates;
        report_.bytes = sizes(stored, report_.output.faces, bytes, small);
        report_.seedBytes = sizes(stored, report_.output.faces, 24, small);
        glb_.moved = report_.centring.moved;
        if (options_.centre != CentreMode::None) glb_.place = report_.centring.place;
        warnOfRounding();
        return std::nullopt;
    }

    /// What a glb stores as a float.
    void warnOfRounding() {
        for (MeshAttribute& attribute : surface_.mesh.attributes) {
            std::size_t rounded = 0;
            std::size_t notFinite = 0;
            for (double& value : attribute.values) {
                notFinite += !std::isfinite(value);
                if (!std::isfinite(value)) value = 0; // glTF has no other number for it
                rounded += static_cast<double>(static_cast<float>(value)) != value;
            }
            if (notFinite > 0) warn(5331, fmt::format("{} values of '{}' are not finite: 0 is written", notFinite, attribute.name));
            if (rounded > 0)
                warn(5331, fmt::format("{} values of '{}' are rounded to floats in a glb; a PLY file keeps them", rounded, attribute.name));
        }
    }

    void warn(int code, std::string text, std::string hint = {}) {
        report_.warnings.push_back(inputWarning(code, {.file = path_.string()}, std::move(text), std::move(hint)));
    }

    void cutUp() {
        begin("chunks");
        std::vector<MeshLevel*> levels;
        for (MeshLevel& level : glb_.levels)
            levels.push_back(&level);
        report_.chunks = cutIntoChunks(surface_.mesh, levels);
        glb_.partsOwnVertices = true;
        end("chunks", report_.chunks.count,
            fmt::format("{} pieces of at most {} vertices, {} vertices more", report_.chunks.count, kMost16BitVertices,
                        report_.chunks.duplicates));
    }

    const std::filesystem::path& path_;
    const PrepOptions& options_;
    Surface surface_;
    std::optional<Mesh> before_; // with its old texture coordinates, for its textures
    GlbOptions glb_;
    PrepReport report_;
    double reach_ = 0; // mm: the greatest coordinate
    Clock::time_point started_;
};

std::optional<Error> check(const PrepOptions& options) {
    const SamePlace& same = options.same;
    if (same.epsilon && (!(*same.epsilon >= 0) || !std::isfinite(*same.epsilon)))
        return usageError(7022, fmt::format("a weld distance of {:g}", *same.epsilon), "give a length in the file's unit, or 0");
    if (same.decimals && (*same.decimals < 0 || *same.decimals > kMostDecimals))
        return usageError(7023, fmt::format("{} decimals", *same.decimals), fmt::format("give 0 to {}", kMostDecimals));
    if (same.decimals && same.epsilon.value_or(0) > 0)
        return usageError(7024, "a weld distance and a number of decimals", "choose one of them");
    return std::nullopt;
}

} // namespace

Result<Prepared> prepareMesh(const std::filesystem::path& path, const PrepOptions& options) {
    if (auto wrong = check(options)) return *wrong;
    try {
        return Preparation(path, options).run();
    } catch (const std::bad_alloc&) {
        return machineError(7025, fmt::format("{}: not enough memory to prepare the mesh", path.string()),
                            "close programs, reduce it, or give a larger --max-memory");
    }
}

} // namespace tegument::prep
