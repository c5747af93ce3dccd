#include "host/run/products.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <span>

namespace tegument::run {

namespace fs = std::filesystem;

namespace {

/// Everything that what a node draws depends on.
struct NodeInputs {
    const Mesh* mesh = nullptr; // null where none is drawn
    bool mirrored = false;
    std::vector<Step> steps;
    std::map<std::string, Numbers> numbers;      // that shaders read, and that count instances
    std::map<std::string, std::string> textures; // name, TextureData::key
    bool operator==(const NodeInputs&) const = default;
};

NodeInputs inputsOf(const RunInput& input, const Prepared& prepared) {
    std::set<std::string> names;
    for (const auto& [pass, program] : prepared.programs) {
        names.insert(program->numbers.begin(), program->numbers.end());
        if (const auto instances = pass->annotations.string("Instances")) names.insert(*instances);
    }
    NodeInputs inputs{.mesh = prepared.drawsMesh ? input.mesh : nullptr,
                      .mirrored = prepared.drawsMesh && isMirrored(prepared.scene),
                      .steps = prepared.plan.steps};
    for (const std::string& name : names)
        if (const Numbers* value = prepared.values.find(name)) inputs.numbers.emplace(name, *value);
    for (const auto& [name, texture] : prepared.textures)
        inputs.textures.emplace(name, texture.key);
    return inputs;
}

} // namespace

struct Products::Node {
    Producer* producer;
    std::string key; // of its textures, with a target's name
    NodeInputs inputs;
    Resources resources;
    std::set<std::string> wanted; // targets that somebody samples
    bool drawn = false;
    bool due = false;  // before the frame that is being made
    bool used = false; // by it

    [[nodiscard]] std::string keyOf(const std::string& target) const { return key + " " + target; }
};

Products::Products(gpu::Device& device, Store& store) : device_(device), store_(store) {}
Products::~Products() = default;

void Products::share(const Products& before) {
    producers_ = before.producers_;
    made_ = before.made_;
    for (const Node& node : before.nodes_) {
        if (!node.drawn) continue;
        Node& own = nodes_.emplace_back(Node{.producer = node.producer,
                                             .key = node.key,
                                             .inputs = node.inputs,
                                             .resources = {device_, store_, node.producer->kit, {}},
                                             .wanted = node.wanted,
                                             .drawn = true});
        for (const auto& [name, texture] : node.resources.targets)
            store_.products[own.keyOf(name)] = &own.resources.targets.emplace(name, texture.shared()).first->second;
    }
}

void Products::begin() {
    for (Node& node : nodes_)
        node.due = node.used = false;
    std::erase_if(nodes_, [&](Node& node) { // of a frame that failed
        if (!node.drawn) drop(node);
        return !node.drawn;
    });
}

void Products::finish() {
    std::erase_if(nodes_, [&](Node& node) {
        if (!node.used) drop(node);
        return !node.used;
    });
    for (Node& node : nodes_) {
        node.drawn = true;
        std::erase_if(node.resources.targets, [&](const auto& target) { return !node.wanted.contains(target.first); });
    }
}

void Products::dropDrawn(const gpu::Texture* texture) {
    std::erase_if(nodes_, [&](Node& node) {
        const bool draws = std::ranges::any_of(node.resources.targets, [&](const auto& target) { return &target.second == texture; });
        if (draws) drop(node);
        return draws;
    });
}

void Products::dropNodes() {
    for (Node& node : nodes_)
        drop(node);
    nodes_.clear();
}

void Products::forget() {
    dropNodes();
    producers_.clear();
}

void Products::drop(Node& node) {
    for (const std::string& target : node.wanted)
        store_.products.erase(node.keyOf(target));
}

Result<void> Products::use(const RunInput& input, Prepared& prepared, std::vector<FrameNode>& due) {
    return useFor(requestOf(input), prepared, due);
}

Result<void> Products::useFor(const ProductRequest& consumer, Prepared& prepared, std::vector<FrameNode>& due) {
    for (const auto& [name, source] : prepared.products) {
        auto key = produce(consumer, source, prepared, due);
        if (!key) return through(key.error(), *consumer.input.effect.findParameter(name), source);
        prepared.textures.emplace(name, TextureData{.format = {}, .key = std::move(*key)});
    }
    return {};
}

Result<std::string> Products::produce(const ProductRequest& consumer, const ProducerSource& source, Prepared& asking,
                                      std::vector<FrameNode>& due) {
    std::string key;
    const auto drawn = [&](const ProductRequest& request, Producer& producer, Prepared& prepared) -> Result<void> {
        if (auto nodes = useFor(request, prepared, due); !nodes) return nodes;
        Node& node = nodeFor(producer, request.input, prepared);
        if (auto placed = schedule(node, source.target, request.input, prepared, due); !placed) return placed;
        if (node.due) asking.warnings.insert(asking.warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
        asking.reads.insert(prepared.reads.begin(), prepared.reads.end());
        key = node.keyOf(source.target);
        return {};
    };
    if (const auto read = withProducer(consumer, source, producers_, drawn); !read) return read.error();
    return key;
}

void Products::take(const Producers& producers) {
    producers_.insert(producers.begin(), producers.end());
}

Products::Node& Products::nodeFor(Producer& producer, const RunInput& input, const Prepared& prepared) {
    NodeInputs inputs = inputsOf(input, prepared);
    const auto found = std::ranges::find_if(nodes_, [&](const Node& node) { return node.producer == &producer && node.inputs == inputs; });
    if (found != nodes_.end()) return *found;
    return nodes_.emplace_back(Node{.producer = &producer,
                                    .key = fmt::format("product {}", made_++),
                                    .inputs = std::move(inputs),
                                    .resources = {device_, store_, producer.kit, {}}});
}

Result<void> Products::schedule(Node& node, const std::string& target, const RunInput& input, Prepared& prepared,
                                std::vector<FrameNode>& due) {
    node.used = true;
    node.wanted.insert(target);
    if (!node.due && !(node.drawn && node.resources.targets.contains(target))) {
        node.drawn = false;
        auto before = frameOf(node, input, prepared);
        if (!before) return before.error();
        due.push_back(std::move(*before));
        node.due = true;
    }
    store_.products[node.keyOf(target)] = &node.resources.targets.at(target);
    return {};
}

Result<FrameNode> Products::frameOf(Node& node, const RunInput& input, Prepared& prepared) {
    if (const auto allocated = allocate(input, prepared, node.resources); !allocated) return allocated.error();
    forgetTexels(prepared, store_.uploaded);
    const ObjectRun run{input, prepared};
    auto frame = buildFrame(std::span(&run, 1), node.resources);
    if (!frame) return frame.error();
    for (auto& [name, texture] : node.resources.targets)
        if (texture.desc().mips > 1) frame->items.emplace_back(FrameMips{&texture});
    return FrameNode{.effect = input.effect.file.string(), .items = std::move(frame->items), .drawn = &node.drawn};
}

} // namespace tegument::run
