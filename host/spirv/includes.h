#pragma once
// #include for both compilers, with a list of what was read: a cached shader holds only while these files are unchanged.

#include "host/support/result.h"
#include "host/support/roots.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

struct IncludedFile {
    std::string path;
    std::string hash; // contentHash of its bytes
};

class IncludeReader {
public:
    /// Looks beside `file` first, then in the folders in order. What lies outside of rootsOf() is not there.
    IncludeReader(const std::string& file, const std::vector<std::filesystem::path>& folders);

    struct Found {
        std::string path;
        std::string text;
    };
    /// `name` as the compiler asks for it: relative to one of the folders, or absolute.
    [[nodiscard]] std::optional<Found> open(const std::filesystem::path& name);
    /// Beside `includer` (a path that open() gave, or the main file), then as above.
    [[nodiscard]] std::optional<Found> openFrom(const std::filesystem::path& includer, const std::filesystem::path& name);

    [[nodiscard]] const std::vector<IncludedFile>& files() const { return files_; }
    /// The file that was read when the compiler asked for this name; the name itself if there was none.
    [[nodiscard]] std::string pathOf(const std::string& asked) const;
    /// Why the first file that is there could not be read: compilers call it missing.
    [[nodiscard]] const std::optional<Error>& unread() const { return unread_; }

private:
    [[nodiscard]] std::optional<Found> read(const std::filesystem::path& path, const std::string& asked);

    std::vector<std::filesystem::path> folders_;
    Roots roots_;
    std::vector<IncludedFile> files_;
    std::map<std::string, std::string> asked_;
    std::optional<Error> unread_;
};

} // namespace tegument
