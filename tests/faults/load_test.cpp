// Picture after picture in one process: after the first rounds its memory, its open files and the device's objects stay as many as they
// are. TEGUMENT_RENDERS says how many pictures (default 300; ctest -L slow draws 10,000).

#include "host/run/run.h"
#include "host/support/sanitized.h"
#include "meshprep/adopt/adopt.h"

#include <gtest/gtest.h>

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kUsual = 300;
constexpr int kSide = 32;
constexpr double kMostGrown = 24; // MiB: what the allocator of the driver's compiler keeps is not the same after each picture

struct Held {
    double mebibytes = 0;
    std::ptrdiff_t files = 0;
    std::int64_t objects = 0;
};

std::ostream& operator<<(std::ostream& out, const Held& held) {
    return out << held.mebibytes << " MiB, " << held.files << " open files, " << held.objects << " objects of the device";
}

std::int64_t objectsOfTheDevice() {
    void* layer = dlopen(TEGUMENT_FAULT_LAYER_FILE, RTLD_NOLOAD | RTLD_NOW);
    const auto count = layer != nullptr ? reinterpret_cast<std::int64_t (*)()>(dlsym(layer, "tegumentLiveObjects")) : nullptr;
    EXPECT_NE(count, nullptr) << "the layer is not loaded";
    return count != nullptr ? count() : -1;
}

Held held() {
    std::size_t pages = 0;
    std::size_t resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    const auto files = std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator{});
    return {static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20), files, objectsOfTheDevice()};
}

/// Of several kinds: one pass, targets of its own, a compute shader, foreign ones.
std::vector<Effect> effects() {
    std::vector<Effect> all;
    for (const char* file : {"effects/Beckmann.fx", "tests/adopt/effects/composer_glow.fx", "tests/adopt/effects/vertex_only.fx"}) {
        auto effect = loadEffect(file, {.lenient = true});
        EXPECT_TRUE(effect) << (effect ? "" : format(effect.error()));
        if (effect) all.push_back(adopted(std::move(*effect), {.width = kSide, .height = kSide}).effect);
    }
    return all;
}

Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{-50, -50, 0}, {50, -50, 0}, {0, 50, 0}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.uvs = {{0, 0}, {1, 0}, {0.5F, 1}};
    mesh.tangents = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
    mesh.indices = {0, 1, 2};
    computeBounds(mesh);
    return mesh;
}

TEST(Load, memory_files_and_objects_of_the_device_stay_as_many_as_they_are) {
    const char* asked = std::getenv("TEGUMENT_RENDERS");
    const int renders = asked != nullptr ? std::atoi(asked) : kUsual;
    ASSERT_GE(renders, kUsual);
    setenv("VK_LAYER_PATH", TEGUMENT_FAULT_LAYER, 1);
    setenv("VK_INSTANCE_LAYERS", "VK_LAYER_TEGUMENT_fault", 1);
    auto device = gpu::Device::create({.validation = false});
    ASSERT_TRUE(device) << format(device.error());
    const std::vector<Effect> all = effects();
    const Mesh mesh = triangle();
    RunOptions options;
    options.width = kSide;
    options.height = kSide;
    Held begun;
    for (int i = 0; i < renders; ++i) {
        const auto drawn = runEffect(*device, all[static_cast<std::size_t>(i) % all.size()], &mesh, Workspace{}, options);
        ASSERT_TRUE(drawn) << i << ": " << format(drawn.error());
        if (i == kUsual / 3) {
            begun = held();
            std::cout << "after " << i << " pictures: " << begun << "\n";
        }
    }
    const Held ended = held();
    std::cout << "after " << renders << " pictures: " << ended << "\n";
    EXPECT_GT(begun.objects, 0);
    EXPECT_EQ(ended.objects, begun.objects);
    EXPECT_EQ(ended.files, begun.files);
    EXPECT_TRUE(!kMemoryCanBeMeasured || ended.mebibytes < begun.mebibytes + kMostGrown) << ended.mebibytes << " MiB, " << begun.mebibytes;
}

} // namespace
} // namespace tegument::test
