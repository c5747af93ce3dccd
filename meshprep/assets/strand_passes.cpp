#include "meshprep/assets/strand_passes.h"

#include "host/run/target_desc.h"
#include "host/support/text.h"
#include "meshprep/assets/given_values.h"
#include "meshprep/fur/ribbons/ribbons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::assets {

namespace {

constexpr double kRootColumns = 4096; // texels in a row of the texture of roots (docs/design/fur.md)

/// Of the parameter that the annotation names; nothing where there is none. TG4081 no such parameter.
Result<std::optional<double>> namedNumber(const PassRequest& request, const char* annotation) {
    const Annotation* given = request.pass.annotations.find(annotation);
    const auto name = request.pass.annotations.string(annotation);
    if (!name) return std::optional<double>();
    const auto found = std::ranges::find_if(request.effect.parameters,
                                            [&](const Parameter& parameter) { return equalsIgnoreCase(parameter.name, *name); });
    if (found == request.effect.parameters.end() || !found->type.isNumeric())
        return inputError(4081, given->at, fmt::format("{} = \"{}\" names no number of the effect", annotation, *name));
    const auto value = request.value(*found);
    if (!value) return value.error();
    return std::optional(value->front());
}

double meshRadius(const PassRequest& request) {
    return static_cast<double>(request.mesh.bounds.radius);
}

/// The annotation Reach names a parameter: this, times ReachScale, says how far from the mesh the pass draws, in its radii. Without it
/// nothing is left out.
Result<std::optional<run::PartView>> viewOf(const PassRequest& request) {
    const auto reach = namedNumber(request, "Reach");
    if (!reach) return reach.error();
    if (!*reach) return std::optional<run::PartView>();
    const auto scale = request.pass.annotations.numbers("ReachScale");
    const double radii = std::abs(**reach) * (scale ? scale->front() : 1);
    run::PartView view = run::partView(request.viewProjection * request.world, request.eye, radii * meshRadius(request));
    view.hidden = horizonOf(radii);
    return std::optional(view);
}

/// Of a world that stretches the mesh: its longest axis by its shortest.
double unevenness(const glm::dmat4& world) {
    const double lengths[] = {glm::length(world[0]), glm::length(world[1]), glm::length(world[2])};
    return *std::ranges::max_element(lengths) / std::max(*std::ranges::min_element(lengths), 1e-30);
}

/// Mean distance of the roots of the part, mm, at least what it is where they stand as densely as anywhere.
double spacingOf(const Mesh& mesh, const MeshPart& strands) {
    if (strands.indexCount == 0) return 0;
    const auto rootAt = [&](std::size_t i) { return mesh.uvs[mesh.indices[strands.firstIndex + i]].y; };
    std::size_t ribbon = 3;
    while (ribbon < strands.indexCount && rootAt(ribbon) == rootAt(0))
        ribbon += 3;
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positions[mesh.indices[i]]); };
    double area = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) // ribbons have none
        area += 0.5 * glm::length(glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i)));
    return std::sqrt(area * static_cast<double>(ribbon) / strands.indexCount);
}

/// Which strands are too thin for the pass, and from where on, as the annotations Least, LeastRadius or LeastSpacings, LeastScale and
/// LeastTaper say.
Result<void> addLeast(const PassRequest& request, const MeshPart* strands, StrandShare& share) {
    const auto least = namedNumber(request, "Least");
    if (!least) return least.error();
    const auto radius = namedNumber(request, "LeastRadius");
    if (!radius) return radius.error();
    const auto spacings = namedNumber(request, "LeastSpacings");
    if (!spacings) return spacings.error();
    if (!*least || !strands) return {};
    const auto scale = request.pass.annotations.numbers("LeastScale");
    const double unit = *spacings ? spacingOf(request.mesh, *strands) : meshRadius(request);
    const auto taper = request.pass.annotations.numbers("LeastTaper");
    share.least = **least;
    share.taper = taper ? std::max(taper->front(), 0.0) : 0;
    share.widest = 2 * (*spacings ? **spacings : radius->value_or(0)) * unit * (scale ? scale->front() : 1) * unevenness(request.world);
    return {};
}

