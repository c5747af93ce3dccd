#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "tools/emit/effect_json.h"
#include "tools/emit/products.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace tegument::emit {

namespace {

/// A shader of the pass: who sees it ("VERTEX", "PIXEL"; "ALL" for compute) and its registers, by each compiler that was asked: the
/// signature has a place for all of them.
struct RootStage {
    std::string_view visibility;
    std::vector<const Reflection*> reflections;
};

bool isSampler(const Resource& resource) {
    return resource.kind == ResourceKind::Sampler || resource.kind == ResourceKind::CompareSampler;
}

bool isStore(const Resource& resource) {
    return resource.kind == ResourceKind::StorageImage;
}

bool isTexture(const Resource& resource) {
    return !isSampler(resource) && !isStore(resource);
}

/// "SRV(t0, numDescriptors=3)": from the first to the last register of a kind; empty without any.
template <class Wanted>
std::string range(const RootStage& stage, std::string_view word, char letter, Wanted wanted) {
    std::vector<std::uint32_t> registers;
    for (const Reflection* reflection : stage.reflections)
        for (const Resource& resource : reflection->resources)
            if (wanted(resource)) registers.push_back(resource.binding);
    if (registers.empty()) return {};
    const auto [first, last] = std::ranges::minmax(registers);
    return fmt::format("{}({}{}, numDescriptors={})", word, letter, first, last - first + 1);
}

void addTable(std::vector<std::string>& parts, const std::vector<std::string>& ranges, std::string_view visibility) {
    std::vector<std::string> filled;
    std::ranges::copy_if(ranges, std::back_inserter(filled), [](const std::string& text) { return !text.empty(); });
    if (!filled.empty())
        parts.push_back(fmt::format("DescriptorTable({}, visibility=SHADER_VISIBILITY_{})", fmt::join(filled, ", "), visibility));
}

void addStage(std::vector<std::string>& parts, const RootStage& stage) {
    const auto block = [&](const UniformBlock& one) {
        const std::string part = fmt::format("CBV(b{}, visibility=SHADER_VISIBILITY_{})", one.binding, stage.visibility);
        if (std::ranges::find(parts, part) == parts.end()) parts.push_back(part);
    };
    for (const Reflection* reflection : stage.reflections) {
        if (reflection->globals) block(*reflection->globals);
        std::ranges::for_each(reflection->constantBuffers, block);
    }
    addTable(parts, {range(stage, "SRV", 't', isTexture), range(stage, "UAV", 'u', isStore)}, stage.visibility);
    addTable(parts, {range(stage, "Sampler", 's', isSampler)}, stage.visibility);
}

/// In the order of the stages, of each: a constant buffer view for every block; one table of its textures and stores; one of its samplers.
/// D3DCompile and DXC take the text as attribute [RootSignature("...")] or by target rootsig_1_0.
std::string rootSignature(const std::vector<RootStage>& stages) {
    std::vector<std::string> parts;
    if (std::ranges::any_of(stages, [](const RootStage& stage) { return stage.visibility == "VERTEX"; }))
        parts.emplace_back("RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT)");
    for (const RootStage& stage : stages)
        addStage(parts, stage);
    return fmt::format("{}", fmt::join(parts, ", "));
}

constexpr std::string_view kFormat = "tegument-effect 1";

std::string_view baseName(MemberBase base) {
    static constexpr std::array<std::string_view, 4> kNames = {"bool", "int", "uint", "float"};
    return kNames.at(static_cast<std::size_t>(base));
}

std::string_view kindName(ResourceKind kind) {
    static constexpr std::array<std::string_view, 8> kNames = {"Texture1D", "Texture2D",      "Texture3D",     "TextureCube",
                                                               "Sampler",   "CompareSampler", "StorageBuffer", "StorageImage"};
    return kNames.at(static_cast<std::size_t>(kind));
}

Json memberJson(const BlockMember& member) {
    Json json{{"name", member.name}, {"offset", member.offset}, {"size", member.size}, {"type", baseName(member.base)}};
    if (member.rows > 1 || member.columns > 1) json["columns"] = member.columns;
    if (member.rows > 1) json["rows"] = member.rows;
    if (member.elements > 0) {
        json["elements"] = member.elements;
        json["stride"] = member.arrayStride;
    }
    if (member.rows > 1) json["column_major"] = member.spirvRowMajor; // see BlockMember
    json["used"] = member.used;
    return json;
}

/// Places: {"register"} in Direct3D, {"set", "binding"} in SPIR-V.
void place(Json& json, bool direct3D, std::uint32_t set, std::uint32_t binding) {
    if (!direct3D) json["set"] = set;
    json[direct3D ? "register" : "binding"] = binding;
}

Json blockJson(const UniformBlock& block, bool direct3D) {
    Json json{{"name", block.name}};
    place(json, direct3D, block.set, block.binding);
    json["size"] = block.size;
    json["members"] = Json::array();
    for (const BlockMember& member : block.members)
        json["members"].push_back(memberJson(member));
    return json;
}

Json variablesJson(const std::vector<StageVariable>& variables, bool direct3D) {
    Json list = Json::array();
    for (const StageVariable& variable : variables)
        list.push_back({{"semantic", variable.semantic},
                        {direct3D ? "register" : "location", variable.location},
                        {"type", baseName(variable.base)},
                        {"components", variable.components}});
    return list;
}

Json reflectionJson(const Reflection& reflection, bool direct3D) {
    Json json{{"constants", Json::array()}, {"resources", Json::array()}};
    if (reflection.globals) json["constants"].push_back(blockJson(*reflection.globals, direct3D));
    for (const UniformBlock& block : reflection.constantBuffers)
        json["constants"].push_back(blockJson(block, direct3D));
    for (const Resource& resource : reflection.resources) {
        Json one{{"name", resource.name}, {"kind", kindName(resource.kind)}};
        place(one, direct3D, resource.set, resource.binding);
        json["resources"].push_back(std::move(one));
    }
    json["inputs"] = variablesJson(reflection.inputs, direct3D);
    json["outputs"] = variablesJson(reflection.outputs, direct3D);
    return json;
}

Json translationJson(const CrossShader& shader, bool metal) {
    Json json{{"entry", shader.entry}};
    if (!shader.globals.empty()) json["globals"] = shader.globals;
    if (metal) {
        json["buffers"] = shader.buffers;
        json["textures"] = shader.textures;
        json["samplers"] = shader.samplerSlots;
        return json;
    }
    json["samplers"] = Json::array();
    for (const CombinedSampler& sampler : shader.samplers)
        json["samplers"].push_back({{"name", sampler.name}, {"texture", sampler.texture}, {"sampler", sampler.sampler}});
    return json;
}

Json formJson(const LinkedShader& shader, Target kind, const std::string& file) {
    Json json{{"file", file}};
    if (const Reflection* reflection = formOf(shader, kind).reflection)
        json.update(reflectionJson(*reflection, kind == Target::Sm5 || kind == Target::Dxil));
    if (const auto found = shader.translated.find(kind); found != shader.translated.end())
        json.update(translationJson(found->second, kind == Target::Msl));
    return json;
}

/// Of the compilers that say how many threads a group has; DXIL's reflection does not.
const Reflection* anyReflection(const LinkedShader& shader) {
    if (const Shader* compiled = shader.spirv()) return &compiled->reflection;
    return shader.entry->sm5Reflection ? &shader.entry->sm5Reflection->reflection : nullptr;
}

Json shaderJson(const LinkedShader& shader) {
    Json json{{"name", shader.name}, {"entry", shader.entry->name}, {"stage", stageNames(shader.entry->stage).name}};
    if (shader.entry->stage == ShaderStage::Compute)
        if (const Reflection* reflection = anyReflection(shader)) json["threads"] = reflection->localSize;
    for (const auto& [kind, file] : shader.files)
        json[std::string(targetName(kind))] = formJson(shader, kind, file);
    return json;
}

/// Of Direct3D 12, which takes shader models 5 and 6; empty where neither is among the products.
std::string rootSignatureOf(const PassShaders& shaders, const Products& products) {
    std::vector<RootStage> stages;
    const auto add = [&](std::string_view visibility, int index) {
        if (index < 0) return;
        const LinkedShader& shader = products.shaders[static_cast<std::size_t>(index)];
        RootStage stage{visibility, {}};
        for (const Target target : {Target::Dxil, Target::Sm5})
            if (const Reflection* reflection = formOf(shader, target).reflection; reflection && shader.files.contains(target))
                stage.reflections.push_back(reflection);
        if (!stage.reflections.empty()) stages.push_back(std::move(stage));
    };
    add("VERTEX", shaders.vertex);
    add("PIXEL", shaders.pixel);
    add("ALL", shaders.compute);
    return stages.empty() ? std::string() : rootSignature(stages);
}

Json passJson(const Pass& pass, const PassShaders& shaders, const Products& products) {
    Json json{{"name", pass.name}};
    const auto stage = [&](const char* name, int index) {
        if (index >= 0) json[name] = products.shaders[static_cast<std::size_t>(index)].name;
    };
    stage("vertex_shader", shaders.vertex);
    stage("pixel_shader", shaders.pixel);
    stage("geometry_shader", shaders.geometry);
    stage("compute_shader", shaders.compute);
    if (const std::string signature = rootSignatureOf(shaders, products); !signature.empty()) json["root_signature"] = signature;
    json["states"] = toJson(pass.state);
    json["annotations"] = toJson(pass.annotations);
    return json;
}

Json techniquesJson(const Effect& effect, const Products& products) {
    Json list = Json::array();
    for (std::size_t t = 0; t < effect.techniques.size(); ++t) {
        const Technique& technique = effect.techniques[t];
        Json passes = Json::array();
        for (std::size_t p = 0; p < technique.passes.size(); ++p)
            passes.push_back(passJson(technique.passes[p], products.passes[t][p], products));
        list.push_back({{"name", technique.name}, {"annotations", toJson(technique.annotations)}, {"passes", std::move(passes)}});
    }
    return list;
}

Json samplersJson(const Effect& effect) {
    Json list = Json::array();
    for (const Sampler& sampler : effect.samplers)
        list.push_back({{"name", sampler.name}, {"texture", sampler.texture}, {"states", toJson(sampler.state)}});
    return list;
}

/// What compute shaders write; target "": the application's own.
Json storagesJson(const Effect& effect) {
    Json list = Json::array();
    for (const StorageTexture& storage : effect.storages) {
        Json one{{"name", storage.name}};
        if (storage.target) one["target"] = *storage.target;
        list.push_back(std::move(one));
    }
    return list;
}

/// Of the texts that were compiled, not of their paths.
std::string sourceHash(const Effect& effect) {
    std::string hashes;
    std::vector<std::filesystem::path> files = effect.includes;
    std::ranges::sort(files);
    files.insert(files.begin(), effect.file);
    for (const auto& file : files)
        if (const auto text = readFile(file)) hashes += contentHash(*text);
    return contentHash(hashes);
}

Json filesJson(const Products& products) {
    Json list = Json::array();
    for (const auto& [name, bytes] : products.files)
        list.push_back({{"name", name}, {"bytes", bytes.size()}, {"hash", contentHash(bytes)}});
    return list;
}

} // namespace

