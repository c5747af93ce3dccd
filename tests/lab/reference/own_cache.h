#pragma once
// A cache of a test's own, gone afterwards.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <unistd.h>

namespace tegument::reference {

class OwnCache : public testing::Test {
protected:
    OwnCache() : folder_(std::filesystem::temp_directory_path() / ("tegument-reference-" + std::to_string(::getpid()))) {
        if (const char* old = std::getenv("TEGUMENT_CACHE")) old_ = old;
        ::setenv("TEGUMENT_CACHE", folder_.c_str(), 1);
    }
    ~OwnCache() override {
        old_ ? ::setenv("TEGUMENT_CACHE", old_->c_str(), 1) : ::unsetenv("TEGUMENT_CACHE");
        std::filesystem::remove_all(folder_);
    }

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
    std::optional<std::string> old_;
};

} // namespace tegument::reference