Result<std::optional<StrandShare>> shareOf(const PassRequest& request) {
    const auto share = namedNumber(request, "Share");
    if (!share) return share.error();
    if (!*share) return std::optional<StrandShare>();
    const auto width = namedNumber(request, "ShareRadius");
    if (!width) return width.error();
    const auto thinnest = namedNumber(request, "ShareThinnest");
    if (!thinnest) return thinnest.error();
    const auto fewest = namedNumber(request, "ShareFewest");
    if (!fewest) return fewest.error();
    const auto first = request.pass.annotations.numbers("ShareFirst");
    const auto segment = namedNumber(request, "Segment");
    if (!segment) return segment.error();
    const auto length = namedNumber(request, "SegmentsOf");
    if (!length) return length.error();
    const auto scale = request.pass.annotations.numbers("SegmentScale");
    const auto rows = request.pass.annotations.numbers("SegmentFewest");
    const double half = std::tan(0.5 * request.horizontalFov);
    const double mm = meshRadius(request) * unevenness(request.world);
    return std::optional(StrandShare{.share = **share,
                                     .width = 2 * width->value_or(0) * mm,
                                     .thinnest = thinnest->value_or(0),
                                     .fewest = fewest->value_or(0),
                                     .first = first ? first->front() : 0,
                                     .pixel = 2 * half / request.viewportWidth,
                                     .count = request.instances,
                                     .length = length->value_or(0) * (scale ? scale->front() : 1) * mm,
                                     .segment = segment->value_or(0),
                                     .fewestSegments = static_cast<std::uint32_t>(std::clamp(rows ? rows->front() : 1.0, 1.0, 64.0))});
}

/// The part that the pass draws, where it is ribbons.
const MeshPart* partOfStrands(const PassRequest& request) {
    const auto part = request.pass.annotations.string("Part");
    const Mesh& mesh = request.mesh;
    if (!part || mesh.uvs.empty() || mesh.normals.empty()) return nullptr;
    const auto named = std::ranges::find(mesh.parts, *part, &MeshPart::name);
    return named != mesh.parts.end() && isRibbons(*named) ? &*named : nullptr;
}

/// Says what makes strands, where the mesh has none.
Error withHowToGrow(Error error, const PassRequest& request) {
    const auto part = request.pass.annotations.string("Part");
    const bool strands = part == kStrandsPart || part == kUnderfurPart;
    if (strands && error.diagnostics.front().code == 4060)
        error.diagnostics.front().hint = "tegument fur strands MESH -o NEW.glb makes them";
    return error;
}

/// Strands of a root, and rows of each.
struct Noted {
    double strands = 1;
    double rows = 1;
};

Result<Noted> notedBy(const PassRequest& request) {
    const auto strands = namedNumber(request, "RowsStrands");
    if (!strands) return strands.error();
    const auto more = namedNumber(request, "RowsMore");
    if (!more) return more.error();
    const auto segments = namedNumber(request, "RowsEach");
    if (!segments) return segments.error();
    const auto scale = request.pass.annotations.numbers("RowsScale");
    return Noted{.strands = strands->value_or(1) + more->value_or(0),
                 .rows = std::ceil((scale ? scale->front() : 1) * std::round(segments->value_or(0))) + 1};
}

std::string howToGive(const Pass& pass, double wanted) {
    const auto macro = pass.annotations.string("RowsMacro");
    if (!macro || wanted > run::kMaxExtent)
        return fmt::format("take fewer strands, or a technique without compute shaders: a target has {} rows at most", run::kMaxExtent);
    return fmt::format("{} {}={:.0f}, fewer strands, or a technique without compute shaders", findSwitch(*macro) ? "--set" : "-D", *macro,
                       wanted);
}

} // namespace

/// Least cosine between a normal and the way to the eye at which strands are still drawn, for a pass that reaches so many of the mesh's
/// radii: over the horizon of a ball of radius R strands of the length K R that stand reach at -sqrt(1 - 1 / (1 + K)^2), leaning ones as if
/// they were half as long again. K is the reach, 0.28 at least: Reach is four lengths, and a body bends as a ball of a quarter of the
/// mesh's radius. ribbonHorizon of effects/passes/fur_ribbons.fxh is the same.
double horizonOf(double reach) {
    constexpr double kLeast = 0.28;
    constexpr double kLeaning = 1.5; // a strand that leans reaches further than one that stands
    const double away = 1 + kLeaning * std::max(reach, kLeast);
    return -std::sqrt(1 - 1 / (away * away));
}

