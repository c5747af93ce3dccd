#include "tools/test/run.h"

#include "host/support/file.h"
#include "host/support/parallel.h"
#include "tools/test/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <span>

namespace tegument::testing {

namespace {

constexpr std::uint32_t kOrders = 8;      // of the threads of a group
constexpr std::size_t kMostFailures = 10; // that a test tells of

/// Compilers quote the code that they got: the line as its author has it instead, from its first word on.
void quoteSource(Diagnostic& message) {
    const auto text = readFile(message.at.file);
    if (!text || message.at.line == 0) return;
    std::size_t start = 0;
    for (int line = 1; line < message.at.line && start != std::string::npos; ++line)
        start = text->find('\n', start) == std::string::npos ? std::string::npos : text->find('\n', start) + 1;
    if (start == std::string::npos) return;
    const std::string own = text->substr(start, text->find('\n', start) - start);
    if (own == message.sourceLine) return;
    message.sourceLine = own;
    message.at.column = static_cast<int>(std::min(own.find_first_not_of(" \t"), own.size())) + 1;
    if (message.text.find("tgTest") != std::string::npos)
        message.hint = "assertions take numbers, and vectors of up to four: rows of matrices";
}

Result<Shader> compiled(const TestFile& file, const std::string& entry, ShaderStage stage, Compiler compiler) {
    auto shader = compileShader(
        {.code = file.code, .file = file.path.string(), .entry = entry, .stage = stage, .apart = true, .language2018 = file.direct3D9},
        compiler);
    if (shader) return shader;
    Error error = shader.error();
    for (Diagnostic& message : error.diagnostics) {
        quoteSource(message);
        if (message.text.find("only pixel shaders have") != std::string::npos)
            message.hint = "TG_PIXEL_TEST has derivatives; " + message.hint;
        for (const Test& test : file.tests)
            for (const Fixture& fixture : test.fixtures)
                if (message.text.find("undeclared identifier '" + fixture.name + "'") != std::string::npos ||
                    message.text.find("unknown variable '" + fixture.name + "'") != std::string::npos)
                    message.hint = fmt::format("a fixture gives values to what HLSL declares: Texture2D {}; or what it is", fixture.name);
    }
    return error;
}

std::string textOf(const Noted& noted) {
    std::string text;
    for (std::uint32_t c = 0; c < noted.count; ++c) {
        const double number = noted.number(c);
        text += c == 0 ? "" : ", ";
        text += noted.kind == 0   ? (std::isnan(number) ? "nan" : fmt::format("{}", static_cast<float>(number)))
                : noted.kind == 3 ? (number != 0 ? "true" : "false")
                                  : fmt::format("{:.0f}", number);
    }
    return noted.count > 1 ? fmt::format("({})", text) : text;
}

/// Numbers of the format between two floats.
std::uint32_t ulpsBetween(double a, double b) {
    const auto ordered = [](double x) {
        const auto bits = static_cast<std::int64_t>(std::bit_cast<std::int32_t>(static_cast<float>(x)));
        return bits < 0 ? -(bits & 0x7fffffff) : bits;
    };
    return static_cast<std::uint32_t>(std::abs(ordered(a) - ordered(b)));
}

/// Of the component that is furthest off.
std::string differenceOf(const Noted& value, const Noted& expected) {
    double absolute = 0;
    std::uint32_t worst = 0;
    for (std::uint32_t c = 0; c < std::min(value.count, expected.count); ++c)
        if (const double here = std::abs(value.number(c) - expected.number(c)); here > absolute) absolute = here, worst = c;
    if (absolute == 0 || std::isinf(absolute)) return {};
    std::string text = fmt::format(", off by {:.3g}", absolute);
    if (value.kind != 0) return text;
    if (expected.number(worst) != 0) text += fmt::format(", relative {:.3g}", absolute / std::abs(expected.number(worst)));
    return text + fmt::format(", {} ulp", ulpsBetween(value.number(worst), expected.number(worst)));
}

bool hasNan(const Noted& noted) {
    for (std::uint32_t c = 0; noted.kind == 0 && c < noted.count; ++c)
        if (std::isnan(noted.number(c))) return true;
    return false;
}

/// One test by one compiler.
class Runner {
public:
    Runner(gpu::Device& device, const TestFile& file, const Test& test, const RunOptions& options, Compiler compiler)
        : device_(device), file_(file), test_(test), options_(options), compiler_(compiler) {}

