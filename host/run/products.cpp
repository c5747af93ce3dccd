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

// Targets without a size of their own follow the picture; a producing effect draws this one and throws it away.
constexpr int kProducerPicture = 64;

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
                      .steps = prepared.plan.steps,
                      .numbers = {},
                      .textures = {}};
    for (const std::string& name : names)
        if (const Numbers* value = prepared.values.find(name)) inputs.numbers.emplace(name, *value);
    for (const auto& [name, texture] : prepared.textures)
        inputs.textures.emplace(name, texture.key);
    return inputs;
}

RunOptions producerOptions(const RunOptions& options, const Effect& effect) {
    RunOptions own{.technique = {}, .width = kProducerPicture, .height = kProducerPicture, .compiler = options.compiler};
    own.meshTextures = options.meshTextures;
    own.plainSkin = options.plainSkin;
    own.compiling = options.compiling;
    for (const auto& [name, value] : options.parameters)
        if (effect.findParameter(name)) own.parameters.emplace(name, value);
    for (const auto& [name, file] : options.textures)
        if (const Parameter* parameter = effect.findParameter(name); parameter && parameter->type.isTexture())
            own.textures.emplace(name, file);
    return own;
}

/// Producer errors point into the other effect; this says how one got there.
Error through(Error error, const Parameter& parameter, const ProducerSource& source) {
    error.diagnostics.push_back({.severity = Severity::Note,
                                 .code = 4037,
                                 .at = parameter.at,
                                 .text = fmt::format("{} is drawn by {}", parameter.name, source.effect.string()),
                                 .hint = fmt::format("or give a file: --set {}=FILE", parameter.name),
                                 .sourceLine = {}});
    return error;
}

Result<void> checkProduct(const Effect& effect, const Prepared& prepared, const ProducerSource& source) {
    std::vector<std::string> drawn;
    for (const std::string& name : prepared.plan.targets())
        if (effect.findParameter(name)) drawn.push_back(name);
    if (std::ranges::find(drawn, source.target) != drawn.end()) return {};
    return inputError(4036, {.file = effect.file.string(), .byte = {}},
                      fmt::format("technique {} draws no target '{}'", prepared.plan.technique->name, source.target),
                      didYouMean(source.target, drawn));
}

/// A texture that is drawn once belongs to the mesh wherever it stands: it is drawn as if the mesh stood in its own space, camera and light
/// moved along. So several heads of one mesh share it.
std::optional<PlacedObject> inOwnSpace(const RunInput& input) {
    if (!input.placed) return std::nullopt;
    PlacedObject local{
        .placement = {}, .scene = seenFrom(input.placed->scene, input.placed->placement), .worldUnitMm = input.placed->worldUnitMm};
    local.placement.scale = input.placed->placement.scale;
    return local;
}

} // namespace

/// A producing effect, read and compiled once.
struct Products::Producer {
    Effect effect;
    Kit kit;
};

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

/// Who asks for textures.
struct Products::Request {
    const RunInput& input;
    std::vector<std::string> chain; // of effects that are waiting for each other, to find circles
};

Products::Products(gpu::Device& device, Store& store) : device_(device), store_(store) {}
Products::~Products() = default;

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
    return useFor({.input = input, .chain = {fs::weakly_canonical(input.effect.file).string()}}, prepared, due);
}

Result<void> Products::useFor(const Request& consumer, Prepared& prepared, std::vector<FrameNode>& due) {
    for (const auto& [name, source] : prepared.products) {
        auto key = produce(consumer, source, prepared, due);
        if (!key) return through(key.error(), *consumer.input.effect.findParameter(name), source);
        prepared.textures.emplace(name, TextureData{.image = {}, .format = {}, .key = std::move(*key), .file = {}});
    }
    return {};
}

Result<std::string> Products::produce(const Request& consumer, const ProducerSource& source, Prepared& asking,
                                      std::vector<FrameNode>& due) {
    const std::string self = fs::weakly_canonical(source.effect).string();
    if (std::ranges::find(consumer.chain, self) != consumer.chain.end())
        return inputError(4035, {.file = self, .byte = {}}, "this effect would have to draw a texture that it needs itself",
                          "producers must not form a circle");
    const auto producer = load(source.effect, self, consumer.input.effect);
    if (!producer) return producer.error();
    const RunOptions options = producerOptions(consumer.input.options, (*producer)->effect);
    const std::optional<PlacedObject> local = inOwnSpace(consumer.input);
    const RunInput own{.effect = (*producer)->effect,
                       .mesh = consumer.input.mesh,
                       .workspace = consumer.input.workspace,
                       .options = options,
                       .placed = local ? &*local : nullptr,
                       .compiled = &(*producer)->kit.programs,
                       .uploaded = &store_.uploaded};
    Request request{.input = own, .chain = consumer.chain};
    request.chain.push_back(self);
    auto prepared = prepareNode(request, **producer, source, due);
    if (!prepared) return prepared.error();
    Node& node = nodeFor(**producer, own, *prepared);
    if (const auto placed = schedule(node, source.target, own, *prepared, due); !placed) return placed.error();
    if (node.due) asking.warnings.insert(asking.warnings.end(), prepared->warnings.begin(), prepared->warnings.end());
    asking.reads.insert(prepared->reads.begin(), prepared->reads.end());
    return node.keyOf(source.target);
}

Result<Prepared> Products::prepareNode(const Request& request, Producer& producer, const ProducerSource& source,
                                       std::vector<FrameNode>& due) {
    auto prepared = prepare(request.input);
    if (!prepared) return prepared;
    producer.kit.programs.insert(prepared->programs.begin(), prepared->programs.end());
    if (const auto checked = checkProduct(producer.effect, *prepared, source); !checked) return checked.error();
    if (const auto textures = prepareTextures(request.input, *prepared); !textures) return textures.error();
    if (const auto nodes = useFor(request, *prepared, due); !nodes) return nodes.error();
    return prepared;
}

Result<Products::Producer*> Products::load(const fs::path& file, const std::string& canonical, const Effect& consumer) {
    std::unique_ptr<Producer>& producer = producers_[canonical];
    if (producer) return producer.get();
    LoadOptions load{.defines = consumer.defines, .includeFolders = consumer.includeFolders};
    load.roots = consumer.roots;
    auto effect = loadEffect(file, load);
    if (!effect) return effect.error();
    producer = std::make_unique<Producer>(Producer{.effect = std::move(*effect), .kit = {}});
    return producer.get();
}

Products::Node& Products::nodeFor(Producer& producer, const RunInput& input, const Prepared& prepared) {
    NodeInputs inputs = inputsOf(input, prepared);
    const auto found = std::ranges::find_if(nodes_, [&](const Node& node) { return node.producer == &producer && node.inputs == inputs; });
    if (found != nodes_.end()) return *found;
    return nodes_.emplace_back(Node{.producer = &producer,
                                    .key = fmt::format("product {}", made_++),
                                    .inputs = std::move(inputs),
                                    .resources = {device_, store_, producer.kit, {}},
                                    .wanted = {}});
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
    return FrameNode{.effect = input.effect.file.string(), .items = std::move(frame->items)};
}

} // namespace tegument::run
