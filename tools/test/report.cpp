#include "tools/test/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::testing {

namespace {

/// What XML 1.0 can hold of it.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\n': result += "&#10;"; break;
        default: result += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? '?' : c;
        }
    return result;
}

std::string testCase(const FileResult& file, const TestResult& test) {
    std::string text =
        fmt::format(R"xml(    <testcase classname="{}" name="{} ({})" file="{}" line="{}" time="{:.3f}" assertions="{}")xml",
                    escaped(file.path.filename().string()), escaped(test.name), test.compiler == Compiler::Dxc ? "dxc" : "glslang",
                    escaped(test.at.file), test.at.line, test.milliseconds / 1000, test.assertions);
    if (test.passed()) return text + "/>\n";
    text += ">\n";
    if (!test.compiled) text += "      <error message=\"it does not compile\"/>\n";
    for (const Failure& failure : test.failures)
        text +=
            fmt::format("      <failure message=\"{}\">{}</failure>\n", escaped(failure.message.text), escaped(format(failure.message)));
    return text + "    </testcase>\n";
}

} // namespace

std::string junit(const std::vector<FileResult>& results) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (const FileResult& file : results) {
        const auto errors = std::ranges::count_if(file.tests, [](const TestResult& test) { return !test.compiled; });
        const auto failed = std::ranges::count_if(file.tests, [](const TestResult& test) { return test.compiled && !test.passed(); });
        double seconds = 0;
        for (const TestResult& test : file.tests)
            seconds += test.milliseconds / 1000;
        text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
                            escaped(file.path.string()), file.tests.size(), failed, errors, seconds);
        for (const TestResult& test : file.tests)
            text += testCase(file, test);
        for (const Diagnostic& message : file.diagnostics)
            text += fmt::format("    <system-err>{}</system-err>\n", escaped(format(message)));
        text += "  </testsuite>\n";
    }
    return text + "</testsuites>\n";
}

Coverage coverageOf(const std::vector<FileResult>& results) {
    Coverage coverage;
    for (const FileResult& file : results)
        for (const auto& [place, runs] : file.counted) {
            FileCoverage& source = coverage[place.at.file];
            std::uint64_t& most = place.side < 0 ? source.lines[place.at.line] : source.sides[{place.at.line, place.at.column, place.side}];
            most = std::max(most, runs);
        }
    return coverage;
}

std::string lcov(const Coverage& coverage) {
    std::string text;
    for (const auto& [file, source] : coverage) {
        text += fmt::format("TN:\nSF:{}\n", file);
        int line = 0, block = 0;
        for (const auto& [place, taken] : source.sides) {
            if (place[2] == 0) block = place[0] == line ? block + 1 : 0;
            line = place[0];
            const bool reached = taken + source.sides.at({line, place[1], 1 - place[2]}) > 0;
            text += fmt::format("BRDA:{},{},{},{}\n", line, block, place[2], reached ? std::to_string(taken) : "-");
        }
        text += fmt::format("BRF:{}\nBRH:{}\n", source.sides.size(), ran(source.sides));
        for (const auto& [line, runs] : source.lines)
            text += fmt::format("DA:{},{}\n", line, runs);
        text += fmt::format("LF:{}\nLH:{}\nend_of_record\n", source.lines.size(), ran(source.lines));
    }
    return text;
}

} // namespace tegument::testing
