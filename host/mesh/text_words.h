#pragma once
// Inside host/mesh only: the words of a text mesh file one after the other, with the line they stand in.

#include "host/mesh/mesh_file.h"

#include <algorithm>

namespace tegument::meshfile {

class TextWords {
public:
    /// `comment` starts a comment that ends with the line; 0 for none.
    TextWords(const Source& source, char comment) : source_(source), comment_(comment) {}

    /// Empty at the end of the file.
    std::string_view next() {
        skipSpace();
        const std::size_t end = std::min(source_.bytes.find_first_of(" \t\r\n\f\v", offset_), source_.bytes.size());
        const std::string_view word = source_.bytes.substr(offset_, end - offset_);
        offset_ = end;
        return word;
    }

    /// The next word as a number. The first failure is kept; after it every number is 0.
    double nextNumber(std::string_view what) {
        if (error_) return 0;
        const std::string_view word = next();
        double value = 0;
        if (word.empty())
            fail(truncated(source_.atByte(source_.bytes.size()), std::string(what) + " is missing"));
        else if (!parseReal(word, value))
            fail(notANumber(at(), word));
        return error_ ? 0 : value;
    }

    /// Times the unit, not rounded.
    glm::dvec3 nextPosition(std::string_view what) {
        const double x = nextNumber(what);
        const double y = nextNumber(what);
        const double z = nextNumber(what);
        const glm::dvec3 position = glm::dvec3(x, y, z) * source_.unitMm;
        if (!error_ && !source_.keepNotFinite && !isFinite(glm::vec3(position))) fail(notFinite(at(), "a coordinate is not finite"));
        return position;
    }

    void skipLine() { offset_ = std::min(source_.bytes.find('\n', offset_), source_.bytes.size()); }
    /// What is left of the line, taken off.
    std::string_view restOfLine() {
        const std::size_t from = offset_;
        skipLine();
        return source_.bytes.substr(from, offset_ - from);
    }

    /// Lines from here on that hold a word.
    [[nodiscard]] std::size_t linesLeft() const {
        std::size_t count = 0;
        for (std::size_t from = offset_; from < source_.bytes.size();) {
            const std::size_t end = std::min(source_.bytes.find('\n', from), source_.bytes.size());
            const std::size_t word = source_.bytes.find_first_not_of(" \t\r\f\v", from);
            count += word < end && source_.bytes[word] != comment_;
            from = end + 1;
        }
        return count;
    }

    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }
    [[nodiscard]] SourcePosition at() const { return source_.atLine(line_); }
    [[nodiscard]] std::size_t bytesLeft() const { return source_.bytes.size() - offset_; }

private:
    void skipSpace() {
        for (; offset_ < source_.bytes.size(); ++offset_) {
            const char c = source_.bytes[offset_];
            if (c == '\n') ++line_;
            if (comment_ != 0 && c == comment_)
                offset_ = std::min(source_.bytes.find('\n', offset_), source_.bytes.size()) - 1;
            else if (c != ' ' && (c < '\t' || c > '\r'))
                return;
        }
    }

    const Source& source_;
    char comment_;
    std::size_t offset_ = 0;
    int line_ = 1;
    std::optional<Error> error_;
};

} // namespace tegument::meshfile
