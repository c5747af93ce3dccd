#include "lab/bench/count.h"

#include "host/spirv/instructions.h"

#include <algorithm>
#include <map>
#include <set>

namespace tegument::bench {

namespace {

using spirv::forEachInstruction;
using Words = std::vector<std::uint32_t>;
using Instruction = std::span<const std::uint32_t>;

/// What of a module matters here.
struct Module {
    std::map<std::uint32_t, std::uint32_t> cameFrom;                         // a value, and what it was loaded, combined or chosen from
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> places; // of variables: descriptor set, binding
    std::uint32_t entry = 0;
    std::uint32_t unsignedType = 0;
    std::uint32_t counterPointer = 0; // to an unsigned number of a storage buffer
    bool testsLate = false;           // discards pixels or writes depth
    bool testsEarly = false;
};

bool looksUp(spv::Op op) {
    return (op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageRead) ||
           (op >= spv::OpImageSparseSampleImplicitLod && op <= spv::OpImageSparseDrefGather) || op == spv::OpImageSparseRead;
}

/// Or is a mode itself.
bool standsBeforeModes(spv::Op op) {
    return op == spv::OpCapability || op == spv::OpExtension || op == spv::OpExtInstImport || op == spv::OpMemoryModel ||
           op == spv::OpEntryPoint || op == spv::OpExecutionMode;
}

bool ends(spv::Op op) {
    return op == spv::OpKill || op == spv::OpTerminateInvocation || op == spv::OpDemoteToHelperInvocationEXT;
}

void readMode(Instruction words, Module& module) {
    module.testsEarly = module.testsEarly || words[2] == spv::ExecutionModeEarlyFragmentTests;
    module.testsLate = module.testsLate || words[2] == spv::ExecutionModeDepthReplacing;
}

void readPlace(Instruction words, Module& module) {
    if (words[2] == spv::DecorationDescriptorSet) module.places[words[1]].first = words[3];
    if (words[2] == spv::DecorationBinding) module.places[words[1]].second = words[3];
}

void readInstruction(spv::Op op, Instruction words, Module& module) {
    module.testsLate = module.testsLate || ends(op);
    switch (op) {
    case spv::OpEntryPoint: module.entry = words[2]; break;
    case spv::OpExecutionMode: readMode(words, module); break;
    case spv::OpDecorate: readPlace(words, module); break;
    case spv::OpTypeInt:
        if (words[2] == 32 && words[3] == 0) module.unsignedType = words[1];
        break;
    case spv::OpTypePointer:
        if (words[2] == spv::StorageClassStorageBuffer && words[3] == module.unsignedType) module.counterPointer = words[1];
        break;
    case spv::OpLoad:
    case spv::OpImage:
    case spv::OpSampledImage:
    case spv::OpAccessChain:
    case spv::OpCopyObject: module.cameFrom[words[2]] = words[3]; break;
    default: break;
    }
}

Module read(const Words& spirv) {
    Module module;
    forEachInstruction(std::span(spirv), [&](spv::Op op, Instruction words) { readInstruction(op, words, module); });
    return module;
}

/// The descriptor of the image that an instruction reads or writes.
AccessCounter accessOf(const Module& module, spv::Op op, Instruction words) {
    const Access access = op == spv::OpImageWrite ? Access::Write : Access::Read;
    std::uint32_t id = access == Access::Write ? words[1] : words[3];
    while (!module.places.contains(id)) {
        const auto from = module.cameFrom.find(id);
        if (from == module.cameFrom.end()) return {access, kUnknownPlace, kUnknownPlace};
        id = from->second;
    }
    const auto& [set, binding] = module.places.at(id);
    return {access, set, binding};
}

void append(Words& words, spv::Op op, std::initializer_list<std::uint32_t> operands) {
    words.push_back(static_cast<std::uint32_t>(operands.size() + 1) << spv::WordCountShift | static_cast<std::uint32_t>(op));
    words.insert(words.end(), operands);
}

/// Writes the module anew, with what counts.
class Rewriter {
public:
    Rewriter(const Shader& shader, std::uint32_t set, std::uint32_t binding)
        : source_(shader.spirv), stage_(shader.stage), set_(set), binding_(binding), module_(read(shader.spirv)),
          bound_(shader.spirv[spirv::kModuleBound]) {
        number_ = module_.unsignedType != 0 ? module_.unsignedType : fresh();
        pointer_ = module_.counterPointer != 0 ? module_.counterPointer : fresh();
        counters_.push_back({});
    }

    void run() {
        out_.assign(source_.begin(), source_.begin() + spirv::kModuleHeader);
        forEachInstruction(std::span(source_), [&](spv::Op op, Instruction words) { add(op, words); });
        out_[spirv::kModuleBound] = bound_;
    }

    [[nodiscard]] Words& words() { return out_; }
    [[nodiscard]] std::vector<AccessCounter>& counters() { return counters_; }

private:
    std::uint32_t fresh() { return bound_++; }

    void add(spv::Op op, Instruction words) {
        addBefore(op);
        if (looksUp(op) || op == spv::OpImageWrite) countAccess(op, words);
        out_.insert(out_.end(), words.begin(), words.end());
        if (op == spv::OpFunction) inEntry_ = words[2] == module_.entry;
        if (op == spv::OpLabel && inEntry_) startsEntry_ = true;
    }

