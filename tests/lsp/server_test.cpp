// The server over two pipes, as an editor speaks to it.

#include "host/spirv/compile.h"
#include "tools/lsp/documents.h"
#include "tools/lsp/rpc.h"
#include "tools/lsp/server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <thread>
#include <unistd.h>

namespace tegument::lsp {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = "float gPower : POWER = 2;\nfloat4 shade(float3 n) { return float4(n * gPower, 1); }\n";
constexpr const char* kServed = R"(#include "part.fxh"
float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;
float4 gTint = { 1, 0, 0, 1 };
Texture2D gColourMap;
SamplerState gColour;
float4 vertex(float3 p : POSITION) : SV_Position { return mul(float4(p, 1), gWorldViewProjection); }
float4 pixel() : SV_Target { return gTint * shade(1) * gColourMap.SampleLevel(gColour, 0.5, 0); }
technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, vertex())); SetPixelShader(CompileShader(ps_5_0, pixel())); } }
)";

/// A server in a thread of its own, and a folder with an effect and what it includes.
class Lsp : public testing::Test {
protected:
    void SetUp() override {
        std::signal(SIGPIPE, SIG_IGN);
        folder_ = fs::temp_directory_path() / ("tegument-lsp-" + std::to_string(::getpid()));
        fs::create_directories(folder_ / ".git"); // a project: what lies in it may be included
        std::ofstream(folder_ / "part.fxh") << kPart;
        std::ofstream(folder_ / "effect.fx") << kServed;
        start();
    }

    void TearDown() override {
        stop();
        fs::remove_all(folder_);
    }

    void start() {
        int in[2] = {};
        int out[2] = {};
        ASSERT_EQ(::pipe(in), 0);
        ASSERT_EQ(::pipe(out), 0);
        to_ = in[1];
        from_ = out[0];
        input_ = std::make_unique<Input>(from_);
        thread_ = std::thread([read = in[0], write = out[1], this] {
            code_ = serve(read, write, {.semantics = {"WORLD", "WORLDVIEWPROJECTION"}, .idleMilliseconds = 1});
            ::close(read);
            ::close(write);
        });
    }

    int stop() {
        if (to_ >= 0) ::close(to_);
        to_ = -1;
        if (thread_.joinable()) thread_.join();
        if (from_ >= 0) ::close(from_);
        from_ = -1;
        return code_;
    }

    void raw(const std::string& bytes) const { ASSERT_EQ(::write(to_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size())); }

    Json next() {
        const auto text = input_->next();
        return text ? Json::parse(*text, nullptr, false) : Json();
    }

