#pragma once
// A folder that lives as long as the test, and small mesh files written by hand.

#include "host/mesh/mesh.h"
#include "host/support/file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <unistd.h>

namespace tegument::testing_scene {

inline int codeOf(const Error& error) {
    return error.diagnostics.front().code;
}

template <class T>
int codeOf(const Result<T>& result) {
    return result ? 0 : codeOf(result.error());
}

class SceneFiles : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() / ("tegument-scene-" + std::to_string(::getpid()) + "-" + info->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        EXPECT_TRUE(writeFile(folder_ / name, bytes));
        return folder_ / name;
    }
    [[nodiscard]] Result<Mesh> load(const std::string& name, std::string_view bytes, const MeshOptions& options = {}) const {
        return loadMesh(write(name, bytes), options);
    }

    struct Fault {
        std::string text;
        int code;
        int line;
    };
    /// Each text is one error with its line.
    void expectFaults(const std::string& name, const std::vector<Fault>& faults) const {
        for (const Fault& fault : faults) {
            const auto mesh = load(name, fault.text);
            ASSERT_EQ(codeOf(mesh), fault.code) << fault.text;
            EXPECT_EQ(mesh.error().diagnostics.front().at.line, fault.line) << fault.text << format(mesh.error());
        }
    }

    std::filesystem::path folder_;
};

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// A glb of this JSON and binary chunk, padded as the specification wants.
inline std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    const auto word = [&](std::size_t value) { append(bytes, std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)}); };
    word(2);
    word(12 + 8 + json.size() + 8 + binary.size());
    word(json.size());
    bytes += "JSON" + json;
    word(binary.size());
    bytes += std::string("BIN\0", 4) + binary;
    return bytes;
}

inline bool hasWarning(const Mesh& mesh, int code) {
    for (const Diagnostic& warning : mesh.warnings)
        if (warning.code == code) return true;
    return false;
}

} // namespace tegument::testing_scene