    Result<TestResult> run(Shader shader, const Shader* vertex, std::vector<std::uint64_t>* reached) {
        result_ = {.name = test_.name, .at = test_.at, .compiler = compiler_, .compiled = true, .cases = test_.cases};
        result_.expectedToFail = test_.why.has_value();
        vertex_ = vertex;
        auto program = Program::create(device_, file_, test_, std::move(shader), vertex);
        if (!program) return program.error();
        if (auto given = give(*program); !given) return given.error();
        for (launch_.order = 0; launch_.order < (test_.group[0] == 0 ? 1 : kOrders) && result_.failures.empty(); ++launch_.order)
            if (auto judged = judge(*program, reached); !judged) return judged.error();
        if (test_.why) expectFailure();
        return std::move(result_);
    }

private:
    /// Each may depend on those before it.
    Result<void> give(Program& program) {
        launch_ = {.end = test_.cases, .seed = options_.seed, .loopMost = options_.loopMost};
        for (const Reference& reference : test_.references) {
            const auto ran = program.run(launch_);
            if (!ran) return ran.error();
            const auto recorded = std::span(ran->recorded).subspan(std::size_t{reference.first} * test_.cases);
            auto results = evaluate(options_.reference, reference, recorded, test_.cases);
            if (!results) return results.error();
            program.give(reference.first + reference.arguments, std::move(*results));
        }
        return {};
    }

    Result<void> judge(Program& program, std::vector<std::uint64_t>* reached) {
        auto ran = program.run(launch_);
        if (!ran) return ran.error();
        for (std::size_t i = 0; reached != nullptr && i < ran->reached.size(); ++i)
            (*reached)[i] += ran->reached[i];
        bool lost = false; // what comes behind an endless loop is not to be believed
        std::uint64_t judged = 0;
        for (std::size_t site = 0; site < ran->sites.size(); ++site) {
            lost = lost || (file_.sites[site].kind == SiteKind::Loop && ran->sites[site].failures > 0);
            if (file_.sites[site].isAssertion()) judged += ran->sites[site].runs;
        }
        result_.assertions += judged;
        for (std::size_t site = 0; site < ran->sites.size(); ++site) {
            Counts& counts = ran->sites[site];
            const SiteKind kind = file_.sites[site].kind;
            if (file_.sites[site].isProperty()) compareNeighbours(file_.sites[site], *ran, counts);
            if (kind == SiteKind::Near && counts.runs > 0 && launch_.order == 0) result_.errors.push_back({file_.sites[site], counts});
            if (counts.failures == 0 || (lost && kind != SiteKind::Loop) || result_.failures.size() == kMostFailures) continue;
            if (auto told = tell(program, static_cast<std::uint32_t>(site), counts); !told) return told;
        }
        if (judged == 0 && result_.failures.empty())
            fail(8202, {.at = test_.at, .text = {}, .line = {}}, "no assertion was reached", "write one");
        return {};
    }

    /// Case by case along the first input, the others as they are.
    void compareNeighbours(const Site& site, const Ran& ran, Counts& counts) {
        if (counts.runs == 0) return; // of another test
        const auto cases = std::span(ran.recorded).subspan(std::size_t{site.property} * test_.cases, test_.cases);
        for (std::uint32_t i = 1; i < test_.cases; ++i) {
            const Recorded& before = cases[i - 1];
            const Recorded& here = cases[i];
            if (i % test_.row == 0 || before.count == 0 || before.count != here.count) continue;
            bool holds = true;
            for (std::size_t c = 0; c < here.count; ++c) {
                const float step = here.numbers.at(c) - before.numbers.at(c);
                holds = holds && (site.kind == SiteKind::Increasing   ? step >= 0
                                  : site.kind == SiteKind::Decreasing ? step <= 0
                                                                      : std::abs(step) <= here.most);
            }
            if (holds) continue;
            if (counts.failures++ == 0) counts.first = i;
        }
        if (counts.failures > 0) before_ = cases[counts.first - 1];
    }