    /// Sections of a module have an order: modes, decorations, types, functions.
    void addBefore(spv::Op op) {
        if (!modesDone_ && !standsBeforeModes(op)) addMode();
        const bool type = op >= spv::OpTypeVoid && op <= spv::OpVariable;
        if (!decorated_ && type) addDecorations();
        if (!declared_ && op == spv::OpFunction) addDeclarations();
        const bool first = startsEntry_ && op != spv::OpVariable && op != spv::OpLine && op != spv::OpNoLine;
        if (!first) return;
        startsEntry_ = false;
        inEntry_ = false;
        count(0);
    }

    void addMode() {
        modesDone_ = true;
        if (stage_ == ShaderStage::Pixel && !module_.testsLate && !module_.testsEarly)
            append(out_, spv::OpExecutionMode, {module_.entry, spv::ExecutionModeEarlyFragmentTests});
    }

    void addDecorations() {
        decorated_ = true;
        append(out_, spv::OpDecorate, {array_, spv::DecorationArrayStride, sizeof(std::uint32_t)});
        append(out_, spv::OpDecorate, {block_, spv::DecorationBlock});
        append(out_, spv::OpMemberDecorate, {block_, 0, spv::DecorationOffset, 0});
        append(out_, spv::OpDecorate, {buffer_, spv::DecorationDescriptorSet, set_});
        append(out_, spv::OpDecorate, {buffer_, spv::DecorationBinding, binding_});
    }

    void addDeclarations() {
        declared_ = true;
        if (module_.unsignedType == 0) append(out_, spv::OpTypeInt, {number_, 32, 0});
        append(out_, spv::OpTypeRuntimeArray, {array_, number_});
        append(out_, spv::OpTypeStruct, {block_, array_});
        append(out_, spv::OpTypePointer, {blockPointer_, spv::StorageClassStorageBuffer, block_});
        if (module_.counterPointer == 0) append(out_, spv::OpTypePointer, {pointer_, spv::StorageClassStorageBuffer, number_});
        append(out_, spv::OpVariable, {blockPointer_, buffer_, spv::StorageClassStorageBuffer});
        append(out_, spv::OpConstant, {number_, zero_, 0});
        append(out_, spv::OpConstant, {number_, one_, 1});
        std::set<AccessCounter> all;
        forEachInstruction(std::span(source_), [&](spv::Op op, Instruction words) {
            if (looksUp(op) || op == spv::OpImageWrite) all.insert(accessOf(module_, op, words));
        });
        counters_.insert(counters_.end(), all.begin(), all.end());
        for (std::uint32_t i = 0; i < counters_.size(); ++i)
            append(out_, spv::OpConstant, {number_, indices_.emplace_back(fresh()), i});
    }

    void countAccess(spv::Op op, Instruction words) {
        count(static_cast<std::size_t>(std::ranges::find(counters_, accessOf(module_, op, words)) - counters_.begin()));
    }

    void count(std::size_t counter) {
        const std::uint32_t at = fresh();
        append(out_, spv::OpAccessChain, {pointer_, at, buffer_, zero_, indices_[counter]});
        append(out_, spv::OpAtomicIAdd, {number_, fresh(), at, one_, zero_, one_}); // scope 1: the device; no order
    }

    const Words& source_;
    ShaderStage stage_;
    std::uint32_t set_;
    std::uint32_t binding_;
    Module module_;
    std::uint32_t bound_;
    std::uint32_t number_ = 0;
    std::uint32_t pointer_ = 0;
    std::uint32_t array_ = fresh();
    std::uint32_t block_ = fresh();
    std::uint32_t blockPointer_ = fresh();
    std::uint32_t buffer_ = fresh();
    std::uint32_t zero_ = fresh();
    std::uint32_t one_ = fresh();
    std::vector<std::uint32_t> indices_; // constants
    std::vector<AccessCounter> counters_;
    Words out_;
    bool modesDone_ = false;
    bool decorated_ = false;
    bool declared_ = false;
    bool inEntry_ = false;
    bool startsEntry_ = false;
};

/// Of its stage, and behind every descriptor there.
std::pair<std::uint32_t, std::uint32_t> freePlace(const Shader& shader) {
    std::uint32_t binding = 0;
    const auto behind = [&](std::uint32_t taken) { binding = std::max(binding, taken + 1); };
    if (shader.reflection.globals) behind(shader.reflection.globals->binding);
    for (const UniformBlock& block : shader.reflection.constantBuffers)
        behind(block.binding);
    for (const Resource& resource : shader.reflection.resources)
        behind(resource.binding);
    return {shader.stage == ShaderStage::Pixel ? 1U : 0U, binding};
}

} // namespace

CountedShader countAccesses(const Shader& shader) {
    const auto [set, binding] = freePlace(shader);
    Rewriter rewriter(shader, set, binding);
    rewriter.run();
    CountedShader counted{.shader = shader, .set = set, .binding = binding, .counters = std::move(rewriter.counters())};
    counted.shader.spirv = std::move(rewriter.words());
    return counted;
}

} // namespace tegument::bench
