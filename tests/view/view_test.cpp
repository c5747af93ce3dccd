// What the viewer does without a window: camera and light, watched files, steps through passes and targets, how targets are shown.

#include "host/run/semantics.h"
#include "tools/view/keys.h"
#include "tools/view/layout.h"
#include "tools/view/levels.h"
#include "tools/view/light_handles.h"
#include "tools/view/orbit.h"
#include "tools/view/panel.h"
#include "tools/view/picture_area.h"
#include "tools/view/state.h"
#include "tools/view/watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <set>

namespace tegument::view {

namespace {

namespace fs = std::filesystem;

constexpr double kFloat = 1e-3; // mm; positions of 500 mm are floats of 3e-5 mm, turned a few times

Camera frontCamera() {
    return {.position = {0, 0, 500}, .target = {0, 0, 0}, .up = {0, 1, 0}};
}

double distanceOf(const Camera& camera) {
    return glm::length(glm::dvec3(camera.position) - glm::dvec3(camera.target));
}

struct Folder {
    Folder() : path(fs::temp_directory_path() / ("tegument-watch-" + std::to_string(std::random_device{}()))) {
        fs::create_directories(path);
    }
    ~Folder() { fs::remove_all(path); }
    fs::path path;

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return path / name;
    }
};

SessionFrame frameOf(std::vector<std::string> passes) {
    SessionFrame frame{.technique = "A", .targets = {"gFirstMap", "gSecondMap"}};
    for (std::string& name : passes)
        frame.passes.push_back({.name = std::move(name), .targets = {"gFirstMap"}});
    return frame;
}

ViewState stateOf(const SessionFrame& frame) {
    ViewState state;
    state.techniques = {"A", "B"};
    adopt(state, frame);
    return state;
}

Image imageOf(int channels, std::vector<float> pixels) {
    const int width = static_cast<int>(pixels.size()) / channels;
    return {.width = width, .height = 1, .channels = channels, .pixels = std::move(pixels)};
}

} // namespace

TEST(Orbit, keeps_the_distance_and_a_quarter_turn_ends_at_the_side) {
    Camera camera = frontCamera();
    orbit(camera, 1.57079632679, 0);
    EXPECT_NEAR(camera.position.x, 500, kFloat);
    EXPECT_NEAR(camera.position.z, 0, kFloat);
    orbit(camera, -0.7, 0.3);
    EXPECT_NEAR(distanceOf(camera), 500, kFloat);
}

TEST(Orbit, rises_by_the_angle_asked_for_and_stops_short_of_the_pole) {
    Camera camera = frontCamera();
    orbit(camera, 0, 0.5);
    EXPECT_NEAR(camera.position.y, 500 * std::sin(0.5), kFloat);
    orbit(camera, 0, 10);
    EXPECT_LT(camera.position.y, 500.0F);
    EXPECT_GT(camera.position.y, 499.0F);
    EXPECT_TRUE(std::isfinite(axesOf(camera).right.x));
}

TEST(Orbit, light_in_front_follows_the_mouse) {
    Light light{.position = {0, 0, 400}};
    orbitLight(light, frontCamera(), 0.2, 0.1);
    EXPECT_GT(light.position.x, 0.0F);
    EXPECT_GT(light.position.y, 0.0F);
    EXPECT_NEAR(glm::length(glm::dvec3(light.position)), 400, kFloat);
}

TEST(Orbit, pan_by_the_pictures_width_moves_the_edge_to_the_middle) {
    Camera camera = frontCamera();
    camera.horizontalFov = 40;
    pan(camera, 0.5, 0);
    EXPECT_NEAR(camera.target.x, 500 * std::tan(0.5 * 40 * 3.14159265358979 / 180), kFloat);
    EXPECT_NEAR(camera.position.x, camera.target.x, kFloat);
}

TEST(Orbit, dolly_neither_passes_the_target_nor_loses_it) {
    Camera camera = frontCamera();
    for (int i = 0; i < 1000; ++i)
        dolly(camera, 0.5);
    EXPECT_GT(distanceOf(camera), 0);
    EXPECT_TRUE(std::isfinite(distanceOf(camera)));
    for (int i = 0; i < 1000; ++i)
        dolly(camera, 2);
    EXPECT_TRUE(std::isfinite(distanceOf(camera)));
}