    Json ask(const std::string& method, const Json& parameters) {
        const int id = ++serial_;
        EXPECT_TRUE(send(to_, {{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", parameters}}));
        for (;;) {
            const Json message = next();
            if (message.is_null() || (message.contains("id") && message["id"] == id)) return message;
            if (message.contains("method")) notes_.push_back(message);
        }
    }

    void tell(const std::string& method, const Json& parameters) const { EXPECT_TRUE(send(to_, notification(method, parameters))); }

    [[nodiscard]] std::string uri(const std::string& name) const { return uriOf((folder_ / name).string()); }

    void open(const std::string& name, const std::string& text) const {
        tell("textDocument/didOpen", {{"textDocument", {{"uri", uri(name)}, {"languageId", "hlsl"}, {"version", 1}, {"text", text}}}});
    }

    void change(const std::string& name, const std::string& text) const {
        tell("textDocument/didChange", {{"textDocument", {{"uri", uri(name)}, {"version", 2}}}, {"contentChanges", {{{"text", text}}}}});
    }

    Json askAt(const std::string& method, const std::string& name, int line, int character) {
        return ask("textDocument/" + method,
                   {{"textDocument", {{"uri", uri(name)}}}, {"position", {{"line", line}, {"character", character}}}})["result"];
    }

    /// The next diagnostics of this file.
    Json diagnostics(const std::string& name) {
        for (;;) {
            Json message;
            if (notes_.empty()) {
                message = next();
            } else {
                message = notes_.front();
                notes_.erase(notes_.begin());
            }
            if (message.is_null()) return message;
            if (message.value("method", "") == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri(name))
                return message["params"]["diagnostics"];
        }
    }

    fs::path folder_;
    std::unique_ptr<Input> input_;
    std::thread thread_;
    std::vector<Json> notes_;
    int to_ = -1;
    int from_ = -1;
    int code_ = -1;
    int serial_ = 0;
};

} // namespace

TEST_F(Lsp, says_what_it_offers_and_ends_as_it_is_told) {
    const Json offered = ask("initialize", Json::object())["result"]["capabilities"];
    EXPECT_EQ(offered["hoverProvider"], true);
    EXPECT_EQ(offered["textDocumentSync"]["change"], 1) << "whole texts";
    EXPECT_EQ(ask("workspace/symbol", Json::object())["error"]["code"], kMethodNotFound);
    EXPECT_TRUE(ask("shutdown", nullptr)["result"].is_null());
    tell("exit", nullptr);
    EXPECT_EQ(stop(), 0);
}

TEST_F(Lsp, an_end_without_shutdown_is_no_success) {
    EXPECT_EQ(stop(), 1);
}

TEST_F(Lsp, a_fault_is_told_where_it_stands_and_taken_back_when_it_is_mended) {
    std::string broken = kServed;
    broken.replace(broken.find("= { 1, 0, 0, 1 }"), 16, "= { 1, 0, 0 1 };;");
    open("effect.fx", broken);
    const Json told = diagnostics("effect.fx");
    ASSERT_EQ(told.size(), 1U) << told;
    EXPECT_EQ(told[0]["severity"], 1);
    EXPECT_EQ(told[0]["range"]["start"]["line"], 2);
    EXPECT_EQ(told[0]["source"], "tegument");
    EXPECT_EQ(told[0]["code"].get<std::string>().substr(0, 2), "TG");
    change("effect.fx", kServed);
    EXPECT_EQ(diagnostics("effect.fx").size(), 0U);
}

TEST_F(Lsp, what_only_a_compiler_finds_comes_when_nobody_types) {
    if (!compilerAvailable(defaultCompiler())) GTEST_SKIP() << whyCompilerMissing(defaultCompiler());
    std::string broken = kServed;
    broken.replace(broken.find("gTint * shade"), 13, "gTint * shape");
    open("effect.fx", broken);
    EXPECT_EQ(diagnostics("effect.fx").size(), 0U) << "the reader knows no bodies of functions";
    const Json told = diagnostics("effect.fx");
    ASSERT_GE(told.size(), 1U);
    EXPECT_EQ(told[0]["range"]["start"]["line"], 6);
    EXPECT_NE(told[0]["message"].get<std::string>().find("shape"), std::string::npos);
}

TEST_F(Lsp, a_fault_in_an_included_file_is_told_there) {
    open("effect.fx", kServed);
    EXPECT_EQ(diagnostics("effect.fx").size(), 0U);
    open("part.fxh", "float gPower : POWER = ;\n");
    Json told = diagnostics("part.fxh"); // of the part alone, which is no effect
    EXPECT_EQ(told.size(), 0U);
    told = diagnostics("part.fxh");
    ASSERT_EQ(told.size(), 1U) << "from the effect that includes it, by the editor's text";
    EXPECT_EQ(told[0]["range"]["start"]["line"], 0);
}

TEST_F(Lsp, definitions_are_found_across_includes) {
    open("effect.fx", kServed);
    const Json shade = askAt("definition", "effect.fx", 6, 46);
    EXPECT_EQ(shade["uri"], uri("part.fxh")) << shade;
    EXPECT_EQ(shade["range"]["start"], (Json{{"line", 1}, {"character", 7}}));
    EXPECT_EQ(shade["range"]["end"], (Json{{"line", 1}, {"character", 12}}));
    EXPECT_EQ(askAt("definition", "effect.fx", 0, 12)["uri"], uri("part.fxh")) << "the include itself";
    const Json local = askAt("definition", "effect.fx", 5, 70);
    EXPECT_EQ(local["range"]["start"], (Json{{"line", 5}, {"character", 21}})) << "the parameter p of vertex";
    EXPECT_TRUE(askAt("definition", "effect.fx", 900, 4).is_null());
}

TEST_F(Lsp, a_part_asks_what_includes_it) {
    open("effect.fx", kServed);
    open("part.fxh", kPart);
    const Json said = askAt("hover", "part.fxh", 1, 48);
    ASSERT_TRUE(said.is_object());
    EXPECT_NE(said["contents"]["value"].get<std::string>().find("float gPower : POWER;"), std::string::npos) << said;
}

TEST_F(Lsp, hover_tells_type_semantic_and_register) {
    open("effect.fx", kServed);
    (void)diagnostics("effect.fx"); // of the reader
    (void)diagnostics("effect.fx"); // of the compilers: then registers are known
    const std::string matrix = askAt("hover", "effect.fx", 1, 12)["contents"]["value"];
    EXPECT_NE(matrix.find("float4x4 gWorldViewProjection : WORLDVIEWPROJECTION;"), std::string::npos) << matrix;
    if (!compilerAvailable(Compiler::Dxc)) GTEST_SKIP() << whyCompilerMissing(Compiler::Dxc);
    // $Globals in the order of the file: gPower c0, the matrix c1 to c4, gTint c5.
    EXPECT_NE(matrix.find("c1 to c4 in vertex"), std::string::npos) << matrix;
    EXPECT_NE(askAt("hover", "effect.fx", 6, 37)["contents"]["value"].get<std::string>().find("c5 in pixel"), std::string::npos);
    EXPECT_NE(askAt("hover", "effect.fx", 3, 12)["contents"]["value"].get<std::string>().find("t0 in pixel"), std::string::npos);
    EXPECT_NE(askAt("hover", "effect.fx", 4, 15)["contents"]["value"].get<std::string>().find("s0 in pixel"), std::string::npos);
}

TEST_F(Lsp, semantics_and_states_are_completed) {
    const auto labels = [](const Json& items) {
        std::set<std::string> all;
        for (const Json& item : items)
            all.insert(item["label"].get<std::string>());
        return all;
    };
    open("half.fx",
         "float4x4 m : ;\nfloat4 f(float3 p : ) { return 0; }\ntechnique T { pass P { ZFunc = ; } }\nsampler s = sampler_state { ");
    EXPECT_TRUE(labels(askAt("completion", "half.fx", 0, 13)).contains("WORLDVIEWPROJECTION"));
    const auto stage = labels(askAt("completion", "half.fx", 1, 20));
    EXPECT_TRUE(stage.contains("TEXCOORD0"));
    EXPECT_FALSE(stage.contains("WORLDVIEWPROJECTION"));
    EXPECT_TRUE(labels(askAt("completion", "half.fx", 2, 23)).contains("AlphaBlendEnable"));
    const auto values = labels(askAt("completion", "half.fx", 2, 31));
    EXPECT_TRUE(values.contains("LESSEQUAL"));
    EXPECT_FALSE(values.contains("AlphaBlendEnable"));
    EXPECT_TRUE(labels(askAt("completion", "half.fx", 3, 28)).contains("MinFilter"));
    EXPECT_TRUE(labels(askAt("completion", "half.fx", 1, 25)).contains("f"));
}

TEST_F(Lsp, nonsense_is_answered_or_dropped) {
    for (
        const char* body :
        {"", "{", "[]", "7", "null", "\"a\"", "{}", R"({"id":{},"method":"initialize"})", R"({"method":7})", R"({"id":1})",
         R"({"method":"textDocument/didOpen"})", R"({"method":"textDocument/didOpen","params":[1]})",
         R"({"method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///x"},"contentChanges":7}})",
         R"({"method":"textDocument/didOpen","params":{"textDocument":{"uri":"file:///nowhere/x.fx","text":7}}})",
         R"({"id":9,"method":"textDocument/hover","params":{"textDocument":7,"position":[]}})",
         R"({"id":9,"method":"textDocument/hover","params":{"textDocument":{"uri":"file:///nowhere/x.fx"},"position":{"line":-5,"character":1e99}}})"}) {
        raw("Content-Length: " + std::to_string(std::string(body).size()) + "\r\n\r\n" + body);
    }
    raw("content-length:   2\r\nX: y\r\n\r\n{}");
    std::string deep(100000, '[');
    raw("Content-Length: 100000\r\n\r\n" + deep);
    EXPECT_TRUE(ask("initialize", Json::object()).contains("result")) << "it still answers";
}

TEST_F(Lsp, a_length_that_is_none_ends_it) {
    for (const char* header :
         {"Content-Length: x\r\n\r\n", "Content-Length: 99999999999999999999\r\n\r\n", "\r\n\r\n", "Length: 5\r\n\r\n{}"}) {
        raw(header);
        EXPECT_EQ(stop(), 1) << header;
        start();
    }
}

/// A session cut off after each of its bytes would take long; after each of these it does not.
TEST_F(Lsp, a_session_that_is_cut_short_anywhere_ends_quietly) {
    std::string session;
    for (const Json& message :
         {Json{{"id", 1}, {"method", "initialize"}, {"params", Json::object()}},
          notification("textDocument/didOpen", {{"textDocument", {{"uri", uri("effect.fx")}, {"text", kServed}}}}),
          Json{{"id", 2},
               {"method", "textDocument/hover"},
               {"params", {{"textDocument", {{"uri", uri("effect.fx")}}}, {"position", {{"line", 2}, {"character", 9}}}}}}}) {
        const std::string text = message.dump();
        session += "Content-Length: " + std::to_string(text.size()) + "\r\n\r\n" + text;
    }
    for (std::size_t length = 0; length < session.size(); length += 37) {
        stop();
        start();
        std::string part = session.substr(0, length);
        raw(part);
        EXPECT_EQ(stop(), 1) << length;
    }
}

/// The text of an effect, cut off at every third byte and with a byte exchanged: the server reads it, and answers.
TEST_F(Lsp, whatever_is_typed_is_survived) {
    const std::string text = kServed;
    open("effect.fx", text);
    for (std::size_t i = 0; i < text.size(); i += 3) {
        std::string typed = i % 2 == 0 ? text.substr(0, i) : text;
        if (i % 2 == 1) typed[i] = static_cast<char>(i * 7 + 1);
        change("effect.fx", typed);
        const int line =
            static_cast<int>(std::count(typed.begin(), typed.begin() + static_cast<std::ptrdiff_t>(std::min(i, typed.size())), '\n'));
        EXPECT_TRUE(askAt("completion", "effect.fx", line, 5).is_array()) << i;
        (void)askAt("hover", "effect.fx", line, 8);
        (void)askAt("definition", "effect.fx", line, 8);
    }
}

} // namespace tegument::lsp
