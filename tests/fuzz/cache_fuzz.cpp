// Any content behind the right magic and checksum, as only our own faults could write it: a shader or a miss; what is read is written to
// the same bytes.

#include "host/spirv/cache.h"
#include "host/support/file.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string content(reinterpret_cast<const char*>(data), size);
    if (tegument::decodeShader(content)) std::abort(); // without the checksum
    static const std::string kMagic = tegument::encodeShader({}).substr(0, 8);
    const std::string file = kMagic + tegument::contentHash(content) + content;
    const auto cached = tegument::decodeShader(file);
    if (cached && tegument::encodeShader(*cached) != file) std::abort();
    return 0;
}
