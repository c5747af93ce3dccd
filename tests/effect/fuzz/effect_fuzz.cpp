// Any bytes are an effect file: it loads or reports errors; it never crashes, hangs or eats memory. What loads is also run.
// An input holds the main file and, behind a line "//---", the text that every include gives.

#include "tests/effect/support.h"

#include <cstdint>
#include <cstdlib>

namespace {

using namespace std::string_view_literals;

/// Scripts may draw for a long time; a few thousand calls show all that can go wrong.
class Bounded : public tegument::test::Log {
    tegument::Result<void> draw(const tegument::Pass&, tegument::DrawKind, const tegument::ScriptState&) override {
        if (++draws_ > 1000) return tegument::inputError(4001, {}, "enough");
        return {};
    }
    tegument::Result<void> targetsChanged(const tegument::BoundTargets&) override {
        if (++draws_ > 1000) return tegument::inputError(4001, {}, "enough");
        return {};
    }
    void write(const tegument::Parameter& parameter, double value) override { values[parameter.name] = value; }
    int draws_ = 0;
};

void require(bool condition) {
    if (!condition) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    const std::size_t border = input.find("\n//---\n"sv);
    const std::string text(input.substr(0, border));
    const std::string include(border == std::string_view::npos ? ""sv : input.substr(border + 7));
    const auto read = [&](const std::filesystem::path& path) -> tegument::Result<std::string> {
        return path == "main.fx" ? text : include;
    };
    const tegument::Result<tegument::Effect> effect = tegument::loadEffect("main.fx", {}, read);
    if (!effect) {
        require(!effect.error().diagnostics.empty());
        for (const tegument::Diagnostic& diagnostic : effect.error().diagnostics) {
            require(diagnostic.code >= 1001 && diagnostic.code < 2400 && !diagnostic.text.empty());
            require(!tegument::format(diagnostic).empty());
        }
        return 0;
    }
    (void)tegument::direct3D9Intrinsic(*effect);
    Bounded sink;
    (void)tegument::runScripts(*effect, "", sink);
    return 0;
}
