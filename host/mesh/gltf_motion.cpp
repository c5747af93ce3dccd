#include "host/mesh/gltf_motion.h"

#include "host/mesh/welding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace tegument::meshfile {

namespace {

using Path = MotionChannel::Path;
using Between = MotionChannel::Between;

bool allFinite(const std::vector<float>& numbers) {
    return std::ranges::all_of(numbers, [](float v) { return std::isfinite(v); });
}

std::string named(const std::string& name, std::size_t number) {
    return name.empty() ? std::to_string(number) : name;
}

class MotionReader {
public:
    MotionReader(const GltfDocument& document, std::span<const std::size_t> drawing, Mesh& mesh)
        : document_(document), root_(document.root()), drawing_(drawing.begin(), drawing.end()), mesh_(mesh) {}

    Result<std::shared_ptr<Motion>> read() {
        if (!moves()) return std::shared_ptr<Motion>();
        json_ = {{"nodes", Json::array()}, {"skins", Json::array()}, {"animations", Json::array()}};
        if (auto error = readNodes()) return *error;
        if (auto error = putInOrder()) return *error;
        for (std::size_t i = 0; i < root_["skins"].size(); ++i)
            if (auto error = readSkin(root_["skins"][i])) return *error;
        for (std::size_t i = 0; i < root_["animations"].size(); ++i)
            if (const std::string why = readAnimation(root_["animations"][i], i); !why.empty())
                leftOut(fmt::format("animation '{}' is left out: {}", named(root_["animations"][i].text("name"), i), why));
        keepScene();
        motion_->json = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        return std::move(motion_);
    }

private:
    void leftOut(const std::string& text) { warn(mesh_, 5331, root_.source().whole(), text); }

    [[nodiscard]] bool moves() const {
        bool moving = root_["animations"].size() > 0;
        for (const std::size_t i : drawing_) {
            const GltfValue node = root_["nodes"][i];
            if (node["extensions"].has("EXT_mesh_gpu_instancing")) return false;
            const auto mesh = node.whole("mesh", root_["meshes"].size(), {});
            const GltfValue primitives = root_["meshes"][mesh ? *mesh : 0]["primitives"];
            moving = moving || node.has("skin");
            for (std::size_t k = 0; k < primitives.size(); ++k)
                moving = moving || primitives[k]["targets"].size() > 0;
        }
        return moving && !drawing_.empty();
    }

    /// Of a file of ours, the nodes of coarser levels stand last, and nothing but MSFT_lod names them: they are made anew.
    [[nodiscard]] std::size_t nodesToKeep() const {
        const GltfValue nodes = root_["nodes"];
        std::set<std::size_t> levels, others(drawing_.begin(), drawing_.end());
        const auto addAll = [&](const GltfValue& list, std::set<std::size_t>& set) {
            for (std::size_t k = 0; k < list.size(); ++k)
                if (const auto index = list[k].whole(nodes.size())) set.insert(*index);
        };
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            addAll(nodes[i]["extensions"]["MSFT_lod"]["ids"], levels);
            addAll(nodes[i]["children"], others);
        }
        for (std::size_t i = 0; i < root_["scenes"].size(); ++i)
            addAll(root_["scenes"][i]["nodes"], others);
        for (std::size_t i = 0; i < root_["skins"].size(); ++i)
            addAll(root_["skins"][i]["joints"], others);
        std::size_t count = nodes.size();
        while (count > 0 && levels.contains(count - 1) && !others.contains(count - 1))
            --count;
        return count;
    }

