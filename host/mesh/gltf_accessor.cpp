// glTF accessors (glTF 2.0 specification, 3.6.2): typed views into buffer views, with strides, normalised integers and sparse substitution.

#include "host/mesh/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace tegument::meshfile {

namespace {

constexpr std::size_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

/// 0 for a type that glTF does not have.
std::size_t componentSize(std::size_t type) {
    switch (type) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    case kUnsignedInt:
    case kFloat: return 4;
    default: return 0;
    }
}

std::size_t componentsOf(const std::string& type) {
    if (type == "MAT4") return 16; // of floats: no padding
    static constexpr std::array<std::string_view, 4> kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto* found = std::ranges::find(kTypes, type);
    return found == kTypes.end() ? 0 : static_cast<std::size_t>(found - kTypes.begin()) + 1;
}

/// Little-endian in the file, whatever the machine.
std::uint32_t bitsAt(std::string_view bytes, std::size_t offset, std::size_t size) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits |= std::uint32_t{static_cast<unsigned char>(bytes[offset + i])} << (8 * i);
    return bits;
}

/// Specification 3.6.2.2: f = c / 127, max(c / 127, -1) and so on.
float toRange(float value, std::size_t type) {
    switch (type) {
    case kByte: return std::max(value / 127, -1.0f);
    case kUnsignedByte: return value / 255.0f;
    case kShort: return std::max(value / 32767, -1.0f);
    case kUnsignedShort: return value / 65535.0f;
    default: return value;
    }
}

float toFloat(std::uint32_t bits, std::size_t type, bool normalized) {
    float value = 0;
    switch (type) {
    case kByte: value = static_cast<float>(static_cast<std::int8_t>(bits)); break;
    case kShort: value = static_cast<float>(static_cast<std::int16_t>(bits)); break;
    case kFloat: std::memcpy(&value, &bits, sizeof value); break;
    default: value = static_cast<float>(bits);
    }
    return normalized ? toRange(value, type) : value;
}

bool isNormalized(const GltfValue& accessor) {
    return accessor.has("normalized") && accessor.json()["normalized"] == true;
}

} // namespace

/// Finds the bytes that `run` (its count, types and, in `owner`, its buffer view and offset) stands for.
Result<GltfDocument::Run> GltfDocument::place(const GltfValue& owner, Run run) const {
    const auto index = owner.whole("bufferView", SIZE_MAX, {});
    if (!index) return index.error();
    const auto bytes = view(*index);
    if (!bytes) return bytes.error();
    const std::size_t element = componentSize(run.componentType) * run.components;
    const auto offset = owner.whole("byteOffset", bytes->size() + 1, 0);
    if (!offset) return offset.error();
    const auto stride = root()["bufferViews"][*index].whole("byteStride", 253, element);
    if (!stride) return stride.error();
    run.stride = *stride;
    run.bytes = bytes->substr(*offset);
    if (run.stride < element) return owner.wrong(fmt::format("has elements of {} bytes every {} bytes", element, run.stride));
    const bool fits = run.count == 0 || (run.bytes.size() >= element && (run.bytes.size() - element) / run.stride >= run.count - 1);
    if (!fits)
        return overclaimed(source_->whole(), fmt::format("{}: {} elements cannot be held by the {} bytes of its buffer view", owner.path(),
                                                         run.count, run.bytes.size()));
    return run;
}

std::size_t GltfDocument::components(std::size_t accessor) const {
    const auto value = item("accessors", accessor);
    const std::size_t count = value ? componentsOf(value->text("type")) : 0;
    return count > 4 ? 0 : count;
}

