#include "host/compile/effect_binary.h"

#include <cstdint>
#include <cstring>

namespace tegument {

namespace {

constexpr std::uint32_t kFx2 = 0xfeff0901;
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
    [[nodiscard]] bool good() const { return good_; }

private:
    std::string_view bytes_;
    std::size_t at_;
    bool good_ = true;
};

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    return WordReader(bytes, at).next();
}

/// fx_2_0: tag, offset of the tables from byte 8; there: counts, then parameters (type, value, flags, annotations), then techniques
/// (name, annotations, passes), passes (name, annotations, states of four words). An annotation is two words.
std::optional<EffectContent> readFx2(std::string_view bytes) {
    WordReader reader(bytes, 8 + std::size_t{wordAt(bytes, 4)});
    const std::uint32_t parameters = reader.next();
    const std::uint32_t techniques = reader.next();
    reader.skip(2); // unknown, number of objects
    for (std::uint32_t i = 0; i < parameters && reader.good(); ++i) {
        reader.skip(3);
        reader.skip(2 * std::size_t{reader.next()});
    }
    std::uint32_t passes = 0;
    for (std::uint32_t i = 0; i < techniques && reader.good(); ++i) {
        reader.skip(1);
        const std::size_t annotations = reader.next();
        const std::uint32_t count = reader.next();
        reader.skip(2 * annotations);
        for (std::uint32_t pass = 0; pass < count && reader.good(); ++pass) {
            reader.skip(1);
            const std::size_t passAnnotations = reader.next();
            const std::size_t states = reader.next();
            reader.skip(2 * passAnnotations + 4 * states);
        }
        passes += count;
    }
    if (!reader.good()) return {};
    return EffectContent{.techniques = static_cast<int>(techniques), .passes = static_cast<int>(passes)};
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
