#include "host/mesh/ply_values.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <utility>

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

// PLY header: "The PLY Polygon File Format", Greg Turk, 1994; type names of both generations.

std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> result;
    while (!(line = trim(line)).empty()) {
        const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
        result.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
    return result;
}

std::optional<PlyType> typeNamed(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
        {"char", PlyType::Int8},
        {"uchar", PlyType::Uint8},
        {"short", PlyType::Int16},
        {"ushort", PlyType::Uint16},
        {"int", PlyType::Int32},
        {"uint", PlyType::Uint32},
        {"float", PlyType::Float32},
        {"double", PlyType::Float64},
        {"int8", PlyType::Int8},
        {"uint8", PlyType::Uint8},
        {"int16", PlyType::Int16},
        {"uint16", PlyType::Uint16},
        {"int32", PlyType::Int32},
        {"uint32", PlyType::Uint32},
        {"float32", PlyType::Float32},
        {"float64", PlyType::Float64},
    }};
    const auto* found = std::ranges::find(kTypes, name, &std::pair<std::string_view, PlyType>::first);
    return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

bool isInteger(PlyType type) {
    return type != PlyType::Float32 && type != PlyType::Float64;
}

/// Reads one header line after the other into `header`.
class HeaderReader {
public:
    explicit HeaderReader(const Source& source) : source_(source) {}

    Result<PlyHeader> read() {
        while (true) {
            const std::size_t end = source_.bytes.find('\n', header_.size);
            if (end == std::string_view::npos) return truncated(source_.atByte(source_.bytes.size()), "no end_header");
            const std::string_view line = source_.bytes.substr(header_.size, end - header_.size);
            header_.size = end + 1;
            ++header_.lines;
            const std::vector<std::string_view> parts = words(line);
            noticePicture(line);
            if (parts.size() == 1 && parts[0] == "end_header") break;
            if (auto wrong = readLine(parts)) return *wrong;
        }
        if (!formatKnown_) return malformed(source_.atLine(2), "the PLY header has no format line");
        if (auto wrong = checkCounts()) return *wrong;
        return std::move(header_);
    }

private:
    std::optional<Error> readLine(const std::vector<std::string_view>& parts) {
        if (header_.lines == 1 || parts.empty() || parts[0] == "comment" || parts[0] == "obj_info") return std::nullopt;
        if (parts[0] == "format") return readFormat(parts);
        if (parts[0] == "element") return readElement(parts);
        if (parts[0] == "property") return readProperty(parts);
        if (header_.elements.empty()) { // a comment in several lines, of which only the first says so
            header_.otherLines.emplace_back(parts[0].substr(0, 80), header_.lines);
            return std::nullopt;
        }
        return wrong(fmt::format("unknown PLY header line '{}'", parts[0]));
    }

    void noticePicture(std::string_view line) {
        if (nextWord(line) != "comment" || !equalsIgnoreCase(nextWord(line), "TextureFile") || trim(line).empty()) return;
        header_.pictures.emplace_back(trim(line));
    }

    std::optional<Error> readFormat(const std::vector<std::string_view>& parts) {
        static constexpr std::array<std::string_view, 3> kNames = {"ascii", "binary_little_endian", "binary_big_endian"};
        if (parts.size() < 2) return wrong("the format line names no format");
        const auto* found = std::ranges::find(kNames, parts[1]);
        if (found == kNames.end()) return wrong(fmt::format("unknown PLY format '{}'", parts[1]));
        header_.format = static_cast<PlyFormat>(found - kNames.begin());
        formatKnown_ = true;
        return std::nullopt;
    }

    std::optional<Error> readElement(const std::vector<std::string_view>& parts) {
        if (parts.size() != 3) return wrong("an element line is 'element NAME COUNT'");
        PlyElement element{.name = std::string(parts[1]), .count = 0, .line = header_.lines};
        const auto parsed = std::from_chars(parts[2].data(), parts[2].data() + parts[2].size(), element.count);
        if (parsed.ec != std::errc() || parsed.ptr != parts[2].data() + parts[2].size())
            return wrong(fmt::format("'{}' is not a number of elements", parts[2]));
        header_.elements.push_back(std::move(element));
        return std::nullopt;
    }

    std::optional<Error> readProperty(const std::vector<std::string_view>& parts) {
        const bool list = parts.size() > 1 && parts[1] == "list";
        if (header_.elements.empty()) return wrong("a property before the first element");
        if (parts.size() != (list ? 5u : 3u)) return wrong("a property line is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
        const auto type = typeNamed(parts[list ? 3 : 1]);
        const auto count = list ? typeNamed(parts[2]) : std::nullopt;
        if (!type || (list && !count)) return wrong("unknown PLY property type");
        if (count && !isInteger(*count)) return wrong("a list's length must be of an integer type");
        header_.elements.back().properties.push_back({.name = std::string(parts.back()), .type = *type, .listCount = count});
        return std::nullopt;
    }

    /// The fewest bytes that one row can take: in text one character and a separator per value.
    [[nodiscard]] std::size_t leastRowBytes(const PlyElement& element) const {
        std::size_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes += header_.format == PlyFormat::Ascii ? 2 : byteSize(property.listCount.value_or(property.type));
        return bytes;
    }

    std::optional<Error> checkCounts() const {
        std::uint64_t left = source_.bytes.size() - header_.size + 1; // the last separator of a text may be missing
        for (const PlyElement& element : header_.elements) {
            const std::size_t least = leastRowBytes(element);
            if (least == 0) continue;
            if (element.count > left / least)
                return overclaimed(source_.atLine(element.line), fmt::format("{} elements '{}' cannot be held by the {} bytes of data",
                                                                             element.count, element.name, left - 1));
            left -= element.count * least;
        }
        return std::nullopt;
    }

    [[nodiscard]] Error wrong(const std::string& text) const { return malformed(source_.atLine(header_.lines), text); }

    const Source& source_;
    PlyHeader header_;
    bool formatKnown_ = false;
};

} // namespace

PlyValues::PlyValues(const Source& source, const PlyHeader& header)
    : source_(source), format_(header.format), offset_(header.size), line_(header.lines + 1) {
    if (format_ != PlyFormat::Ascii) return;
    double items = 0;
    for (const PlyElement& element : header.elements)
        items += static_cast<double>(element.count);
    const std::string_view data = trim(source.bytes.substr(std::min(offset_, source.bytes.size())));
    const double lines = static_cast<double>(std::ranges::count(data, '\n')) + 1;
    rowsAreLines_ = lines >= items;
    linesAreRows_ = lines == items;
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

bool PlyValues::skipRestOfLine() {
    if (!linesAreRows_ || error_) return false;
    const std::size_t end = std::min(source_.bytes.find('\n', offset_), source_.bytes.size());
    const bool more = !trim(source_.bytes.substr(offset_, end - offset_)).empty();
    if (more) offset_ = end;
    return more;
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

std::size_t byteSize(PlyType type) {
    constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (std::ranges::find(names, std::string_view(properties[i].name)) != names.end()) return i;
    return std::nullopt;
}

Result<PlyHeader> readPlyHeader(const Source& source) {
    return HeaderReader(source).read();
}

} // namespace tegument::meshfile
