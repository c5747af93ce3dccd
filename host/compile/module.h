#pragma once
// A SPIR-V module as a table of what its instructions declare. The words stay the owner of everything; nothing here changes them.

#include <spirv/unified1/spirv.hpp11>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tegument::spirv {

using Id = std::uint32_t;
using Words = std::span<const std::uint32_t>;

inline constexpr std::size_t kHeaderWords = 5;
inline constexpr std::uint32_t kWhole = ~0U; // "member" of a decoration on the object itself

/// One instruction; words[0] holds length and opcode.
struct Instruction {
    spv::Op op = spv::Op::OpNop;
    Words words;
};

/// Calls visit(Instruction, offset) in order; stops where a length does not fit.
template <class Visit>
void forEachInstruction(Words module, Visit&& visit) {
    for (std::size_t at = kHeaderWords; at < module.size();) {
        const std::size_t length = module[at] >> 16U;
        if (length == 0 || at + length > module.size()) return;
        visit(Instruction{static_cast<spv::Op>(module[at] & 0xffffU), module.subspan(at, length)}, at);
        at += length;
    }
}

/// A string literal of SPIR-V: bytes in words, ended by a zero byte.
[[nodiscard]] std::string literalString(Words words);

struct Variable {
    Id id = 0;
    Id pointee = 0; // type behind the pointer
    spv::StorageClass storage = spv::StorageClass::Private;
};

struct Type {
    spv::Op op = spv::Op::OpTypeVoid;
    Words operands; // after the result id
};

class Module {
public:
    /// `words` must outlive the module.
    explicit Module(Words words);

    [[nodiscard]] Words words() const { return words_; }
    [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
    [[nodiscard]] const Type& type(Id id) const;
    [[nodiscard]] std::string name(Id id) const;
    [[nodiscard]] std::string memberName(Id structure, std::uint32_t member) const;
    [[nodiscard]] std::optional<std::uint32_t> constant(Id id) const;

    [[nodiscard]] bool has(Id id, spv::Decoration decoration, std::uint32_t member = kWhole) const;
    /// The first operand of the decoration.
    [[nodiscard]] std::optional<std::uint32_t> value(Id id, spv::Decoration decoration, std::uint32_t member = kWhole) const;
    [[nodiscard]] std::string text(Id id, spv::Decoration decoration) const;

private:
    void read(const Instruction& instruction);
    void readDecoration(const Instruction& instruction);
    void readDefinition(const Instruction& instruction);

    using DecorationKey = std::tuple<Id, std::uint32_t, spv::Decoration>; // object, member, decoration
    Words words_;
    std::vector<Variable> variables_;
    std::map<Id, Type> types_;
    std::map<Id, std::uint32_t> constants_;
    std::map<std::pair<Id, std::uint32_t>, std::string> names_;
    std::map<DecorationKey, Words> decorations_;
};

/// Whether an output is decorated as the position.
[[nodiscard]] bool writesPosition(Words module);

} // namespace tegument::spirv
