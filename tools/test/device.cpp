#include "tools/test/device.h"

#include "host/image/image.h"
#include "host/run/values.h"
#include "tools/test/rewrite.h"
#include "tools/test/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace tegument::testing {

namespace {

constexpr std::size_t kSiteNumbers = 22; // of assertions.hlsl, as are the next three
constexpr std::size_t kPropertyNumbers = 6;
constexpr std::size_t kNoteNumbers = 6;
constexpr std::size_t kMostNotes = 256;
constexpr std::uint32_t kThreads = 64; // of a group of cases that stand alone

/// Behind the sites and the word that says whether a loop did not end.
std::size_t notesAt(const TestFile& file) {
    return file.sites.size() * kSiteNumbers + 1;
}

/// Behind the notes and the counts of coverage.
std::size_t valuesAt(const TestFile& file) {
    return notesAt(file) + kMostNotes * kNoteNumbers + file.counted.size();
}

std::uint32_t wordOf(double number, bool integer) {
    if (!integer) return std::bit_cast<std::uint32_t>(static_cast<float>(number));
    constexpr double kMost = 4294967295.0;
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::clamp(std::trunc(number), -kMost, kMost)));
}

Address addressOf(const std::vector<std::string>& words) {
    const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
    return has("clamp") ? Address::Clamp : has("mirror") ? Address::Mirror : Address::Wrap;
}

} // namespace

double Noted::number(std::uint32_t component) const {
    const std::uint32_t word = bits.at(component);
    if (kind == 0) return static_cast<double>(std::bit_cast<float>(word));
    return kind == 1 ? static_cast<double>(static_cast<std::int32_t>(word)) : static_cast<double>(word);
}

Result<Program> Program::create(gpu::Device& device, const TestFile& file, const Test& test, Shader shader, const Shader* vertex) {
    Program program(device, file, test, std::move(shader));
    if (auto prepared = program.prepare(vertex); !prepared) return prepared.error();
    return program;
}

void Program::add(std::uint32_t set, std::uint32_t binding, gpu::BindingKind kind, decltype(gpu::BoundResource::resource) resource) {
    bindings_.push_back({set, binding, kind});
    resources_.push_back({set, binding, resource});
}

const std::string& Program::authorsName(const std::string& name) const {
    const auto found = file_.authors.find(name);
    return found == file_.authors.end() ? name : found->second;
}

const Fixture* Program::fixture(const std::string& name, std::string_view kind) const {
    const auto found = std::find_if(test_.fixtures.rbegin(), test_.fixtures.rend(),
                                    [&](const Fixture& each) { return each.name == name && each.kind == kind; });
    return found == test_.fixtures.rend() ? nullptr : &*found;
}

Error Program::missing(const std::string& what, const std::string& name, const std::string& hint) const {
    return inputError(8205, test_.at, fmt::format("{} reads the {} {}, which has no value", test_.name, what, name), hint);
}

Result<void> Program::fill(const UniformBlock& block) {
    blocks_.emplace_back(block.size);
    for (const BlockMember& member : block.members) {
        if (block.name == "tgTestRun" || !member.used) continue;
        const Fixture* given = fixture(member.name, "tgConstant");
        if (given == nullptr) return missing("constant", member.name, fmt::format("tgConstant({}, numbers);", member.name));
        const std::size_t count = std::size_t{member.rows} * member.columns * std::max(member.elements, 1U);
        if (given->numbers.size() != count)
            return inputError(8203, given->at,
                              fmt::format("{} has {} numbers, and {} are given", member.name, count, given->numbers.size()));
        constexpr double kMost = 2147483647.0;
        if (member.base != MemberBase::Float && std::ranges::any_of(given->numbers, [](double x) { return std::abs(x) > kMost; }))
            return inputError(8203, given->at, fmt::format("{} takes whole numbers up to {}", member.name, kMost));
        run::pack(member, given->numbers, blocks_.back());
    }
    if (block.name == "tgTestRun") launchBytes_ = blocks_.size() - 1;
    add(block.set, block.binding, gpu::BindingKind::UniformBuffer, std::span<const std::byte>());
    return {};
}

Result<void> Program::bindBuffer(const Resource& resource) {
    std::vector<std::uint32_t> words;
    if (resource.name == "tgTestOut") {
        output_ = resources_.size();
        words = {0};
    } else if (resource.name == "tgTestTable") {
        for (const float number : test_.table)
            words.push_back(std::bit_cast<std::uint32_t>(number));
    } else {
        const Fixture* given = fixture(resource.name, "tgBuffer");
        if (given == nullptr) return missing("buffer", resource.name, fmt::format("tgBuffer({}, {{ numbers }});", resource.name));
        std::vector<double> numbers = given->numbers;
        if (!given->file.empty()) {
            auto table = readTable(given->file);
            if (!table) return table.error();
            numbers = std::move(table->numbers);
        }
        if (given->width != 0) numbers.assign(given->width, 0);
        const auto type = file_.elements.find(resource.name);
        const std::string element = type == file_.elements.end() ? "float" : type->second;
        for (const double number : numbers)
            words.push_back(wordOf(number, element.starts_with("int") || element.starts_with("uint")));
    }
    if (words.empty()) words.push_back(0);
    auto made = device_.createBuffer(gpu::BufferUsage::Storage, std::as_bytes(std::span(words)));
    if (!made) return made.error();
    buffers_.push_back(std::make_unique<gpu::Buffer>(std::move(*made)));
    add(resource.set, resource.binding, gpu::BindingKind::StorageBuffer, buffers_.back().get());
    return {};
}

