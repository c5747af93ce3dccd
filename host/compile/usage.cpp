#include "host/compile/usage.h"

namespace tegument::spirv {

namespace {

class Finder {
public:
    explicit Finder(const Module& module) : module_(module) {}

    void visit(const Instruction& instruction) {
        const Words& w = instruction.words;
        switch (instruction.op) {
        case spv::Op::OpAccessChain:
        case spv::Op::OpInBoundsAccessChain: chain(w); break;
        case spv::Op::OpLoad:
        case spv::Op::OpCopyObject:
            origin_[w[2]] = originOf(w[3]);
            usage_.whole.insert(w[3]);
            break;
        case spv::Op::OpStore: usage_.whole.insert(w[1]); break;
        case spv::Op::OpCopyMemory: usage_.whole.insert({w[1], w[2]}); break;
        case spv::Op::OpArrayLength:
        case spv::Op::OpImageTexelPointer: usage_.whole.insert(w[3]); break;
        case spv::Op::OpFunctionCall: usage_.whole.insert(w.begin() + 4, w.end()); break;
        case spv::Op::OpSampledImage: sampler_[w[2]] = originOf(w[4]); break;
        case spv::Op::OpImageSampleDrefImplicitLod:
        case spv::Op::OpImageSampleDrefExplicitLod:
        case spv::Op::OpImageSampleProjDrefImplicitLod:
        case spv::Op::OpImageSampleProjDrefExplicitLod:
        case spv::Op::OpImageDrefGather: compare(w[3]); break;
        default: break;
        }
    }

    [[nodiscard]] Usage take() { return std::move(usage_); }

private:
    void chain(const Words& w) {
        origin_[w[2]] = originOf(w[3]);
        const auto index = w.size() > 4 ? module_.constant(w[4]) : std::nullopt;
        if (index)
            usage_.members[w[3]].insert(*index);
        else
            usage_.whole.insert(w[3]); // a computed index may reach every element
    }

    void compare(Id sampledImage) {
        if (const auto found = sampler_.find(sampledImage); found != sampler_.end()) usage_.comparing.insert(found->second);
    }

    /// The variable behind an access chain or a load.
    [[nodiscard]] Id originOf(Id id) const {
        const auto found = origin_.find(id);
        return found == origin_.end() ? id : found->second;
    }

    const Module& module_;
    Usage usage_;
    std::map<Id, Id> origin_;
    std::map<Id, Id> sampler_; // sampled image -> variable of its sampler
};

} // namespace

bool Usage::reads(Id variable, std::uint32_t member) const {
    const auto found = members.find(variable);
    return whole.contains(variable) || (found != members.end() && found->second.contains(member));
}

Usage findUsage(const Module& module) {
    Finder finder(module);
    forEachInstruction(module.words(), [&](const Instruction& instruction, std::size_t) { finder.visit(instruction); });
    return finder.take();
}

} // namespace tegument::spirv
