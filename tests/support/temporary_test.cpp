#include "host/support/temporary.h"

#include "host/support/file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

using namespace tegument;
namespace fs = std::filesystem;

namespace {

class Temporaries : public testing::Test {
protected:
    void SetUp() override { ASSERT_TRUE(writeFile(file_, "before")); }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string content() const { return *readFile(file_); }
    const fs::path folder_ = fs::temp_directory_path() / ("tegument-temporaries-" + std::to_string(::getpid()));
    const fs::path file_ = folder_ / "x";
};

} // namespace

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
