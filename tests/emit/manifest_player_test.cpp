// docs/samples/player/manifest.h: manifests as `check --emit` writes them, and texts that nobody should have written.
#include "docs/samples/player/manifest.h"
#include "tests/effect/player_calls.h"
#include "tools/emit/products.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <random>

namespace tegument::test {
namespace {

namespace player = script_player;

/// Without shaders: a manifest's scripts and parameters need no compiler.
std::string manifestOf(const Effect& effect) {
    FileReport report;
    report.file = effect.file;
    report.effect = effect;
    return emit::manifest(report, {}, emit::linkShaders(report));
}

PlayedParameters parametersOf(const player::Json& manifest) {
    PlayedParameters parameters;
    for (const player::Json& one : manifest.at("parameters").list()) {
        player::Value value = player::defaultOf(one);
        if (value.numbers.empty()) value.numbers = {0};
        parameters.add({one.at("name").text(), std::move(value)});
    }
    return parameters;
}

/// What the reader and the player make of a text; empty without an error.
std::string errorOf(const std::string& text) {
    try {
        const player::Json manifest = player::readManifest(text);
        for (const player::Json& technique : manifest.at("techniques").list()) {
            ByPlayer engine(parametersOf(manifest));
            player::play(player::techniqueOf(manifest, technique.at("name").text()), engine);
        }
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::string jsonErrorOf(const std::string& text) {
    try {
        player::readJson(text);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

void expectAlike(const player::Json& read, const nlohmann::json& expected) {
    using Kind = player::Json::Kind;
    if (expected.is_object()) {
        ASSERT_EQ(read.kind, Kind::Object);
        ASSERT_EQ(read.keys.size(), expected.size());
        for (const auto& [key, value] : expected.items())
            expectAlike(read.at(key), value);
    } else if (expected.is_array()) {
        ASSERT_EQ(read.list().size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            expectAlike(read.items[i], expected[i]);
    } else if (expected.is_string()) {
        EXPECT_EQ(read.text(), expected.get<std::string>());
    } else if (expected.is_number()) {
        EXPECT_EQ(read.kind, Kind::Number);
        EXPECT_EQ(read.value, expected.get<double>());
    } else if (expected.is_boolean()) {
        EXPECT_EQ(read.kind, Kind::Bool);
        EXPECT_EQ(read.value != 0, expected.get<bool>());
    } else
        EXPECT_EQ(read.kind, Kind::Null);
}

} // namespace

TEST(ManifestPlayer, calls_an_engine_as_this_project_s_runner_does_in_every_technique_of_every_effect) {
    std::size_t techniques = 0;
    for (const char* folder : {"effects", "effects/peers"})
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".fx") continue;
            const Effect effect = loaded(loadEffect(entry.path()));
            const player::Json manifest = player::readManifest(manifestOf(effect));
            for (const Technique& technique : effect.techniques) {
                ByPlayer engine(parametersOf(manifest));
                player::play(player::techniqueOf(manifest, technique.name), engine);
                EXPECT_FALSE(engine.lines.empty());
                EXPECT_EQ(engine.lines, runnersCalls(effect, technique)) << entry.path() << ' ' << technique.name;
                ++techniques;
            }
        }
    EXPECT_GE(techniques, 50U);
}

TEST(ManifestPlayer, reads_a_manifest_as_another_reader_of_json_does) {
    const std::string text = manifestOf(loaded(loadEffect("effects/Pyramid.fx")));
    expectAlike(player::readJson(text), nlohmann::json::parse(text));
    const std::string odd =
        R"({"a":[1e3,-0.5E-2,0,-0,12345678901234567890,true,false,null,"\u00e4\ud83d\ude00\n\"\\\/\t",[],{}]," ":{"":""}})";
    expectAlike(player::readJson(odd), nlohmann::json::parse(odd));
}

TEST(ManifestPlayer, takes_no_text_that_another_reader_of_json_refuses) {
    for (const char* text : {"",
                             " ",
                             "{",
                             "}",
                             "[1,]",
                             "{\"a\":1,}",
                             "[,1]",
                             "[1 2]",
                             "{\"a\" 1}",
                             "{a:1}",
                             "01",
                             "+1",
                             "1.",
                             ".5",
                             "1e",
                             "0x10",
                             "nan",
                             "tru",
                             "nulll",
                             "'a'",
                             "\"a",
                             "\"\\x\"",
                             "\"\\u12g4\"",
                             "\"\\ud800\"",
                             "\"\\ud800\\u0041\"",
                             "\"\\udc00\"",
                             "\"\\u 123\"",
                             "\"\n\"",
                             "[1]]",
                             "1 1",
                             "-",
                             "1e999",
                             "\"\\u-123\"",
                             "/**/1"}) {
        EXPECT_NE(jsonErrorOf(text), "") << text;
        EXPECT_FALSE(nlohmann::json::accept(text)) << text;
    }
    EXPECT_EQ(jsonErrorOf("{\"a\":1,\"a\":2}"), "manifest: byte 10: a name stands twice"); // which of them holds, readers do not agree
    EXPECT_NE(jsonErrorOf(std::string(100000, '[')).find("nested too deeply"), std::string::npos);
}

TEST(ManifestPlayer, says_what_a_manifest_lacks) {
    EXPECT_EQ(errorOf("[]"), "manifest: of another format");
    EXPECT_EQ(errorOf(R"({"format":"tegument-effect 1"})"), "manifest: no techniques");
    EXPECT_EQ(errorOf(R"({"format":"tegument-effect 1","parameters":[],"techniques":[{"name":1}]})"),
              "manifest: text is wanted where something else stands");
    EXPECT_EQ(errorOf(R"({"format":"tegument-effect 1","parameters":[],"techniques":[{"name":"T","annotations":{},"passes":7}]})"),
              "manifest: a list is wanted where something else stands");
    const player::Json manifest = player::readManifest(manifestOf(loaded(loadEffect("effects/Main.fx"))));
    EXPECT_THROW((void)player::techniqueOf(manifest, "Nothing"), std::runtime_error);
}

TEST(ManifestPlayer, gives_floats_and_sizes_that_fit_and_refuses_others) {
    const auto defaultOf = [](const std::string& value) {
        return player::defaultOf(player::readJson(R"({"type":"float","default":)" + value + "}")).numbers;
    };
    EXPECT_EQ(defaultOf("[0.1,-3e38]"), (std::vector<float>{0.1F, -3e38F}));
    EXPECT_EQ(defaultOf("1e-999"), std::vector<float>{0});
    EXPECT_THROW((void)defaultOf("1e39"), std::runtime_error);
    EXPECT_THROW((void)defaultOf("[0,-1e300]"), std::runtime_error);
    EXPECT_EQ(player::readJson("4294967295").whole(), 4294967295U);
    for (const char* text : {"-1", "0.5", "4294967296", "1e99", "\"1\""})
        EXPECT_THROW((void)player::readJson(text).whole(), std::runtime_error) << text;
}

/// Seconds where each name is compared with all before it; a tenth of a second here, and far less than the limit on any machine.
TEST(ManifestPlayer, reads_an_object_of_many_names_in_time) {
    std::string text = "{\"0\":0";
    for (int i = 1; i < 200000; ++i)
        text += ",\"" + std::to_string(i) + "\":0";
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(player::readJson(text + "}").keys.size(), 200000U);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

/// Every prefix of a small manifest, and bytes of it changed at random: an error or none, and no more than that (ASan and UBSan look on).
TEST(ManifestPlayer, ends_with_one_error_whatever_a_manifest_holds) {
    const std::string whole = manifestOf(loaded(loadEffect("effects/Stretch.fx")));
    ASSERT_EQ(errorOf(whole), "");
    for (std::size_t size = 0; size + 2 < whole.size(); size += 7)
        EXPECT_NE(errorOf(whole.substr(0, size)), "") << size;
    std::mt19937 random(26);
    const std::string letters = "{}[]\",:=;?0189-eE\\utx \n";
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string text = whole;
        for (int changes = 0; changes < 3; ++changes)
            text[random() % text.size()] = letters[random() % letters.size()];
        refused += errorOf(text).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 1000);
}

} // namespace tegument::test
