// Reflections of Microsoft's compiler as JSON: what it says, and what it says as it dies.
#include "tools/direct3d/microsoft_reflection.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tegument::test {
namespace {

using nlohmann::json;

json plain() {
    return json::parse(R"({"buffers": [{"name": "$Globals", "size": 48, "kind": 0, "members": [
        {"name": "gTable", "offset": 0, "size": 36, "used": true, "class": 1, "type": 3, "rows": 1, "columns": 1, "elements": 3,
         "default": [1065353216, 0, 0, 0, 1073741824, 0, 0, 0, 1077936128]}]}],
        "resources": [], "inputs": [], "outputs": [], "threads": [0, 0, 0]})");
}

json& member(json& reflection) {
    return reflection["buffers"][0]["members"][0];
}

} // namespace

TEST(Sm5Reflections, of_a_constant_give_its_default_an_element_a_register) {
    const auto read = readSm5Reflection(plain());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->defaults.at("gTable"), (std::vector<double>{1, 2, 3}));
}

TEST(Sm5Reflections, with_numbers_that_are_none_are_not_read) {
    for (const char* key : {"offset", "size", "rows", "columns", "elements", "type", "class"})
        for (const json& value : {json(1e300), json(0.5), json(-1), json(std::uint64_t{1} << 40), json(true), json("1"), json(nullptr)}) {
            json wrong = plain();
            member(wrong)[key] = value;
            EXPECT_FALSE(readSm5Reflection(wrong)) << key << " " << value;
        }
    json word = plain();
    member(word)["default"][1] = 1e300;
    EXPECT_FALSE(readSm5Reflection(word));
    json large = plain();
    member(large)["elements"] = 16384;
    EXPECT_TRUE(readSm5Reflection(large)) << "what a buffer has room for";
    member(large)["rows"] = 2;
    EXPECT_FALSE(readSm5Reflection(large));
}

} // namespace tegument::test