    std::optional<Error> readNodes() {
        const std::size_t count = nodesToKeep();
        motion_->nodes.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const GltfValue value = root_["nodes"][i];
            MotionNode& node = motion_->nodes[i];
            node.name = value.text("name");
            const auto list = [&](const char* key, std::size_t size, std::vector<double> absent) {
                return value.numbers(key, size, std::move(absent));
            };
            const auto m = list("matrix", 16, {});
            const auto t = list("translation", 3, {0, 0, 0}), r = list("rotation", 4, {0, 0, 0, 1}), s = list("scale", 3, {1, 1, 1});
            for (const auto* each : {&m, &t, &r, &s})
                if (!*each && (each != &m || value.has("matrix"))) return each->error();
            node.translation = {(*t)[0], (*t)[1], (*t)[2]};
            node.rotation = {(*r)[0], (*r)[1], (*r)[2], (*r)[3]};
            node.scale = {(*s)[0], (*s)[1], (*s)[2]};
            if (value.has("matrix")) {
                node.matrix = glm::dmat4(1);
                for (glm::length_t k = 0; k < 16; ++k)
                    (*node.matrix)[k / 4][k % 4] = (*m)[static_cast<std::size_t>(k)];
            }
            const GltfValue children = value["children"];
            for (std::size_t k = 0; k < children.size(); ++k) {
                const auto child = children[k].whole(count);
                if (!child) return child.error();
                if (motion_->nodes[*child].parent) return root_["nodes"][*child].wrong("is reached twice: nodes must form trees");
                motion_->nodes[*child].parent = i;
            }
            if (auto error = readWeights(value, node)) return error;
            keepNode(value, i);
        }
        return std::nullopt;
    }

    std::optional<Error> readWeights(const GltfValue& value, MotionNode& node) {
        targets_.push_back(0);
        if (!value.has("mesh")) return std::nullopt;
        const auto index = value.whole("mesh", root_["meshes"].size(), {});
        if (!index) return index.error();
        const GltfValue mesh = root_["meshes"][*index];
        targets_.back() = mesh["primitives"].size() > 0 ? mesh["primitives"][std::size_t{0}]["targets"].size() : 0;
        const GltfValue from = value.has("weights") ? value : mesh;
        const auto weights = from.numbers("weights", targets_.back(), std::vector<double>(targets_.back(), 0));
        if (!weights) return weights.error();
        node.weights = *weights;
        return std::nullopt;
    }

    /// What is valid in the new file: references to what is not kept are not.
    void keepNode(const GltfValue& value, std::size_t index) {
        Json node = Json::object();
        for (const char* key : {"name", "translation", "rotation", "scale", "matrix", "children", "camera", "extras"})
            if (value.has(key)) node[key] = value.json()[key];
        if (node.contains("name") && !node["name"].is_string()) node.erase("name");
        const auto camera = value.whole("camera", root_["cameras"].size(), {});
        if (!camera) node.erase("camera");
        if (std::ranges::find(drawing_, index) != drawing_.end()) {
            for (const char* key : {"skin", "weights"})
                if (value.has(key)) node[key] = value.json()[key];
        } else if (value.has("mesh")) {
            leftOut(fmt::format("the mesh of node '{}' is left out: no node of the default scene", named(value.text("name"), index)));
        }
        if (value["extensions"].json().is_object())
            for (const auto& [name, extension] : value["extensions"].json().items()) {
                if (name == "KHR_lights_punctual" || name == "KHR_node_visibility")
                    node["extensions"][name] = extension;
                else if (name != "MSFT_lod")
                    leftOut(fmt::format("{} of node '{}' is left out", name, named(value.text("name"), index)));
            }
        json_["nodes"].push_back(std::move(node));
    }

    std::optional<Error> putInOrder() {
        std::vector<std::size_t>& order = motion_->order;
        std::vector<bool> placed(motion_->nodes.size(), false);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            std::vector<std::size_t> chain;
            for (std::optional<std::size_t> at = i; at && !placed[*at]; at = motion_->nodes[*at].parent) {
                if (chain.size() > placed.size()) return root_["nodes"][i].wrong("is its own ancestor: nodes must form trees");
                chain.push_back(*at);
            }
            for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
                placed[*at] = true;
                order.push_back(*at);
            }
        }
        return std::nullopt;
    }

    /// The number of the accessor's list.
    Result<std::size_t> listOf(const GltfValue& owner, const char* key, std::size_t components) {
        const auto accessor = owner.whole(key, root_["accessors"].size(), {});
        if (!accessor) return accessor.error();
        const auto [known, isNew] = lists_.try_emplace({*accessor, components}, motion_->lists.size());
        if (!isNew) return known->second;
        auto numbers = document_.floats(*accessor, components);
        if (!numbers) {
            lists_.erase(known);
            return numbers.error();
        }
        motion_->lists.push_back({.components = components, .numbers = std::move(*numbers)});
        return known->second;
    }

    std::optional<Error> readSkin(const GltfValue& value) {
        MotionSkin skin{.name = value.text("name")};
        const GltfValue joints = value["joints"];
        if (joints.size() == 0) return value.wrong("has no joints");
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const auto joint = joints[i].whole(motion_->nodes.size());
            if (!joint) return joint.error();
            skin.joints.push_back(*joint);
        }
        skin.inverseBinds.resize(joints.size(), glm::dmat4(1));
        Json json = {{"joints", value.json()["joints"]}};
        if (value.has("inverseBindMatrices")) {
            const auto list = listOf(value, "inverseBindMatrices", 16);
            if (!list) return list.error();
            const std::vector<float>& numbers = motion_->lists[*list].numbers;
            if (numbers.size() < 16 * joints.size())
                return value.wrong(fmt::format("has {} inverse bind matrices for {} joints", numbers.size() / 16, joints.size()));
            if (!allFinite(numbers)) return value.wrong("has an inverse bind matrix that is not finite");
            for (std::size_t i = 0; i < 16 * joints.size(); ++i)
                skin.inverseBinds[i / 16][static_cast<glm::length_t>(i % 16 / 4)][static_cast<glm::length_t>(i % 4)] =
                    static_cast<double>(numbers[i]);
            json["inverseBindMatrices"] = *list;
        }
        if (!skin.name.empty()) json["name"] = skin.name;
        if (value.whole("skeleton", motion_->nodes.size(), {})) json["skeleton"] = value.json()["skeleton"];
        if (value.has("extras")) json["extras"] = value.json()["extras"];
        json_["skins"].push_back(std::move(json));
        motion_->skins.push_back(std::move(skin));
        return std::nullopt;
    }

    /// Why it cannot be kept; empty when it is.
    std::string readAnimation(const GltfValue& value, std::size_t number) {
        MotionAnimation animation{.name = named(value.text("name"), number)};
        Json json = {{"channels", Json::array()}, {"samplers", Json::array()}};
        const GltfValue channels = value["channels"];
        std::map<std::size_t, std::size_t> samplers; // by the file's number
        std::size_t pointers = 0;
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const GltfValue target = channels[i]["target"];
            pointers += target.text("path") == "pointer";
            if (!target.has("node") || target.text("path") == "pointer") continue;
            const auto node = target.whole("node", root_["nodes"].size(), {});
            if (!node) return node.error().diagnostics.front().text;
            if (*node >= motion_->nodes.size()) continue;
            const auto sampler = channels[i].whole("sampler", value["samplers"].size(), {});
            if (!sampler) return sampler.error().diagnostics.front().text;
            auto channel = readChannel(*node, target.text("path"), value["samplers"][*sampler]);
            if (!channel) return channel.error().diagnostics.front().text;
            if (channel->path == Path::Weights && std::ranges::find(drawing_, *node) == drawing_.end()) continue; // its mesh goes
            animation.seconds = std::max(animation.seconds, static_cast<double>(channel->times.back()));
            const auto [known, isNew] = samplers.try_emplace(*sampler, samplers.size());
            if (isNew) json["samplers"].push_back(sampler_);
            json["channels"].push_back({{"sampler", known->second}, {"target", {{"node", *node}, {"path", target.text("path")}}}});
            animation.channels.push_back(std::move(*channel));
        }
        if (pointers > 0)
            leftOut(fmt::format("{} channels of animation '{}' are left out: KHR_animation_pointer", pointers, animation.name));
        if (animation.channels.empty()) return "no channel of it moves a node";
        if (const std::string name = value.text("name"); !name.empty()) json["name"] = name;
        if (value.has("extras")) json["extras"] = value.json()["extras"];
        json_["animations"].push_back(std::move(json));
        motion_->animations.push_back(std::move(animation));
        return {};
    }

    /// Leaves its sampler's JSON in `sampler_`.
    Result<MotionChannel> readChannel(std::size_t node, const std::string& path, const GltfValue& sampler) {
        static const std::map<std::string, std::pair<Path, std::size_t>> kPaths = {{"translation", {Path::Translation, 3}},
                                                                                   {"rotation", {Path::Rotation, 4}},
                                                                                   {"scale", {Path::Scale, 3}},
                                                                                   {"weights", {Path::Weights, 1}}};
        static const std::map<std::string, Between> kBetween = {
            {"", Between::Linear}, {"LINEAR", Between::Linear}, {"STEP", Between::Step}, {"CUBICSPLINE", Between::CubicSpline}};
        const auto kind = kPaths.find(path);
        const auto between = kBetween.find(sampler.text("interpolation"));
        if (kind == kPaths.end()) return sampler.wrong(fmt::format("moves '{}', which nodes do not have", path.substr(0, 40)));
        if (between == kBetween.end()) return sampler.wrong("has an unknown interpolation");
        const auto input = listOf(sampler, "input", 1);
        if (!input) return input.error();
        const auto output = listOf(sampler, "output", kind->second.second);
        if (!output) return output.error();
        const std::vector<float>& times = motion_->lists[*input].numbers;
        const std::vector<float>& values = motion_->lists[*output].numbers;
        const std::size_t width = kind->second.first == Path::Weights ? targets_[node] : kind->second.second;
        if (times.empty() || width == 0) return sampler.wrong(times.empty() ? "has no times" : "moves morph targets that are not there");
        if (!allFinite(times) || !allFinite(values)) return sampler.wrong("has times or values that are not finite");
        for (std::size_t i = 1; i < times.size(); ++i)
            if (!(times[i] > times[i - 1]))
                return sampler.wrong(
                    fmt::format("has time {} ({:g} s) that is not after the one before ({:g} s)", i, times[i], times[i - 1]));
        const std::size_t wanted = times.size() * width * (between->second == Between::CubicSpline ? 3 : 1);
        if (values.size() != wanted) return sampler.wrong(fmt::format("has {} numbers, {} are needed", values.size(), wanted));
        sampler_ = {{"input", *input}, {"output", *output}};
        if (sampler.has("interpolation")) sampler_["interpolation"] = sampler.text("interpolation");
        return MotionChannel{
            .node = node, .path = kind->second.first, .between = between->second, .times = times, .values = values, .width = width};
    }

    void keepScene() {
        for (const char* key : {"cameras"})
            if (root_[key].size() > 0) json_[key] = root_[key].json();
        if (const GltfValue lights = root_["extensions"]["KHR_lights_punctual"]; lights["lights"].size() > 0)
            json_["extensions"]["KHR_lights_punctual"] = lights.json();
        json_["scene"] = Json::object();
        Json& nodes = json_["scene"]["nodes"] = Json::array();
        if (root_["scenes"].size() > 0) {
            const auto scene = root_.whole("scene", root_["scenes"].size(), 0);
            const GltfValue value = root_["scenes"][scene ? *scene : 0];
            nodes = value["nodes"].json();
            for (const char* key : {"name", "extras"})
                if (value.has(key)) json_["scene"][key] = value.json()[key];
        } else {
            for (std::size_t i = 0; i < motion_->nodes.size(); ++i)
                if (!motion_->nodes[i].parent) nodes.push_back(i);
        }
    }

    const GltfDocument& document_;
    GltfValue root_;
    std::vector<std::size_t> drawing_;
    Mesh& mesh_;
    std::shared_ptr<Motion> motion_ = std::make_shared<Motion>();
    Json json_;
    Json sampler_;
    std::vector<std::size_t> targets_; // of each node's mesh
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> lists_;
};

