#pragma once
// tests/check/broken: effects with one mistake each. A mark at the end of a line says what that line must be blamed for:
//     //~ TG1001                                  the front end, hence every target
//     //~ fx_2_0 sm5 TG3101, spirv-dxc TG3001     these targets; every other target must not fail
//     //~ fx_2_0 sm5 TG3101, else TG3001          all that the line has not named before
//     //~ sm5 TG3204, may spirv-glslang TG3003    versions of a compiler differ: it fails so, or not at all

#include "host/support/file.h"
#include "tools/check/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace tegument::test {

struct Expected {
    std::string target; // empty: the front end
    int code = 0;
    int line = 0;
    bool may = false;
};

inline std::vector<Expected> expectedOf(const std::filesystem::path& file) {
    std::vector<Expected> all;
    const auto text = readFile(file);
    std::istringstream lines(text ? *text : "");
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::size_t mark = line.find("//~ ");
        if (mark == std::string::npos) continue;
        std::istringstream words(line.substr(mark + 4));
        std::vector<std::string> targets;
        std::vector<Target> left = allTargets();
        bool may = false;
        for (std::string word; words >> word;) {
            if (word == "may") {
                may = true;
            } else if (!word.starts_with("TG")) {
                if (word != "else") targets.push_back(word);
                for (const Target target : left)
                    if (word == "else") targets.emplace_back(targetName(target));
                std::erase_if(left, [&](Target target) { return targetName(target) == word; });
            } else {
                if (targets.empty()) targets.emplace_back();
                for (const std::string& target : targets)
                    all.push_back({target, std::stoi(word.substr(2)), number, may});
                targets.clear();
                may = false;
            }
        }
    }
    return all;
}

inline std::vector<std::filesystem::path> brokenEffects() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator("tests/check/broken"))
        files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

inline std::string listed(const std::vector<Diagnostic>& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics)
        text += format(diagnostic) + "\n";
    return text;
}

inline bool blames(const std::vector<Diagnostic>& diagnostics, const std::filesystem::path& file, const Expected& expected) {
    return std::ranges::any_of(diagnostics, [&](const Diagnostic& d) {
        return d.severity == Severity::Error && d.code == expected.code && d.at.line == expected.line && d.at.file == file.string();
    });
}

/// Holds every target of the report against the marks of its file.
inline void expectBlame(const FileReport& report) {
    const std::vector<Expected> expected = expectedOf(report.file);
    EXPECT_FALSE(expected.empty()) << report.file << " has no mark";
    std::set<std::string> failing;
    for (const Expected& one : expected) {
        failing.insert(one.target);
        if (one.target.empty()) {
            EXPECT_TRUE(blames(report.diagnostics, report.file, one)) << "TG" << one.code << "\n" << listed(report.diagnostics);
        }
        for (const TargetCheck& target : report.targets) {
            if (targetName(target.target) != one.target || (one.may && target.verdict != Verdict::Failed)) continue;
            EXPECT_TRUE(blames(target.diagnostics, report.file, one))
                << report.file << "(" << one.line << ") for " << one.target << ": expected TG" << one.code << ", got\n"
                << listed(target.diagnostics) << target.reason;
        }
    }
    for (const TargetCheck& target : report.targets) {
        if (failing.contains("") || failing.contains(std::string(targetName(target.target)))) continue;
        EXPECT_NE(target.verdict, Verdict::Failed) << report.file << " " << targetName(target.target) << "\n" << listed(target.diagnostics);
    }
}

} // namespace tegument::test
