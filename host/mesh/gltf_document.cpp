// The glb container (glTF 2.0 specification, 4.4), the JSON, the buffers.

#include "host/mesh/gltf_document.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>

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

/// What a buffer view packed by the extension stands for. TG5302 what the extension does not allow, TG5303 a size that so few bytes cannot
/// hold, TG5307 a later form of the codec.
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

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

std::uint32_t littleEndian32(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[offset + i])} << (8 * i);
    return value;
}

std::optional<std::string> decodeBase64(std::string_view text) {
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    while (text.ends_with('='))
        text.remove_suffix(1);
    std::string bytes;
    std::uint32_t bits = 0;
    unsigned filled = 0;
    for (const char c : text) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        filled += 6;
        if (filled < 8) continue;
        filled -= 8;
        bytes.push_back(static_cast<char>(bits >> filled & 255));
    }
    return bytes;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// RFC 3986: %20 is a space.
std::string decodePercent(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
        const int low = high >= 0 ? hexDigit(uri[i + 2]) : -1;
        if (low < 0) {
            text.push_back(uri[i]);
            continue;
        }
        text.push_back(static_cast<char>(high * 16 + low));
        i += 2;
    }
    return text;
}

/// Extensions that are read, and those without which the geometry is still right.
bool isHarmless(const std::string& extension) {
    static constexpr std::array<std::string_view, 17> kNames = {"EXT_mesh_primitive_restart",
                                                                "KHR_mesh_quantization",
                                                                "KHR_lights_punctual",
                                                                "KHR_texture_transform",
                                                                "KHR_draco_mesh_compression",
                                                                "EXT_meshopt_compression",
                                                                "KHR_meshopt_compression",
                                                                "EXT_mesh_gpu_instancing",
                                                                "KHR_texture_basisu",
                                                                "EXT_texture_webp",
                                                                "EXT_texture_avif",
                                                                "MSFT_texture_dds",
                                                                "KHR_techniques_webgl",
                                                                "KHR_technique_webgl",
                                                                "KHR_xmp_json_ld",
                                                                "KHR_animation_pointer",
                                                                "MSFT_lod"};
    return extension.starts_with("KHR_materials_") || std::ranges::find(kNames, extension) != kNames.end();
}

} // namespace

Result<std::unique_ptr<GltfDocument>> GltfDocument::open(const Source& source) {
    std::unique_ptr<GltfDocument> document(new GltfDocument(source)); // the constructor is private
    auto error = source.bytes.starts_with(kMagic) ? document->readGlb() : document->parse(source.bytes, 0);
    if (!error) error = document->checkExtensions();
    if (!error) error = document->readBuffers();
    if (error) return *error;
    return document;
}

std::optional<Error> GltfDocument::readGlb() {
    std::string_view bytes = source_->bytes;
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    if (bytes.size() < kHeader) return truncated(source_->atByte(bytes.size()), "a glb header has 12 bytes");
    if (const std::uint32_t version = littleEndian32(bytes, 4); version != 2)
        return unsupported(source_->atByte(4), fmt::format("glb version {} cannot be read", version), "export it as glTF 2.0");
    const std::size_t length = littleEndian32(bytes, 8);
    if (length > bytes.size())
        return truncated(source_->atByte(bytes.size()), fmt::format("its header announces {} bytes, {} are there", length, bytes.size()));
    if (length < kHeader + kChunkHeader)
        return malformed(source_->atByte(8),
                         fmt::format("its header announces {} bytes, {} are there: no JSON chunk fits", length, bytes.size()));
    bytes = bytes.substr(0, length);

    std::string_view text;
    std::size_t textOffset = 0;
    for (std::size_t offset = kHeader; offset < bytes.size();) {
        if (bytes.size() - offset < kChunkHeader) return truncated(source_->atByte(offset), "a chunk's header is cut off");
        const std::size_t size = littleEndian32(bytes, offset);
        const std::uint32_t type = littleEndian32(bytes, offset + 4);
        const std::size_t start = offset + kChunkHeader;
        if (size > bytes.size() - start)
            return overclaimed(source_->atByte(offset), fmt::format("a chunk announces {} bytes, {} are left", size, bytes.size() - start));
        if (type == kJsonChunk && text.empty()) {
            if (size == 0) break;
            text = bytes.substr(start, size);
            textOffset = start;
        } else if (type == kBinaryChunk && !hasGlbBuffer_) {
            glbBuffer_ = bytes.substr(start, size);
            hasGlbBuffer_ = true;
        }
        offset = start + size;
    }
    if (text.empty()) return malformed(source_->atByte(kHeader), "the glb has no JSON chunk, or one of length 0");
    return parse(text, textOffset);
}