TEST(FileWatch, sees_writing_renaming_over_removing_and_coming_back_once_each) {
    const Folder folder;
    const fs::path file = folder.write("a.fxh", "one");
    FileWatch watch;
    watch.watch({file});
    EXPECT_FALSE(watch.changed());
    folder.write("a.fxh", "longer");
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
    fs::rename(folder.write("new", "third version"), file);
    EXPECT_TRUE(watch.changed());
    fs::remove(file);
    EXPECT_TRUE(watch.changed());
    folder.write("a.fxh", "back");
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
}

TEST(FileWatch, a_change_while_the_list_is_renewed_is_not_lost) {
    const Folder folder;
    const fs::path file = folder.write("a.fxh", "one");
    FileWatch watch;
    watch.watch({file});
    folder.write("a.fxh", "changed while it was being compiled");
    watch.watch({file, folder.write("b.fxh", "two")});
    EXPECT_TRUE(watch.changed());
}

TEST(Steps, passes_go_round_and_come_back) {
    const SessionFrame frame = frameOf({"P1", "P2", "P3"});
    ViewState state = stateOf(frame);
    EXPECT_EQ(passCount(state), kAllPasses);
    const ViewState start = state;
    for (const std::size_t expected : {1U, 2U, 3U, 1U}) {
        EXPECT_EQ(apply(state, Command::NextPass, start), Request::Draw);
        EXPECT_EQ(passCount(state), expected);
    }
    EXPECT_EQ(apply(state, Command::PreviousPass, start), Request::Draw);
    EXPECT_EQ(passCount(state), 3U);
    EXPECT_EQ(shownTarget(state, frame), "gFirstMap");
    EXPECT_EQ(shownText(state, frame), "pass 3 of 3, P3 into gFirstMap");
    EXPECT_EQ(apply(state, Command::Picture, start), Request::Draw);
    EXPECT_EQ(shownTarget(state, frame), "");
}

TEST(Steps, what_the_new_frame_does_not_have_is_not_shown) {
    ViewState state = stateOf(frameOf({"P1", "P2", "P3"}));
    const ViewState start = state;
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(apply(state, Command::NextPass, start), Request::Draw);
    const SessionFrame shorter = frameOf({"P1"});
    adopt(state, shorter);
    EXPECT_EQ(state.show, Show::Picture);
    EXPECT_EQ(shownTarget(state, shorter), "");
}

TEST(Steps, techniques_and_settings_go_round) {
    ViewState state = stateOf(frameOf({"P1"}));
    const ViewState start = state;
    EXPECT_EQ(apply(state, Command::PreviousTechnique, start), Request::Draw);
    EXPECT_EQ(state.technique, "B");
    EXPECT_EQ(apply(state, Command::NextTechnique, start), Request::Draw);
    EXPECT_EQ(state.technique, "A");
    EXPECT_EQ(apply(state, Command::NextSetting, start), Request::None) << "an effect without settings";
    state.settings = {"low", "middle", "high"};
    state.setting = "high";
    for (const char* expected : {"low", "middle", "high"}) {
        EXPECT_EQ(apply(state, Command::NextSetting, start), Request::Load);
        EXPECT_EQ(state.setting, expected);
    }
}

TEST(Steps, an_effect_without_passes_or_targets_is_stepped_through_without_harm) {
    ViewState state;
    const ViewState start = state;
    for (const Command command : {Command::NextTechnique, Command::NextPass, Command::PreviousPass, Command::NextTarget})
        EXPECT_EQ(apply(state, command, start), Request::None);
}

TEST(Orbit, turns_parallel_light_as_it_would_turn_a_lamp_far_away) {
    const Camera camera = frontCamera();
    Light lamp{.position = {100, 300, 800}};
    Light sun;
    sun.direction = -lamp.position;
    orbitLight(lamp, camera, 0.4, -0.2);
    orbitLight(sun, camera, 0.4, -0.2);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR((*sun.direction)[axis], -lamp.position[axis], kFloat) << axis;
}

