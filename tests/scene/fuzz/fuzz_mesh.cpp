// loadMesh on any bytes as a file of FUZZ_FORMAT: a mesh or one error, never a crash, a hang or memory beyond the file's means.
#include "tests/scene/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tegument::fuzz::loadBytes(data, size, FUZZ_FORMAT);
    return 0;
}
