#include "host/mesh/ply_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

namespace tegument::meshfile {

namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

template <class T>
double as(const std::array<char, 8>& raw) {
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    return static_cast<double>(value);
}

double decode(const std::array<char, 8>& raw, PlyType type) {
    switch (type) {
    case PlyType::Int8: return as<std::int8_t>(raw);
    case PlyType::Uint8: return as<std::uint8_t>(raw);
    case PlyType::Int16: return as<std::int16_t>(raw);
    case PlyType::Uint16: return as<std::uint16_t>(raw);
    case PlyType::Int32: return as<std::int32_t>(raw);
    case PlyType::Uint32: return as<std::uint32_t>(raw);
    case PlyType::Float32: return as<float>(raw);
    case PlyType::Float64: return as<double>(raw);
    }
    return 0;
}

} // namespace

PlyValues::PlyValues(const Source& source, const PlyHeader& header)
    : source_(source), format_(header.format), offset_(header.size), line_(header.lines + 1) {
    if (format_ != PlyFormat::Ascii) return;
    double items = 0;
    for (const PlyElement& element : header.elements)
        items += static_cast<double>(element.count);
    const std::string_view data = source.bytes.substr(std::min(offset_, source.bytes.size()));
    rowsAreLines_ = static_cast<double>(std::ranges::count(data, '\n')) + 1 >= items;
}

SourcePosition PlyValues::at() const {
    return format_ == PlyFormat::Ascii ? source_.atLine(line_) : source_.atByte(std::min(offset_, source_.bytes.size()));
}

std::size_t PlyValues::nextCount(const PlyProperty& property) {
    const double count = next(*property.listCount);
    const std::size_t least = format_ == PlyFormat::Ascii ? 2 : byteSize(property.type);
    const std::size_t left = source_.bytes.size() - offset_;
    if (count >= 0 && count * static_cast<double>(least) <= static_cast<double>(left + 1)) return static_cast<std::size_t>(count);
    fail(overclaimed(at(), fmt::format("a list '{}' of {} entries, but only {} bytes are left", property.name, count, left)));
    return 0;
}

std::optional<Error> PlyValues::checkEnd() const {
    const std::string_view rest = source_.bytes.substr(std::min(offset_, source_.bytes.size()));
    if (std::ranges::all_of(rest, isSpace)) return std::nullopt;
    return malformed(source_.atByte(offset_), fmt::format("{} bytes follow the last element that the header announces", rest.size()),
                     "a list may be longer than the type of its length can say, or a count is wrong: export the file again");
}

void PlyValues::skipList(const PlyProperty& property) {
    for (std::size_t left = nextCount(property); left > 0 && !error_; --left)
        next(property.type);
}

void PlyValues::nextRow(const PlyElement& element, std::vector<double>& row) {
    row.assign(element.properties.size(), 0);
    for (std::size_t i = 0; i < row.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.listCount)
            skipList(property);
        else
            row[i] = next(property.type);
    }
    if (rowsAreLines_ && !error_) checkRow(element);
}

/// A row that goes on would become the next item's numbers.
void PlyValues::checkRow(const PlyElement& element) {
    const std::string_view bytes = source_.bytes;
    const std::size_t next = bytes.find_first_not_of(" \t\r", offset_);
    if (next == std::string_view::npos || bytes[next] == '\n') return;
    const std::size_t end = std::min(bytes.find('\n', next), bytes.size());
    fail(malformed(at(),
                   fmt::format("the row has more values than the {} that the header declares for '{}': '{}'", element.properties.size(),
                               element.name, bytes.substr(next, std::min<std::size_t>(end - next, 40))),
                   "declare a property for each value, or export the mesh again"));
}

void PlyValues::skip(const PlyElement& element) {
    std::vector<double> row;
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count && !error_; ++i)
        nextRow(element, row);
}

double PlyValues::nextText(PlyType type) {
    const std::string_view bytes = source_.bytes;
    while (offset_ < bytes.size() && isSpace(bytes[offset_]))
        line_ += bytes[offset_++] == '\n';
    const bool wholeWanted = type != PlyType::Float32 && type != PlyType::Float64;
    const char* const begin = bytes.data() + offset_;
    const char* const end = bytes.data() + bytes.size();
    double value = 0;
    std::int64_t whole = 0;
    const auto parsed = wholeWanted ? std::from_chars(begin, end, whole) : std::from_chars(begin, end, value);
    if (parsed.ec != std::errc() || (parsed.ptr != end && !isSpace(*parsed.ptr)))
        return parseWord(std::min(bytes.find_first_of(" \t\r\n", offset_), bytes.size()), wholeWanted);
    offset_ = static_cast<std::size_t>(parsed.ptr - bytes.data());
    return wholeWanted ? static_cast<double>(whole) : value;
}

double PlyValues::parseWord(std::size_t end, bool wholeWanted) {
    const std::string_view word = source_.bytes.substr(offset_, end - offset_);
    if (word.empty()) {
        fail(truncated(source_.atByte(source_.bytes.size()), "more values are announced in its header"));
        return 0;
    }
    offset_ = end;
    double value = 0;
    const bool number = parseReal(word, value);
    if (!number) fail(notANumber(at(), word));
    if (number && wholeWanted && !(value == std::floor(value)))
        fail(malformed(at(), fmt::format("'{}' is not a whole number", word.substr(0, 40))));
    return value;
}

double PlyValues::nextBinary(PlyType type) {
    std::array<char, 8> raw{};
    const std::size_t size = std::min(byteSize(type), raw.size()); // always the former; GCC 12 for arm64 warns where it does not see that
    if (size > source_.bytes.size() - offset_) {
        fail(truncated(source_.atByte(source_.bytes.size()), "more values are announced in its header"));
        return 0;
    }
    std::memcpy(raw.data(), source_.bytes.data() + offset_, size);
    offset_ += size;
    const bool swap = (format_ == PlyFormat::BigEndian) != (std::endian::native == std::endian::big);
    if (swap) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    return decode(raw, type);
}

} // namespace tegument::meshfile
