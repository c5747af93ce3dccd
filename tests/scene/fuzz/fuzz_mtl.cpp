// loadMesh on an OBJ file of one triangle whose library of materials holds any bytes.
#include "tests/scene/fuzz/fuzz_mesh.h"

#include <filesystem>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string kFolder = "/tmp/tegument-mtl-fuzz-" + std::to_string(::getpid()); // small: names are looked for in any case
    static const bool kMade = std::filesystem::create_directory(kFolder);
    // A small part of the square of coordinates: how the square is covered is found out by its texels, and is no matter here.
    static const std::string kObj = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0.01 0\nvt 0 0.01\nf 1/1 2/2 3/3\n";
    if (kMade) tegument::fuzz::writeAnew(kFolder + "/a.obj", reinterpret_cast<const std::uint8_t*>(kObj.data()), kObj.size());
    tegument::fuzz::writeAnew(kFolder + "/a.mtl", data, size);
    tegument::fuzz::check(kFolder + "/a.obj");
    return 0;
}
