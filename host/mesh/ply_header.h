#pragma once
// Inside host/mesh only: what a PLY file says about itself.

#include "host/mesh/mesh_file.h"

#include <cstdint>

namespace tegument::meshfile {

using PlyType = NumberType;

[[nodiscard]] std::size_t byteSize(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    std::optional<PlyType> listCount; // set for lists
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    int line = 0;
    std::vector<PlyProperty> properties;

    /// Index of the first property with one of these names.
    [[nodiscard]] std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
};

enum class PlyFormat { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0; // bytes up to the first of the data
    int lines = 0;
    std::vector<std::string> pictures; // of the lines `comment TextureFile NAME`, as scanners' programs write them
};

/// Also refuses element counts that the rest of the file cannot hold.
[[nodiscard]] Result<PlyHeader> readPlyHeader(const Source& source);

} // namespace tegument::meshfile
