
#include "host/support/cache.h"
#include "host/support/file.h"
#include "host/support/result.h"
#include "host/support/temporary.h"
#include "host/support/text.h"

#include "tests/support/variable.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

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

class Temporaries : public testing::Test {
protected:
    void SetUp() override { ASSERT_TRUE(writeFile(file_, "before")); }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string content() const { return *readFile(file_); }
    const fs::path folder_ = fs::temp_directory_path() / ("tegument-temporaries-" + std::to_string(::getpid()));
    const fs::path file_ = folder_ / "x";
};

} // namespace

TEST_F(Files, what_is_kept_comes_back_and_a_file_cut_short_or_changed_anywhere_is_a_miss) {
    const test::Variable cache("TEGUMENT_CACHE", folder_.string());
    EXPECT_FALSE(loadCached("kind/name"));
    const std::vector<double> numbers = {1.5, -0.0};
    storeCached("kind/name", bytesOf(numbers));
    EXPECT_EQ(loadCachedList<double>("kind/name"), numbers);
    const std::string whole = *readFile(folder_ / "kind" / "name");
    for (std::size_t at = 0; at < whole.size(); ++at) {
        ASSERT_TRUE(writeFile(folder_ / "kind" / "name", whole.substr(0, at)));
        ASSERT_FALSE(loadCached("kind/name")) << at << " bytes";
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 16);
        ASSERT_TRUE(writeFile(folder_ / "kind" / "name", changed));
        ASSERT_FALSE(loadCached("kind/name")) << "byte " << at;
    }
}

TEST(CacheKeys, keep_maker_parts_and_their_order_apart) {
    const auto key = [](std::string_view maker, std::string_view a, std::string_view b) { return CacheKey(maker).add(a).add(b).text(); };
    EXPECT_EQ(key("links 3", "ab", "c"), key("links 3", "ab", "c"));
    for (const std::string& other : {key("links 4", "ab", "c"), key("links 3", "a", "bc"), key("links 3", "c", "ab")})
        EXPECT_NE(key("links 3", "ab", "c"), other);
    EXPECT_NE(CacheKey("").add(1).text(), CacheKey("").add(2).text());
}

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

TEST_F(Files, are_found_in_any_case_whichever_of_several_folders_they_are_in) {
    for (const char* name : {"maps/fur.dds", "Maps/Brick.TGA", "MAPS/Brick.tga", "MAPS/x/Y"})
        ASSERT_TRUE(writeFile(folder_ / name, "1"));
    const auto found = [&](const char* name) {
        return findInAnyCase(folder_, name).value_or(fs::path()).lexically_relative(folder_).string();
    };
    EXPECT_EQ(found("maps\\brick.tga"), "MAPS/Brick.tga") << "not only in the folder that is spelt so; the first in order";
    EXPECT_EQ(found("Maps/Brick.TGA"), "Maps/Brick.TGA") << "as it is written before all";
    EXPECT_EQ(found("maps/../Maps/X/y"), "MAPS/x/Y");
    EXPECT_FALSE(findInAnyCase(folder_, "maps")) << "a folder";
    EXPECT_FALSE(findInAnyCase(folder_, "maps/none"));
}

TEST_F(Files, of_links_that_lead_back_are_looked_for_and_given_up) {
    for (const char* name : {"x", "X"})
        fs::create_directory_symlink(".", folder_ / name);
    std::string way;
    for (int i = 0; i < 30; ++i)
        way += "x/";
    EXPECT_FALSE(findInAnyCase(folder_, way + "none")) << "2^30 ways";
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

TEST_F(Files, what_has_no_end_is_not_read_for_ever) {
    const auto zeros = readFile("/dev/zero");
    ASSERT_FALSE(zeros);
    EXPECT_NE(format(zeros.error()).find("/dev/zero: error TG5001: gives more than 1024 MiB"), std::string::npos) << format(zeros.error());
}

TEST_F(Files, a_pipe_is_read_while_somebody_writes_and_said_where_nobody_does) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const auto alone = readFile(pipe);
    ASSERT_FALSE(alone);
    EXPECT_NE(format(alone.error()).find("nobody writes into it"), std::string::npos) << format(alone.error());
    std::string sent;
    for (int i = 0; i < 300000; ++i)
        sent += static_cast<char>(i);
    std::thread writer([&] {
        std::ofstream out(pipe, std::ios::binary);
        out << sent.substr(0, 7) << std::flush;
        std::this_thread::sleep_for(std::chrono::milliseconds(50)); // a slow writer is no end
        out << sent.substr(7);
    });
    const auto read = readFile(pipe);
    writer.join();
    ASSERT_TRUE(read) << format(read.error());
    EXPECT_EQ(*read, sent);
}

