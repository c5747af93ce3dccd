#pragma once
// The engine of docs/your-engine.md that skins: its file beside a copy of the effects.

#include "host/support/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <unistd.h>

namespace tegument::test {

/// The first block of HLSL in docs/your-engine.md.
inline std::string hookExample() {
    const auto page = readFile("docs/your-engine.md");
    const std::string fence = "```hlsl\n";
    const std::size_t from = page ? page->find(fence) : std::string::npos;
    if (from == std::string::npos) return {};
    const std::size_t begin = from + fence.size();
    return page->substr(begin, page->find("```", begin) - begin);
}

/// The text with another effect in place of Main.fx. `effect`: below effects/, "peers/Burley.fx" too.
inline std::string hookedText(const std::string& text, const std::string& effect) {
    const std::filesystem::path file(effect);
    std::string hooked = std::regex_replace(text, std::regex("\"Main\\.fx\""), "\"" + file.filename().string() + "\"");
    if (file.has_parent_path()) hooked = std::regex_replace(hooked, std::regex("\"\\.\\./hlsl"), "\"../../hlsl");
    return hooked;
}

/// A copy of hlsl/ and effects/ into which files are put; gone with its owner.
class EffectsCopy {
public:
    EffectsCopy() : folder_(std::filesystem::temp_directory_path() / ("tegument-hook-" + std::to_string(::getpid()))) {
        namespace fs = std::filesystem;
        for (const char* name : {"hlsl", "effects"}) {
            fs::create_directories(folder_ / name);
            fs::copy(name, folder_ / name, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        }
    }
    ~EffectsCopy() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    EffectsCopy(const EffectsCopy&) = delete;
    EffectsCopy& operator=(const EffectsCopy&) = delete;

    /// `text` beside the effect, which it includes.
    [[nodiscard]] std::filesystem::path put(const std::string& text, const std::string& effect) const {
        const std::filesystem::path beside = folder_ / "effects" / effect;
        std::filesystem::path file = beside.parent_path() / ("Hooked" + beside.filename().string());
        EXPECT_TRUE(writeFile(file, hookedText(text, effect)));
        return file;
    }

private:
    std::filesystem::path folder_;
};

} // namespace tegument::test
