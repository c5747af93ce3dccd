#pragma once
// Inside host/mesh only: typed access to the JSON of a glTF file. Each value knows its path ("accessors[3].count") for messages.

#include "host/mesh/mesh_file.h"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace tegument::meshfile {

using Json = nlohmann::json;

/// A JSON value and where it stands. The JSON must outlive it.
class GltfValue {
public:
    GltfValue(const Source& source, const Json& json, std::string path) : source_(&source), json_(&json), path_(std::move(path)) {}

    [[nodiscard]] const Json& json() const { return *json_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const Source& source() const { return *source_; }

    [[nodiscard]] bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
    /// The member, or an empty object where there is none.
    [[nodiscard]] GltfValue operator[](const char* key) const;
    /// The item of a list.
    [[nodiscard]] GltfValue operator[](std::size_t index) const;
    /// Number of items; 0 unless it is a list.
    [[nodiscard]] std::size_t size() const { return json_->is_array() ? json_->size() : 0; }

    /// The value itself as a whole number below `limit`.
    [[nodiscard]] Result<std::size_t> whole(std::size_t limit) const;
    /// A member; where it is absent, `absent` (which need not be below the limit), or an error without one.
    [[nodiscard]] Result<std::size_t> whole(const char* key, std::size_t limit, std::optional<std::size_t> absent) const;
    /// A member that is a list of `count` finite numbers; `absent` where there is none.
    [[nodiscard]] Result<std::vector<double>> numbers(const char* key, std::size_t count, std::vector<double> absent) const;
    /// A member that is a string; empty where it is absent or something else.
    [[nodiscard]] std::string text(const char* key) const;

    [[nodiscard]] Error wrong(const std::string& text) const { return malformed(source_->whole(), path_ + " " + text); }

private:
    const Source* source_;
    const Json* json_;
    std::string path_;
};

} // namespace tegument::meshfile
