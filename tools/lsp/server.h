#pragma once
// A language server for effects.

#include "host/effect/model.h"

#include <functional>
#include <string>
#include <vector>

namespace tegument::lsp {

struct Options {
    LoadOptions load;                                                     // defines, include folders
    std::vector<std::string> semantics;                                   // that the host binds, for completion
    int idleMilliseconds = 300;                                           // without a message, after which the compilers are asked
    std::function<std::vector<Diagnostic>(const std::string& path)> test; // runs a .test.hlsl file as it lies on the disk: what failed
};

/// Answers until it is told to exit, or nothing comes any more. The exit code: 0 after `shutdown`, else 1, as the protocol has it.
[[nodiscard]] int serve(int input, int output, const Options& options);

} // namespace tegument::lsp
