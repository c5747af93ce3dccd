// Skins, morph targets and animations as section 3.7 and appendix C of the glTF 2.0 specification have them, in double precision.

#include "host/mesh/motion.h"

#include "host/mesh/normals.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

namespace tegument {

namespace {

using Path = MotionChannel::Path;
using Between = MotionChannel::Between;
using Numbers = std::vector<double>;

glm::dquat quaternion(const double* xyzw) {
    const glm::dquat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const double length = glm::length(q);
    return length > 0 ? q / length : glm::dquat(1, 0, 0, 0);
}

/// By the shorter way round; nearly equal ones linearly.
glm::dquat turned(const glm::dquat& from, glm::dquat to, double share) {
    double cosine = glm::dot(from, to);
    if (cosine < 0) to = -to, cosine = -cosine;
    if (cosine > 1 - 1e-12) return glm::normalize(from * (1 - share) + to * share);
    const double angle = std::acos(cosine);
    return (from * std::sin((1 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
}

/// The numbers of a channel at a time.
Numbers sampled(const MotionChannel& channel, double seconds) {
    const bool cubic = channel.between == Between::CubicSpline;
    const std::size_t width = channel.width;
    const auto number = [&](std::size_t key, std::size_t part, std::size_t i) {
        return static_cast<double>(channel.values[(cubic ? 3 * key + part : key) * width + i]);
    };
    const auto after = std::ranges::upper_bound(channel.times, seconds, {}, [](float t) { return static_cast<double>(t); });
    const auto next = static_cast<std::size_t>(after - channel.times.begin());
    const std::size_t last = next == 0 ? 0 : next - 1;
    Numbers values(width);
    const bool stands = next == 0 || next == channel.times.size() || channel.between == Between::Step;
    const double from = static_cast<double>(channel.times[last]);
    const double length = stands ? 1 : static_cast<double>(channel.times[next]) - from;
    const double t = stands ? 0 : (seconds - from) / length;
    for (std::size_t i = 0; i < width; ++i) {
        const double a = number(last, 1, i);
        if (stands) {
            values[i] = a;
        } else if (!cubic) {
            values[i] = a + t * (number(next, 1, i) - a);
        } else { // appendix C.5
            const double t2 = t * t, t3 = t2 * t;
            values[i] = (2 * t3 - 3 * t2 + 1) * a + length * (t3 - 2 * t2 + t) * number(last, 2, i) +
                        (3 * t2 - 2 * t3) * number(next, 1, i) + length * (t3 - t2) * number(next, 0, i);
        }
    }
    if (channel.path == Path::Rotation && channel.between == Between::Linear && !stands) {
        Numbers a(4), b(4);
        for (std::size_t i = 0; i < 4; ++i)
            a[i] = number(last, 1, i), b[i] = number(next, 1, i);
        const glm::dquat q = turned(quaternion(a.data()), quaternion(b.data()), t);
        values = {q.x, q.y, q.z, q.w};
    }
    return values;
}

glm::dmat4 localOf(const MotionNode& node) {
    if (node.matrix) return *node.matrix;
    glm::dmat4 matrix(1);
    if (node.rotation != glm::dvec4(0, 0, 0, 1)) matrix = glm::mat4_cast(quaternion(&node.rotation.x));
    for (glm::length_t i = 0; i < 3; ++i)
        matrix[i] *= node.scale[i];
    matrix[3] = glm::dvec4(node.translation, 1);
    return matrix;
}

} // namespace

Carrier::Carrier(const glm::dmat4& m) : matrix(m), linear(m) {
    const double scale = linear[0][0];
    turns = !(scale > 0 && linear == glm::dmat3(scale));
    mirrors = glm::determinant(linear) < 0;
    normals = glm::dmat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1]));
    if (mirrors) normals = -normals;
}

glm::vec3 Carrier::direction(const glm::dmat3& by, const glm::vec3& v) const {
    if (!turns) return v;
    const glm::dvec3 carried = by * glm::dvec3(v);
    const double length = glm::length(carried);
    return length > 0 ? glm::vec3(carried / length) : glm::vec3(0);
}

const MotionRun& Motion::runOf(std::uint32_t vertex) const {
    assert(!runs.empty());
    return *std::prev(std::ranges::upper_bound(runs, vertex, {}, &MotionRun::firstVertex));
}

MotionState stateAt(const Motion& motion, const MotionAnimation* animation, double seconds) {
    std::vector<MotionNode> nodes = motion.nodes;
    for (const MotionChannel& channel : animation ? animation->channels : std::vector<MotionChannel>()) {
        MotionNode& node = nodes[channel.node];
        const Numbers v = sampled(channel, seconds);
        switch (channel.path) {
        case Path::Translation: node.translation = {v[0], v[1], v[2]}; break;
        case Path::Rotation: node.rotation = {v[0], v[1], v[2], v[3]}; break;
        case Path::Scale: node.scale = {v[0], v[1], v[2]}; break;
        case Path::Weights: node.weights = v; break;
        }
    }
    MotionState state{.worlds = std::vector<glm::dmat4>(nodes.size()), .weights = {}};
    for (const std::size_t i : motion.order)
        state.worlds[i] = nodes[i].parent ? state.worlds[*nodes[i].parent] * localOf(nodes[i]) : localOf(nodes[i]);
    for (MotionNode& node : nodes)
        state.weights.push_back(std::move(node.weights));
    return state;
}

MotionShape::MotionShape(const Motion& motion, const MotionState& state, const glm::dmat4& root) : motion_(motion), state_(state) {
    for (const glm::dmat4& world : state.worlds)
        places_.push_back(root * world);
    for (const MotionSkin& skin : motion.skins) {
        joints_.emplace_back();
        for (std::size_t i = 0; i < skin.joints.size(); ++i)
            joints_.back().push_back(places_[skin.joints[i]] * skin.inverseBinds[i]);
    }
}

/// Weights of a sum that is not 1 are divided by it; a vertex whose sum is 0 goes with its first joint.
Carrier MotionShape::carrier(std::uint32_t vertex) const {
    const MotionRun& run = motion_.runOf(vertex);
    if (!run.skin) return Carrier(places_[run.node]);
    const std::size_t first = (vertex - run.firstVertex) * run.influences;
    glm::dmat4 sum(0);
    double weights = 0;
    for (std::size_t i = first; i < first + run.influences; ++i) {
        const auto weight = static_cast<double>(run.weights[i]);
        if (weight != 0) sum += weight * joints_[*run.skin][run.joints[i]];
        weights += weight;
    }
    return Carrier(weights > 0 ? sum / weights : joints_[*run.skin][run.joints[first]]);
}

glm::dvec3 MotionShape::morphed(std::uint32_t vertex, const glm::dvec3& at, std::vector<glm::vec3> MorphTarget::*list, double sign) const {
    const MotionRun& run = motion_.runOf(vertex);
    const std::vector<double>& weights = state_.weights[run.node];
    glm::dvec3 result = at;
    for (std::size_t i = 0; i < std::min(run.targets.size(), weights.size()); ++i)
        if (const auto& changes = run.targets[i].*list; !changes.empty() && weights[i] != 0)
            result += sign * weights[i] * glm::dvec3(changes[vertex - run.firstVertex]);
    return result;
}

glm::dvec3 MotionShape::inFile(std::uint32_t vertex, const Carrier& by, const glm::vec3& v, bool isNormal) const {
    const auto list = isNormal ? &MorphTarget::normals : &MorphTarget::tangents;
    const glm::dvec3 own = isNormal ? glm::dvec3(motion_.normals[vertex]) : glm::dvec3(motion_.tangents[vertex]);
    if (by.direction(isNormal ? by.normals : by.linear, glm::vec3(morphed(vertex, own, list))) == v) return own;
    glm::dvec3 back(v);
    if (by.turns && isNormal) back = glm::transpose(by.linear) * back;
    if (by.turns && !isNormal && glm::determinant(by.linear) != 0) back = glm::inverse(by.linear) * back;
    const double length = glm::length(back);
    return morphed(vertex, length > 0 ? back / length : back, list, -1);
}

namespace {

template <class Name>
std::string known(const std::vector<Name>& names, const char* what) {
    return names.empty() ? fmt::format("it has no {}", what) : fmt::format("its {}: {}", what, fmt::join(names, ", "));
}

/// The item of that name, else of that number.
std::optional<std::size_t> find(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    std::size_t number = 0;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
    if (parsed.ec != std::errc() || parsed.ptr != name.data() + name.size() || number >= names.size()) return std::nullopt;
    return number;
}

Error unknown(const std::string& option, const std::string& name, const std::vector<std::string>& names, const char* what) {
    const std::string near = didYouMean(name, names);
    return usageError(8053, fmt::format("{} {}: the mesh has none of that name", option, name),
                      (near.empty() ? "" : near + "; ") + known(names, what));
}

std::optional<Error> setMorphs(const Motion& motion, const PoseChoice& choice, MotionState& state) {
    for (const auto& [name, weight] : choice.morphs) {
        bool found = false;
        std::vector<std::string> all;
        for (const MotionRun& run : motion.runs) {
            std::vector<std::string> names;
            for (const MorphTarget& target : run.targets)
                names.push_back(target.name);
            for (const std::string& one : names)
                if (std::ranges::find(all, one) == all.end()) all.push_back(one);
            const auto index = find(names, name);
            if (!index) continue;
            found = true;
            state.weights[run.node].resize(std::max(state.weights[run.node].size(), names.size()), 0);
            state.weights[run.node][*index] = weight;
        }
        if (!found) return unknown("--morph", name, all, "morph targets");
    }
    return std::nullopt;
}

/// A mesh in its default pose and how its vertices came there.
class Poser {
public:
    Poser(Mesh& mesh, const MotionState& state)
        : mesh_(mesh), motion_(*mesh.motion), restState_(stateAt(motion_, nullptr, 0)), rest_(motion_, restState_, mesh.motionRoot),
          shape_(motion_, state, mesh.motionRoot) {}

