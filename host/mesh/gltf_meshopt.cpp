// EXT_meshopt_compression (Khronos registry): runs of vertices or indices packed by meshoptimizer's codecs, perhaps filtered.

#include "host/mesh/gltf_meshopt.h"

#include <fmt/format.h>

#include <meshoptimizer.h>

namespace tegument::meshfile {

namespace {

/// One byte of the vertex codec's header stands for four groups of 16 equal bytes at best; more is no packed run, whatever it announces.
constexpr std::size_t kMostPerByte = 512;

struct Packed {
    std::size_t count = 0;
    std::size_t stride = 0;
    std::string mode;
    std::string filter;
};

Result<Packed> describe(const GltfValue& packed) {
    const auto count = packed.whole("count", kMaxIndices, {});
    if (!count) return count.error();
    const auto stride = packed.whole("byteStride", 257, {});
    if (!stride) return stride.error();
    Packed run{.count = *count, .stride = *stride, .mode = packed.text("mode"), .filter = packed.text("filter")};
    const bool indices = run.mode == "TRIANGLES" || run.mode == "INDICES";
    if (!indices && run.mode != "ATTRIBUTES") return packed.wrong(fmt::format("has the unknown mode '{}'", run.mode.substr(0, 40)));
    const bool right = indices ? run.stride == 2 || run.stride == 4 : run.stride > 0 && run.stride % 4 == 0;
    if (!right || (run.mode == "TRIANGLES" && run.count % 3 != 0))
        return packed.wrong(fmt::format("has {} elements of {} bytes, which its mode does not allow", run.count, run.stride));
    return run;
}

bool decode(const Packed& run, std::string_view bytes, std::string& values) {
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    if (run.mode == "ATTRIBUTES") return meshopt_decodeVertexBuffer(values.data(), run.count, run.stride, from, bytes.size()) == 0;
    if (run.mode == "TRIANGLES") return meshopt_decodeIndexBuffer(values.data(), run.count, run.stride, from, bytes.size()) == 0;
    return meshopt_decodeIndexSequence(values.data(), run.count, run.stride, from, bytes.size()) == 0;
}

bool unfilter(const Packed& run, std::string& values) {
    if (run.filter.empty() || run.filter == "NONE") return true;
    if (run.mode != "ATTRIBUTES") return false;
    if (run.filter == "OCTAHEDRAL" && (run.stride == 4 || run.stride == 8))
        meshopt_decodeFilterOct(values.data(), run.count, run.stride);
    else if (run.filter == "QUATERNION" && run.stride == 8)
        meshopt_decodeFilterQuat(values.data(), run.count, run.stride);
    else if (run.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(values.data(), run.count, run.stride);
    else
        return false;
    return true;
}

} // namespace

Result<std::string> unpackMeshopt(const GltfValue& packed, std::string_view bytes) {
    const auto run = describe(packed);
    if (!run) return run.error();
    const std::size_t size = run->count * run->stride;
    if (size > bytes.size() * kMostPerByte)
        return overclaimed(packed.source().whole(),
                           fmt::format("{} announces {} bytes, which {} cannot hold", packed.path(), size, bytes.size()));
    std::string values(size, '\0');
    if (run->count > 0 && !decode(*run, bytes, values))
        return unsupported(packed.source().whole(),
                           packed.path() + " cannot be unpacked: it is damaged, or of a later form of meshoptimizer's codec",
                           "export the file again with EXT_meshopt_compression of version 0, or without it");
    if (!unfilter(*run, values)) return packed.wrong(fmt::format("has a filter that does not fit: '{}'", run->filter.substr(0, 40)));
    return values;
}

} // namespace tegument::meshfile
