#pragma once
// What the tests of the compilers share.

#include "host/spirv/compile.h"
#include "tests/spirv/missing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <unistd.h>

namespace tegument::test {

/// A cache of its own, so that a test neither finds nor leaves anything in the user's.
class CompileTest : public testing::Test {
protected:
    CompileTest() : folder_(std::filesystem::temp_directory_path() / ("tegument-compile-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
        ::setenv("TEGUMENT_CACHE", folder_.c_str(), 1);
    }
    ~CompileTest() override {
        std::filesystem::remove_all(folder_);
        ::unsetenv("TEGUMENT_CACHE");
    }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
};

/// A test that is run with each compiler; skipped, visibly, where DXC is not there.
class EachCompiler : public CompileTest, public testing::WithParamInterface<Compiler> {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(GetParam()); !missing.empty()) GTEST_SKIP() << missing;
    }

    [[nodiscard]] Result<Shader> tryCompile(std::string_view code, std::string entry, ShaderStage stage) const {
        return compileShader({.code = code, .file = "test.fx", .entry = std::move(entry), .stage = stage}, GetParam());
    }
    /// Fails the test and gives an empty shader when the compiler refuses.
    [[nodiscard]] Shader compile(std::string_view code, std::string entry, ShaderStage stage) const {
        auto shader = tryCompile(code, std::move(entry), stage);
        if (shader) return std::move(*shader);
        ADD_FAILURE() << format(shader.error());
        return {};
    }
};

inline const BlockMember* member(const Shader& shader, std::string_view name) {
    if (!shader.reflection.globals) return nullptr;
    const auto& members = shader.reflection.globals->members;
    const auto found = std::ranges::find(members, name, &BlockMember::name);
    return found == members.end() ? nullptr : &*found;
}

inline const Resource* resource(const Shader& shader, std::string_view name) {
    const auto found = std::ranges::find(shader.reflection.resources, name, &Resource::name);
    return found == shader.reflection.resources.end() ? nullptr : &*found;
}

inline std::map<std::string, std::uint32_t> locations(const std::vector<StageVariable>& variables) {
    std::map<std::string, std::uint32_t> found;
    for (const StageVariable& variable : variables)
        found[variable.semantic] = variable.location;
    return found;
}

} // namespace tegument::test
