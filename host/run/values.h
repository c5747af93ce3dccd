#pragma once
// The numbers that the effect's parameters have: --set, then the workspace, then semantics, then the effect's defaults.
// Lays parameter values out in a uniform block as the SPIR-V's reflection says.

#include "host/effect/model.h"
#include "host/run/semantics.h"
#include "host/spirv/compile.h"
#include "host/support/result.h"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tegument::run {

using Numbers = std::vector<double>;

/// Where values come from. `set` is what --set names; all names must be parameters of the effect. `workspace` serves many effects: names
/// that this one does not have are passed over.
struct ValueSources {
    const std::map<std::string, Numbers>* set = nullptr;
    const std::map<std::string, Numbers>* workspace = nullptr;
    std::string workspaceFile;
    const SceneView* scene = nullptr;
};

class Values {
public:
    /// TG4010 unknown name, TG4011 wrong number of values, TG4016 not a whole number; warnings TG4012 outside UIMin..UIMax, TG4052 a unit
    /// that the world does not have.
    [[nodiscard]] static Result<Values> resolve(const Effect& effect, const ValueSources& sources, std::vector<Diagnostic>& warnings);

    /// Null when nothing gives it a value.
    [[nodiscard]] const Numbers* find(const std::string& name) const;
    /// The value, or why there is none: TG4013, TG4014, TG4015 (needs a mesh), TG4017 (unknown semantic, no default), TG4018 (no source at
    /// all).
    [[nodiscard]] Result<Numbers> require(const Parameter& parameter) const;

    /// Overrides one value: loop indices, the size of the current target.
    void write(const std::string& name, Numbers value) { known_[name] = std::move(value); }
    [[nodiscard]] bool fixedByUser(const std::string& name) const { return fixed_.contains(name); }

private:
    std::map<std::string, Numbers> known_;
    std::map<std::string, bool> fixed_;
    std::map<std::string, Error> failed_; // semantics that do not fit; reported when the parameter is used
};

/// Writes `value` (row order), as many numbers as the member has, at the member's offsets. Matrices: HLSL's column_major shows as RowMajor
/// in the SPIR-V, its element (row, column) lies at column * stride + 4 * row: the transpose of the row-vector matrix, as in a Direct3D 11
/// constant buffer.
void pack(const BlockMember& member, std::span<const double> value, std::span<std::byte> block);
/// TG4019 when the member and the parameter differ in shape.
[[nodiscard]] Result<void> pack(const BlockMember& member, const Parameter& parameter, const Numbers& value, std::span<std::byte> block);

} // namespace tegument::run
