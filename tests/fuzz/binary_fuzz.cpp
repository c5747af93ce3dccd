// Any bytes are what Microsoft's compiler wrote: an effect with its shaders inside the bytes, or nothing.

#include "tools/direct3d/effect_binary.h"
#include "tools/direct3d/sm3.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    (void)tegument::readEffectBinary(bytes);
    (void)tegument::fx2Parameters(bytes);
    for (const tegument::EffectShader& shader : tegument::fx2Shaders(bytes)) {
        if (shader.bytes.data() < bytes.data() || shader.bytes.data() + shader.bytes.size() > bytes.data() + bytes.size()) std::abort();
        (void)tegument::isPixelShader(shader);
    }
    return 0;
}