TEST(SceneInTheWorld, is_the_same_in_metres) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {200, 0, 0}, {0, 150, 90}};
    computeBounds(mesh);
    const SessionScene scene{.mesh = &mesh};
    Workspace workspace;
    const Workspace millimetres = run::inWorld(workspace, scene);
    workspace.worldUnitMm = 1000;
    const Workspace metres = run::inWorld(workspace, scene);
    EXPECT_EQ(metres.camera.position, millimetres.camera.position) << "a workspace holds millimetres";
    EXPECT_EQ(metres.light.position, millimetres.light.position);
    EXPECT_NEAR(glm::length(millimetres.camera.position - mesh.bounds.centre), 5 * mesh.bounds.radius, kFloat);
    EXPECT_FALSE(metres.camera.nearPlane) << "to be fitted anew wherever the camera goes";
}

TEST(Presets, are_laid_over_what_was_given_and_leave_nothing_of_each_other) {
    ViewState state;
    state.presets = {{.name = "dry", .parameters = {{"gA", {1}}}}, {.name = "oily", .parameters = {{"gB", {2}}}}};
    state.parameters = {{"gA", {5}}, {"gC", {7}}};
    const ViewState start = state;
    EXPECT_EQ(apply(state, Command::NextPreset, start), Request::Draw);
    EXPECT_EQ(state.preset, "dry");
    EXPECT_EQ(state.parameters, (std::map<std::string, std::vector<double>>{{"gA", {1}}, {"gC", {7}}}));
    state.parameters["gA"] = {3}; // a slider
    EXPECT_EQ(apply(state, Command::NextPreset, start), Request::Draw);
    EXPECT_EQ(state.parameters, (std::map<std::string, std::vector<double>>{{"gA", {5}}, {"gB", {2}}, {"gC", {7}}}));
    EXPECT_EQ(apply(state, Command::NextPreset, start), Request::Draw);
    EXPECT_EQ(state.preset, "") << "behind the last one: as at the start";
    EXPECT_EQ(state.parameters, start.parameters);
    choosePreset(state, "oily", start);
    EXPECT_EQ(apply(state, Command::Reset, start), Request::Draw);
    EXPECT_EQ(state.parameters, start.parameters);
    ViewState none;
    EXPECT_EQ(apply(none, Command::NextPreset, none), Request::None);
}

TEST(Surroundings, turn_about_the_vertical_where_the_effect_has_them_and_are_light_that_moves) {
    ViewState state;
    const Input drag{.surroundings = 0.75};
    EXPECT_FALSE(apply(state, drag)) << "nothing to turn";
    state.read = {"gSurroundingsTurn"};
    state.workspace.parameters["gSurroundingsTurn"] = {90};
    EXPECT_TRUE(movesLight(drag));
    EXPECT_TRUE(apply(state, drag));
    EXPECT_NEAR(state.parameters.at("gSurroundingsTurn").front(), 90 + 0.75 * 180 - 360, 1e-9) << "within what its slider has";
    EXPECT_TRUE(apply(state, {.surroundings = -0.75}));
    EXPECT_NEAR(state.parameters.at("gSurroundingsTurn").front(), 90, 1e-9) << "what was dragged last, not the workspace";
}

TEST(Views, of_the_digits_are_those_of_other_programs_and_as_far_as_before) {
    ViewState state;
    state.workspace.camera = {.position = {100, 200, 300}, .target = {0, 50, 0}, .up = {0, 1, 0}};
    const double distance = distanceOf(state.workspace.camera);
    const ViewState start = state;
    const auto back = [&](char32_t key) {
        const auto command = commandOf(key);
        EXPECT_TRUE(command);
        EXPECT_EQ(apply(state, *command, start), Request::Move);
        EXPECT_NEAR(distanceOf(state.workspace.camera), distance, kFloat);
        EXPECT_EQ(state.workspace.camera.target, start.workspace.camera.target);
        return axesOf(state.workspace.camera).back;
    };
    EXPECT_NEAR(back(U'1').z, 1, 1e-6);
    EXPECT_NEAR(back(U'3').x, 1, 1e-6);
    EXPECT_GT(back(U'7').y, 0.999);
    const auto right = axesOf(state.workspace.camera).right;
    EXPECT_NEAR(right.x, 1, 1e-3) << "from above, right is right";
}