std::string manifest(const FileReport& report, const EmitOptions& options, const Products& products) {
    const Effect& effect = report.effect;
    Json json{{"format", kFormat}, {"effect", effect.file.filename().string()}, {"variant", report.variant}, {"hash", ""}};
    json["source_hash"] = sourceHash(effect);
    json["defines"] = Json::object();
    for (const auto& [name, value] : options.defines)
        json["defines"][name] = value;
    json["targets"] = Json::object();
    for (const auto& [kind, file] : products.effects)
        json["targets"][std::string(targetName(kind))] = file;
    json["missing"] = Json::array();
    for (const auto& [kind, reason] : products.missing)
        json["missing"].push_back({{"kind", targetName(kind)}, {"reason", reason}});
    json["parameters"] = Json::array();
    for (const Parameter& parameter : effect.parameters)
        json["parameters"].push_back(toJson(parameter));
    json["samplers"] = samplersJson(effect);
    if (!effect.storages.empty()) json["storages"] = storagesJson(effect);
    json["techniques"] = techniquesJson(effect, products);
    json["shaders"] = Json::array();
    for (const LinkedShader& shader : products.shaders)
        json["shaders"].push_back(shaderJson(shader));
    json["files"] = filesJson(products);
    json["hash"] = contentHash(json.dump(1, ' ', false, Json::error_handler_t::replace));
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool isManifest(std::string_view text) {
    const auto json = Json::parse(text, nullptr, false);
    return json.is_object() && json.contains("format") && json["format"] == kFormat;
}

} // namespace tegument::emit