using Floats = std::function<Result<std::vector<float>>(const std::string& name)>;

std::optional<Error> readInfluences(const GltfValue& primitive, const Floats& floats, const MotionSkin& skin, MotionRun& run,
                                    Mesh& warnings) {
    const GltfValue list = primitive["attributes"];
    std::vector<std::vector<float>> joints, weights;
    for (std::size_t set = 0; list.has(fmt::format("JOINTS_{}", set).c_str()); ++set)
        for (auto* all : {&joints, &weights}) {
            auto read = floats(fmt::format("{}_{}", all == &joints ? "JOINTS" : "WEIGHTS", set));
            if (!read) return read.error();
            if (read->size() != 4 * run.count) return list.wrong("has other numbers of joints and weights than of positions");
            if (!allFinite(*read)) return list.wrong("has a weight that is not finite");
            all->push_back(std::move(*read));
        }
    run.influences = 4 * joints.size();
    if (joints.empty()) return list.wrong("has no JOINTS_0, and its node has a skin");
    std::size_t unheld = 0;
    for (std::size_t vertex = 0; vertex < run.count; ++vertex) {
        float sum = 0;
        for (std::size_t i = 0; i < run.influences; ++i) {
            const float joint = joints[i / 4][4 * vertex + i % 4];
            const float weight = weights[i / 4][4 * vertex + i % 4];
            const bool there = joint >= 0 && joint < static_cast<float>(skin.joints.size());
            if (!there && weight != 0)
                return badIndex(list.source().whole(),
                                fmt::format("{}: vertex {} goes with joint {:g} of {}", list.path(), vertex, joint, skin.joints.size()));
            run.joints.push_back(there ? static_cast<std::uint16_t>(joint) : std::uint16_t{0});
            run.weights.push_back(weight);
            sum += weight;
        }
        unheld += !(sum > 0);
    }
    if (unheld > 0)
        warn(warnings, 5323, list.source().whole(),
             fmt::format("{}: the weights of {} vertices have no sum above 0: they go with their first joint", list.path(), unheld));
    return std::nullopt;
}

} // namespace

