#include "host/spirv/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <type_traits>

namespace tegument {

namespace {

using Differences = std::vector<std::string>;

template <class T>
void compareValue(Differences& into, std::string_view owner, std::string_view what, const T& a, const T& b) {
    if (a == b) return;
    if constexpr (std::is_enum_v<T>)
        into.push_back(fmt::format("{}: {} {} and {}", owner, what, static_cast<int>(a), static_cast<int>(b)));
    else
        into.push_back(fmt::format("{}: {} {} and {}", owner, what, a, b));
}

void compareMember(Differences& into, const BlockMember& a, const BlockMember& b) {
    const auto value = [&](std::string_view what, const auto& x, const auto& y) { compareValue(into, a.name, what, x, y); };
    value("base type", a.base, b.base);
    value("offset", a.offset, b.offset);
    value("size", a.size, b.size);
    value("rows", a.rows, b.rows);
    value("columns", a.columns, b.columns);
    value("elements", a.elements, b.elements);
    value("array stride", a.arrayStride, b.arrayStride);
    value("matrix stride", a.matrixStride, b.matrixStride);
    value("row-major", a.spirvRowMajor, b.spirvRowMajor);
    value("used", a.used, b.used);
}

/// Pairs elements by `key`; what is in one list only is a difference.
template <class T, class Key, class Compare>
void comparePairs(Differences& into, std::string_view what, const std::vector<T>& a, const std::vector<T>& b, Key key, Compare compare) {
    for (const T& x : a) {
        const auto y = std::ranges::find(b, std::invoke(key, x), key);
        if (y == b.end())
            into.push_back(fmt::format("{} {}: only in the first", what, std::invoke(key, x)));
        else
            compare(x, *y);
    }
    for (const T& y : b)
        if (std::ranges::find(a, std::invoke(key, y), key) == a.end())
            into.push_back(fmt::format("{} {}: only in the second", what, std::invoke(key, y)));
}

void compareBlock(Differences& into, const UniformBlock& a, const UniformBlock& b) {
    compareValue(into, a.name, "size", a.size, b.size);
    comparePairs(into, "parameter", a.members, b.members, &BlockMember::name,
                 [&](const BlockMember& x, const BlockMember& y) { compareMember(into, x, y); });
}

/// A compiler may drop a block or resource that nothing reads.
std::vector<UniformBlock> usedBlocks(const Reflection& reflection) {
    std::vector<UniformBlock> blocks = reflection.constantBuffers;
    if (reflection.globals) blocks.push_back(*reflection.globals);
    std::erase_if(blocks, [](const UniformBlock& block) { return std::ranges::none_of(block.members, &BlockMember::used); });
    return blocks;
}

std::vector<Resource> usedResources(const Reflection& reflection) {
    std::vector<Resource> resources = reflection.resources;
    std::erase_if(resources, [](const Resource& resource) { return !resource.used; });
    return resources;
}

} // namespace

std::vector<std::string> compareReflections(const Reflection& a, const Reflection& b) {
    Differences differences;
    comparePairs(differences, "block", usedBlocks(a), usedBlocks(b), &UniformBlock::name,
                 [&](const UniformBlock& x, const UniformBlock& y) { compareBlock(differences, x, y); });
    comparePairs(differences, "resource", usedResources(a), usedResources(b), &Resource::name,
                 [&](const Resource& x, const Resource& y) { compareValue(differences, x.name, "kind", x.kind, y.kind); });
    const auto variables = [&](std::string_view what, const std::vector<StageVariable>& x, const std::vector<StageVariable>& y) {
        comparePairs(differences, what, x, y, &StageVariable::semantic, [&](const StageVariable& left, const StageVariable& right) {
            compareValue(differences, left.semantic, "components", left.components, right.components);
            compareValue(differences, left.semantic, "base type", left.base, right.base);
        });
    };
    variables("input", a.inputs, b.inputs);
    variables("output", a.outputs, b.outputs);
    for (int i = 0; i < 3; ++i)
        compareValue(differences, "numthreads", "size", a.localSize[i], b.localSize[i]);
    return differences;
}

} // namespace tegument