    void pose() {
        const bool own = std::ranges::all_of(motion_.runs, &MotionRun::hasNormals);
        std::vector<bool> flipped(mesh_.positions.size(), false);
        for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
            const std::uint32_t vertex = mesh_.motionVertices[i];
            const Carrier from = rest_.carrier(vertex);
            const Carrier to = shape_.carrier(vertex);
            const glm::dvec3 local = shape_.morphed(vertex, motion_.positions[vertex], &MorphTarget::positions);
            mesh_.positions[i] = glm::vec3(glm::dvec3(to.matrix * glm::dvec4(local, 1)) - mesh_.origin);
            flipped[i] = from.mirrors != to.mirrors;
            if (!mesh_.normals.empty()) turn(mesh_.normals[i], vertex, from, to, &MorphTarget::normals);
            if (mesh_.tangents.empty()) continue;
            glm::vec3 tangent(mesh_.tangents[i]);
            turn(tangent, vertex, from, to, &MorphTarget::tangents);
            mesh_.tangents[i] = {tangent, flipped[i] ? -mesh_.tangents[i].w : mesh_.tangents[i].w};
        }
        for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3)
            if (flipped[mesh_.indices[i]]) std::swap(mesh_.indices[i + 1], mesh_.indices[i + 2]);
        if (!own) mesh_.normals.clear();
        computeNormals(mesh_);
        computeBounds(mesh_);
        for (MeshPart& part : mesh_.parts)
            computeClusters(mesh_, part);
    }

private:
    /// What was made anew at rest moves as the file's own does.
    void turn(glm::vec3& v, std::uint32_t vertex, const Carrier& from, const Carrier& to, std::vector<glm::vec3> MorphTarget::*list) const {
        const bool isNormal = list == &MorphTarget::normals;
        const glm::dvec3 local = shape_.morphed(vertex, rest_.inFile(vertex, from, v, isNormal), list);
        const glm::vec3 turned = to.direction(isNormal ? to.normals : to.linear, glm::vec3(local));
        if (turned != glm::vec3(0)) v = glm::normalize(turned);
    }

