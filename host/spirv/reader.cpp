#include "host/spirv/reader.h"

namespace tegument::spirv {

Reader::Reader(Words words) : Compiler(words.data(), words.size()) {
    // SPIRV-Cross tells which members of buffers are read (get_active_buffer_ranges), but neither elements of arrays among the inputs
    // nor members behind a load of the whole block.
    struct Chains : OpcodeHandler {
        explicit Chains(Reader& owner) : reader(owner) {}
        bool handle(spv::Op op, const std::uint32_t* operands, std::uint32_t count) override {
            if (op == spv::OpLoad || op == spv::OpCopyObject) reader.whole_.insert(operands[2]);
            if (op != spv::OpAccessChain && op != spv::OpInBoundsAccessChain) return true;
            const auto* index = count > 3 ? reader.maybe_get<spirv_cross::SPIRConstant>(operands[3]) : nullptr;
            if (index != nullptr)
                reader.members_[operands[2]].insert(index->scalar());
            else
                reader.whole_.insert(operands[2]);
            return true;
        }
        Reader& reader;
    } chains(*this);
    traverse_all_reachable_opcodes(get<spirv_cross::SPIRFunction>(ir.default_entry_point), chains);
    active_ = get_active_interface_variables();
    analyze_image_and_sampler_usage();
}

bool Reader::reads(spirv_cross::VariableID variable, std::uint32_t member) const {
    const auto found = members_.find(variable);
    return whole_.contains(variable) || (found != members_.end() && found->second.contains(member));
}

void redecorate(const spirv_cross::Compiler& module, std::vector<std::uint32_t>& words, spirv_cross::VariableID variable,
                spv::Decoration decoration, std::uint32_t value) {
    if (std::uint32_t at = 0; module.get_binary_offset_for_decoration(variable, decoration, at)) words[at] = value;
}

} // namespace tegument::spirv