TEST(Mouse, a_drag_that_dollies_is_nearer_to_the_right_and_up_and_undone_by_its_opposite) {
    ViewState state;
    state.workspace.camera = frontCamera();
    EXPECT_TRUE(apply(state, {.dolly = 0.2}));
    EXPECT_LT(distanceOf(state.workspace.camera), 400);
    EXPECT_TRUE(apply(state, {.dolly = -0.2}));
    EXPECT_NEAR(distanceOf(state.workspace.camera), 500, kFloat);
}

namespace {

Result<Effect> sliders() {
    const Folder folder;
    return loadEffect(folder.write(
        "sliders.fx", "float gCount < string UIWidget = \"Slider\"; float UIMin = 1; float UIMax = 64; float UIStep = 1; > = 4;\n"
                      "float gShare < string UIWidget = \"Slider\"; float UIMin = 0; float UIMax = 1; float UIStep = 0.01; > = 0.5;\n"
                      "float gSwitch < string UIWidget = \"CheckBox\"; > = 0;\n"
                      "int gBlurs < string UIWidget = \"Slider\"; int UIMin = 1; int UIMax = 6; > = 3;\n"
                      "float gHalves < string UIWidget = \"Slider\"; float UIMin = 0; float UIMax = 4; float UIStep = 0.5; > = 1;\n"
                      "float gInner < string UIWidget = \"None\"; > = 1;\n"
                      "technique None { pass P { } }\n"));
}

} // namespace

TEST(Panels, stand_inside_the_window_and_none_covers_another_or_the_picture) {
    const auto apart = [](const Area& a, const Area& b) {
        return a.width == 0 || a.height == 0 || b.width == 0 || b.height == 0 || a.x + a.width <= b.x || b.x + b.width <= a.x ||
               a.y + a.height <= b.y || b.y + b.height <= a.y;
    };
    for (const float width : {1.0F, 160.0F, 320.0F, 900.0F, 3840.0F})
        for (const float height : {1.0F, 120.0F, 240.0F, 900.0F})
            for (const float em : {14.0F, 28.0F})
                for (int shown = 0; shown < 64; ++shown) {
                    const Panels panels{.em = em,
                                        .frame = (shown & 1) != 0,
                                        .controls = (shown & 2) != 0,
                                        .sheets = (shown & 4) != 0,
                                        .strip = (shown & 8) != 0,
                                        .source = (shown & 16) != 0,
                                        .problem = (shown & 32) != 0 ? 0.3F * height : 0};
                    const Layout layout = arrange(width, height, panels);
                    const std::vector<Area> all = {layout.bar,     layout.controls, layout.sheets, layout.strip,
                                                   layout.problem, layout.status,   layout.source, layout.picture};
                    for (std::size_t i = 0; i < all.size(); ++i) {
                        for (std::size_t j = 0; j < i; ++j)
                            EXPECT_TRUE(apart(all[i], all[j])) << width << "x" << height << " " << shown << ": " << i << " and " << j;
                        EXPECT_GE(all[i].x, 0);
                        EXPECT_GE(all[i].y, 0);
                        EXPECT_LE(all[i].x + all[i].width, width);
                        EXPECT_LE(all[i].y + all[i].height, height);
                    }
                    if (width < 100 || height < 100) continue;
                    const float beside = panels.source ? 0.5F * width : width;
                    EXPECT_GE(layout.picture.width, 0.39F * beside);
                    EXPECT_GE(layout.picture.height, height / 6);
                }
}

TEST(Panels, stand_side_by_side_where_there_is_room_and_what_was_opened_last_goes_before_the_controls) {
    const Panels both{.em = 14, .controls = true, .sheets = true};
    EXPECT_GT(arrange(1280, 800, both).controls.width, 0);
    EXPECT_GT(arrange(1280, 800, both).sheets.width, 0);
    EXPECT_EQ(arrange(640, 320, both).controls.width, 0);
    EXPECT_GT(arrange(640, 320, both).sheets.width, 0);
    EXPECT_EQ(arrange(2560, 1600, {.em = 28, .controls = true}).controls.width,
              2 * arrange(1280, 800, {.em = 14, .controls = true}).controls.width);
}

