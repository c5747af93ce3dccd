#pragma once
// Inside this room: the tokens of a file of tests become plain HLSL.

#include "host/effect/preprocess.h"
#include "host/support/roots.h"
#include "tools/test/test_file.h"

namespace tegument::testing {

/// Pixel tests lie in a grid of quads.
inline constexpr std::uint32_t kQuadsInARow = 512;
inline constexpr std::uint32_t kMostCases = 1U << 20U;
inline constexpr std::uint32_t kMostGroups = 65535;

struct Rewritten {
    Preprocessed view;
    std::string counters;         // declarations of the loops' counters
    std::optional<Effect> effect; // what the file declares for effects, where it is written for Direct3D 9
};

/// Each assertion, input, loop and index gets a number, its site in `file`; fixtures leave the code; so does an effect's own syntax.
[[nodiscard]] Result<Rewritten> rewrite(const Preprocessed& view, Sources& sources, const Roots& roots, const ReadOptions& options,
                                        TestFile& file);

} // namespace tegument::testing
