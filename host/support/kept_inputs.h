#pragma once
// Inputs are kept: what a command reads is not among what it writes, by whatever name.

#include "host/support/result.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace tegument {

/// While one lives, readFile notes what it reads, and writeFile refuses to replace it: TG5004. Files are compared by what they are, not by
/// name: hard and symbolic links, another case and ".." count. Files that the process itself has written, and those of the cache, are not
/// inputs. One at a time: the program's main function makes it; a library's client may.
class KeptInputs {
public:
    KeptInputs();
    ~KeptInputs();
    KeptInputs(const KeptInputs&) = delete;
    KeptInputs& operator=(const KeptInputs&) = delete;
    KeptInputs(KeptInputs&&) = delete;
    KeptInputs& operator=(KeptInputs&&) = delete;
};

/// canWrite, for a file that will be an output: reading it from now on is TG5004, so that the error comes before the work.
[[nodiscard]] Result<void> willWrite(const std::filesystem::path& path);

/// The first TG5004 of readFile, which a reader may have taken for a file that is not there.
[[nodiscard]] Result<void> inputsAreKept();

/// writeFile, also over what was read: texts that are edited where they stand, and notes of the program's own.
[[nodiscard]] Result<void> rewriteFile(const std::filesystem::path& path, std::string_view bytes);

/// TG5004 where a file that was read lies in this folder, which is to be replaced.
[[nodiscard]] Result<void> holdsNoInput(const std::filesystem::path& folder);

/// Files that programs have read and written, the cache left out: what decided an outcome, and what came of it.
struct FilesUsed {
    std::vector<std::filesystem::path> read;
    std::vector<std::filesystem::path> written;
};

/// A program with KeptInputs that finds this variable appends its files, when it ends, to the file that it names.
inline constexpr const char* kFilesUsedVariable = "TEGUMENT_FILES_USED";

/// Of such a list; what is gone is left out.
[[nodiscard]] FilesUsed filesUsed(const std::filesystem::path& list);

namespace kept {

/// For readFile. TG5004 for what willWrite was asked about.
[[nodiscard]] Result<void> noteRead(const std::filesystem::path& path);
/// For canWrite and writeFile. TG5004 for what was read.
[[nodiscard]] Result<void> mayWrite(const std::filesystem::path& path);
/// For writeFile: the file is the process's own from now on.
void noteWritten(const std::filesystem::path& path);

} // namespace kept

} // namespace tegument
