#pragma once
// Files that hold grooms, in and out. docs/design/grooms.md says what each cannot hold.

#include "meshprep/groom/groom.h"

#include "host/support/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tegument {

struct GroomOptions {
    std::optional<double> unitMm; // millimetres in a unit of the file; default: as the file says, else as its format has it
    std::optional<bool> zIsUp;    // likewise
    std::size_t frame = 0;        // of an animated file: which of its samples
};

/// By its ending and its content. Strands have at least leastPoints() points, all of them finite; shorter ones are left out, with a warning
/// (TG5323), as is all that is not read. TG5340 no format of grooms, TG5341 no strand in it; TG5301 to TG5311 as of meshes.
[[nodiscard]] Result<Groom> readGroom(const std::filesystem::path& path, const GroomOptions& options = {});

/// By its ending. In the unit and with the axis that are asked for; else in the groom's where the format says them, and in the format's
/// unit, y up, where it does not. Returns the warnings (TG5342) of what the format does not hold. TG5340 no format of grooms.
[[nodiscard]] Result<std::vector<Diagnostic>> writeGroom(const std::filesystem::path& path, const Groom& groom,
                                                         const GroomOptions& options = {});

/// By its ending: one that readGroom reads, or the binary forms and bones beside these.
[[nodiscard]] bool isGroom(const std::filesystem::path& path);
/// ".abc, .glb" ...
[[nodiscard]] std::vector<std::string> groomEndings();

} // namespace tegument
