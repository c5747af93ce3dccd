#include "tools/cli/ends.h"

#include "tools/cli/output.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tegument::app {

int ended(int code) {
    const bool lost = std::ferror(stdout) != 0;
    if (std::fflush(stdout) == 0 && !lost) return code;
    say(format(machineError(8090, fmt::format("cannot write to standard output: {}", std::strerror(errno != 0 ? errno : EIO)),
                            "files that were written are whole; run it again with its output elsewhere")));
    return code != 0 ? code : static_cast<int>(Blame::Machine);
}

} // namespace tegument::app
