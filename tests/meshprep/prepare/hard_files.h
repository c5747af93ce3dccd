#pragma once
// Mesh files that programs get wrong, and what is right for each (docs/design/meshprep-tables.md has the table). Written from their
// descriptions.

#include <optional>
#include <string>
#include <vector>

namespace tegument::testing_prep {

/// The right behaviour: either one error, or counts.
struct Expected {
    int error = 0; // code; 0: none
    int line = 0;
    std::optional<std::size_t> byte;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::string step; // one that must have happened...
    std::size_t changed = 0;
    bool anywhere = false; // the error may name any place
    int warning = 0;       // code of one that must be there
};

struct HardFile {
    int number = 0; // in the table; variants share one
    std::string name;
    std::string bytes;
    Expected expected;
};

/// Numbers 55 to 86, as `hardFiles` has them at its end.
[[nodiscard]] std::vector<HardFile> moreHardFiles();

/// Numbers 1 to 86 without 46 and 47 (real scans) and 48 (ten million triangles).
[[nodiscard]] std::vector<HardFile> hardFiles();

} // namespace tegument::testing_prep