Result<std::shared_ptr<Motion>> readMotion(const GltfDocument& document, std::span<const std::size_t> nodes, Mesh& warnings) {
    return MotionReader(document, nodes, warnings).read();
}

std::optional<Error> readRun(const GltfDocument& document, const GltfValue& mesh, const GltfValue& primitive, const Floats& floats,
                             const Motion& motion, MotionRun& run, Mesh& warnings) {
    const GltfValue node = document.root()["nodes"][run.node];
    if (node.has("skin")) {
        const auto skin = node.whole("skin", motion.skins.size(), {});
        if (!skin) return skin.error();
        run.skin = *skin;
        if (auto error = readInfluences(primitive, floats, motion.skins[*skin], run, warnings)) return error;
    }
    const GltfValue targets = primitive["targets"];
    if (targets.size() * run.count > kMaxIndices) return tooLarge(primitive.source().whole());
    const GltfValue names = mesh["extras"]["targetNames"];
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const bool has = i < names.size() && names.json()[i].is_string();
        MorphTarget target{.name = named(has ? names.json()[i].get<std::string>() : "", i)};
        for (const auto& [name, list] :
             {std::pair("POSITION", &target.positions), std::pair("NORMAL", &target.normals), std::pair("TANGENT", &target.tangents)}) {
            if (!targets[i].has(name)) continue;
            const auto accessor = targets[i].whole(name, SIZE_MAX, {});
            if (!accessor) return accessor.error();
            const auto read = document.floats(*accessor, 3);
            if (!read) return read.error();
            if (read->size() != 3 * run.count) return targets[i].wrong("has another number of vertices than its primitive");
            if (!allFinite(*read)) return targets[i].wrong("has a number that is not finite");
            for (std::size_t k = 0; k < read->size(); k += 3)
                list->emplace_back((*read)[k], (*read)[k + 1], (*read)[k + 2]);
        }
        run.targets.push_back(std::move(target));
    }
    return std::nullopt;
}

