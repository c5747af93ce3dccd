#pragma once
// Microsoft's messages and paths in our form.

#include "host/spirv/messages.h"
#include "host/support/roots.h"

#include <filesystem>

namespace tegument {

/// "/tmp/a.fx" as Wine's programs know it: "Z:\tmp\a.fx".
[[nodiscard]] std::string windowsPath(const std::filesystem::path& absolute);

/// And back; other paths keep their places, with slashes.
[[nodiscard]] std::filesystem::path unixPath(std::string_view written);

/// `Z:\tmp\a.fx(3,7-9): error X3000: text` as an error of code TG3101 in `source`, spelt as `source` is when it is that file. Included
/// files come relative to the source's folder, or to one of `folders`. X4717 ("Effects deprecated"), which comes with every effect, is left
/// out. A line is quoted from a file within the roots only: `#line` can name any.
[[nodiscard]] Messages readMicrosoftMessages(std::string_view log, const std::filesystem::path& source,
                                             const std::vector<std::filesystem::path>& folders = {},
                                             const Roots& roots = {.anywhere = true});

} // namespace tegument
