// What `check` accepts is drawn, and what it refuses is not: effects among the tests as they are, and changed at random.

#include "host/support/file.h"
#include "meshprep/assets/job.h"
#include "tests/check/describe.h"
#include "tests/gpu/with_device.h"
#include "tests/spirv/missing.h"
#include "tools/check/check.h"

#include <unistd.h>

#include <algorithm>
#include <random>
#include <regex>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> effects() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator("tests"))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

class Drawn : public WithDevice {
protected:
    Drawn() : folder_(fs::temp_directory_path() / ("tegument-drawn-" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
        EXPECT_TRUE(writeFile(file("square.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                                                  "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n"));
        EXPECT_TRUE(writePng(file("grey.png"), {.width = 1, .height = 1, .channels = 3, .pixels = {0.5F, 0.5F, 0.5F}}, PngEncoding::Raw));
    }
    ~Drawn() override { fs::remove_all(folder_); }

    void SetUp() override {
        if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
        WithDevice::SetUp();
    }

    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }

    /// Empty: drawn. Of an effect that is written for this host no compiler refuses any other pass either.
    std::string whyNotDrawn(const fs::path& effect, const fs::path& includes) {
        auto job = assets::loadJob({.file = effect.string(),
                                    .effect = {.includeFolders = {includes.string()}},
                                    .scene = {.mesh = file("square.obj").string()},
                                    .size = "16",
                                    .compiler = "dxc"});
        if (!job) return format(job.error());
        if (job->effect.ownDialect) giveWhatIsMissing(*job);
        const auto drawn = assets::draw(*device_, *job);
        if (!drawn) return format(drawn.error());
        for (std::size_t i = 0; job->effect.ownDialect && i < job->effect.techniques.size(); ++i) {
            job->run.technique = job->effect.techniques[i].name;
            job->effect.techniques[i].script = {}; // all its passes, also those that no script runs
            const auto other = assets::draw(*device_, *job);
            if (!other && other.error().diagnostics.front().code < 4000) return format(other.error());
        }
        return {};
    }

    void expectVerdict(const fs::path& effect, const fs::path& includes) {
        const FileReport report = checkEffects({effect}, {Target::SpirvDxc}, {.includeFolders = {includes}}).files.at(0);
        const bool accepted = !report.failed() && report.targets[0].verdict == Verdict::Passed;
        const std::string why = whyNotDrawn(effect, includes);
        EXPECT_EQ(accepted, why.empty()) << describe(report) << "render: " << why;
    }

private:
    /// Values and textures that only a user has: check warns of them (TG4018, TG4030).
    void giveWhatIsMissing(assets::Job& job) const {
        for (const Parameter& parameter : job.effect.parameters) {
            if (parameter.type.isNumeric() && !parameter.defaultValue && parameter.semantic.empty())
                job.run.parameters[parameter.name].assign(static_cast<std::size_t>(parameter.type.scalarCount()), 1);
            if (parameter.type.base == BaseType::Texture2D && !parameter.isTarget() && !parameter.annotations.find("Producer"))
                job.run.textures[parameter.name] = file("grey.png").string();
        }
    }

    fs::path folder_;
};

TEST_F(Drawn, is_what_check_accepts_of_all_effects_of_the_tests) {
    for (const fs::path& effect : effects())
        expectVerdict(effect, effect.parent_path());
}

/// One word, number or sign is left out, repeated, or gives way to another of the same file.
std::string changed(const std::string& text, std::mt19937& random) {
    static const std::regex kToken(R"(\w+|[^\s\w])");
    const std::vector<std::smatch> tokens(std::sregex_iterator(text.begin(), text.end(), kToken), std::sregex_iterator());
    const auto any = [&]() -> const std::smatch& { return tokens[random() % tokens.size()]; };
    const std::smatch& from = any();
    const std::string other[] = {"", from.str() + " " + from.str(), any().str()};
    return text.substr(0, static_cast<std::size_t>(from.position())) + other[random() % 3] + from.suffix().str();
}

TEST_F(Drawn, is_what_check_accepts_of_a_hundred_effects_changed_at_random) {
    const std::vector<fs::path> all = effects();
    std::mt19937 random(46);
    for (int i = 0; i < 100; ++i) {
        const fs::path& effect = all[random() % all.size()];
        const auto text = readFile(effect);
        ASSERT_TRUE(text);
        const fs::path made = file(std::to_string(i) + ".fx");
        ASSERT_TRUE(writeFile(made, changed(*text, random)));
        SCOPED_TRACE(effect);
        expectVerdict(made, effect.parent_path());
    }
}

} // namespace
} // namespace tegument::test
