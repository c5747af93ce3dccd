#include "host/spirv/cache.h"

#include "host/support/cache.h"
#include "host/support/file.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace tegument {

namespace {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Writer {
public:
    std::string bytes;

    template <Plain T>
    void operator()(const T& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void operator()(const std::string& text) {
        (*this)(static_cast<std::uint64_t>(text.size()));
        bytes += text;
    }
};

class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}
    bool good = true;

    template <Plain T>
    void operator()(T& value) {
        if (take(sizeof value)) std::memcpy(&value, taken_.data(), sizeof value);
    }
    void operator()(bool& value) {
        std::uint8_t byte = 0;
        (*this)(byte);
        good = good && byte <= 1;
        value = byte == 1;
    }
    void operator()(std::string& text) {
        std::uint64_t size = 0;
        (*this)(size);
        if (take(size)) text = taken_;
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

private:
    bool take(std::uint64_t size) {
        good = good && size <= bytes_.size();
        if (!good) return false;
        taken_ = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return true;
    }

    std::string_view bytes_;
    std::string_view taken_;
};

// One list of fields serves both directions: Archive is Writer with const values, Reader with mutable ones.

template <class Archive, class Vector>
void each(Archive& archive, Vector& list, auto&& fields) {
    auto count = static_cast<std::uint64_t>(list.size());
    archive(count);
    if constexpr (std::is_same_v<Archive, Reader>) {
        archive.good = archive.good && count <= archive.left(); // every element takes at least a byte
        list.resize(archive.good ? count : 0);
    }
    for (auto& element : list)
        fields(element);
}

template <class Archive>
void block(Archive& archive, auto& value) {
    archive(value.name), archive(value.set), archive(value.binding), archive(value.size);
    each(archive, value.members, [&](auto& m) {
        archive(m.name), archive(m.base), archive(m.offset), archive(m.size), archive(m.rows), archive(m.columns), archive(m.elements);
        archive(m.arrayStride), archive(m.matrixStride), archive(m.spirvRowMajor), archive(m.used);
    });
}

template <class Archive>
void reflection(Archive& archive, auto& value) {
    bool hasGlobals = value.globals.has_value();
    archive(hasGlobals);
    if constexpr (std::is_same_v<Archive, Reader>)
        if (hasGlobals) value.globals.emplace();
    if (hasGlobals) block(archive, *value.globals);
    each(archive, value.constantBuffers, [&](auto& b) { block(archive, b); });
    each(archive, value.resources, [&](auto& r) { archive(r.name), archive(r.kind), archive(r.set), archive(r.binding), archive(r.used); });
    const auto variable = [&](auto& v) { archive(v.semantic), archive(v.location), archive(v.components), archive(v.base); };
    each(archive, value.inputs, variable);
    each(archive, value.outputs, variable);
    for (auto& size : value.localSize)
        archive(size);
}

template <class Archive>
void content(Archive& archive, auto& cached) {
    archive(cached.shader.stage), archive(cached.shader.file), archive(cached.shader.entry);
    each(archive, cached.shader.spirv, [&](auto& word) { archive(word); });
    reflection(archive, cached.shader.reflection);
    each(archive, cached.shader.warnings, [&](auto& w) {
        archive(w.severity), archive(w.code), archive(w.at.file), archive(w.at.line), archive(w.at.column);
        archive(w.text), archive(w.hint), archive(w.sourceLine);
    });
    each(archive, cached.includes, [&](auto& file) { archive(file.path), archive(file.hash); });
}

std::filesystem::path pathFor(const std::string& key) {
    return std::filesystem::path("spirv") / (key + ".bin");
}

bool unchanged(const IncludedFile& file) {
    const auto bytes = readFile(file.path);
    return bytes && contentHash(*bytes) == file.hash;
}

} // namespace

std::string encodeShader(const CachedShader& cached) {
    Writer writer;
    content(writer, cached);
    return std::move(writer.bytes);
}

std::optional<CachedShader> decodeShader(std::string_view bytes) {
    Reader reader(bytes);
    CachedShader cached;
    content(reader, cached);
    if (!reader.good || reader.left() != 0) return {};
    return cached;
}

std::optional<Shader> loadCachedShader(const std::string& key) {
    const auto bytes = loadCached(pathFor(key));
    auto cached = bytes ? decodeShader(*bytes) : std::nullopt;
    if (!cached || !std::ranges::all_of(cached->includes, unchanged)) return {};
    return std::move(cached->shader);
}

void storeCachedShader(const std::string& key, const CachedShader& cached) {
    storeCached(pathFor(key), encodeShader(cached));
}

} // namespace tegument