    void fail(int code, const Site& site, std::string text, std::string hint) {
        Failure made;
        made.message = {
            .code = code, .at = site.at, .text = fmt::format("{} ({}): {}", test_.name, compilerWord(), text), .hint = std::move(hint)};
        made.message.sourceLine = site.line;
        result_.failures.push_back(std::move(made));
    }

    [[nodiscard]] std::string_view compilerWord() const { return compiler_ == Compiler::Dxc ? "dxc" : "glslang"; }

    /// Runs the first case that failed once more, to note its values.
    Result<void> tell(Program& program, std::uint32_t number, const Counts& counts) {
        const Site& site = file_.sites[number];
        const std::uint32_t index = counts.first / test_.invocations();
        Launch again = launch_;
        again.first = index;
        again.end = index + 1;
        again.wanted = counts.first;
        const auto ran = program.run(again);
        if (!ran) return ran.error();
        std::vector<Noted> own;
        std::vector<std::pair<std::string, std::string>> values;
        for (const Noted& noted : ran->notes) {
            if (noted.site == number) own.push_back(noted);
            const SiteKind kind = file_.sites[noted.site].kind;
            if (own.empty() && (kind == SiteKind::Input || kind == SiteKind::Watch))
                values.emplace_back(file_.sites[noted.site].text, textOf(noted));
        }
        std::string where = test_.cases > 1 ? fmt::format("case {}", index) : "";
        if (test_.invocations() > 1)
            where += fmt::format("{}{} {}", where.empty() ? "" : ", ", test_.stage == ShaderStage::Pixel ? "pixel" : "thread",
                                 counts.first % test_.invocations());
        if (launch_.order > 0) where += fmt::format(" in order {} of {}", launch_.order + 1, kOrders);
        for (const auto& [name, value] : values)
            where += fmt::format("{}{} = {}", where.empty() ? "" : ", ", name, value);
        std::string compared;
        if (own.size() > 1 && site.isAssertion())
            compared = fmt::format(": {}, expected {}{}", textOf(own[0]), textOf(own[1]), differenceOf(own[0], own[1]));
        else if (!own.empty() && site.isAssertion())
            compared = ": " + textOf(own[0]);
        if (!own.empty() && site.isProperty()) {
            Noted before{.kind = 0, .count = own[0].count};
            for (std::uint32_t c = 0; c < before.count; ++c)
                before.bits.at(c) = std::bit_cast<std::uint32_t>(before_.numbers.at(c));
            compared += fmt::format(" after {}", textOf(before));
        }
        const std::string often = counts.runs > 1 ? fmt::format(" in {} of {}", counts.failures, counts.runs) : "";
        if (site.kind == SiteKind::Loop)
            fail(8211, site, fmt::format("the loop takes more than {} turns", options_.loopMost), where);
        else if (site.kind == SiteKind::Index)
            fail(8212, site,
                 fmt::format("{} reaches outside: index {} of {} elements", site.text, own.empty() ? "" : textOf(own[0]),
                             own.size() > 1 ? textOf(own[1]) : ""),
                 where);
        else
            fail(8210, site, fmt::format("{} failed{}{}", site.text, often, compared), where);
        Failure& made = result_.failures.back();
        made.cases = counts.failures;
        made.values = std::move(values);
        if (!own.empty()) made.value = textOf(own[0]);
        if (own.size() > 1) made.expected = textOf(own[1]);
        if (site.isAssertion() && !own.empty() && hasNan(own[0])) return placeNan(again, made);
        return {};
    }

