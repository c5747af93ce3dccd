// Ten million triangles in four GiB of address space, and nothing that grows faster than the mesh.
#include "host/support/sanitized.h"
#include "meshprep/prepare/prepare.h"
#include "meshprep/prepare/shapes.h"
#include "meshprep/write/write_mesh.h"

#include <gtest/gtest.h>

#include <ctime>
#include <sys/resource.h>
#include <unistd.h>

using namespace tegument;
using namespace tegument::prep;
namespace fs = std::filesystem;

namespace {

class LargeMesh : public testing::Test {
protected:
    void TearDown() override { fs::remove(path_); }

    void make(int detail) { ASSERT_TRUE(writePly(path_, makeShape(Shape::Terrain, detail))); }

    /// Of the processor, by all threads: the wall's would be that of what else runs here.
    [[nodiscard]] double secondsFor(int detail) {
        make(detail);
        const std::clock_t start = std::clock();
        const auto result = prepareMesh(path_, {.levels = 1});
        EXPECT_TRUE(result) << format(result.error());
        return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }

    fs::path path_ = fs::temp_directory_path() / ("tegument-large-" + std::to_string(::getpid()) + ".ply");
};

} // namespace

TEST_F(LargeMesh, time_grows_with_the_triangles) {
    const double small = secondsFor(354);  // 250,632 triangles
    const double large = secondsFor(1118); // 2,499,848
    EXPECT_LT(large, 16 * small) << "ten times the triangles; caches account for the rest";
}

TEST_F(LargeMesh, of_ten_million_triangles_is_prepared_within_four_gib) {
    make(2237);
    if (kMemoryCanBeLimited) {
        constexpr rlim_t kLimit = rlim_t{4} << 30;
        const rlimit limit{.rlim_cur = kLimit, .rlim_max = kLimit};
        ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
    }
    const auto result = prepareMesh(path_, {});
    ASSERT_TRUE(result) << format(result.error());
    EXPECT_EQ(result->report.output.faces, 10008338u);
    EXPECT_EQ(result->report.output.vertices, 2238u * 2238);
    EXPECT_EQ(result->report.levels.size(), 3u);
}