    Mesh& mesh_;
    const Motion& motion_;
    MotionState restState_;
    MotionShape rest_;
    MotionShape shape_;
};

} // namespace

Result<const MotionAnimation*> chosenAnimation(const Mesh& mesh, const PoseChoice& choice) {
    std::vector<std::string> names;
    for (const MotionAnimation& animation : mesh.motion ? mesh.motion->animations : std::vector<MotionAnimation>())
        names.push_back(animation.name);
    if (choice.animation.empty() && !choice.time) return nullptr;
    const auto found = find(names, choice.animation.empty() ? "0" : choice.animation);
    if (!found) return unknown(choice.animation.empty() ? "--time" : "--animation", choice.animation, names, "animations");
    return &mesh.motion->animations[*found];
}

Result<void> poseMesh(Mesh& mesh, const PoseChoice& choice) {
    const auto animation = chosenAnimation(mesh, choice);
    if (!animation) return animation.error();
    static const Motion kNone;
    MotionState state = stateAt(mesh.motion ? *mesh.motion : kNone, *animation, choice.time.value_or(0));
    if (auto error = setMorphs(mesh.motion ? *mesh.motion : kNone, choice, state)) return *error;
    if (mesh.motion) Poser(mesh, state).pose();
    return {};
}

} // namespace tegument
