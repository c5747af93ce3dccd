// Starting a device, and what it says when it cannot.

#include "tests/gpu/fixture.h"

#include "shaders/color_frag.h"
#include "shaders/mesh_vert.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

namespace tegument::gpu {
namespace {

/// Sets an environment variable and puts it back.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        ::setenv(name, value, 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() {
        if (old_)
            ::setenv(name_, old_->c_str(), 1);
        else
            ::unsetenv(name_);
    }

private:
    const char* name_;
    std::optional<std::string> old_;
};

TEST(DeviceStart, without_any_driver_is_a_machine_error_that_names_the_package) {
    const Environment driver("VK_DRIVER_FILES", "/nonexistent/driver.json");
    const Environment icd("VK_ICD_FILENAMES", "/nonexistent/driver.json");
    const auto made = Device::create();
    if (codeOf(made) == 6001) GTEST_SKIP() << "no Vulkan loader";
    ASSERT_EQ(codeOf(made), 6002);
    EXPECT_EQ(made.error().blame, Blame::Machine);
    EXPECT_NE(format(made.error()).find("mesa-vulkan-drivers"), std::string::npos) << format(made.error());
}

TEST(DeviceStart, without_the_validation_layer_is_an_error_only_when_validation_is_asked_for) {
    const Environment layers("VK_LAYER_PATH", "/nonexistent");
    const auto validated = Device::create({.validation = true});
    if (codeOf(validated) == 6001) GTEST_SKIP() << "no Vulkan loader";
    ASSERT_EQ(codeOf(validated), 6003);
    EXPECT_NE(format(validated.error()).find("vulkan-validationlayers"), std::string::npos) << format(validated.error());
    EXPECT_NE(codeOf(Device::create()), 6003);
}

/// Libraries that are mapped into this process.
std::set<std::string> libraries() {
    std::set<std::string> names;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);)
        if (const auto name = line.find('/'); name != std::string::npos && line.find(".so", name) != std::string::npos)
            names.insert(line.substr(name));
    return names;
}

TEST(DeviceStart, a_driver_that_two_devices_had_stays_open) {
    if (const auto first = Device::create(); !first) GTEST_SKIP() << format(first.error());
    std::set<std::string> open;
    {
        const Device second = must(Device::create());
        open = libraries();
    }
    const std::set<std::string> after = libraries();
    EXPECT_FALSE(open.empty());
    for (const std::string& name : open)
        EXPECT_TRUE(after.contains(name)) << name << ": some drivers can be opened a few dozen times by a process only";
}

TEST_F(Gpu, an_unknown_device_name_is_an_error_that_lists_the_names_there_are) {
    const auto made = Device::create({.prefer = "no such device"});
    ASSERT_EQ(codeOf(made), 6004);
    EXPECT_NE(format(made.error()).find(device().info().name), std::string::npos) << format(made.error());
}

TEST_F(Gpu, a_device_name_with_a_slip_is_answered_with_the_word_that_was_meant) {
    const std::string& name = device().info().name;
    const std::string word = name.substr(0, name.find_first_of(" ("));
    ASSERT_GT(word.size(), 3U) << name;
    const auto made = Device::create({.prefer = word + word.back()});
    ASSERT_EQ(codeOf(made), 6004);
    EXPECT_NE(format(made.error()).find("did you mean '" + word + "'?"), std::string::npos) << format(made.error());
}

TEST_F(Gpu, the_environment_chooses_the_device_when_the_options_do_not) {
    const Environment variable("TEGUMENT_DEVICE", "no such device");
    EXPECT_EQ(codeOf(Device::create()), 6004);
    EXPECT_EQ(codeOf(Device::create({.prefer = device().info().name})), 0);
}

TEST_F(Gpu, a_device_is_found_by_part_of_its_name_ignoring_case) {
    std::string part = device().info().name.substr(1, 5);
    std::ranges::transform(part, part.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
    EXPECT_EQ(must(Device::create({.prefer = part})).info().name, device().info().name);
}

TEST_F(Gpu, a_number_behind_a_name_counts_the_devices_that_have_it) {
    const std::string& name = device().info().name;
    EXPECT_EQ(must(Device::create({.prefer = name + "#1"})).info().name, name);
    EXPECT_EQ(codeOf(Device::create({.prefer = name + "#99"})), 6004);
    EXPECT_EQ(codeOf(Device::create({.prefer = name + "#0"})), 6004) << "no number: part of a name";
}

TEST_F(Gpu, the_device_names_itself_its_driver_and_its_version) {
    EXPECT_FALSE(device().info().name.empty());
    EXPECT_FALSE(device().info().driver.empty());
    EXPECT_EQ(device().info().apiVersion.substr(0, 2), "1.");
}

TEST_F(Gpu, validation_messages_are_collected) {
    messagesExpected = true;
    // The vertex shader reads two attributes, and the pipeline feeds none.
    PipelineDesc desc = screen(color_frag, {}, {Format::RGBA32F});
    desc.vertex = {.spirv = mesh_vert, .entry = "main"};
    must(device().createPipeline(desc));
    EXPECT_FALSE(device().validationMessages().empty());
}

TEST_F(Gpu, destroyed_textures_and_buffers_give_their_memory_back) {
    const std::uint64_t before = device().allocatedBytes();
    {
        const Texture image = target(Format::RGBA32F, 64, 64);
        const Buffer buffer = must(device().createBuffer(BufferUsage::Storage, bytesOf(std::vector<float>(1000))));
        EXPECT_GE(device().allocatedBytes(), before + 64 * 64 * 16 + 4000);
    }
    EXPECT_EQ(device().allocatedBytes(), before);
}

TEST_F(Gpu, a_second_device_that_ends_leaves_the_first_as_it_is) {
    Texture first = target(Format::RGBA8, 4, 4);
    {
        Device second = must(Device::create());
        Texture image = must(second.createTexture({.name = "second", .width = 4, .height = 4, .renderTarget = true}));
        must(second.run([&](Recorder& recorder) { return recorder.clearColor(image, {1, 1, 1, 1}); }));
    }
    must(device().run([&](Recorder& recorder) { return recorder.clearColor(first, {1, 0, 0, 1}); }));
    EXPECT_EQ(must(device().readback(first)).front(), std::byte{255});
}

TEST_F(Gpu, resources_may_outlive_the_device_object) {
    auto second = std::make_unique<Device>(must(Device::create({.validation = true})));
    const Texture image = must(second->createTexture({.name = "late", .width = 4, .height = 4}));
    const Sampler sampler = must(second->createSampler({}));
    second.reset();
    EXPECT_EQ(image.desc().width, 4u);
}

} // namespace
} // namespace tegument::gpu
