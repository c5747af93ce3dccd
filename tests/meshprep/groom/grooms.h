#pragma once
// Grooms that tests make up, and files of them.

#include "meshprep/groom/groom_file.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace tegument::test {

/// Strands on a ball of 100 mm, each bent in its own way, with all that a groom may say. `points`: of each; 0: 4 to 19.
inline Groom madeGroom(std::size_t strands = 40, std::size_t points = 0, Spline spline = Spline::Linear) {
    Groom groom{.points = {}, .spline = spline};
    for (std::size_t i = 0; i < strands; ++i) {
        const auto f = static_cast<float>(i);
        const float up = 1 - 2 * (f + 0.5F) / static_cast<float>(strands), around = 2.4F * f;
        const float flat = std::sqrt(1 - up * up);
        const glm::vec3 n(flat * std::cos(around), up, flat * std::sin(around));
        const std::size_t count = points > 0 ? points : 4 + i % 16;
        for (std::size_t k = 0; k < count; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(count - 1);
            groom.points.push_back(100.0F * n + 40.0F * (n * t + t * t * glm::vec3(0.3F * std::sin(f), -0.8F, 0.2F)));
            groom.widths.push_back(0.08F * (1 - 0.7F * t));
            groom.colors.emplace_back(0.1F + 0.5F * t, 0.2F, 0.05F * static_cast<float>(i % 7));
        }
        groom.rootUvs.emplace_back(0.25F + 0.01F * f, 0.75F - 0.01F * f);
        groom.ids.push_back(static_cast<std::int32_t>(7 * i));
        groom.guides.push_back(i % 5 == 0);
        groom.clumps.push_back(static_cast<std::int32_t>(i / 4));
        groom.endStrand();
    }
    return groom;
}

/// A file of this process's own.
inline std::filesystem::path groomFile(const std::string& name, const std::string& bytes = {}) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("tegument-groom-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    if (!bytes.empty()) std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

inline std::string readAll(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
void put(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline int codeOf(const Result<Groom>& groom) {
    return groom ? 0 : groom.error().diagnostics.front().code;
}

} // namespace tegument::test
