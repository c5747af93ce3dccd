#include "meshprep/write/glb_motion.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::meshfile {

namespace {

constexpr int kShorts = 5123;
constexpr int kWords = 5125;
constexpr int kFloats = 5126;
constexpr int kVertices = 34962;

std::string typeOf(std::size_t components) {
    return components == 1 ? "SCALAR" : components == 16 ? "MAT4" : fmt::format("VEC{}", components);
}

void addLimits(MotionJson& accessor, const std::vector<float>& numbers, std::size_t components) {
    for (std::size_t c = 0; c < components && c < numbers.size(); ++c) {
        float low = numbers[c], high = numbers[c];
        for (std::size_t i = c; i < numbers.size(); i += components)
            low = std::min(low, numbers[i]), high = std::max(high, numbers[i]);
        accessor["min"].push_back(low);
        accessor["max"].push_back(high);
    }
}

} // namespace

Mesh inFile(const Mesh& mesh) {
    const Motion& motion = *mesh.motion;
    const MotionState state = stateAt(motion, nullptr, 0);
    const MotionShape rest(motion, state, mesh.motionRoot);
    Mesh own = mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::uint32_t vertex = mesh.motionVertices[i];
        const Carrier by = rest.carrier(vertex);
        own.positions[i] = motion.positions[vertex];
        const auto direction = [&](const glm::vec3& v, bool isNormal) {
            const glm::dvec3 local = rest.inFile(vertex, by, v, isNormal);
            const auto& was = isNormal ? motion.normals[vertex] : glm::vec3(motion.tangents[vertex]);
            const double length = glm::length(local);
            return glm::vec3(local) == was || !(length > 0) ? glm::vec3(local) : glm::vec3(local / length);
        };
        if (!mesh.normals.empty()) own.normals[i] = direction(mesh.normals[i], true);
        if (!mesh.tangents.empty())
            own.tangents[i] = {direction(glm::vec3(mesh.tangents[i]), false), by.mirrors ? -mesh.tangents[i].w : mesh.tangents[i].w};
    }
    return own;
}

MotionWriter::MotionWriter(const Mesh& mesh, MotionJson& json, AddView addView, const glm::dvec3& place)
    : mesh_(mesh), motion_(*mesh.motion), state_(stateAt(motion_, nullptr, 0)), rest_(motion_, state_, glm::dmat4(1)), json_(json),
      addView_(std::move(addView)), own_(MotionJson::parse(motion_.json)), levelsOfNode_(motion_.nodes.size()) {
    placeScene(place);
}

/// A node above those of the scene, where the mesh was moved or its unit is not glTF's.
void MotionWriter::placeScene(const glm::dvec3& place) {
    glm::dmat4 root = mesh_.motionRoot;
    root[3] += glm::dvec4(place, 0);
    for (glm::length_t c = 0; c < 4; ++c)
        root[c] = glm::dvec4(glm::dvec3(root[c]) * 0.001, root[c].w);
    if (root == glm::dmat4(1)) return;
    MotionJson top = {{"name", "prepared"}, {"children", MotionJson::array()}, {"matrix", MotionJson::array()}};
    for (glm::length_t i = 0; i < 16; ++i)
        top["matrix"].push_back(root[i / 4][i % 4]);
    MotionJson nodes = MotionJson::array();
    for (const MotionJson& index : own_["scene"]["nodes"]) { // what a skin moves goes with its joints wherever it stands
        const MotionJson& node = own_["nodes"][index.get<std::size_t>()];
        (node.contains("skin") && !node.contains("children") ? nodes : top["children"]).push_back(index);
    }
    if (!top["children"].empty()) {
        nodes.push_back(own_["nodes"].size());
        own_["nodes"].push_back(std::move(top));
    }
    own_["scene"]["nodes"] = std::move(nodes);
}

std::size_t MotionWriter::addNumbers(const std::vector<float>& numbers, std::size_t components, std::optional<int> target) {
    const std::size_t view = addView_(numbers.data(), numbers.size() * sizeof(float), target);
    MotionJson accessor = {
        {"bufferView", view}, {"componentType", kFloats}, {"count", numbers.size() / components}, {"type", typeOf(components)}};
    if (components == 1) addLimits(accessor, numbers, components);
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].size() - 1;
}

/// Those that are not 0 alone, where that takes fewer bytes.
std::size_t MotionWriter::addChanges(const std::vector<glm::vec3>& changes) {
    std::vector<float> all;
    std::vector<std::uint32_t> where;
    std::vector<glm::vec3> what;
    for (std::uint32_t i = 0; i < changes.size(); ++i) {
        all.insert(all.end(), {changes[i].x, changes[i].y, changes[i].z});
        if (changes[i] == glm::vec3(0)) continue;
        where.push_back(i);
        what.push_back(changes[i]);
    }
    MotionJson accessor = {{"componentType", kFloats}, {"count", changes.size()}, {"type", "VEC3"}};
    addLimits(accessor, all, 3);
    if (what.size() * 4 >= changes.size() * 3) {
        accessor["bufferView"] = addView_(all.data(), all.size() * sizeof(float), kVertices);
    } else if (!what.empty()) {
        const std::size_t indices = addView_(where.data(), where.size() * sizeof(where[0]), std::nullopt);
        const std::size_t values = addView_(what.data(), what.size() * sizeof(what[0]), std::nullopt);
        accessor["sparse"] = {{"count", what.size()},
                              {"indices", {{"bufferView", indices}, {"componentType", kWords}}},
                              {"values", {{"bufferView", values}}}};
    }
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].size() - 1;
}

