#pragma once
// The numbers that the effect's parameters have: --set, then the workspace, then semantics, then the effect's defaults.

#include "host/effect/model.h"
#include "host/run/semantics.h"
#include "host/support/result.h"

#include <map>
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

} // namespace tegument::run
