#include "tools/test/test_file.h"

#include "host/effect/code_view.h"
#include "host/effect/preprocess.h"
#include "meshprep/adopt/rewrite.h"
#include "tools/test/rewrite.h"

#include "generated/test_assertions.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument::testing {

namespace {

Error quoted(Error error, const Sources& sources) {
    for (Diagnostic& diagnostic : error.diagnostics)
        quote(diagnostic, sources);
    return error;
}

/// The function that the compiler starts from.
std::string entryPoint(const Test& test) {
    if (test.stage == ShaderStage::Pixel)
        return fmt::format(
            "float4 {0}(float4 position : SV_Position) : SV_Target0 {{ const uint2 at = uint2(position.xy); "
            "const uint index = at.y / 2u * {1}u + at.x / 2u; tgQuad = float2(at % 2u); tgCase = min(index, tgTestEnd - 1u); "
            "tgTestSilent = index >= tgTestEnd; tgTestInvocation = tgCase * 4u + at.y % 2u * 2u + at.x % 2u; "
            "tgTest_{2}(); return 0.0; }}\n",
            test.entry, kQuadsInARow, test.name);
    if (test.group[0] == 0)
        return fmt::format("[numthreads(64, 1, 1)] void {}(uint3 id : SV_DispatchThreadID) {{ tgCase = tgTestFirst + id.x; "
                           "tgTestInvocation = tgCase; if (tgCase < tgTestEnd) tgTest_{}(); }}\n",
                           test.entry, test.name);
    return fmt::format("[numthreads({1}, {2}, {3})] void {0}(uint3 id : SV_GroupID, uint index : SV_GroupIndex) {{ "
                       "tgCase = tgTestFirst + id.x; tgThread = tgTestThread(index, {4}u); "
                       "tgThreadID = uint3(tgThread % {1}u, tgThread / {1}u % {2}u, tgThread / {5}u); "
                       "tgTestInvocation = tgCase * {4}u + tgThread; tgTest_{6}(); }}\n",
                       test.entry, test.group[0], test.group[1], test.group[2], test.invocations(), test.group[0] * test.group[1],
                       test.name);
}

std::optional<Error> unusable(const TestFile& file) {
    if (file.tests.empty())
        return inputError(8201, {.file = file.path.string()}, "the file has no tests", "write one: TG_TEST(name) { tgEqual(1 + 1, 2); }");
    std::map<std::string, SourcePosition> names;
    for (const Test& test : file.tests)
        if (const auto [first, isNew] = names.emplace(test.name, test.at); !isNew)
            return inputError(8202, test.at, fmt::format("two tests have the name '{}'", test.name),
                              fmt::format("the first is in line {}", first->second.line));
    return {};
}

/// What the tests reach, as later compilers have it, with Direct3D 9's arithmetic.
std::string respelt(Effect effect, TestFile& file) {
    const std::vector<Parameter> declared = effect.parameters;
    const adopt::Rewriter rewriter(effect);
    file.direct3D9 = true;
    file.samplers = effect.samplers;
    for (const auto& [name, plan] : rewriter.samplers()) {
        file.authors[plan.state] = name;
        if (std::ranges::find(declared, plan.texture, &Parameter::name) == declared.end()) file.authors[plan.texture] = name;
    }
    ShaderReference root{.entry = "tgTest_" + file.tests.front().name, .profile = "ps_3_0"};
    for (std::size_t i = 1; i < file.tests.size(); ++i)
        root.arguments.push_back("tgTest_" + file.tests[i].name);
    return rewriter.source(&root, {});
}

} // namespace

Result<TestFile> readTests(const std::filesystem::path& path, const ReadOptions& options) {
    const Roots roots = rootsOfEffect(path, options.load.includeFolders, options.load.roots);
    PreprocessOptions preprocessing{.defines = options.load.defines,
                                    .includeFolders = options.load.includeFolders,
                                    .read = confinedReader(path, roots),
                                    .search = [&](const std::string& name) { return folderOfInclude(name, path, roots); }};
    preprocessing.defines.emplace_back("FX_ENTRY", "1");
    Sources sources;
    Result<Preprocessed> view = preprocess(path, preprocessing, sources);
    if (!view) return quoted(view.error(), sources);
    TestFile file{.path = path, .includes = view->includes, .warnings = view->warnings};
    if (options.mutant && options.mutant->token < view->tokens.size())
        view->tokens[options.mutant->token].text = sources.keep(options.mutant->to);
    auto rewritten = rewrite(*view, sources, roots, options, file);
    if (!rewritten) return quoted(rewritten.error(), sources);
    if (auto error = unusable(file)) return quoted(*error, sources);
    for (Site& site : file.sites)
        site.line = sources.line(site.at.file, site.at.line);
    std::string code = codeView(rewritten->view, sources, {});
    if (rewritten->effect) {
        rewritten->effect->code = std::move(code);
        code = respelt(std::move(*rewritten->effect), file);
    }
    file.code = fmt::format("#line 1 \"assertions.hlsl\"\n{}{}{}\n#line 1 \"tests\"\n", kAssertions, rewritten->counters, code);
    for (const Test& test : file.tests)
        file.code += entryPoint(test);
    return file;
}

} // namespace tegument::testing
