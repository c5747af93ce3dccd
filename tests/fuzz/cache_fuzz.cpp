// Any content behind a right checksum, as only our own faults could write it: a shader or a miss; what is read is written to the same
// bytes.

#include "host/spirv/cache.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string content(reinterpret_cast<const char*>(data), size);
    const auto cached = tegument::decodeShader(content);
    if (cached && tegument::encodeShader(*cached) != content) std::abort();
    return 0;
}
