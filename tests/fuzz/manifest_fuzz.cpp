// Any bytes are a manifest for docs/samples/player: read, and every technique played.

#include "docs/samples/player/manifest.h"

#include <cstdint>
#include <cstdlib>
#include <map>

namespace {

class FuzzedEngine : public script_player::Engine {
public:
    explicit FuzzedEngine(const script_player::Json& manifest) {
        for (const script_player::Json& parameter : manifest.at("parameters").list())
            values_[parameter.at("name").text()] = script_player::defaultOf(parameter);
    }

    void setTargets(const script_player::Targets&) override { bound_ = true; }
    void clear(script_player::Clear what, std::optional<std::size_t> place, const std::vector<float>& value) override {
        const std::size_t least = what == script_player::Clear::Color ? 4 : 1;
        if (!bound_ || value.size() < least || place.value_or(0) >= script_player::kColors) std::abort();
    }
    void draw(const script_player::Pass&, script_player::Draw) override {
        if (!bound_) std::abort();
        if (++draws_ > 100000) throw std::runtime_error("long enough");
    }
    script_player::Value value(const std::string& parameter) override { return values_[parameter]; }
    void setNumber(const std::string& parameter, float number) override { values_[parameter].numbers = {number}; }
    void external() override {}

private:
    std::map<std::string, script_player::Value> values_;
    bool bound_ = false;
    int draws_ = 0;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const script_player::Json manifest = script_player::readManifest({reinterpret_cast<const char*>(data), size});
        for (const script_player::Json& technique : manifest.at("techniques").list()) {
            FuzzedEngine engine(manifest);
            script_player::play(script_player::techniqueOf(manifest, technique.at("name").text()), engine);
        }
    } catch (const std::runtime_error&) { // what is wrong with it
    }
    return 0;
}
