#include "meshprep/portrait/head_pose.h"

#include "meshprep/portrait/face_relief.h"
#include "meshprep/portrait/mirror_plane.h"
#include "meshprep/portrait/surface_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tegument {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// What is seen along one direction of the plane of symmetry.
struct View {
    glm::dvec3 up{0};
    glm::dvec3 front{0};
    FaceMatch match;
};

View viewAt(const std::vector<SurfaceSample>& samples, const MirrorPlane& plane, const glm::dvec3& across, double angle, bool flipped,
            bool fine) {
    const glm::dvec3 ahead = glm::cross(plane.normal, across);
    View view;
    view.front = std::cos(angle) * across + std::sin(angle) * ahead;
    view.up = glm::cross(view.front, plane.normal) * (flipped ? -1.0 : 1.0);
    view.match = matchFace(samples, plane.point, view.up, view.front, fine);
    return view;
}

double between(const View& a, const View& b) {
    const double turn = (glm::dot(a.up, b.up) + glm::dot(a.front, b.front)); // about one axis, or flipped
    return std::acos(std::clamp(turn / 2, -1.0, 1.0));
}

bool agrees(const View& view, const HeadPoseHints& hints) {
    constexpr double kNear = 0.8; // cosine
    return (!hints.up || glm::dot(*hints.up, view.up) > kNear) && (!hints.front || glm::dot(*hints.front, view.front) > kNear);
}

/// The file's axes where the head lies nearly along them, as exporters put it.
void snap(HeadPose& pose) {
    constexpr double kFar = 22; // degrees: heads are held forward and back by as much
    const auto nearest = [](const glm::dvec3& v) {
        const glm::dvec3 size = glm::abs(v);
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        glm::dvec3 unit(0);
        unit[axis] = v[axis] > 0 ? 1 : -1;
        return unit;
    };
    const glm::dvec3 up = nearest(pose.up), front = nearest(pose.front);
    const double least = std::cos(kFar * kDegree);
    if (glm::dot(up, pose.up) < least || glm::dot(front, pose.front) < least || glm::dot(up, front) != 0) return;
    pose.up = up;
    pose.front = front;
    pose.onAxes = true;
}

} // namespace

bool isCertain(const HeadPose& pose) {
    return pose.likeness >= kLeastLikeness && pose.likeness - pose.runnerUp >= kLeastLead;
}

namespace {

std::optional<HeadPose> guessWhole(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                   const HeadPoseHints& hints) {
    const std::vector<SurfaceSample> samples = sampleSurface(positions, indices);
    if (samples.empty()) return std::nullopt;
    HeadPose pose;
    std::optional<View> best;
    double runnerUp = -1;
    for (const MirrorPlane& plane : mirrorPlanes(samples)) {
        const glm::dvec3 across =
            glm::normalize(glm::cross(plane.normal, std::abs(plane.normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        std::vector<View> views;
        constexpr int kAngles = 36;
        for (int i = 0; i < kAngles; ++i)
            for (const bool flipped : {false, true})
                views.push_back(viewAt(samples, plane, across, 2 * std::numbers::pi * i / kAngles, flipped, false));
        const auto likeness = [&](std::size_t i) { return agrees(views[i], hints) ? views[i].match.likeness : -1.0; };
        std::size_t top = 0;
        for (std::size_t i = 1; i < views.size(); ++i)
            if (likeness(i) > likeness(top)) top = i;
        if (likeness(top) <= -1) continue;
        View refined = views[top];
        const auto at = [&](const View& from, double degrees) {
            View view;
            const double turn = degrees * kDegree;
            view.front = std::cos(turn) * from.front + std::sin(turn) * from.up;
            view.up = std::cos(turn) * from.up - std::sin(turn) * from.front;
            view.match = matchFace(samples, plane.point, view.up, view.front, true);
            return view;
        };
        const View coarse = views[top];
        for (const double degrees : {-9.0, -6.0, -3.0, 0.0, 3.0, 6.0, 9.0}) {
            const View view = at(coarse, degrees);
            if (degrees == -9.0 || view.match.likeness > refined.match.likeness) refined = view;
        }
        double second = 0;
        constexpr double kAnother = 35 * kDegree;
        for (std::size_t i = 0; i < views.size(); ++i) { // of the same face seen from above or below only the best is a view of its own
            const bool highest =
                likeness(i) >= likeness((i + 2) % views.size()) && likeness(i) >= likeness((i + views.size() - 2) % views.size());
            if (highest && between(views[i], coarse) > kAnother) second = std::max(second, likeness(i));
        }
        if (best && best->match.likeness >= refined.match.likeness) {
            runnerUp = std::max(runnerUp, refined.match.likeness);
            continue;
        }
        runnerUp = std::max(second, best ? best->match.likeness : 0.0);
        best = refined;
        pose.symmetry = plane.likeness;
    }
    if (!best) return std::nullopt;
    pose.up = best->up;
    pose.front = best->front;
    pose.nasion = best->match.nasion;
    pose.millimetre = best->match.millimetre;
    pose.likeness = best->match.likeness;
    pose.runnerUp = runnerUp;
    snap(pose);
    pose.left = glm::cross(pose.up, pose.front);
    return pose;
}

/// The triangles within a share of the mesh's extent from one of its ends.
std::vector<std::uint32_t> endOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, int axis, float least,
                                 float most) {
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const auto inside = [&](std::size_t corner) {
            const float place = positions[indices[i + corner]][axis];
            return place >= least && place <= most;
        };
        if (inside(0) && inside(1) && inside(2)) kept.insert(kept.end(), {indices[i], indices[i + 1], indices[i + 2]});
    }
    return kept;
}

/// A body's head is one of the ends of its longest axes. None: the mesh is not so long.
std::optional<HeadPose> guessAtEnds(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                    const HeadPoseHints& hints) {
    constexpr std::array<float, 2> kShares = {0.17F, 0.25F}; // of a grown person's height, and of a figure with a large head
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const std::uint32_t index : indices)
        low = glm::min(low, positions[index]), high = glm::max(high, positions[index]);
    const glm::vec3 size = high - low;
    const float longest = std::max({size.x, size.y, size.z});
    if (longest < 2.2F * std::min({size.x, size.y, size.z})) return std::nullopt;
    std::optional<HeadPose> best;
    double runnerUp = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool top : {false, true}) {
            if (size[axis] < 0.6F * longest) continue;
            std::optional<HeadPose> here; // another share of the same end shows the same face
            for (const float share : kShares) {
                const float inner = top ? high[axis] - share * size[axis] : low[axis] + share * size[axis];
                const auto pose =
                    guessWhole(positions, endOf(positions, indices, axis, top ? inner : low[axis], top ? high[axis] : inner), hints);
                const float along = pose ? static_cast<float>(top ? pose->up[axis] : -pose->up[axis]) : 0.0F;
                if (along > 0.7F && (!here || pose->likeness > here->likeness)) here = pose;
            }
            if (!here) continue;
            if (!best || here->likeness > best->likeness) std::swap(best, here);
            if (here) runnerUp = std::max(runnerUp, here->likeness);
        }
    if (best) best->runnerUp = std::max(best->runnerUp, runnerUp);
    return best;
}

} // namespace

std::optional<HeadPose> guessHeadPose(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                      const HeadPoseHints& hints) {
    auto pose = guessWhole(positions, indices, hints);
    if (!pose || isCertain(*pose)) return pose;
    const auto ofBody = guessAtEnds(positions, indices, hints);
    return ofBody && isCertain(*ofBody) ? ofBody : pose;
}

} // namespace tegument
