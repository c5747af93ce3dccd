// Lights other than one that stands far away with its pyramid fitted to the mesh: parallel, with a map smaller than the mesh, near by.

#include "lab/verify/scene.h"
#include "tests/lab/verify/fixture.h"

#include <functional>

using namespace tegument;
using namespace tegument::test;

namespace {

struct LightCase {
    const char* name;
    std::function<void(Light&)> change;
};

/// The body is 40 x 80 mm, its bounding sphere 45 mm wide about the origin; the usual light stands at (-330, 280, 420).
const std::vector<LightCase>& lights() {
    static const std::vector<LightCase> kLights = {{"parallel", [](Light& light) { light.direction = glm::vec3(330, -280, -420); }},
                                                   {"parallel_narrow",
                                                    [](Light& light) {
                                                        light.direction = glm::vec3(330, -280, -420);
                                                        light.width = 36.0F;
                                                    }},
                                                   {"narrow", [](Light& light) { light.fov = 4.0F; }},
                                                   {"wide",
                                                    [](Light& light) {
                                                        light.position = {-20, 16, 46};
                                                    }}, // opens by 110 degrees: most of it is far off its axis
                                                   {"inside", [](Light& light) {
                                                        light.position = {-12, 10, 28};
                                                    }}};
    return kLights;
}

struct LitModule {
    const LightCase* light;
    const char* module;
    const char* setting;
};

void PrintTo(const LitModule& c, std::ostream* out) {
    *out << c.light->name << ", " << c.module << ", " << c.setting;
}

std::vector<LitModule> litModules() {
    std::vector<LitModule> all;
    for (const LightCase& light : lights())
        for (const char* module : {"TSM", "ShadowMap", "Specular", "Irradiance"})
            all.push_back({&light, module, "corrected"});
    for (const char* module : {"TSM", "ShadowMap"}) // maps of z/w
        all.push_back({&lights().front(), module, "seed"});
    return all;
}

class Lights : public Verify, public testing::WithParamInterface<LitModule> {};

} // namespace

TEST_P(Lights, are_what_the_reference_says) {
    const LitModule& c = GetParam();
    verify::Scene scene = verify::sceneOf({});
    c.light->change(scene.workspace.light);
    constexpr int kSize = 192;
    expectPass(verifyModule(*device_, c.module,
                            {.setting = c.setting,
                             .compiler = defaultCompiler(),
                             .mapSize = kSize,
                             .pictureSize = kSize,
                             .mesh = &scene.mesh,
                             .workspace = &scene.workspace}));
}

INSTANTIATE_TEST_SUITE_P(All, Lights, testing::ValuesIn(litModules()), [](const auto& each) {
    return std::string(each.param.light->name) + "_" + each.param.module + "_" + each.param.setting;
});
