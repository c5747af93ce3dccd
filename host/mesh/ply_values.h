#pragma once
// Inside host/mesh only: the data section of a PLY file, one value after the other.

#include "host/mesh/ply_header.h"

namespace tegument::meshfile {

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
    std::optional<Error> error_;
};

} // namespace tegument::meshfile
