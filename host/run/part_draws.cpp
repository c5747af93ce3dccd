#include "host/run/part_draws.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tegument::run {

namespace {

/// Of the parameter that the annotation names; nothing where there is none.
Result<std::optional<double>> namedNumber(const PartRequest& request, const char* annotation) {
    const auto name = request.pass.annotations.string(annotation);
    if (!name) return std::optional<double>();
    const Parameter* parameter = request.input.effect.findParameter(*name);
    assert(parameter); // host/effect has checked the annotation
    const auto value = request.prepared.values.require(*parameter);
    if (!value) return value.error();
    return std::optional(value->front());
}

double meshRadius(const PartRequest& request) {
    return static_cast<double>(request.input.mesh->bounds.radius);
}

/// The annotation Reach names a parameter: this, times ReachScale, says how far from the mesh the pass draws, in its radii. Without it
/// nothing is left out.
Result<std::optional<PartView>> viewOf(const PartRequest& request) {
    const auto reach = namedNumber(request, "Reach");
    if (!reach) return reach.error();
    if (!*reach) return std::optional<PartView>();
    const auto scale = request.pass.annotations.numbers("ReachScale");
    const double radii = std::abs(**reach) * (scale ? scale->front() : 1);
    PartView view = partView(request.prepared.scene, radii * meshRadius(request));
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
Result<void> addLeast(const PartRequest& request, const MeshPart* strands, StrandShare& share) {
    const auto least = namedNumber(request, "Least");
    if (!least) return least.error();
    const auto radius = namedNumber(request, "LeastRadius");
    if (!radius) return radius.error();
    const auto spacings = namedNumber(request, "LeastSpacings");
    if (!spacings) return spacings.error();
    if (!*least || !strands) return {};
    const auto scale = request.pass.annotations.numbers("LeastScale");
    const double unit = *spacings ? spacingOf(*request.input.mesh, *strands) : meshRadius(request);
    const auto taper = request.pass.annotations.numbers("LeastTaper");
    share.least = **least;
    share.taper = taper ? std::max(taper->front(), 0.0) : 0;
    share.widest =
        2 * (*spacings ? **spacings : radius->value_or(0)) * unit * (scale ? scale->front() : 1) * unevenness(request.prepared.scene.world);
    return {};
}

Result<std::optional<StrandShare>> shareOf(const PartRequest& request, std::uint32_t instances) {
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
    const SceneView& scene = request.prepared.scene;
    const double half = std::tan(0.5 * static_cast<double>(scene.camera.horizontalFov));
    const double mm = meshRadius(request) * unevenness(scene.world);
    return std::optional(StrandShare{.share = **share,
                                     .width = 2 * width->value_or(0) * mm,
                                     .thinnest = thinnest->value_or(0),
                                     .fewest = fewest->value_or(0),
                                     .first = first ? first->front() : 0,
                                     .pixel = 2 * half / request.viewport.width,
                                     .count = instances,
                                     .length = length->value_or(0) * (scale ? scale->front() : 1) * mm,
                                     .segment = segment->value_or(0),
                                     .fewestSegments = static_cast<std::uint32_t>(std::clamp(rows ? rows->front() : 1.0, 1.0, 64.0))});
}

const MeshPart* partOfStrands(const PartRequest& request) {
    const auto part = request.pass.annotations.string("Part");
    const Mesh& mesh = *request.input.mesh;
    if (!part || mesh.uvs.empty() || mesh.normals.empty()) return nullptr;
    const auto named = std::ranges::find(mesh.parts, *part, &MeshPart::name);
    return named != mesh.parts.end() && isRibbons(*named) ? &*named : nullptr;
}

Result<const PartList*> listed(const PartRequest& request, const MeshPart& part, const PartView* view, const StrandShare& share,
                               PartLists& lists) {
    const PartList::Key key{.mesh = request.input.mesh, .part = part.name, .reach = view ? view->reach : -1, .share = share};
    const auto found = std::ranges::find_if(lists, [&](const auto& list) { return list->key == key; });
    if (found != lists.end()) return static_cast<const PartList*>(found->get());
    auto made = listStrands(*request.input.mesh, part, view, eyeOf(request.prepared.scene), share);
    PartList list{.key = key, .indices = {}, .ranges = {}, .whole = !made};
    if (made && !made->indices.empty()) {
        auto buffer = request.device.createBuffer(gpu::BufferUsage::Index, std::as_bytes(std::span(made->indices)));
        if (!buffer) return buffer.error();
        list.indices = std::move(*buffer);
        list.ranges = std::move(made->ranges);
    }
    return static_cast<const PartList*>(lists.emplace_back(std::make_unique<PartList>(std::move(list))).get());
}

void drawList(const PartList& list, gpu::Draw& draw) {
    draw.first = draw.count = 0;
    if (list.ranges.empty()) return;
    draw.indices = &*list.indices;
    draw.count = list.ranges.front().range.count;
    draw.instances = list.ranges.front().instances;
    for (const StrandRange& range : std::span(list.ranges).subspan(1))
        draw.more.push_back({range.range.first, range.range.count, range.firstInstance, range.instances});
}

} // namespace

Result<void> chooseTriangles(const PartRequest& request, PartLists& lists, gpu::Draw& draw) {
    const auto view = viewOf(request);
    if (!view) return view.error();
    auto share = shareOf(request, draw.instances);
    if (!share) return share.error();
    const MeshPart* strands = partOfStrands(request);
    if (*share)
        if (const auto added = addLeast(request, strands, **share); !added) return added;
    if (strands && draw.instances > 0 && (*view || *share)) {
        const auto list =
            listed(request, *strands, *view ? &**view : nullptr, share->value_or(StrandShare{.count = draw.instances}), lists);
        if (!list) return list.error();
        if (!(*list)->whole) {
            drawList(**list, draw);
            return {};
        }
    }
    const auto ranges = partOf(request.input.effect, request.pass, *request.input.mesh, *view ? &**view : nullptr);
    if (!ranges) return ranges.error();
    draw.first = ranges->empty() ? 0 : ranges->front().first;
    draw.count = ranges->empty() ? 0 : ranges->front().count;
    for (std::size_t i = 1; i < ranges->size(); ++i)
        draw.more.push_back({.first = (*ranges)[i].first, .count = (*ranges)[i].count});
    return {};
}

} // namespace tegument::run
