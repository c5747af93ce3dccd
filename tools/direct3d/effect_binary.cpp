#include "tools/direct3d/effect_binary.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <tuple>

namespace tegument {

namespace {

constexpr std::uint32_t kFx2 = 0xfeff0901;
constexpr std::size_t kFx2Base = 8; // of an fx_2_0 effect: offsets count from here
constexpr std::uint32_t kFx4 = 0xfeff1001;
constexpr std::uint32_t kFx5 = 0xfeff2001;

/// Little-endian words; reading past the end gives 0 and is remembered.
class WordReader {
public:
    WordReader(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

    std::uint32_t next() {
        std::uint32_t word = 0;
        good_ = good_ && at_ <= bytes_.size() && bytes_.size() - at_ >= sizeof word;
        if (good_) std::memcpy(&word, bytes_.data() + at_, sizeof word);
        at_ += sizeof word;
        return word;
    }
    void skip(std::size_t words) { at_ += words * sizeof(std::uint32_t); }
    /// A block with its length before it, padded to whole words.
    std::string_view block() {
        const std::size_t length = next();
        good_ = good_ && length <= bytes_.size() - std::min(at_, bytes_.size());
        if (!good_) return {};
        const std::string_view found = bytes_.substr(at_, length);
        at_ += (length + 3) / 4 * 4;
        return found;
    }
    [[nodiscard]] bool good() const { return good_; }

private:
    std::string_view bytes_;
    std::size_t at_;
    bool good_ = true;
};

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    return WordReader(bytes, at).next();
}

struct Fx2Counts {
    std::uint32_t techniques = 0;
    std::uint32_t passes = 0;
};

/// fx_2_0: tag, offset of the tables from byte 8; there: counts, then parameters (type, value, flags, annotations), then techniques
/// (name, annotations, passes), passes (name, annotations, states of four words). An annotation is two words. Leaves the reader behind.
Fx2Counts walkFx2(WordReader& reader) {
    Fx2Counts counts;
    const std::uint32_t parameters = reader.next();
    counts.techniques = reader.next();
    reader.skip(2); // unknown, number of objects
    for (std::uint32_t i = 0; i < parameters && reader.good(); ++i) {
        reader.skip(3);
        reader.skip(2 * std::size_t{reader.next()});
    }
    for (std::uint32_t i = 0; i < counts.techniques && reader.good(); ++i) {
        reader.skip(1);
        const std::size_t annotations = reader.next();
        const std::uint32_t passes = reader.next();
        reader.skip(2 * annotations);
        for (std::uint32_t pass = 0; pass < passes && reader.good(); ++pass) {
            reader.skip(1);
            const std::size_t passAnnotations = reader.next();
            const std::size_t states = reader.next();
            reader.skip(2 * passAnnotations + 4 * states);
        }
        counts.passes += passes;
    }
    return counts;
}

WordReader fx2Tables(std::string_view bytes) {
    return {bytes, kFx2Base + std::size_t{wordAt(bytes, 4)}};
}

std::optional<EffectContent> readFx2(std::string_view bytes) {
    WordReader reader = fx2Tables(bytes);
    const Fx2Counts counts = walkFx2(reader);
    if (!reader.good()) return {};
    return EffectContent{.techniques = static_cast<int>(counts.techniques), .passes = static_cast<int>(counts.passes)};
}

/// Vertex shaders begin with 0xfffe and their version, pixel shaders with 0xffff.
bool isShader(std::string_view object) {
    const std::uint32_t tag = wordAt(object, 0) >> 16U;
    return object.size() >= 8 && (tag == 0xfffeU || tag == 0xffffU);
}

/// A length with the zero byte, then the text.
std::string fx2String(std::string_view bytes, std::uint32_t offset) {
    if (offset == 0) return {};
    WordReader reader(bytes, kFx2Base + offset);
    const std::string_view text = reader.block();
    return std::string(text.substr(0, text.find('\0')));
}

// Values of d3dx9shader.h.
constexpr std::uint32_t kTypeBool = 1; // 2 is int
constexpr std::uint32_t kTypeFloat = 3;
constexpr std::uint32_t kClassLast = 3; // matrices; objects and structs follow

double fx2Number(std::uint32_t word, std::uint32_t type) {
    if (type == kTypeFloat) return std::bit_cast<float>(word);
    return type == kTypeBool ? static_cast<double>(word != 0) : static_cast<double>(std::bit_cast<std::int32_t>(word));
}

/// A type: base, class, name, semantic, elements, then rows and columns (of a vector the other way round).
std::optional<EffectParameter> readFx2Parameter(std::string_view bytes, std::uint32_t type, std::uint32_t value) {
    WordReader reader(bytes, kFx2Base + type);
    const std::uint32_t base = reader.next();
    const std::uint32_t kind = reader.next();
    if (base < kTypeBool || base > kTypeFloat || kind > kClassLast) return {};
    EffectParameter parameter{.name = fx2String(bytes, reader.next()), .semantic = fx2String(bytes, reader.next())};
    const std::uint64_t elements = std::max(reader.next(), 1U);
    const std::uint64_t first = reader.next();
    const std::uint64_t second = reader.next();
    const std::uint64_t count = elements * first * second;
    if (!reader.good() || count > bytes.size() / 4) return {};
    WordReader numbers(bytes, kFx2Base + value);
    for (std::uint64_t i = 0; i < count; ++i)
        parameter.numbers.push_back(fx2Number(numbers.next(), base));
    return parameter;
}

/// fx_4_0 and fx_5_0: word 7 counts the techniques, word 17 the shaders.
std::optional<EffectContent> readFx4(std::string_view bytes) {
    constexpr std::size_t kTechniques = 28;
    constexpr std::size_t kShaders = 68;
    if (bytes.size() < kShaders + 4) return {};
    return EffectContent{.techniques = static_cast<int>(wordAt(bytes, kTechniques)), .shaders = static_cast<int>(wordAt(bytes, kShaders))};
}

/// The content of a DXBC container's FX10 chunk.
std::string_view fxChunk(std::string_view bytes) {
    constexpr std::size_t kCount = 28;
    const std::uint32_t count = wordAt(bytes, kCount);
    for (std::uint32_t i = 0; i < count && kCount + std::size_t{4} * i < bytes.size(); ++i) {
        const std::size_t at = wordAt(bytes, kCount + 4 + 4 * std::size_t{i});
        if (at + 8 <= bytes.size() && bytes.substr(at, 4) == "FX10") return bytes.substr(at + 8, wordAt(bytes, at + 4));
    }
    return {};
}

} // namespace

bool isPixelShader(const EffectShader& shader) {
    return wordAt(shader.bytes, 0) >> 16U == 0xffffU;
}

std::vector<EffectParameter> fx2Parameters(std::string_view bytes) {
    std::vector<EffectParameter> parameters;
    if (wordAt(bytes, 0) != kFx2) return parameters;
    WordReader reader = fx2Tables(bytes);
    const std::uint32_t count = reader.next();
    reader.skip(3); // techniques, unknown, objects
    for (std::uint32_t i = 0; i < count && reader.good(); ++i) {
        const std::uint32_t type = reader.next();
        const std::uint32_t value = reader.next();
        reader.skip(1);
        reader.skip(2 * std::size_t{reader.next()});
        if (auto parameter = readFx2Parameter(bytes, type, value)) parameters.push_back(std::move(*parameter));
    }
    return parameters;
}

/// Behind the techniques: number of values and of resources; values (object, block); resources (technique, pass, element, state, kind,
/// block).
std::vector<EffectShader> fx2Shaders(std::string_view bytes) {
    WordReader reader = fx2Tables(bytes);
    std::vector<EffectShader> shaders;
    if (wordAt(bytes, 0) != kFx2) return shaders;
    walkFx2(reader);
    const std::uint32_t values = reader.next();
    const std::uint32_t resources = reader.next();
    for (std::uint32_t i = 0; i < values && reader.good(); ++i) {
        reader.skip(1);
        reader.block();
    }
    for (std::uint32_t i = 0; i < resources && reader.good(); ++i) {
        const auto technique = static_cast<int>(reader.next());
        const auto pass = static_cast<int>(reader.next());
        reader.skip(3);
        const std::string_view object = reader.block();
        if (technique >= 0 && isShader(object)) shaders.push_back({technique, pass, object});
    }
    std::ranges::sort(shaders, {}, [](const EffectShader& s) { return std::tuple(s.technique, s.pass, isPixelShader(s)); });
    return shaders;
}

std::optional<EffectContent> readEffectBinary(std::string_view bytes) {
    if (bytes.starts_with("DXBC")) bytes = fxChunk(bytes);
    switch (wordAt(bytes, 0)) {
    case kFx2: return readFx2(bytes);
    case kFx4:
    case kFx5: return readFx4(bytes);
    default: return {};
    }
}

} // namespace tegument
