#pragma once
// The effects of effects/peers and the forms they come in.

#include "tools/check/check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tegument::test {

inline std::vector<std::filesystem::path> peerFiles() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator("effects/peers"))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

inline std::vector<Variant> peerForms() {
    std::vector<Variant> forms = settingVariants("effects/peers/Separable.fx");
    forms.push_back({.name = "printed", .defines = {{"TEGUMENT_PEERS_AS_PRINTED", "1"}}});
    return forms;
}

inline void expectEveryPeerPasses(const std::vector<Target>& targets) {
    const auto files = peerFiles();
    ASSERT_GE(files.size(), 4U) << "run from the repository's root";
    const CheckReport report = checkEffects(files, targets, {.variants = peerForms()});
    EXPECT_EQ(report.files.size(), peerForms().size() * files.size());
    for (const FileReport& file : report.files)
        for (const TargetCheck& target : file.targets) {
            EXPECT_EQ(target.verdict, Verdict::Passed) << file.file << " " << file.variant << " " << targetName(target.target);
            for (const Diagnostic& diagnostic : target.diagnostics)
                ADD_FAILURE() << format(diagnostic);
        }
}

} // namespace tegument::test
