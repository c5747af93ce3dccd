// Any bytes behind "DDS " are a texture or one error; what is read is written and read again to the same values.

#include "host/image/dds.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

/// NaN keeps its bits.
bool same(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void requireRoundTrip(const tegument::DdsTexture& texture, tegument::DdsHeader header) {
    const std::string bytes = tegument::encodeDds(texture, header);
    const auto again = tegument::decodeDds(std::as_bytes(std::span(bytes)), "again");
    require(static_cast<bool>(again));
    require(again->faces == texture.faces && again->mips == texture.mips);
    for (std::size_t i = 0; i < texture.images.size(); ++i)
        require(same(again->images[i].pixels, texture.images[i].pixels));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes = "DDS ";
    bytes.append(reinterpret_cast<const char*>(data), size);
    const auto texture = tegument::decodeDds(std::as_bytes(std::span(bytes)), "input");
    if (!texture) {
        require(texture.error().diagnostics.size() == 1);
        const tegument::Diagnostic& diagnostic = texture.error().diagnostics.front();
        require(diagnostic.code >= 5201 && diagnostic.code <= 5205 && diagnostic.at.byte && !diagnostic.text.empty());
        return 0;
    }
    requireRoundTrip(*texture, tegument::DdsHeader::Dx10);
    requireRoundTrip(*texture, tegument::DdsHeader::Direct3D9);
    return 0;
}