void findKinds(Motion& motion) {
    const auto vectorKey = [](std::uint32_t kind, const glm::vec3& v) {
        const auto bits = floatKey<3>({v.x, v.y, v.z});
        return std::array{kind, bits[0], bits[1], bits[2]};
    };
    std::vector<std::uint32_t> kinds;
    for (std::uint32_t run = 0; run < motion.runs.size(); ++run)
        kinds.resize(kinds.size() + motion.runs[run].count, run);
    kinds = firstEqual(kinds.size(), [&](std::uint32_t i) { return vectorKey(kinds[i], motion.positions[i]); });
    for (const MotionRun& run : motion.runs) {
        const auto refine = [&](const auto& keyOf) { // vertices of a run have kinds of that run
            const auto first = static_cast<std::uint32_t>(run.firstVertex);
            const auto equal = firstEqual(run.count, [&](std::uint32_t i) { return keyOf(kinds[first + i], i); });
            for (std::uint32_t i = 0; i < run.count; ++i)
                kinds[first + i] = first + equal[i];
        };
        for (std::size_t k = 0; k < run.influences; ++k)
            refine([&](std::uint32_t kind, std::uint32_t i) {
                return std::array{kind, std::uint32_t{run.joints[i * run.influences + k]},
                                  floatKey<1>({run.weights[i * run.influences + k]})[0]};
            });
        for (const MorphTarget& target : run.targets)
            for (const auto* list : {&target.positions, &target.normals, &target.tangents})
                if (!list->empty()) refine([&](std::uint32_t kind, std::uint32_t i) { return vectorKey(kind, (*list)[i]); });
    }
    motion.kinds = std::move(kinds);
}

} // namespace tegument::meshfile
