#pragma once
// Files and folders that must not outlive their use, nor the program when it is interrupted.

#include <filesystem>

namespace tegument {

/// Removed, with all that is in it, on destruction and by removeTemporaries(). Makes nothing: the path need not exist, and may be renamed.
class Temporary {
public:
    explicit Temporary(std::filesystem::path path);
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Removes all that there are, and holds up threads that would make another one or end one: the last thing before the program is ended.
void removeTemporaries();

} // namespace tegument
