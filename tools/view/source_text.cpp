#include "tools/view/source_text.h"

#include "host/support/file.h"
#include "host/support/kept_inputs.h"

#include <algorithm>

namespace tegument::view {

namespace fs = std::filesystem;

namespace {

bool sameFile(const fs::path& a, const fs::path& b) {
    std::error_code failed;
    return a == b || fs::equivalent(a, b, failed);
}

} // namespace

void openSource(SourceText& source, const fs::path& file) {
    source.marks.clear();
    source.goTo.reset();
    source.file = file;
    const auto text = readFile(file);
    source.problem = text ? std::string() : format(text.error());
    source.text = text ? *text : std::string();
    source.saved = source.text;
}

void refreshSource(SourceText& source) {
    if (source.file.empty()) return;
    const auto text = readFile(source.file);
    source.problem = text ? std::string() : format(text.error());
    if (!text || *text == source.saved) return;
    if (source.edited() && *text != source.text) {
        source.problem = "the file has changed, too; Ctrl+S writes what stands here";
        return;
    }
    source.text = source.saved = *text;
}

void writeSource(SourceText& source) {
    const auto written = rewriteFile(source.file, source.text);
    source.problem = written ? std::string() : format(written.error());
    if (written) source.saved = source.text;
}

void markSource(SourceText& source, const Error& error) {
    const auto first = std::ranges::find_if(
        error.diagnostics, [](const Diagnostic& diagnostic) { return !diagnostic.at.file.empty() && diagnostic.at.line > 0; });
    if (first == error.diagnostics.end()) return;
    if (!sameFile(first->at.file, source.file) && !source.edited()) openSource(source, first->at.file);
    source.marks.clear();
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.at.line > 0 && sameFile(diagnostic.at.file, source.file)) {
            source.marks.push_back({diagnostic.at.line, diagnostic.text});
            if (source.marks.size() == 1) source.goTo = diagnostic.at.line;
        }
}

} // namespace tegument::view
