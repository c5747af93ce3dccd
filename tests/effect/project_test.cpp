// Where the files of an effect may lie when no mark says how far its project reaches, and where one that is missing lies.

#include "host/support/file.h"
#include "tests/effect/support.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

class Unpacked : public testing::Test {
protected:
    void SetUp() override {
        root_ = fs::temp_directory_path() /
                fmt::format("tegument-unpacked-{}", ::testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(root_);
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    fs::path write(const std::string& name, const std::string& text) const {
        EXPECT_TRUE(writeFile(root_ / name, text));
        return root_ / name;
    }
    static std::string said(const fs::path& effect) {
        const auto read = loadEffect(effect, {.lenient = true});
        return read ? std::string() : format(read.error());
    }

    fs::path root_;
};

TEST_F(Unpacked, an_archive_reads_what_its_effects_name_in_folders_beside_and_above) {
    write("common.fxh", "float gCommon;");
    write("lib/deep/more.fxh", "#include \"../more2.fxh\"\n");
    write("lib/more2.fxh", "#include \"../common.fxh\"\n");
    EXPECT_EQ(said(write("pack/sub/above.fx", "#include \"../../common.fxh\"\n")), "");
    EXPECT_EQ(said(write("pack/sub/beside.fx", "#include <..\\..\\lib\\deep\\more.fxh>\n")), "") << "through what it includes";
    EXPECT_EQ(said(write("sub/one.fx", "  #  include \"../common.fxh\" // shared\n")), "");
}

TEST_F(Unpacked, an_archive_holds_no_file_that_is_named_absolutely_or_behind_a_link) {
    const fs::path secret = write("secret/s.fxh", "float gSecret;");
    EXPECT_NE(said(write("a/absolute.fx", "#include \"" + secret.string() + "\"\n")).find("TG1014"), std::string::npos);
    fs::create_directories(root_ / "a");
    fs::create_symlink(secret, root_ / "a/link.fxh");
    EXPECT_NE(said(write("a/linked.fx", "#include \"link.fxh\"\n")).find("TG1014"), std::string::npos);
    EXPECT_NE(said(write("a/far.fx", "#include \"../../../../../../../../../../etc/passwd\"\n")).find("TG1014"), std::string::npos)
        << "the common parent is the whole machine";
}

TEST_F(Unpacked, a_mark_ends_the_project_before_the_file) {
    write("shared.fxh", "float gShared;");
    write("repository/.git/HEAD", "ref");
    EXPECT_NE(said(write("repository/sub/a.fx", "#include \"../../shared.fxh\"\n")).find("TG1014"), std::string::npos);
}

TEST_F(Unpacked, the_working_directory_holds_what_is_named_absolutely) {
    const fs::path shared = write("lib/shared.fxh", "float gShared;");
    const fs::path effect = write("a/b.fx", "#include \"" + shared.string() + "\"\n");
    EXPECT_NE(said(effect).find("TG1014"), std::string::npos);
    const fs::path before = fs::current_path();
    fs::current_path(root_);
    const std::string here = said(effect);
    fs::current_path(root_ / "lib");
    const std::string elsewhere = said(effect);
    fs::current_path(before);
    EXPECT_EQ(here, "");
    EXPECT_NE(elsewhere.find("TG1014"), std::string::npos) << "the working directory does not hold the effect";
}

TEST_F(Unpacked, a_missing_include_is_looked_for_and_its_folder_named) {
    write("shaders/lib/common.fxh", "float gCommon;");
    write("shaders/lib/inner/part.fxh", "float gPart;");
    const auto hint = [&](const fs::path& effect) {
        const std::string text = said(effect);
        EXPECT_NE(text.find("TG1001"), std::string::npos) << text;
        const std::size_t at = text.find("-I ");
        return at == std::string::npos ? std::string() : text.substr(at + 3, text.find(" finds it") - at - 3);
    };
    const std::string lib = (root_ / "shaders/lib").string();
    const fs::path plain = write("shaders/sm3/a.fx", "#include \"common.fxh\"\n");
    EXPECT_EQ(hint(plain), lib);
    EXPECT_TRUE(loadEffect(plain, {.includeFolders = {lib}})) << "the hint works";
    EXPECT_EQ(hint(write("shaders/sm3/b.fx", "#include <inner\\part.fxh>\n")), lib) << "of a name with a folder";
    EXPECT_EQ(hint(write("c.fx", "#include \"Common.FXH\"\n")), lib) << "in another case";
    EXPECT_EQ(hint(write("shaders/sm3/d.fx", "#include \"nowhere.fxh\"\n")), "");
}

} // namespace
} // namespace tegument::test
