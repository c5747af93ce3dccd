// Every technique of every effect, found in the files: the same scene put otherwise gives the same picture (docs/invariance.md).

#include "host/effect/model.h"
#include "host/invariance/invariance.h"
#include "host/support/file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace tegument;

namespace {

namespace fs = std::filesystem;

/// Without validation layers, which would double the time: tests/run and tests/app have the same passes under them.
gpu::Device* device(std::string& reason) {
    static Result<gpu::Device> made = gpu::Device::create();
    if (made) return &*made;
    reason = format(made.error());
    return nullptr;
}

class Invariance : public testing::Test {
protected:
    void SetUp() override {
        std::string reason;
        device_ = device(reason);
        if (!device_) GTEST_SKIP() << reason;
    }

    [[nodiscard]] std::vector<InvarianceCell> measure(const fs::path& effect, InvarianceOptions options) {
        options.compiler = defaultCompiler();
        auto cells = measureInvariance(*device_, effect, options);
        EXPECT_TRUE(cells) << format(cells.error());
        return cells ? *std::move(cells) : std::vector<InvarianceCell>();
    }

    gpu::Device* device_ = nullptr;
};

class EveryEffect : public Invariance, public testing::WithParamInterface<fs::path> {};

std::string message(const InvarianceCell& cell) {
    return invarianceMarkdown({cell});
}

std::string testName(const testing::TestParamInfo<fs::path>& each) {
    return each.param.stem().string();
}

} // namespace

INSTANTIATE_TEST_SUITE_P(Effects, EveryEffect, testing::ValuesIn(effectFiles("effects")), testName);

TEST_P(EveryEffect, looks_the_same_however_its_scene_is_put) {
    const auto effect = loadEffect(GetParam());
    ASSERT_TRUE(effect) << format(effect.error());
    ASSERT_FALSE(effect->techniques.empty());
    const auto cells = measure(GetParam(), {});
    for (const InvarianceCell& cell : cells)
        EXPECT_TRUE(cell.pass()) << message(cell);
    for (const Technique& technique : effect->techniques)
        for (const std::string& name : invarianceCases())
            EXPECT_EQ(
                std::ranges::count_if(cells, [&](const InvarianceCell& c) { return c.technique == technique.name && c.name == name; }), 1)
                << technique.name << ", " << name;
}

TEST_F(Invariance, no_effect_of_the_library_is_left_out) {
    std::set<std::string> found;
    for (const fs::path& file : effectFiles("effects"))
        found.insert(file.generic_string());
    std::size_t there = 0;
    for (const auto& entry : fs::recursive_directory_iterator("effects"))
        if (entry.path().extension() == ".fx") {
            EXPECT_TRUE(found.contains(entry.path().generic_string())) << entry.path();
            ++there;
        }
    EXPECT_EQ(found.size(), there);
}

TEST(InvarianceExceptions, are_at_most_three_each_of_a_technique_and_a_case_with_its_cause) {
    const std::vector<std::string> cases = invarianceCases();
    EXPECT_LE(invarianceExceptions().size(), 3U);
    for (const InvarianceException& exception : invarianceExceptions()) {
        EXPECT_NE(std::ranges::find(cases, exception.name), cases.end()) << exception.name;
        EXPECT_GT(exception.cause.size(), 20U) << exception.technique;
    }
}
