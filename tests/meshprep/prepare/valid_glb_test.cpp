// Everything that preparation writes, judged by others: Khronos's validator, and gltfpack, whose reader is cgltf.
#include "host/support/file.h"
#include "meshprep/prepare/prepare.h"
#include "meshprep/write/write_mesh.h"
#include "tests/meshprep/prepare/hard_files.h"
#include "tests/meshprep/prepare/meshes.h"

#include <fmt/format.h>

#include <cstdlib>

using namespace tegument;
using namespace tegument::testing_prep;

namespace {

class ValidGlb : public PrepFolder {
protected:
    static std::filesystem::path tools() {
        const char* own = std::getenv("TEGUMENT_GLTF_TOOLS");
        return own ? std::filesystem::path(own) : cacheFolder() / "tools/gltf";
    }

    void judge(const prep::PrepOptions& options) {
        if (!std::filesystem::exists(tools() / "node_modules/gltf-validator") || std::system("node --version > /dev/null 2>&1") != 0)
            GTEST_SKIP() << "no gltf-validator: ./bootstrap test fetches it where npm is";
        writeAll(options);
        EXPECT_GT(written_, 50u);
        const auto log = folder_ / "log.txt";
        const std::string command = fmt::format("node tests/meshprep/prepare/judge_glb.js '{}' '{}' > '{}' 2>&1", tools().string(),
                                                (folder_ / "out").string(), log.string());
        const int result = std::system(command.c_str());
        const auto said = readFile(log);
        EXPECT_EQ(result, 0) << (said ? *said : "no log");
    }

private:
    void writeAll(const prep::PrepOptions& options) {
        std::filesystem::create_directories(folder_ / "out");
        for (const HardFile& file : hardFiles()) {
            if (file.expected.error != 0 || file.bytes.size() > kLarge) continue;
            EXPECT_TRUE(writeFile(folder_ / file.name, file.bytes));
            const auto prepared = prep::prepareMesh(folder_ / file.name, options);
            if (!prepared) continue; // what some options refuse: half floats of 1e20
            const std::string name = fmt::format("{}_{}.glb", file.number, std::filesystem::path(file.name).stem().string());
            EXPECT_TRUE(writeGlb(folder_ / "out" / name, prepared->mesh, prepared->glb)) << name;
            ++written_;
        }
    }

    static constexpr std::size_t kLarge = 300'000; // of those like it one is enough, and takes time enough
    std::size_t written_ = 0;
};

prep::PrepOptions lenient() {
    prep::PrepOptions options;
    options.read.dropNotFinite = true;
    return options;
}

} // namespace

TEST_F(ValidGlb, of_every_hard_file_passes_the_validator_and_is_read_by_another_program) {
    judge(lenient());
}

TEST_F(ValidGlb, with_small_vertices_passes_too) {
    prep::PrepOptions small = lenient();
    small.precision = prep::VertexPrecision::Unorm16;
    small.overdraw = true;
    judge(small);
}

TEST_F(ValidGlb, in_pieces_with_levels_passes_too) {
    prep::PrepOptions chunked = lenient();
    chunked.chunk16 = true;
    chunked.levels = 2;
    chunked.centre = prep::CentreMode::None;
    judge(chunked);
}