TEST(PictureInTheWindow, shows_at_least_as_much_of_the_scene_in_width_and_in_height_as_was_asked_for) {
    Workspace workspace;
    workspace.camera.horizontalFov = 30;
    const double half = std::tan(glm::radians(15.0));
    for (const double shape : {0.5, 1.0, 16.0 / 9}) {
        const PictureArea area{.shape = shape};
        for (const PixelSize size : {PixelSize{300, 900}, {640, 640}, {1920, 1080}, {3000, 200}}) {
            const double seen = std::tan(glm::radians(0.5 * static_cast<double>(area.seen(workspace, size).camera.horizontalFov)));
            const double high = seen * size.height / size.width;
            EXPECT_GE(seen, half - 1e-6);
            EXPECT_GE(high, half / shape - 1e-6);
            EXPECT_NEAR(std::min(seen / half, high / (half / shape)), 1, 1e-5) << "and of one of them no more";
        }
    }
}

TEST(LightHandles, stand_where_the_light_is_seen_or_at_the_edge_and_are_turned_as_the_mouse_moves) {
    const auto effect = sliders();
    ASSERT_TRUE(effect) << format(effect.error());
    ViewState state;
    state.workspace.camera = {.position = {0, 0, 500}, .target = {0, 0, 0}, .up = {0, 1, 0}, .horizontalFov = 60};
    state.workspace.light.position = {50, 80, 100};
    const auto handle = [&] { return lightHandles(state, *effect, state.workspace, 1).front(); };
    const double most = 400 * std::tan(glm::radians(30.0));
    EXPECT_NEAR(handle().place.x, 0.5 + 0.5 * 50 / most, 1e-5);
    EXPECT_NEAR(handle().place.y, 0.5 - 0.5 * 80 / most, 1e-5);
    EXPECT_FALSE(handle().outside);
    EXPECT_FALSE(handle().behind);
    const LightHandle before = handle();
    turnLight(state, *effect, before, {0.05, 0});
    EXPECT_GT(handle().place.x, before.place.x);
    turnLight(state, *effect, before, {-0.05, 0.05});
    EXPECT_LT(handle().place.y, before.place.y);
    state.workspace.light.position = {0, 0, -300};
    EXPECT_TRUE(handle().behind);
    state.workspace.light.position = {4000, 10, 900}; // behind the camera
    EXPECT_TRUE(handle().outside);
    EXPECT_NEAR(handle().place.x, 0.96, 1e-6);
    state.workspace.light.direction = glm::vec3(0, -1, 0);
    EXPECT_NEAR(handle().place.x, 0.5, 1e-6);
    EXPECT_LT(handle().place.y, 0.2);
    EXPECT_FALSE(handle().outside);
}

TEST(FileDialogs, list_folders_and_files_of_their_kind_and_take_what_is_there) {
    const Folder folder;
    fs::create_directories(folder.path / "sub");
    for (const char* name : {"a.obj", "b.json", "c.txt", "sub/d.obj"})
        (void)folder.write(name, "x");
    FileDialog dialog;
    dialog.open(FileUse::Mesh, folder.path);
    ASSERT_EQ(dialog.entries.size(), 2U);
    EXPECT_EQ(dialog.entries[0].name, "sub");
    EXPECT_EQ(dialog.entries[1].name, "a.obj");
    dialog.typed = "nowhere.obj";
    EXPECT_TRUE(dialog.choose().empty());
    EXPECT_FALSE(dialog.problem.empty());
    dialog.typed = "sub";
    EXPECT_TRUE(dialog.choose().empty());
    EXPECT_EQ(dialog.folder, folder.path / "sub");
    dialog.typed = "..";
    EXPECT_TRUE(dialog.choose().empty());
    EXPECT_EQ(dialog.folder.lexically_normal(), folder.path.lexically_normal());
    dialog.typed = "a.obj";
    EXPECT_EQ(dialog.choose(), folder.path / "a.obj");
    dialog.open(FileUse::SaveWorkspace, folder.path);
    dialog.typed = "new";
    EXPECT_EQ(dialog.choose(), folder.path / "new.json");
    dialog.typed = "b.json";
    EXPECT_TRUE(dialog.choose().empty()) << "it is there: asked once more";
    EXPECT_EQ(dialog.choose(), folder.path / "b.json");
    dialog.typed = "none/new";
    EXPECT_TRUE(dialog.choose().empty());
}

