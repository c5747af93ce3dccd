#include "tools/lsp/server.h"

#include "tools/lsp/answers.h"
#include "tools/lsp/documents.h"

#include <algorithm>
#include <set>
#include <utility>

namespace tegument::lsp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostFiles = 500; // of one effect; more are a circle that nothing ends

std::string textAt(const Json& json, const char* place) {
    const Json::json_pointer pointer(place);
    if (!json.contains(pointer)) return {};
    const Json& found = json.at(pointer);
    return found.is_string() ? found.get<std::string>() : std::string();
}

int numberAt(const Json& json, const char* place) {
    const Json::json_pointer pointer(place);
    if (!json.contains(pointer)) return 0;
    const Json& found = json.at(pointer);
    return found.is_number_integer() ? static_cast<int>(std::clamp<std::int64_t>(found.get<std::int64_t>(), 0, 1 << 28)) : 0;
}

/// What is known of an open file, with all that it includes.
struct Unit {
    std::vector<FileNames> files;
    std::optional<Effect> effect; // as it was last read without an error
    Compiled compiled;            // of that
    bool stale = false;           // the compilers have not been asked since
    bool untested = false;        // it holds tests, and was saved since they ran
    std::set<std::string> told;   // files that diagnostics were published of
};

class Server {
public:
    Server(int output, const Options& options) : output_(output), options_(options) {}

    /// False once it is to end.
    bool take(const std::string& text);
    void idle();
    [[nodiscard]] bool hasWork() const {
        return std::ranges::any_of(units_, [](const auto& entry) { return entry.second.stale || entry.second.untested; });
    }
    [[nodiscard]] int exitCode() const { return shutDown_ ? 0 : 1; }

private:
    void request(const Json& id, const std::string& method, const Json& parameters);
    void notified(const std::string& method, const Json& parameters);
    Json answerAt(const Json& parameters, const std::string& method);

    std::vector<FileNames> filesOf(const std::string& path) const;
    std::optional<std::string> includeOf(const std::string& path, const std::string& name) const;
    void changed(const std::string& path);
    void read(const std::string& path);
    void closed(const std::string& path);
    void publish(const std::string& path, Unit& unit, const std::vector<Diagnostic>& diagnostics);
    void say(const Json& message) { ended_ = !send(output_, message) || ended_; }

    int output_;
    const Options& options_;
    Documents documents_;
    std::map<std::string, Unit> units_; // by the path of an open document
    bool shutDown_ = false;
    bool ended_ = false;
};

bool Server::take(const std::string& text) {
    const Json message = Json::parse(text, nullptr, false);
    if (message.is_discarded()) {
        say(refusal(nullptr, kParseError, "this is no JSON"));
        return !ended_;
    }
    const std::string method = textAt(message, "/method");
    const Json parameters = message.is_object() && message.contains("params") ? message["params"] : Json();
    const Json id = message.is_object() && message.contains("id") ? message["id"] : Json();
    if (method == "exit") return false;
    if (method.empty() || !(id.is_null() || id.is_number_integer() || id.is_string())) {
        if (!message.is_object() || !message.contains("result"))
            say(refusal(nullptr, kInvalidRequest, "neither a request nor a notification"));
    } else if (id.is_null()) {
        notified(method, parameters);
    } else {
        request(id, method, parameters);
    }
    return !ended_;
}

void Server::request(const Json& id, const std::string& method, const Json& parameters) {
    if (method == "shutdown") {
        shutDown_ = true;
        return say(answer(id, nullptr));
    }
    if (method == "initialize")
        return say(answer(id, {{"capabilities",
                                {{"textDocumentSync", {{"openClose", true}, {"change", 1}, {"save", true}}},
                                 {"hoverProvider", true},
                                 {"definitionProvider", true},
                                 {"completionProvider", {{"triggerCharacters", {":", "="}}}}}},
                               {"serverInfo", {{"name", "tegument"}}}}));
    constexpr const char* kRequests[] = {"textDocument/hover", "textDocument/definition", "textDocument/completion"};
    if (std::ranges::find(kRequests, method) == std::end(kRequests)) return say(refusal(id, kMethodNotFound, method + " is not offered"));
    say(answer(id, answerAt(parameters, method)));
}

Json Server::answerAt(const Json& parameters, const std::string& method) {
    const std::string path = pathOf(textAt(parameters, "/textDocument/uri"));
    const std::string* text = documents_.find(path);
    const auto found = units_.find(path);
    if (!text || found == units_.end()) return nullptr;
    const Unit* unit = &found->second;
    // What includes this file knows more of it than it does itself.
    for (const auto& [other, its] : units_)
        if (!unit->effect && its.effect && std::ranges::find(its.files, path, &FileNames::file) != its.files.end()) unit = &its;
    std::vector<FileNames> files = found->second.files;
    if (unit != &found->second) files.insert(files.end(), unit->files.begin(), unit->files.end());
    const int line = numberAt(parameters, "/position/line") + 1;
    const Question question{.text = *text,
                            .line = line,
                            .column = byteColumn(lineOf(*text, line), numberAt(parameters, "/position/character")),
                            .files = files,
                            .effect = unit->effect ? &*unit->effect : nullptr,
                            .compiled = &unit->compiled,
                            .semantics = options_.semantics,
                            .include = [&](const std::string& name) { return includeOf(path, name); }};
    if (method == "textDocument/completion") return completion(question);
    if (method == "textDocument/hover") {
        const auto said = hover(question);
        return said ? Json{{"contents", {{"kind", "markdown"}, {"value", *said}}}} : Json(nullptr);
    }
    const auto place = definition(question);
    if (!place) return nullptr;
    const std::string file = normal(place->file);
    return {{"uri", uriOf(file)}, {"range", rangeJson(documents_.textOf(file), *place)}};
}

