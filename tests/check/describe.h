#pragma once
// What a check of a file found, for the message of a failing test.

#include "tools/check/check.h"

#include <string>

namespace tegument::test {

inline std::string describe(const FileReport& file) {
    std::string text = file.file.string() + " " + file.variant + "\n";
    for (const Diagnostic& diagnostic : file.diagnostics)
        text += format(diagnostic) + "\n";
    for (const TargetCheck& target : file.targets) {
        text += std::string(targetName(target.target)) + " " + target.reason + "\n";
        for (const Diagnostic& diagnostic : target.diagnostics)
            text += format(diagnostic) + "\n";
    }
    return text;
}

} // namespace tegument::test
