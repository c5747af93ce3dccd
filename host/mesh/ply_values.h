#pragma once
// Inside host/mesh only: the data section of a PLY file, one value after the other.
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
    std::vector<std::string> pictures;                   // of the lines `comment TextureFile NAME`, as scanners' programs write them
    std::vector<std::pair<std::string, int>> otherLines; // before all elements: the first word and the line of what is not understood
};

/// Also refuses element counts that the rest of the file cannot hold.
[[nodiscard]] Result<PlyHeader> readPlyHeader(const Source& source);

/// The first error is kept; after it every value is 0.
class PlyValues {
public:
    PlyValues(const Source& source, const PlyHeader& header);

    double next(PlyType type) {
        if (error_) return 0;
        return format_ == PlyFormat::Ascii ? nextText(type) : nextBinary(type);
    }

    /// A list's length, already held against what is left of the file.
    std::size_t nextCount(const PlyProperty& property);
    void skipList(const PlyProperty& property);
    /// One of an element's items; lists are read over, and count as 0.
    void nextRow(const PlyElement& element, std::vector<double>& row);
    /// Of a text where each line is an item: reads over what follows on it. TRUE where that is more than blanks.
    bool skipRestOfLine();
    /// Reads over all items of an element.
    void skip(const PlyElement& element);
    /// Bytes behind the last element: a list was longer than the type of its length can say, or the header counts too few.
    [[nodiscard]] std::optional<Error> checkEnd() const;

    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }
    [[nodiscard]] SourcePosition at() const;

private:
    double nextText(PlyType type);
    double nextBinary(PlyType type);
    void checkRow(const PlyElement& element);
    /// The slow way, which also says what is wrong.
    double parseWord(std::size_t end, bool wholeWanted);

    const Source& source_;
    PlyFormat format_;
    std::size_t offset_;
    int line_;
    bool rowsAreLines_ = false; // of a text: each item has a line of its own
    bool linesAreRows_ = false; // and none has two
    std::optional<Error> error_;
};

} // namespace tegument::meshfile
