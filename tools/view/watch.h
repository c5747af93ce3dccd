#pragma once
// Did a file change? Asked a few times a second: no editor's way of saving (in place, or a new file renamed over the old) is missed.

#include <filesystem>
#include <map>
#include <vector>

namespace tegument::view {

class FileWatch {
public:
    /// From now on these. Those watched already are compared with what they were, so that no change is missed while others are read. A
    /// folder counts as changed when files come or go.
    void watch(const std::vector<std::filesystem::path>& files);
    /// Whether any differs from when this was last asked.
    [[nodiscard]] bool changed();

private:
    struct Stamp {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;
        bool there = false;
        bool operator==(const Stamp&) const = default;
    };
    [[nodiscard]] static Stamp stampOf(const std::filesystem::path& file);

    std::map<std::filesystem::path, Stamp> stamps_;
};

} // namespace tegument::view
