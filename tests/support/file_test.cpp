#include "host/support/file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <unistd.h>

using namespace tegument;
namespace fs = std::filesystem;

namespace {

class Files : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("tegument-files-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

} // namespace

TEST_F(Files, what_is_written_is_read_back_byte_for_byte) {
    const std::string bytes("a\0b\r\n\xff", 6);
    ASSERT_TRUE(writeFile(folder_ / "new" / "folder" / "x.bin", bytes));
    const auto read = readFile(folder_ / "new" / "folder" / "x.bin");
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, bytes);
}

TEST_F(Files, writing_leaves_no_temporary_behind) {
    ASSERT_TRUE(writeFile(folder_ / "x", "1"));
    ASSERT_TRUE(writeFile(folder_ / "x", "2"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Files, whether_one_can_be_written_is_known_beforehand_and_leaves_nothing) {
    EXPECT_TRUE(canWrite(folder_ / "x"));
    EXPECT_TRUE(canWrite(folder_ / "new" / "folder" / "x"));
    EXPECT_TRUE(fs::is_empty(folder_));
    ASSERT_TRUE(writeFile(folder_ / "file", "1"));
    for (const fs::path& path : {folder_, folder_ / "file" / "x", fs::path("/proc/nowhere/x")}) {
        const auto can = canWrite(path);
        ASSERT_FALSE(can) << path;
        EXPECT_EQ(can.error().diagnostics.front().code, 5002);
        EXPECT_FALSE(writeFile(path, "2")) << path << ": the two agree";
    }
    EXPECT_TRUE(canWrite(folder_ / "file")) << "it is replaced";
}

TEST_F(Files, a_failed_write_keeps_the_old_file) {
    fs::create_directories(folder_ / "target");
    EXPECT_FALSE(writeFile(folder_ / "target", "text")); // a folder is in the way
    EXPECT_TRUE(fs::is_directory(folder_ / "target"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Files, missing_and_folder_are_different_messages) {
    const auto missing = readFile(folder_ / "none");
    const auto folder = readFile(folder_);
    ASSERT_FALSE(missing);
    ASSERT_FALSE(folder);
    EXPECT_NE(format(missing.error()).find("No such file"), std::string::npos);
    EXPECT_NE(format(folder.error()).find("is a folder"), std::string::npos);
    EXPECT_EQ(missing.error().blame, Blame::Input);
}

TEST(ContentHash, differs_for_one_bit_and_is_the_same_for_the_same_bytes) {
    EXPECT_EQ(contentHash("abc"), contentHash("abc"));
    EXPECT_NE(contentHash("abc"), contentHash("abb"));
    EXPECT_EQ(contentHash("").size(), 32u);
}

TEST(CacheFolder, follows_the_three_variables_in_order) {
    const auto keep = [](const char* name) {
        return std::pair<const char*, std::string>(name, std::getenv(name) ? std::getenv(name) : "");
    };
    const std::pair<const char*, std::string> old[] = {keep("TEGUMENT_CACHE"), keep("XDG_CACHE_HOME"), keep("HOME")};
    setenv("HOME", "/h", 1);
    setenv("XDG_CACHE_HOME", "/x", 1);
    setenv("TEGUMENT_CACHE", "/t", 1);
    EXPECT_EQ(cacheFolder(), "/t");
    unsetenv("TEGUMENT_CACHE");
    EXPECT_EQ(cacheFolder(), "/x/tegument");
    unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(cacheFolder(), "/h/.cache/tegument");
    for (const auto& [name, value] : old)
        value.empty() ? unsetenv(name) : setenv(name, value.c_str(), 1);
}
