#pragma once
// Files and folders that must not outlive their use, and files that are changed for a while: nor the program when it is interrupted.

#include "host/support/result.h"

#include <filesystem>
#include <string>
#include <string_view>

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

/// A file that is changed for a while: it gets its content back, where it has another by then, on destruction and by removeTemporaries().
class Borrowed {
public:
    Borrowed(std::filesystem::path path, std::string content);
    ~Borrowed();
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    [[nodiscard]] const std::string& content() const { return content_; }
    /// Writes something else into it.
    [[nodiscard]] Result<void> change(std::string_view bytes) const;

private:
    friend void removeTemporaries();
    void putBack() const;

    std::filesystem::path path_;
    std::string content_;
};

/// Removes all that there are, gives back what is borrowed, and holds up threads that would make, change or end one: the last thing before
/// the program is ended.
void removeTemporaries();

} // namespace tegument