TEST(Sliders, of_whole_numbers_are_those_whose_type_or_steps_are_whole) {
    const auto effect = sliders();
    ASSERT_TRUE(effect) << format(effect.error());
    std::vector<std::string> whole;
    for (const Parameter& parameter : effect->parameters)
        if (isWhole(parameter)) whole.push_back(parameter.name);
    EXPECT_EQ(whole, (std::vector<std::string>{"gCount", "gBlurs"}));
}

TEST(Sliders, are_those_that_make_a_difference_to_the_frame) {
    const auto effect = sliders();
    ASSERT_TRUE(effect) << format(effect.error());
    ViewState state;
    state.read = {"gBlurs", "gInner", "gShare"};
    std::vector<std::string> shown;
    for (const Parameter* parameter : slidersOf(state, *effect))
        shown.push_back(parameter->name);
    EXPECT_EQ(shown, (std::vector<std::string>{"gShare", "gBlurs"}));
}

TEST(Sliders, of_others_are_numbers_without_one_and_each_has_a_group) {
    const auto effect = sliders();
    ASSERT_TRUE(effect) << format(effect.error());
    ViewState state;
    state.read = {"gBlurs", "gInner", "gShare"};
    const auto others = othersOf(state, *effect);
    ASSERT_EQ(others.size(), 1U);
    EXPECT_EQ(others.front()->name, "gInner");
    EXPECT_EQ(groupOf(*others.front()), "Sliders");
}

TEST(Keys, each_is_bound_once_and_the_help_names_every_one) {
    std::set<char32_t> keys;
    const std::string help = bindingsHelp();
    for (const KeyBinding& binding : keyBindings()) {
        EXPECT_TRUE(keys.insert(binding.key).second) << binding.label;
        EXPECT_EQ(commandOf(binding.key), binding.command);
        EXPECT_NE(help.find(binding.text), std::string::npos) << binding.text;
    }
    EXPECT_EQ(commandOf(U'~'), std::nullopt);
}

TEST(LevelsOfATarget, light_is_shown_as_the_picture_is) {
    const Levels levels = levelsOf(imageOf(4, {0.1F, 0.2F, 0.3F, 1, 0.9F, 0.5F, 0.4F, 1}));
    EXPECT_TRUE(levels.toneMap);
    EXPECT_EQ(levels.scale[0], 1.0F);
}

TEST(LevelsOfATarget, depth_and_texture_coordinates_are_each_spread_on_their_own) {
    std::vector<float> pixels(4, 0.0F); // nothing was drawn there
    for (int i = 0; i <= 100; ++i) {
        const float share = static_cast<float>(i) / 100.0F;
        pixels.insert(pixels.end(), {600 + 100 * share, share, 1 - share, 1});
    }
    const Levels levels = levelsOf(imageOf(4, pixels));
    EXPECT_FALSE(levels.toneMap);
    // 1 % at each end may clip
    EXPECT_NEAR(601 * levels.scale[0] + levels.offset[0], 0, 1e-3);
    EXPECT_NEAR(699 * levels.scale[0] + levels.offset[0], 1, 1e-3);
    EXPECT_NEAR(0.99F * levels.scale[1] + levels.offset[1], 1, 1e-3);
}

TEST(LevelsOfATarget, nan_infinity_and_an_empty_target_leave_finite_levels) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const Image& image :
         {imageOf(1, {nan, inf, 5, 7}), imageOf(1, {nan}), imageOf(4, std::vector<float>(16, 0.0F)), imageOf(1, {3, 3})})
        for (const float value : levelsOf(image).scale)
            EXPECT_TRUE(std::isfinite(value));
}

TEST(LevelsOfATarget, one_stop_is_twice_the_light) {
    const Levels levels = brightened(Levels{.scale = {1, 2, 3, 1}, .offset = {0, -1, 0, 0}}, 1);
    EXPECT_EQ(levels.scale, (std::array<float, 4>{2, 4, 6, 1}));
    EXPECT_EQ(levels.offset, (std::array<float, 4>{0, -2, 0, 0}));
}

} // namespace tegument::view