void MotionWriter::addTo(MotionJson& primitive, const MotionRun& run, const VertexSpan& vertices) {
    // vertices of other runs that lie between are nobody's: they go with the first joint
    const auto numberIn = [&](std::size_t i) -> std::optional<std::size_t> {
        const std::size_t number = mesh_.motionVertices[vertices.first + i] - run.firstVertex;
        return number < run.count ? std::optional(number) : std::nullopt;
    };
    for (std::size_t set = 0; set < (run.skin ? run.influences : 0); set += 4) {
        std::vector<std::uint16_t> joints(4 * vertices.count, 0);
        std::vector<float> weights(4 * vertices.count, 0);
        for (std::size_t i = 0; i < vertices.count; ++i) {
            const auto number = numberIn(i);
            if (!number && set == 0) weights[4 * i] = 1;
            for (std::size_t k = 0; number && k < 4; ++k) {
                joints[4 * i + k] = run.joints[*number * run.influences + set + k];
                weights[4 * i + k] = run.weights[*number * run.influences + set + k];
            }
        }
        primitive["attributes"][fmt::format("JOINTS_{}", set / 4)] = json_["accessors"].size();
        const std::size_t view = addView_(joints.data(), joints.size() * sizeof(joints[0]), kVertices);
        json_["accessors"].push_back({{"bufferView", view}, {"componentType", kShorts}, {"count", vertices.count}, {"type", "VEC4"}});
        primitive["attributes"][fmt::format("WEIGHTS_{}", set / 4)] = addNumbers(weights, 4, kVertices);
    }
    for (const MorphTarget& target : run.targets) {
        MotionJson json = MotionJson::object();
        for (const auto& [name, list] :
             {std::pair("POSITION", &target.positions), std::pair("NORMAL", &target.normals), std::pair("TANGENT", &target.tangents)}) {
            const bool has = name == std::string("POSITION") || !list->empty();
            if (!has || (std::string(name) == "NORMAL" && mesh_.normals.empty()) ||
                (std::string(name) == "TANGENT" && mesh_.tangents.empty()))
                continue;
            std::vector<glm::vec3> changes(vertices.count, glm::vec3(0));
            for (std::size_t i = 0; i < vertices.count && !list->empty(); ++i)
                if (const auto number = numberIn(i)) changes[i] = (*list)[*number];
            json[name] = addChanges(changes);
        }
        primitive["targets"].push_back(std::move(json));
    }
}

void MotionWriter::draw(const MotionRun& run, std::size_t mesh, std::size_t level) {
    if (!run.targets.empty()) {
        MotionJson& drawn = json_["meshes"][mesh];
        drawn["weights"] = motion_.nodes[run.node].weights;
        MotionJson names = MotionJson::array(), numbers = MotionJson::array();
        for (std::size_t i = 0; i < run.targets.size(); ++i) {
            names.push_back(run.targets[i].name);
            numbers.push_back(std::to_string(i));
        }
        if (names != numbers) drawn["extras"]["targetNames"] = names;
    }
    MotionJson& node = own_["nodes"][run.node];
    if (level == 0) {
        node["mesh"] = mesh;
        return;
    }
    MotionJson copy = {{"name", fmt::format("{} level {}", motion_.nodes[run.node].name, level)}, {"mesh", mesh}};
    for (const char* key : {"translation", "rotation", "scale", "matrix", "skin", "weights"})
        if (node.contains(key)) copy[key] = node[key];
    levelsOfNode_[run.node].push_back(own_["nodes"].size());
    own_["nodes"].push_back(std::move(copy));
}

/// Coarser levels stand in for their node, so they move as it does.
void MotionWriter::moveLevels() {
    for (std::size_t i = 0; i < levelsOfNode_.size(); ++i)
        if (!levelsOfNode_[i].empty()) own_["nodes"][i]["extensions"]["MSFT_lod"]["ids"] = levelsOfNode_[i];
    for (MotionJson& animation : own_["animations"]) {
        const MotionJson channels = animation["channels"];
        for (const MotionJson& channel : channels)
            for (const std::size_t level : levelsOfNode_[channel["target"]["node"].get<std::size_t>()]) {
                animation["channels"].push_back(channel);
                animation["channels"].back()["target"]["node"] = level;
            }
    }
}

void MotionWriter::finish() {
    moveLevels();
    std::vector<std::size_t> accessors;
    for (const Motion::List& list : motion_.lists)
        accessors.push_back(addNumbers(list.numbers, list.components, std::nullopt));
    for (MotionJson& skin : own_["skins"])
        if (skin.contains("inverseBindMatrices")) skin["inverseBindMatrices"] = accessors[skin["inverseBindMatrices"].get<std::size_t>()];
    for (MotionJson& animation : own_["animations"])
        for (MotionJson& sampler : animation["samplers"])
            for (const char* key : {"input", "output"})
                sampler[key] = accessors[sampler[key].get<std::size_t>()];
    json_["scenes"][0] = own_["scene"];
    for (const char* key : {"nodes", "skins", "animations", "cameras", "extensions"})
        if (own_.contains(key) && !own_[key].empty()) json_[key] = own_[key];
}

} // namespace tegument::meshfile
