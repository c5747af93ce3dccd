// Flattened effects, compiled by Microsoft: bit for bit what the originals give, with every define still selectable.

#include "host/check/check.h"
#include "host/emit/flatten.h"
#include "host/support/file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

TEST(Flattened, effects_compile_to_the_same_bytes_in_every_setting_as_direct3d_9_10_and_11) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const fs::path folder = fs::temp_directory_path() / ("tegument-flatten-" + std::to_string(::getpid()));
    std::vector<fs::path> originals;
    std::vector<fs::path> flat;
    for (const auto& entry : fs::directory_iterator("effects")) {
        if (entry.path().extension() != ".fx") continue;
        const auto text =
            flattenEffect(entry.path(), {.defines = {}, .includeFolders = {}, .read = [](const fs::path& p) { return readFile(p); }});
        ASSERT_TRUE(text) << format(text.error());
        originals.push_back(entry.path());
        flat.push_back(folder / entry.path().filename());
        ASSERT_TRUE(writeFile(flat.back(), *text));
    }
    std::vector<fs::path> all = originals;
    all.insert(all.end(), flat.begin(), flat.end());
    const CheckReport report =
        checkEffects(all, {Target::Fx2, Target::Fx4, Target::Fx5}, {.variants = settingVariants(), .includeFolders = {}});
    fs::remove_all(folder);
    const std::size_t count = originals.size();
    ASSERT_EQ(report.files.size(), settingVariants().size() * 2 * count);
    for (std::size_t i = 0; i < report.files.size(); ++i) {
        const FileReport& original = report.files[i];
        if (i % (2 * count) >= count) continue;
        const FileReport& single = report.files[i + count];
        EXPECT_EQ(original.binaries.size(), 3U) << original.file;
        EXPECT_EQ(original.binaries, single.binaries) << original.file << " " << original.variant;
    }
}

} // namespace
} // namespace tegument::test
