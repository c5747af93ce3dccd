#include "host/run/constants.h"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>

namespace tegument::run {

namespace {

std::uint32_t encode(double value, MemberBase base) {
    switch (base) {
    case MemberBase::Bool: return value != 0 ? 1U : 0U;
    case MemberBase::Int: return std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value));
    case MemberBase::Uint: return static_cast<std::uint32_t>(value);
    case MemberBase::Float: break;
    }
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

std::size_t offsetInElement(const BlockMember& member, std::uint32_t row, std::uint32_t column) {
    if (member.rows == 1) return std::size_t{4} * column;
    return member.spirvRowMajor ? std::size_t{column} * member.matrixStride + std::size_t{4} * row
                                : std::size_t{row} * member.matrixStride + std::size_t{4} * column;
}

bool sameShape(const BlockMember& member, const Type& type) {
    const auto same = [](std::uint32_t reflected, int declared) { return reflected == static_cast<std::uint32_t>(declared); };
    return same(member.rows, type.rows) && same(member.columns, type.columns) && same(member.elements, type.elements);
}

} // namespace

Result<void> pack(const BlockMember& member, const Parameter& parameter, const Numbers& value, std::span<std::byte> block) {
    if (!sameShape(member, parameter.type))
        return inputError(4019, parameter.at,
                          fmt::format("{} is declared {} here, but the compiler saw {} rows, {} columns, {} elements", parameter.name,
                                      parameter.type.name, member.rows, member.columns, member.elements),
                          "do not declare it differently under #ifdef FX_ENTRY");
    assert(value.size() == static_cast<std::size_t>(parameter.type.scalarCount()));
    std::size_t next = 0;
    const std::uint32_t elements = member.elements == 0 ? 1 : member.elements;
    for (std::uint32_t element = 0; element < elements; ++element)
        for (std::uint32_t row = 0; row < member.rows; ++row)
            for (std::uint32_t column = 0; column < member.columns; ++column) {
                const std::size_t at = member.offset + std::size_t{element} * member.arrayStride + offsetInElement(member, row, column);
                const std::uint32_t bits = encode(value[next++], member.base);
                assert(at + sizeof bits <= block.size());
                std::memcpy(block.data() + at, &bits, sizeof bits);
            }
    return {};
}

} // namespace tegument::run
