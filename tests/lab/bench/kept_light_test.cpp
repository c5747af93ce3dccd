// Light that is computed once: by parts, by whoever comes first, and again where a file is missing or torn.

#include "host/support/file.h"
#include "lab/bench/kept_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <unistd.h>

namespace tegument::bench {
namespace {

namespace fs = std::filesystem;

class KeptLights : public testing::Test {
protected:
    KeptLights() { fs::remove_all(folder_); }
    ~KeptLights() override {
        std::error_code code;
        fs::remove_all(folder_, code);
    }

    /// Light that tells which point it is of; counts the points that were computed.
    std::vector<glm::dvec3> light(std::size_t count, Part part = {}, const fs::path& folder = {}) {
        const auto all = keptLight({.folder = folder.empty() ? folder_ : folder, .key = "key", .part = part}, count,
                                   [&](std::size_t first, std::size_t last) {
                                       std::vector<glm::dvec3> some;
                                       for (std::size_t i = first; i < last; ++i)
                                           some.emplace_back(static_cast<double>(i), 1.0 / static_cast<double>(i + 1), -0.0);
                                       computed_ += some.size();
                                       return some;
                                   });
        EXPECT_TRUE(all) << format(all.error());
        return all ? *all : std::vector<glm::dvec3>{};
    }

    void expectWhole(const std::vector<glm::dvec3>& all, std::size_t count) {
        ASSERT_EQ(all.size(), count);
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(all[i], glm::dvec3(static_cast<double>(i), 1.0 / static_cast<double>(i + 1), -0.0)) << i;
    }

    fs::path folder_ = fs::temp_directory_path() / ("tegument-kept-light-" + std::to_string(::getpid()));
    std::size_t computed_ = 0;
};

constexpr std::size_t kMany = 10 * kKeptTogether + 7;

TEST(Parts, count_from_one) {
    EXPECT_EQ(partOf("3/100")->index, 3U);
    for (const char* wrong : {"", "3", "0/4", "5/4", "-1/4", "1/0", "a/b", "1/4x", "1 / 4", "1//4"})
        EXPECT_EQ(partOf(wrong) ? 0 : partOf(wrong).error().diagnostics.at(0).code, 8101) << wrong;
}

TEST_F(KeptLights, are_computed_once) {
    expectWhole(light(kMany), kMany);
    EXPECT_EQ(computed_, kMany);
    expectWhole(light(kMany), kMany);
    EXPECT_EQ(computed_, kMany) << "bit for bit from the files";
}

TEST_F(KeptLights, of_parts_are_a_whole) {
    for (const std::size_t part : {3U, 1U, 2U}) {
        const std::size_t before = computed_;
        const auto some = light(kMany, {part, 3});
        EXPECT_EQ(std::isnan(some[kMany - 1].x), part != 2) << "the eleventh file is the second part's, which comes last";
        EXPECT_LE(computed_ - before, 4 * kKeptTogether);
    }
    EXPECT_EQ(computed_, kMany) << "each point in one part";
    expectWhole(light(kMany), kMany);
    EXPECT_EQ(computed_, kMany);
}

TEST_F(KeptLights, are_computed_again_where_a_file_is_torn) {
    light(kMany);
    fs::resize_file(folder_ / "key" / "00003.f64", 100);
    fs::remove(folder_ / "key" / "00010.f64");
    expectWhole(light(kMany), kMany);
    EXPECT_EQ(computed_, kMany + kKeptTogether + 7);
}

TEST_F(KeptLights, of_few_points_or_without_a_folder_are_not_kept) {
    light(kKeptFrom - 1);
    EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(KeptLights, that_cannot_be_written_are_an_error) {
    ASSERT_TRUE(writeFile(folder_ / "file", "x"));
    const auto all = keptLight({.folder = folder_ / "file", .key = "key", .part = {}}, kMany,
                               [](std::size_t first, std::size_t last) { return std::vector<glm::dvec3>(last - first); });
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().diagnostics.at(0).code, 5002);
}

} // namespace
} // namespace tegument::bench
