#include "host/effect/states.h"
#include "host/effect/vocabularies.h"

#include <cstdint>

namespace tegument {

namespace {

using Entry = StateEntry<SamplerState>;

template <auto Member>
void setFilter(SamplerState& state, int, Numbers v) {
    state.*Member = static_cast<Filter>(v[0] < 1 ? 0 : v[0] - 1);
}

void setMipFilter(SamplerState& state, int, Numbers v) {
    state.mipmapping = v[0] != 0;
    state.mipFilter = v[0] > 1 ? Filter::Linear : Filter::Point;
}

/// See kFilter10 for the bits. A comparison filter without ComparisonFunc compares with Direct3D's default, never.
void setCombinedFilter(SamplerState& state, int, Numbers v) {
    const auto bits = static_cast<unsigned>(v[0]);
    const bool anisotropic = (bits & 0x40u) != 0;
    const auto filter = [&](unsigned bit) {
        return anisotropic ? Filter::Anisotropic : (bits & bit) != 0 ? Filter::Linear : Filter::Point;
    };
    state.minFilter = filter(0x10);
    state.magFilter = filter(0x04);
    state.mipFilter = (bits & 0x01u) != 0 ? Filter::Linear : Filter::Point;
    state.mipmapping = true;
    if ((bits & 0x80u) != 0 && !state.compare) state.compare = CompareOp::Never;
}

template <auto Member>
void setAddress(SamplerState& state, int, Numbers v) {
    state.*Member = static_cast<Address>(v[0] - 1);
}

template <auto Member>
void setFloat(SamplerState& state, int, Numbers v) {
    state.*Member = static_cast<float>(v[0]);
}

constexpr Vocabulary kNumber{};

constexpr std::array<Entry, 17> kEntries{{
    {"MinFilter", kFilter9, setFilter<&SamplerState::minFilter>},
    {"MagFilter", kFilter9, setFilter<&SamplerState::magFilter>},
    {"MipFilter", kFilter9, setMipFilter},
    {"Filter", kFilter10, setCombinedFilter},
    {"AddressU", kAddress, setAddress<&SamplerState::addressU>},
    {"AddressV", kAddress, setAddress<&SamplerState::addressV>},
    {"AddressW", kAddress, setAddress<&SamplerState::addressW>},
    {"MipMapLodBias", kNumber, setFloat<&SamplerState::mipLodBias>},
    {"MipLODBias", kNumber, setFloat<&SamplerState::mipLodBias>},
    {"MaxMipLevel", kNumber, setFloat<&SamplerState::minLod>},
    {"MaxAnisotropy", kNumber,
     [](SamplerState& s, int, Numbers v) { s.maxAnisotropy = v[0] < 1    ? 1
                                                             : v[0] > 16 ? 16
                                                                         : static_cast<int>(v[0]); }},
    {"MinLOD", kNumber, setFloat<&SamplerState::minLod>},
    {"MaxLOD", kNumber, setFloat<&SamplerState::maxLod>},
    {"ComparisonFunc", kCompare, [](SamplerState& s, int, Numbers v) { s.compare = static_cast<CompareOp>(v[0] - 1); }},
    {"BorderColor", kNumber, [](SamplerState& s, int, Numbers v) { s.borderColor = colorValue(v); }},
    {"ElementIndex", kNumber, nullptr, 0, "a texture has one element"},
    {"DMapOffset", kNumber, nullptr, 0, "there is no displacement mapping"},
}};

} // namespace

std::array<float, 4> colorValue(Numbers v) {
    std::array<float, 4> color{0, 0, 0, 1};
    if (v.size() == 1) {
        const auto word = static_cast<std::uint32_t>(static_cast<std::int64_t>(v[0]));
        for (const std::size_t i : {0u, 1u, 2u, 3u})
            color[i] = static_cast<float>((word >> (i == 3 ? 24 : 16 - 8 * i)) & 255u) / 255.0f;
        return color;
    }
    for (std::size_t i = 0; i < v.size() && i < 4; ++i)
        color[i] = static_cast<float>(v[i]);
    return color;
}

std::span<const StateEntry<SamplerState>> samplerStateEntries() {
    return kEntries;
}

SamplerState direct3D9SamplerDefaults() {
    return {.minFilter = Filter::Point, .magFilter = Filter::Point, .mipFilter = Filter::Point, .mipmapping = false};
}

SamplerState direct3D10SamplerDefaults() {
    return {.addressU = Address::Clamp, .addressV = Address::Clamp, .addressW = Address::Clamp};
}

} // namespace tegument
