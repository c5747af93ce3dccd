// What lies beside links: whose mesh they were made for.
#include "host/support/file.h"
#include "meshprep/assets/cached_links.h"

#include <gtest/gtest.h>

using namespace tegument;

namespace {

/// Three faces that meet at right angles, `height` high.
Mesh corner(float height) {
    Mesh mesh;
    mesh.name = "corner";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}};
    mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2};
    mesh.bounds.radius = height; // of some ball: all is counted in it
    return mesh;
}

struct Links {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / ("skin_links_" + std::to_string(::getpid()));
    std::filesystem::path file = folder / "links.dds";

    Links() { std::filesystem::create_directories(folder); }
    ~Links() { std::filesystem::remove_all(folder); }
    Links(const Links&) = delete;
    Links& operator=(const Links&) = delete;

    void beside(const std::string& json) const { ASSERT_TRUE(writeFile(folder / "links.json", json)); }
};

} // namespace

TEST(SkinLinksFile, of_another_mesh_is_refused_and_of_the_same_taken) {
    const Links links;
    ASSERT_TRUE(assets::writeSkinLinks(
        links.file, corner(1), SkinLinks{.sheet = {.width = 4, .height = 4, .pixels = std::vector<float>(64), .metadata = {}}}, {}));
    EXPECT_TRUE(assets::checkSkinLinks(links.file, corner(1)));
    const auto other = assets::checkSkinLinks(links.file, corner(3));
    ASSERT_FALSE(other);
    const std::string said = format(other.error());
    for (const char* text : {"TG4055", "another mesh than corner"})
        EXPECT_NE(said.find(text), std::string::npos) << said;
}

TEST(SkinLinksFile, with_any_json_beside_it_is_taken_as_it_is) {
    const Links links;
    const std::string head = R"({"kind": "tegument skin links", "mesh": )";
    for (const std::string& text :
         {std::string(), std::string("[1]"), std::string(R"({"kind": 3})"), std::string(R"({"kind": {"a": 1}})"), head + "7}",
          head + "[{}]}", head + R"({"surface": "no"}})", head + R"({"surface": {"area": "1", "middle": [0,0,0], "spread": [0,0,0]}}})",
          head + R"({"surface": {"area": 1, "middle": {"x": 1}, "spread": [0,0,0]}}})",
          head + R"({"surface": {"area": 1, "middle": [0,0], "spread": [0,null,0]}}})", head + std::string(100000, '[')}) {
        links.beside(text);
        EXPECT_TRUE(assets::checkSkinLinks(links.file, corner(1))) << text.substr(0, 120);
    }
}