TEST_F(Files, what_says_that_it_has_no_bytes_is_read_to_its_end) {
    const auto process = readFile("/proc/self/status");
    ASSERT_TRUE(process);
    EXPECT_NE(process->find("VmPeak"), std::string::npos);
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

TEST_F(Temporaries, a_borrowed_file_gets_its_content_back) {
    {
        const Borrowed borrowed(file_, "before");
        ASSERT_TRUE(borrowed.change("while it is borrowed"));
        EXPECT_EQ(content(), "while it is borrowed");
        EXPECT_EQ(borrowed.content(), "before");
    }
    EXPECT_EQ(content(), "before");
}

TEST_F(Temporaries, a_borrowed_file_that_is_as_it_was_is_not_written) {
    const auto then = fs::last_write_time(file_) - std::chrono::hours(1);
    fs::last_write_time(file_, then);
    { const Borrowed borrowed(file_, "before"); }
    EXPECT_EQ(fs::last_write_time(file_), then);
}

/// In a process of its own, which then may make no temporary file any more.
TEST_F(Temporaries, a_program_that_is_interrupted_removes_its_files_and_gives_back_what_it_borrowed) {
    const pid_t child = ::fork();
    if (child == 0) {
        const Temporary gone(folder_ / "gone");
        const Borrowed borrowed(file_, "before");
        const bool made = writeFile(gone.path() / "y", "1") && borrowed.change("while it is borrowed");
        removeTemporaries();
        ::_exit(made && !fs::exists(gone.path()) ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(content(), "before");
}

TEST(Text, comparison_ignores_case_only) {
    EXPECT_TRUE(equalsIgnoreCase("ViewPortRatio", "viewportratio"));
    EXPECT_FALSE(equalsIgnoreCase("Format", "Formats"));
    EXPECT_TRUE(equalsIgnoreCase("", ""));
}

TEST(Text, trim_removes_white_space_at_both_ends) {
    EXPECT_EQ(trim(" \t a b \r\n"), "a b");
    EXPECT_EQ(trim(" \n"), "");
}

TEST(Text, nearest_name_forgives_a_third_of_the_letters) {
    const std::vector<std::string> names = {"RenderColorTarget", "RenderDepthStencilTarget", "Clear"};
    EXPECT_EQ(nearestName("RenderColourTarget", names), "RenderColorTarget");
    EXPECT_EQ(nearestName("claer", names), "Clear");
    EXPECT_EQ(nearestName("Draw", names), "");
    EXPECT_EQ(nearestName("", names), "");
}

TEST(Text, hint_is_a_question_or_nothing) {
    const std::vector<std::string> names = {"gMix"};
    EXPECT_EQ(didYouMean("gmix", names), "did you mean 'gMix'?");
    EXPECT_EQ(didYouMean("unrelated", names), "");
}

TEST(Text, words_of_a_command_line_come_back_as_they_were) {
    EXPECT_EQ(shellWord("scans/head_1.obj"), "scans/head_1.obj");
    EXPECT_EQ(shellWord("my scan (2).obj"), "'my scan (2).obj'");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
    EXPECT_EQ(shellWord(""), "''");
}

TEST(Diagnostics, carry_file_line_column_code_and_hint) {
    const Diagnostic diagnostic{.code = 2004,
                                .at = {.file = "effects/Main.fx", .line = 41, .column = 12},
                                .text = "unknown script command 'RenderColourTarget'",
                                .hint = "did you mean 'RenderColorTarget'?"};
    EXPECT_EQ(format(diagnostic),
              "effects/Main.fx(41,12): error TG2004: unknown script command 'RenderColourTarget'; did you mean 'RenderColorTarget'?");
}

TEST(Diagnostics, put_the_caret_under_the_column_whatever_the_tab_width) {
    const Diagnostic diagnostic{
        .severity = Severity::Warning, .code = 1, .at = {.file = "a.fx", .line = 2, .column = 4}, .text = "x", .sourceLine = "\tab cd"};
    EXPECT_EQ(format(diagnostic), "a.fx(2,4): warning TG0001: x\n    \tab cd\n    \t  ^");
}

TEST(Diagnostics, print_no_bytes_that_a_terminal_would_obey) {
    Diagnostic diagnostic{.code = 1101,
                          .at = {.file = "a.fx", .line = 1, .column = 9},
                          .text = "found '\x1b[31m'",
                          .hint = "\xe4\xff \xc0\xaf",
                          .sourceLine = "fl\xc3\xb6\x07\x7f\x80 x"};
    EXPECT_EQ(format(diagnostic), "a.fx(1,9): error TG1101: found '?[31m'; ?? ??\n    fl\xc3\xb6??? x\n            ^")
        << "one question mark for each, so that the caret keeps its column; UTF-8 stays";
}

TEST(Diagnostics, name_the_byte_in_binary_files) {
    EXPECT_EQ(format(inputError(5100, {.file = "head.glb", .byte = 12}, "ends early")), "head.glb(byte 12): error TG5100: ends early");
}

TEST(Diagnostics, of_the_machine_name_the_program) {
    const Error error = machineError(6001, "no Vulkan device");
    EXPECT_EQ(format(error), "tegument: error TG6001: no Vulkan device");
    EXPECT_EQ(static_cast<int>(error.blame), 3);
}

TEST(Results, hold_either_a_value_or_an_error) {
    const Result<int> value = 7;
    const Result<int> failed = usageError(8000, "no");
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, 7);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().blame, Blame::Usage);
    EXPECT_TRUE(Result<void>());
    EXPECT_FALSE(Result<void>(usageError(8000, "no")));
}