    /// Where the first NaN came from: by code that looks at every float.
    Result<void> placeNan(const Launch& launch, Failure& failure) {
        ReadOptions read = options_.read;
        read.trace = true;
        read.coverage = false;
        const auto traced = readTests(file_.path, read);
        if (!traced) return traced.error();
        const auto test = std::ranges::find(traced->tests, test_.name, &Test::name);
        if (test == traced->tests.end()) return {};
        auto shader = compiled(*traced, test->entry, test->stage, compiler_);
        if (!shader) return {}; // the looking itself cannot be compiled: the assertion's place stays
        auto program = Program::create(device_, *traced, *test, std::move(*shader), vertex_);
        if (!program) return program.error();
        const auto ran = program->run(launch);
        if (!ran) return ran.error();
        for (std::size_t site = 0; site < ran->sites.size(); ++site)
            if (ran->sites[site].failures > 0 && traced->sites[site].kind == SiteKind::NotANumber) {
                const Site& first = traced->sites[site];
                failure.message.text += fmt::format("; the first NaN comes from {}({}): {}", first.at.file, first.at.line, first.text);
            }
        return {};
    }

    void expectFailure() {
        const bool failed = !result_.failures.empty();
        result_.failures.clear();
        if (!failed)
            fail(8213, {.at = test_.at, .text = {}, .line = {}}, "passes, and was expected to fail: " + *test_.why,
                 "remove tgExpectFailure");
    }