Result<std::shared_ptr<const DrawList>> StrandPasses::list(const PassRequest& request) {
    using List = std::shared_ptr<const DrawList>;
    if (const auto all = run::partOf(request.effect, request.pass, request.mesh); !all) return withHowToGrow(all.error(), request);
    const auto view = viewOf(request);
    if (!view) return view.error();
    auto share = shareOf(request);
    if (!share) return share.error();
    const MeshPart* strands = partOfStrands(request);
    if (*share)
        if (const auto added = addLeast(request, strands, **share); !added) return added.error();
    if (!*view && !*share) return List();
    const run::PartView* seen = *view ? &**view : nullptr;
    if (!strands || request.instances == 0) {
        const auto ranges = run::partOf(request.effect, request.pass, request.mesh, seen);
        if (!ranges) return ranges.error();
        return List(std::make_shared<DrawList>(DrawList{.ranges = *ranges}));
    }
    const StrandShare asked = share->value_or(StrandShare{.count = request.instances});
    const Key key{.indices = request.mesh.indices.data(),
                  .part = strands->name,
                  .reach = seen ? seen->reach : -1,
                  .share = asked,
                  .toClip = request.viewProjection * request.world,
                  .eye = request.eye};
    const std::scoped_lock lock(mutex_);
    std::erase_if(made_, [&](const Made& made) { return made.whole ? made.key.indices != key.indices : made.list.expired(); });
    const auto found = std::ranges::find(made_, key, &Made::key);
    if (found != made_.end() && !found->whole) return found->list.lock();
    auto listed = found != made_.end() ? std::nullopt : listStrands(request.mesh, *strands, seen, request.eye, asked);
    if (!listed) { // all of the part, without clusters that cannot be seen
        if (found == made_.end()) made_.push_back({.key = key, .whole = true});
        const auto ranges = run::partOf(request.effect, request.pass, request.mesh, seen);
        if (!ranges) return ranges.error();
        return List(std::make_shared<DrawList>(DrawList{.ranges = *ranges}));
    }
    const List list = std::make_shared<DrawList>(*std::move(listed));
    made_.push_back({.key = key, .whole = false, .list = list});
    return list;
}

std::uint32_t rootRowsOf(const Mesh& mesh, const std::string& part) {
    const auto named = std::ranges::find(mesh.parts, part, &MeshPart::name);
    if (named == mesh.parts.end() || !isRibbons(*named) || named->indexCount == 0 || mesh.uvs.empty()) return 0;
    const auto addressAt = [&](std::uint32_t i) { return mesh.uvs[mesh.indices[named->firstIndex + i]].y; };
    std::uint32_t ribbon = 3; // indices of one: all have as many
    while (ribbon < named->indexCount && addressAt(ribbon) == addressAt(0))
        ribbon += 3;
    double least = static_cast<double>(addressAt(0));
    double most = least;
    for (std::uint32_t i = 0; i < named->indexCount; i += ribbon) {
        least = std::min(least, static_cast<double>(addressAt(i)));
        most = std::max(most, static_cast<double>(addressAt(i)));
    }
    return static_cast<std::uint32_t>(std::floor(most / kRootColumns) - std::floor(least / kRootColumns)) + 1;
}

Result<void> checkStrandRows(const PassRequest& request) {
    const Pass& pass = request.pass;
    const auto target = pass.annotations.string("Rows");
    const auto part = pass.annotations.string("Part");
    const auto rows = request.rows(target.value_or(""));
    if (!target || !part || !rows) return {};
    const auto noted = notedBy(request);
    if (!noted) return noted.error();
    const double roots = rootRowsOf(request.mesh, *part);
    const std::string threads = pass.annotations.string("Threads").value_or("");
    if (const auto most = request.rows(threads); most && roots > *most)
        return inputError(4064, pass.at,
                          fmt::format("pass {} notes {:.0f} rows of roots, and {} holds {}", pass.name, roots, threads, *most),
                          "grow fewer strands, or take a technique without compute shaders");
    const double wanted = std::ceil(roots * noted->strands * noted->rows);
    if (wanted <= *rows) return {};
    return inputError(4064, pass.at,
                      fmt::format("pass {} notes {:.0f} rows of strands, and {} holds {}: {:.0f} rows of roots, {:g} strands to a root, "
                                  "{:.0f} rows to a strand",
                                  pass.name, wanted, *target, *rows, roots, noted->strands, noted->rows),
                      howToGive(pass, wanted));
}

} // namespace tegument::assets
