// Presets beside an effect: read in order, and refused with the place.
#include "host/scene/presets.h"
#include "tests/mesh/files.h"

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

class Presets : public SceneFiles {
protected:
    /// code(line) of the only diagnostic.
    [[nodiscard]] std::string faultOf(const std::string& text) const {
        const auto presets = parsePresets(text, folder_ / "A.presets.json");
        if (presets) return "accepted";
        const Diagnostic& d = presets.error().diagnostics.front();
        return std::to_string(d.code) + "(" + std::to_string(d.at.line) + ")";
    }
};

} // namespace

TEST_F(Presets, arrive_in_the_order_of_the_file) {
    write("A.presets.json", R"({ "comment": ["any", 1],
      "old": { "comment": "thin", "parameters": { "gMix": 0.5, "gTint": [1, 2, 3], "gUse": true } },
      "a new one": { "parameters": {} } })");
    const auto presets = loadPresets(folder_ / "A.fx");
    ASSERT_TRUE(presets) << format(presets.error());
    ASSERT_EQ(presets->size(), 2U);
    EXPECT_EQ(presets->front().name, "old");
    EXPECT_EQ(presets->front().comment, "thin");
    EXPECT_EQ(presets->front().parameters.at("gTint"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(presets->front().parameters.at("gUse"), std::vector<double>{1});
    EXPECT_EQ(presets->front().at.line, 2);
    EXPECT_EQ(presets->back().name, "a new one");
}

TEST_F(Presets, of_an_effect_without_such_a_file_are_none) {
    const auto presets = loadPresets(folder_ / "B.fx");
    ASSERT_TRUE(presets);
    EXPECT_TRUE(presets->empty());
}

TEST_F(Presets, that_are_wrong_are_refused_with_code_and_line) {
    EXPECT_EQ(faultOf("{ \"a\": {\n \"parameter\": {} } }"), "5401(2)");
    EXPECT_EQ(faultOf("{ \"a\":\n 3 }"), "5402(1)");
    EXPECT_EQ(faultOf("{ \"a\": { \"parameters\": {\n \"gMix\": \"much\" } } }"), "5402(2)");
    EXPECT_EQ(faultOf("{ \"a\": { \"parameters\": {\n \"gMix\": [1, \"2\"] } } }"), "5402(2)");
    EXPECT_EQ(faultOf("{ \"a\": {},\n \"a\": {} }"), "5404(2)");
    EXPECT_EQ(faultOf("[]"), "5402(1)");
    EXPECT_EQ(faultOf("{"), "5400(1)");
}