    gpu::Device& device_;
    const TestFile& file_;
    const Test& test_;
    const RunOptions& options_;
    Compiler compiler_;
    const Shader* vertex_ = nullptr;
    Launch launch_;
    Recorded before_; // the neighbour of the case that the property at hand failed in
    TestResult result_;
};

/// A test and a compiler.
struct Work {
    const Test* test = nullptr;
    Compiler compiler = Compiler::Dxc;
    std::optional<Result<Shader>> shader;
    std::optional<Result<Shader>> vertex; // of pixel tests
};

/// glslang takes no structures of textures, into which Direct3D 9's samplers are made.
std::vector<Compiler> compilersOf(const TestFile& file, const RunOptions& options) {
    return file.direct3D9 ? std::vector{Compiler::Dxc} : options.compilers;
}

std::vector<Work> worksOf(const TestFile& file, const RunOptions& options) {
    std::vector<Work> works;
    for (const Test& test : file.tests)
        for (const Compiler compiler : compilersOf(file, options))
            if (chosen(test.name, options.filter)) works.push_back({.test = &test, .compiler = compiler, .shader = {}, .vertex = {}});
    return works;
}

void compile(Work& work, const TestFile& file) {
    work.shader = compiled(file, work.test->entry, work.test->stage, work.compiler);
    if (work.test->stage == ShaderStage::Pixel) work.vertex = compiled(file, "tgTestScreenVS", ShaderStage::Vertex, work.compiler);
}

void addOnce(std::vector<Diagnostic>& all, const std::vector<Diagnostic>& more) {
    for (const Diagnostic& each : more)
        if (std::ranges::none_of(all, [&](const Diagnostic& known) { return format(known) == format(each); })) all.push_back(each);
}

const Error* errorOf(const Work& work) {
    if (!*work.shader) return &work.shader->error();
    return work.vertex && !*work.vertex ? &work.vertex->error() : nullptr;
}

Result<TestResult> runWork(gpu::Device& device, const TestFile& file, Work& work, const RunOptions& options,
                           std::vector<std::uint64_t>* reached) {
    const auto start = std::chrono::steady_clock::now();
    Runner runner(device, file, *work.test, options, work.compiler);
    auto result = runner.run(std::move(**work.shader), work.vertex ? &**work.vertex : nullptr, reached);
    if (result) result->milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// The file with one change: do its tests notice?
Result<Fate> fateOf(gpu::Device& device, const TestFile& file, std::vector<Work>& works, const RunOptions& options) {
    for (Work& work : works) {
        if (const Error* error = errorOf(work)) return error->blame == Blame::Input ? Result<Fate>(Fate::NotCompiled) : *error;
        const auto result = runWork(device, file, work, options, nullptr);
        if (!result && result.error().blame != Blame::Input) return result.error();
        if (!result || !result->passed()) return Fate::Killed;
    }
    return Fate::Survived;
}

} // namespace

bool FileResult::passed() const {
    return read && std::ranges::all_of(tests, &TestResult::passed);
}

bool chosen(const std::string& name, const std::string& filter) {
    // Of each `*` the last place from which the rest was tried.
    std::size_t at = 0;
    std::size_t f = 0;
    std::size_t star = std::string::npos;
    std::size_t from = 0;
    while (at < name.size()) {
        if (f < filter.size() && filter[f] == '*') {
            star = f++;
            from = at;
        } else if (f < filter.size() && filter[f] == name[at]) {
            ++f, ++at;
        } else if (star != std::string::npos) {
            f = star + 1;
            at = ++from;
        } else {
            return filter.empty();
        }
    }
    return filter.find_first_not_of('*', f) == std::string::npos;
}

Result<FileResult> runFile(gpu::Device& device, const std::filesystem::path& path, const RunOptions& options) {
    const auto file = readTests(path, options.read);
    if (!file) return file.error();
    FileResult result{.path = path, .includes = file->includes};
    result.diagnostics = file->warnings;
    std::vector<Work> works = worksOf(*file, options);
    forEachInParallel(works.size(), [&](std::size_t i) { compile(works[i], *file); });
    std::vector<std::uint64_t> reached(file->counted.size());
    for (Work& work : works) {
        if (const Error* error = errorOf(work)) {
            if (error->blame != Blame::Input) return *error;
            addOnce(result.diagnostics, error->diagnostics);
            result.tests.push_back({.name = work.test->name, .at = work.test->at, .compiler = work.compiler, .cases = work.test->cases});
            continue;
        }
        auto test = runWork(device, *file, work, options, work.compiler == works.front().compiler ? &reached : nullptr);
        if (!test && test.error().blame != Blame::Input) return test.error();
        if (!test) {
            addOnce(result.diagnostics, test.error().diagnostics);
            result.tests.push_back({.name = work.test->name, .at = work.test->at, .compiler = work.compiler, .cases = work.test->cases});
        } else {
            result.tests.push_back(std::move(*test));
        }
    }
    for (std::size_t i = 0; i < reached.size(); ++i)
        result.counted.emplace_back(file->counted[i], reached[i]);
    return result;
}

Result<std::vector<MutantResult>> mutate(gpu::Device& device, const std::filesystem::path& path, const RunOptions& options,
                                         std::size_t most, const std::function<void(std::size_t, std::size_t)>& progress) {
    RunOptions one = options;
    one.compilers.resize(1);
    const auto plain = readTests(path, one.read);
    if (!plain) return plain.error();
    std::vector<std::size_t> order(plain->mutants.size());
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 random(options.seed);
    for (std::size_t i = order.size(); i > 1; --i) // the same on every system
        std::swap(order[i - 1], order[random() % i]);
    order.resize(std::min(order.size(), most));
    std::ranges::sort(order);
    std::vector<MutantResult> results;
    constexpr std::size_t kAtOnce = 8; // are compiled while none runs
    for (std::size_t first = 0; first < order.size(); first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, order.size() - first);
        std::vector<std::unique_ptr<TestFile>> files(count);
        std::vector<std::vector<Work>> works(count);
        const auto made = tryEachInParallel(count, [&](std::size_t i) -> Result<void> {
            ReadOptions read = one.read;
            read.mutant = plain->mutants[order[first + i]];
            auto file = readTests(path, read);
            if (!file) return file.error();
            files[i] = std::make_unique<TestFile>(std::move(*file));
            works[i] = worksOf(*files[i], one);
            for (Work& work : works[i])
                compile(work, *files[i]);
            return {};
        });
        if (!made) return made.error();
        for (std::size_t i = 0; i < count; ++i) {
            const auto fate = fateOf(device, *files[i], works[i], one);
            if (!fate) return fate.error();
            results.push_back({plain->mutants[order[first + i]], *fate});
        }
        progress(results.size(), order.size());
    }
    return results;
}

} // namespace tegument::testing