std::optional<Error> GltfDocument::parse(std::string_view text, std::size_t offset) {
    try {
        json_ = Json::parse(text);
    } catch (const Json::parse_error& error) {
        return malformed(source_->atByte(offset + error.byte), "the JSON of the glTF file cannot be read here");
    } catch (const Json::exception&) { // a number beyond double
        return malformed(source_->atByte(offset), "the JSON of the glTF file holds a number that is too large");
    }
    if (!json_.is_object() || !root().has("asset"))
        return malformed(source_->atByte(offset), "the JSON is not a glTF file: it has no 'asset'");
    if (const std::string version = root()["asset"].text("version"); !version.starts_with("2."))
        return unsupported(source_->atByte(offset), fmt::format("glTF version '{}' cannot be read", version), "export it as glTF 2.0");
    return std::nullopt;
}

std::optional<Error> GltfDocument::checkExtensions() const {
    const GltfValue required = root()["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const Json& name = required.json()[i];
        if (name.is_string() && isHarmless(name.get<std::string>())) continue;
        return unsupported(source_->whole(),
                           fmt::format("the file requires the glTF extension {}", name.dump(-1, ' ', true, Json::error_handler_t::replace)),
                           "export it without that extension");
    }
    return std::nullopt;
}

std::optional<Error> GltfDocument::readBuffers() {
    const GltfValue buffers = root()["buffers"];
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const GltfValue buffer = buffers[i];
        const auto length = buffer.whole("byteLength", std::size_t{1} << 40, {});
        if (!length) return length.error();
        std::string_view bytes = glbBuffer_;
        const GltfValue extensions = buffer["extensions"];
        const bool fallback =
            extensions["EXT_meshopt_compression"].has("fallback") || extensions["KHR_meshopt_compression"].has("fallback");
        if (fallback && !buffer.has("uri")) { // stands for what is unpacked; holds nothing
            buffers_.emplace_back();
            continue;
        }
        if (buffer.has("uri")) {
            auto read = resolveUri(buffer, buffer.text("uri"));
            if (!read) return read.error();
            bytes = owned_.emplace_back(std::move(*read));
        } else if (i != 0 || !hasGlbBuffer_) {
            return buffer.wrong("has no 'uri', and the file has no binary chunk for it");
        }
        if (*length > bytes.size())
            return overclaimed(source_->whole(), fmt::format("{} announces {} bytes, {} are there", buffer.path(), *length, bytes.size()));
        buffers_.push_back(bytes.substr(0, *length));
    }
    return std::nullopt;
}

Result<std::string> GltfDocument::resolveUri(const GltfValue& owner, const std::string& uri) const {
    if (uri.starts_with("data:")) {
        const std::size_t start = uri.find(";base64,");
        auto bytes = start == std::string::npos ? std::nullopt : decodeBase64(std::string_view(uri).substr(start + 8));
        if (!bytes) return owner.wrong("has a data URI that is not base64");
        return std::move(*bytes);
    }
    if (uri.empty() || uri.find("://") != std::string::npos || uri.find('\0') != std::string::npos)
        return owner.wrong(fmt::format("has a uri that is no file: '{}'", uri.substr(0, 60)));
    return readNamed(*source_, source_->path.parent_path() / decodePercent(uri));
}

Result<GltfValue> GltfDocument::item(const char* list, std::size_t index) const {
    const GltfValue values = root()[list];
    if (index >= values.size()) return malformed(source_->whole(), fmt::format("{}[{}] does not exist", list, index));
    return values[index];
}

Result<std::string_view> GltfDocument::view(std::size_t bufferView) const {
    const auto value = item("bufferViews", bufferView);
    if (!value) return value.error();
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if ((*value)["extensions"].has(name)) return unpacked(bufferView, (*value)["extensions"][name]);
    return bytesOf(*value);
}

Result<std::string_view> GltfDocument::bytesOf(const GltfValue& view) const {
    const auto buffer = view.whole("buffer", buffers_.size(), {});
    if (!buffer) return buffer.error();
    const std::string_view bytes = buffers_[*buffer];
    const auto offset = view.whole("byteOffset", bytes.size() + 1, 0);
    if (!offset) return offset.error();
    const auto length = view.whole("byteLength", bytes.size() - *offset + 1, {});
    if (!length) return length.error();
    return bytes.substr(*offset, *length);
}

Result<std::string_view> GltfDocument::unpacked(std::size_t bufferView, const GltfValue& packed) const {
    if (const auto known = unpacked_.find(bufferView); known != unpacked_.end()) return std::string_view(known->second);
    const auto bytes = bytesOf(packed);
    if (!bytes) return bytes.error();
    auto values = unpackMeshopt(packed, *bytes);
    if (!values) return values.error();
    return std::string_view(unpacked_.emplace(bufferView, std::move(*values)).first->second);
}

} // namespace tegument::meshfile