void Server::notified(const std::string& method, const Json& parameters) {
    const std::string path = pathOf(textAt(parameters, "/textDocument/uri"));
    if (path.empty()) return;
    if (method == "textDocument/didOpen") {
        documents_.set(path, textAt(parameters, "/textDocument/text"));
    } else if (method == "textDocument/didChange") {
        const Json changes = parameters.contains("contentChanges") ? parameters["contentChanges"] : Json();
        if (!documents_.find(path) || !changes.is_array() || changes.empty() || !changes.back().contains("text")) return;
        documents_.set(path, textAt(changes.back(), "/text")); // whole texts are asked for: the last one holds
    } else if (method == "textDocument/didClose") {
        return closed(path);
    } else if (method != "textDocument/didSave") {
        return;
    }
    if (!documents_.find(path)) return;
    changed(path);
    for (auto& [other, unit] : units_) // after a change, marks would stand at other lines
        if (method != "textDocument/didChange" && options_.test && other.ends_with(".test.hlsl") &&
            std::ranges::find(unit.files, path, &FileNames::file) != unit.files.end())
            unit.untested = true;
}

std::optional<std::string> Server::includeOf(const std::string& path, const std::string& name) const {
    const FileReader reader = documents_.reader(path, options_.load);
    std::vector<fs::path> folders = {fs::path(path).parent_path()};
    folders.insert(folders.end(), options_.load.includeFolders.begin(), options_.load.includeFolders.end());
    for (const fs::path& folder : folders)
        if (const std::string file = normal(folder / name); reader(file)) return file;
    return std::nullopt;
}

std::vector<FileNames> Server::filesOf(const std::string& path) const {
    const FileReader reader = documents_.reader(path, options_.load);
    std::vector<std::string> paths = {path};
    std::vector<FileNames> files;
    for (std::size_t i = 0; i < paths.size() && i < kMostFiles; ++i) {
        const auto text = reader(paths[i]);
        files.push_back(namesOf(paths[i], text ? *text : std::string()));
        for (const auto& [line, name] : files.back().includes)
            if (const auto file = includeOf(paths[i], name); file && std::ranges::find(paths, *file) == paths.end()) paths.push_back(*file);
    }
    return files;
}

/// The file itself, and every open effect that includes it.
void Server::changed(const std::string& path) {
    read(path);
    for (auto& [other, unit] : units_)
        if (other != path && std::ranges::find(unit.files, path, &FileNames::file) != unit.files.end()) read(other);
}

void Server::read(const std::string& path) {
    Unit& unit = units_[path];
    unit.files = filesOf(path);
    const bool isEffect =
        std::ranges::any_of(unit.files.front().declarations, [](const Declaration& one) { return one.kind == "technique"; });
    if (!isEffect && fs::path(path).extension() != ".fx") return publish(path, unit, {}); // a part is judged by what includes it
    auto effect = loadEffect(path, options_.load, documents_.reader(path, options_.load));
    publish(path, unit, effect ? effect->warnings : effect.error().diagnostics);
    unit.stale = static_cast<bool>(effect);
    if (effect) unit.effect = std::move(*effect);
}

void Server::idle() {
    for (auto& [path, unit] : units_) {
        if (std::exchange(unit.untested, false)) return publish(path, unit, options_.test(path));
        if (!unit.stale) continue;
        unit.stale = false;
        unit.compiled = compile(*unit.effect);
        std::vector<Diagnostic> all = unit.effect->warnings;
        all.insert(all.end(), unit.compiled.diagnostics.begin(), unit.compiled.diagnostics.end());
        return publish(path, unit, all); // one effect, then messages first
    }
}

void Server::closed(const std::string& path) {
    documents_.close(path);
    if (const auto found = units_.find(path); found != units_.end()) {
        publish(path, found->second, {});
        units_.erase(found);
    }
}

void Server::publish(const std::string& path, Unit& unit, const std::vector<Diagnostic>& diagnostics) {
    std::map<std::string, Json> lists;
    for (const std::string& file : unit.told)
        lists[file] = Json::array();
    lists[path] = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) {
        const std::string file = diagnostic.at.file.empty() ? path : normal(diagnostic.at.file);
        if (!lists[file].is_array()) lists[file] = Json::array();
        lists[file].push_back(diagnosticJson(documents_.textOf(file), diagnostic));
    }
    unit.told.clear();
    for (const auto& [file, list] : lists) {
        if (!list.empty()) unit.told.insert(file);
        say(notification("textDocument/publishDiagnostics", {{"uri", uriOf(file)}, {"diagnostics", list}}));
    }
}

} // namespace

int serve(int input, int output, const Options& options) {
    Input messages(input);
    Server server(output, options);
    for (;;) {
        if (server.hasWork() && !messages.waits(options.idleMilliseconds)) {
            server.idle();
            continue;
        }
        const auto message = messages.next();
        if (!message || !server.take(*message)) return server.exitCode();
    }
}

} // namespace tegument::lsp