Result<void> Program::bindTexture(const Resource& resource) {
    const std::string& name = authorsName(resource.name);
    const Fixture* given = fixture(name, "tgTexture");
    if (given == nullptr) return missing("texture", name, fmt::format("tgTexture({}, width, height, {{ numbers }});", name));
    if (resource.kind != ResourceKind::Texture2D && resource.kind != ResourceKind::StorageImage)
        return inputError(8203, given->at, fmt::format("{} is no Texture2D", name), "tgTexture gives textures of two dimensions");
    Image image{.width = static_cast<int>(given->width), .height = static_cast<int>(given->height)};
    if (!given->file.empty()) {
        auto loaded = loadImage(given->file);
        if (!loaded) return loaded.error();
        image = std::move(*loaded);
    } else {
        image.pixels.assign(given->numbers.begin(), given->numbers.end());
        image.channels = static_cast<int>(image.pixels.size()) / (image.width * image.height);
    }
    std::vector<std::array<float, 4>> texels;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            std::array<float, 4> texel = {0, 0, 0, 1};
            for (int c = 0; c < image.channels; ++c)
                texel.at(static_cast<std::size_t>(c)) = image.at(x, y, c);
            texels.push_back(texel);
        }
    const bool stored = resource.kind == ResourceKind::StorageImage;
    auto made = device_.createTexture({.name = resource.name,
                                       .format = gpu::Format::RGBA32F,
                                       .width = static_cast<std::uint32_t>(image.width),
                                       .height = static_cast<std::uint32_t>(image.height),
                                       .renderTarget = stored,
                                       .storage = stored});
    if (!made) return made.error();
    if (auto uploaded = device_.upload(*made, std::as_bytes(std::span(texels))); !uploaded) return uploaded.error();
    textures_.push_back(std::make_unique<gpu::Texture>(std::move(*made)));
    if (stored)
        add(resource.set, resource.binding, gpu::BindingKind::StorageTexture, gpu::StoredTexture{textures_.back().get()});
    else
        add(resource.set, resource.binding, gpu::BindingKind::Texture, textures_.back().get());
    return {};
}

Result<void> Program::bindSampler(const Resource& resource) {
    const auto declared = std::ranges::find(file_.samplers, resource.name, &Sampler::name);
    SamplerState state = declared == file_.samplers.end() ? SamplerState{} : declared->state;
    if (const Fixture* given = fixture(authorsName(resource.name), "tgSampler")) {
        const bool point = std::ranges::find(given->words, "point") != given->words.end();
        state.minFilter = state.magFilter = state.mipFilter = point ? Filter::Point : Filter::Linear;
        state.addressU = state.addressV = state.addressW = addressOf(given->words);
    }
    if (resource.kind == ResourceKind::CompareSampler) state.compare = CompareOp::LessEqual;
    auto made = device_.createSampler(state);
    if (!made) return made.error();
    samplers_.push_back(std::make_unique<gpu::Sampler>(std::move(*made)));
    add(resource.set, resource.binding, gpu::BindingKind::Sampler, samplers_.back().get());
    return {};
}

Result<void> Program::bind(const Resource& resource) {
    switch (resource.kind) {
    case ResourceKind::StorageBuffer: return bindBuffer(resource);
    case ResourceKind::Sampler:
    case ResourceKind::CompareSampler: return bindSampler(resource);
    default: return bindTexture(resource);
    }
}

Result<void> Program::prepare(const Shader* vertex) {
    const Reflection& reflection = shader_.reflection;
    std::vector<const UniformBlock*> all;
    if (reflection.globals) all.push_back(&*reflection.globals);
    for (const UniformBlock& block : reflection.constantBuffers)
        all.push_back(&block);
    for (const UniformBlock* block : all)
        if (auto filled = fill(*block); !filled) return filled;
    for (const Resource& resource : reflection.resources)
        if (auto bound = bind(resource); !bound) return bound;
    if (vertex == nullptr) {
        auto made = device_.createPipeline(gpu::ComputePipelineDesc{
            .name = test_.name, .shader = {.spirv = shader_.spirv, .entry = shader_.entry}, .bindings = bindings_});
        if (!made) return made.error();
        pipeline_ = std::move(*made);
        return {};
    }
    gpu::PipelineDesc desc{.name = test_.name,
                           .vertex = {.spirv = vertex->spirv, .entry = vertex->entry},
                           .pixel = {.spirv = shader_.spirv, .entry = shader_.entry},
                           .bindings = bindings_,
                           .colorFormats = {gpu::Format::RGBA8}};
    desc.state.cull = CullMode::None;
    desc.state.depthTest = false;
    auto made = device_.createPipeline(desc);
    if (!made) return made.error();
    pipeline_ = std::move(*made);
    auto target = device_.createTexture({.name = "target",
                                         .format = gpu::Format::RGBA8,
                                         .width = 2 * std::min(test_.cases, kQuadsInARow),
                                         .height = 2 * ((test_.cases + kQuadsInARow - 1) / kQuadsInARow),
                                         .renderTarget = true});
    if (!target) return target.error();
    target_ = std::move(*target);
    return {};
}