/// An accessor without a buffer view is all zeros; its run has no bytes.
Result<GltfDocument::Run> GltfDocument::describe(const GltfValue& accessor, std::size_t components) const {
    const auto count = accessor.whole("count", kMaxIndices, {});
    if (!count) return count.error();
    const auto type = accessor.whole("componentType", 65536, {});
    if (!type) return type.error();
    if (componentSize(*type) == 0) return accessor.wrong(fmt::format("has the unknown componentType {}", *type));
    if (componentsOf(accessor.text("type")) != components)
        return accessor.wrong(fmt::format("is of type '{}', but {} components are needed", accessor.text("type"), components));
    const Run shape{.stride = 0, .count = *count, .componentType = *type, .components = components, .normalized = isNormalized(accessor)};
    if (!accessor.has("bufferView")) {
        // zeros need no bytes in the file, so the size of the file is the only measure for a count that means no harm
        if (*count > source_->bytes.size())
            return overclaimed(source_->whole(), fmt::format("{} has {} elements and no data", accessor.path(), *count));
        return shape;
    }
    return place(accessor, shape);
}

float GltfDocument::normalised(float value, const GltfValue& accessor) {
    const auto type = accessor.whole("componentType", 65536, kFloat);
    return type && isNormalized(accessor) ? toRange(value, *type) : value;
}

Result<std::vector<float>> GltfDocument::floats(std::size_t index, std::size_t components) const {
    const auto accessor = item("accessors", index);
    if (!accessor) return accessor.error();
    const auto found = describe(*accessor, components);
    if (!found) return found.error();
    const Run& run = *found;
    std::vector<float> values(run.count * components);
    const std::size_t size = componentSize(run.componentType);
    if (!run.bytes.empty())
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] =
                toFloat(bitsAt(run.bytes, i / components * run.stride + i % components * size, size), run.componentType, run.normalized);
    if (accessor->has("sparse"))
        if (auto error = applySparse(*accessor, run, values)) return *error;
    return values;
}

std::optional<Error> GltfDocument::applySparse(const GltfValue& accessor, const Run& shape, std::vector<float>& values) const {
    const GltfValue sparse = accessor["sparse"];
    const auto count = sparse.whole("count", shape.count + 1, {});
    if (!count) return count.error();
    const auto indexType = sparse["indices"].whole("componentType", 65536, {});
    if (!indexType) return indexType.error();
    if (*indexType != kUnsignedByte && *indexType != kUnsignedShort && *indexType != kUnsignedInt)
        return sparse.wrong("has indices that are not unsigned integers");
    const auto where = place(sparse["indices"], {.stride = 0, .count = *count, .componentType = *indexType, .components = 1});
    if (!where) return where.error();
    Run wanted = shape;
    wanted.count = *count;
    const auto what = place(sparse["values"], wanted);
    if (!what) return what.error();
    const std::size_t size = componentSize(what->componentType);
    for (std::size_t i = 0; i < *count; ++i) {
        const std::size_t element = bitsAt(where->bytes, i * where->stride, componentSize(*indexType));
        if (element >= shape.count)
            return badIndex(source_->whole(), fmt::format("{} replaces element {} of {}", sparse.path(), element, shape.count));
        for (std::size_t c = 0; c < shape.components; ++c)
            values[element * shape.components + c] =
                toFloat(bitsAt(what->bytes, i * what->stride + c * size, size), what->componentType, what->normalized);
    }
    return std::nullopt;
}

Result<std::vector<std::uint32_t>> GltfDocument::indices(std::size_t index) const {
    const auto accessor = item("accessors", index);
    if (!accessor) return accessor.error();
    const auto found = describe(*accessor, 1);
    if (!found) return found.error();
    const Run& run = *found;
    if (run.componentType != kUnsignedByte && run.componentType != kUnsignedShort && run.componentType != kUnsignedInt)
        return accessor->wrong("has indices that are not unsigned integers");
    if (accessor->has("sparse"))
        return unsupported(source_->whole(), accessor->path() + ": sparse indices cannot be read", "export the mesh again");
    std::vector<std::uint32_t> values(run.count);
    if (!run.bytes.empty())
        for (std::size_t i = 0; i < run.count; ++i)
            values[i] = bitsAt(run.bytes, i * run.stride, componentSize(run.componentType));
    return values;
}

} // namespace tegument::meshfile