std::vector<std::uint32_t> Program::outputs() const {
    std::vector<std::uint32_t> words(valuesAt(file_) + std::size_t{test_.properties} * test_.cases * kPropertyNumbers, 0);
    for (std::size_t site = 0; site < file_.sites.size(); ++site)
        words[site * kSiteNumbers + 2] = std::numeric_limits<std::uint32_t>::max();
    for (const auto& [property, values] : given_)
        for (std::size_t i = 0; i < values.size(); ++i)
            std::ranges::transform(
                values[i], words.begin() + static_cast<std::ptrdiff_t>(valuesAt(file_) + (property * test_.cases + i) * kPropertyNumbers),
                [](float x) { return std::bit_cast<std::uint32_t>(x); });
    return words;
}

Result<void> Program::submit() {
    const auto ran = device_.run([&](gpu::Recorder& recorder) -> Result<void> {
        const std::uint32_t cases = launch_.end - launch_.first;
        if (test_.stage == ShaderStage::Pixel)
            return recorder.draw({.colors = {&target_}}, {.pipeline = &pipeline_, .resources = resources_, .count = 3});
        return recorder.dispatch(pipeline_, resources_, {test_.group[0] == 0 ? (cases + kThreads - 1) / kThreads : cases, 1, 1});
    });
    if (!ran) return ran.error();
    return {};
}

Result<Ran> Program::run(const Launch& launch) {
    launch_ = launch;
    if (test_.stage == ShaderStage::Pixel) launch_.first = 0, launch_.end = test_.cases;
    std::size_t next = 0; // blocks come first
    for (auto& bytes : blocks_)
        resources_[next++].resource = std::span<const std::byte>(bytes);
    const auto notes = static_cast<std::uint32_t>(notesAt(file_)), values = static_cast<std::uint32_t>(valuesAt(file_));
    const std::pair<Launch, std::array<std::uint32_t, 3>> told = {launch_, {notes, values, test_.cases}};
    if (launchBytes_) std::memcpy(blocks_[*launchBytes_].data(), &told, std::min(sizeof told, blocks_[*launchBytes_].size()));
    const auto outputResource = std::ranges::find_if(shader_.reflection.resources, [](const Resource& r) { return r.name == "tgTestOut"; });
    Ran ran;
    ran.sites.resize(file_.sites.size());
    ran.reached.resize(file_.counted.size());
    if (outputResource == shader_.reflection.resources.end()) return ran; // no assertion is left in it
    const std::vector<std::uint32_t> initial = outputs();
    auto output = device_.createBuffer(gpu::BufferUsage::Storage, std::as_bytes(std::span(initial)));
    if (!output) return output.error();
    resources_[output_].resource = &*output;
    if (auto submitted = submit(); !submitted) return submitted.error();
    const auto bytes = device_.readback(*output);
    if (!bytes) return bytes.error();
    std::vector<std::uint32_t> words(bytes->size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes->data(), words.size() * sizeof(std::uint32_t));
    for (std::size_t site = 0; site < ran.sites.size(); ++site) {
        const std::uint32_t* const at = words.data() + site * kSiteNumbers;
        Counts& counts = ran.sites[site];
        counts = {.runs = at[0], .failures = at[1], .first = at[2], .ulp = at[5]};
        counts.absolute = std::bit_cast<float>(at[3]);
        counts.relative = std::bit_cast<float>(at[4]);
        std::copy_n(at + 6, counts.classes.size(), counts.classes.begin());
    }
    for (std::size_t note = 0; note < kMostNotes; ++note) {
        const std::uint32_t* const at = words.data() + notesAt(file_) + note * kNoteNumbers;
        if (at[0] == 0 || at[0] > file_.sites.size()) break;
        ran.notes.push_back({.site = at[0] - 1, .kind = at[1] / 8, .count = std::min(at[1] % 8, 4U), .bits = {at[2], at[3], at[4], at[5]}});
    }
    std::copy_n(words.begin() + static_cast<std::ptrdiff_t>(notesAt(file_) + kMostNotes * kNoteNumbers), ran.reached.size(),
                ran.reached.begin());
    for (std::size_t at = valuesAt(file_); at + kPropertyNumbers <= words.size(); at += kPropertyNumbers) {
        Recorded& recorded = ran.recorded.emplace_back();
        for (std::size_t i = 0; i < recorded.numbers.size(); ++i)
            recorded.numbers.at(i) = std::bit_cast<float>(words[at + i]);
        recorded.most = std::bit_cast<float>(words[at + 4]);
        recorded.count = std::min(words[at + 5], 4U);
    }
    return ran;
}

} // namespace tegument::testing
