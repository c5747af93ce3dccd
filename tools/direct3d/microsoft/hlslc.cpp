// hlslc JOBS CLAIMS [STORE]: runs d3dcompiler_47.dll over a list of jobs, on Windows or in Wine. No effect is known here: the host reads
// what the compiler wrote.
//
// JOBS holds one job a line, fields separated by tabs, paths in Windows form, UTF-8:
//     profile  entry  source  output  listing  folders  [NAME=VALUE ...]
// entry, listing and folders (of includes, separated by '|') may be empty. Profile `listing` disassembles a compiled shader.
// Several of these processes share the list: whoever creates the file CLAIMS\<number> does that job. On standard output, flushed after
// each line: `begin <number>`, then one JSON object with what came of it, at last `end`. A missing object tells which job brought the
// compiler down.
//
// What was compiled is kept in the folder STORE under the hash of all that the compiler reads: the text that its own preprocessor makes,
// the profile, the entry point. That text is the same for the same code in other files, or with macros that it does not ask for.

#include "files.h"
#include "reflection.h"
#include "store.h"
#include "text.h"

#include <fcntl.h>
#include <io.h>

#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace {

using hlslc::jsonString;
using hlslc::readFile;
using hlslc::save;
using hlslc::wide;

struct Api {
    HRESULT(WINAPI* preprocess)(LPCVOID, SIZE_T, LPCSTR, const D3D_SHADER_MACRO*, ID3DInclude*, ID3DBlob**, ID3DBlob**);
    HRESULT(WINAPI* compileFromFile)(LPCWSTR, const D3D_SHADER_MACRO*, ID3DInclude*, LPCSTR, LPCSTR, UINT, UINT, ID3DBlob**, ID3DBlob**);
    HRESULT(WINAPI* compile)
    (LPCVOID, SIZE_T, LPCSTR, const D3D_SHADER_MACRO*, ID3DInclude*, LPCSTR, LPCSTR, UINT, UINT, ID3DBlob**, ID3DBlob**);
    HRESULT(WINAPI* disassemble)(LPCVOID, SIZE_T, UINT, LPCSTR, ID3DBlob**);
    hlslc::Reflect reflect;
};

struct Job {
    std::string profile;
    std::string entry;
    std::string source;
    std::string output;
    std::string listing;
    std::vector<std::string> folders;
    std::vector<std::pair<std::string, std::string>> defines;
    bool compatible = false; // as fxc has it with /Gec, and without a byte order mark
};

template <class Function>
bool load(HMODULE module, const char* name, Function& function) {
    function = reinterpret_cast<Function>(reinterpret_cast<void*>(GetProcAddress(module, name)));
    return function != nullptr;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> fields;
    std::istringstream in(text);
    for (std::string field; std::getline(in, field, separator);)
        fields.push_back(field);
    return fields;
}

Job readJob(const std::string& line) {
    std::vector<std::string> fields = split(line, '\t');
    if (fields.size() < 6) fields.resize(6);
    Job job{fields[0], fields[1], fields[2], fields[3], fields[4], split(fields[5], '|'), {}, false};
    for (std::size_t i = 6; i < fields.size(); ++i) {
        if (fields[i] == "/Gec=1") {
            job.compatible = true;
            continue;
        }
        const std::size_t equals = fields[i].find('=');
        job.defines.emplace_back(fields[i].substr(0, equals), equals == std::string::npos ? "1" : fields[i].substr(equals + 1));
    }
    return job;
}

std::string textOf(ID3DBlob* blob) {
    if (blob == nullptr) return {};
    std::string text(static_cast<const char*>(blob->GetBufferPointer()), blob->GetBufferSize());
    return text.substr(0, text.find('\0'));
}

std::string bytesOf(ID3DBlob& blob) {
    return {static_cast<const char*>(blob.GetBufferPointer()), blob.GetBufferSize()};
}

std::string folderOf(const std::string& path) {
    const std::size_t slash = path.find_last_of("\\/");
    return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

bool isAbsolute(const std::string& path) {
    return path.rfind('/', 0) == 0 || path.rfind('\\', 0) == 0 || path.find(':') == 1;
}

/// Microsoft's own include handler knows no folders, and does not say what it opened. This one looks where that does, beside the including
/// file and beside each on the way up to the main file, then in the folders.
class Includes final : public ID3DInclude {
public:
    explicit Includes(const Job& job) : main_(folderOf(job.source)) {
        for (const std::string& folder : job.folders)
            folders_.push_back(folder + "\\");
    }

    HRESULT WINAPI Open(D3D_INCLUDE_TYPE, LPCSTR name, LPCVOID parent, LPCVOID* data, UINT* size) override {
        std::vector<std::string> folders;
        for (LPCVOID above = parent; above != nullptr && opened_.count(above) != 0; above = opened_[above].parent)
            folders.push_back(opened_[above].folder);
        folders.push_back(main_);
        folders.insert(folders.end(), folders_.begin(), folders_.end());
        if (isAbsolute(name)) folders = {""};
        for (const std::string& folder : folders) {
            auto text = std::string();
            if (!readFile(folder + name, text)) continue;
            char* copy = new char[text.size() + 1];
            text.copy(copy, text.size());
            opened_[copy] = {folderOf(folder + name), parent};
            files_.insert(folder + name);
            *data = copy;
            *size = static_cast<UINT>(text.size());
            return S_OK;
        }
        return E_FAIL;
    }

    HRESULT WINAPI Close(LPCVOID data) override {
        opened_.erase(data);
        delete[] static_cast<const char*>(data);
        return S_OK;
    }

    const std::set<std::string>& files() const { return files_; }

private:
    struct Opened {
        std::string folder;
        LPCVOID parent;
    };
    std::string main_;
    std::vector<std::string> folders_;
    std::map<LPCVOID, Opened> opened_;
    std::set<std::string> files_;
};

double seconds() {
    LARGE_INTEGER count;
    LARGE_INTEGER frequency;
    QueryPerformanceCounter(&count);
    QueryPerformanceFrequency(&frequency);
    return static_cast<double>(count.QuadPart) / static_cast<double>(frequency.QuadPart);
}

struct Outcome {
    HRESULT result = E_FAIL;
    bool ok = false;
    bool found = false; // in the store
    hlslc::Compiled compiled{{}, {}, "null", {}};
    std::set<std::string> included;
};

bool list(const Api& api, LPCVOID shader, SIZE_T size, std::string& listing) {
    ID3DBlob* made = nullptr;
    if (FAILED(api.disassemble(shader, size, 0, nullptr, &made))) return false;
    listing = bytesOf(*made);
    made->Release();
    return true;
}

Outcome disassemble(const Api& api, const Job& job) {
    Outcome outcome;
    std::string shader;
    outcome.ok = readFile(job.source, shader) && list(api, shader.data(), shader.size(), outcome.compiled.listing);
    outcome.result = outcome.ok ? S_OK : E_FAIL;
    return outcome;
}

bool isEffect(const Job& job) {
    return job.profile.rfind("fx_", 0) == 0;
}

bool hasReflection(const Job& job) {
    return !isEffect(job) && (job.profile.find("_4_") != std::string::npos || job.profile.find("_5_") != std::string::npos);
}

std::vector<D3D_SHADER_MACRO> macrosOf(const Job& job) {
    std::vector<D3D_SHADER_MACRO> macros;
    for (const auto& [name, value] : job.defines)
        macros.push_back({name.c_str(), value.c_str()});
    macros.push_back({nullptr, nullptr});
    return macros;
}

void lose(Outcome& outcome, const char* why) {
    outcome.ok = false;
    outcome.compiled.messages += why;
}

bool readSource(const Job& job, std::string& text) {
    if (!readFile(job.source, text)) return false;
    if (job.compatible && text.rfind("\xef\xbb\xbf", 0) == 0) text.erase(0, 3);
    return true;
}

HRESULT compiled(const Api& api, const Job& job, Includes& includes, ID3DBlob** binary, ID3DBlob** messages) {
    const char* entry = job.entry.empty() ? nullptr : job.entry.c_str();
    const std::vector<D3D_SHADER_MACRO> macros = macrosOf(job);
    if (!job.compatible)
        return api.compileFromFile(wide(job.source).c_str(), macros.data(), &includes, entry, job.profile.c_str(), 0, 0, binary, messages);
    std::string text;
    if (!readSource(job, text)) return E_FAIL;
    return api.compile(text.data(), text.size(), job.source.c_str(), macros.data(), &includes, entry, job.profile.c_str(),
                       D3DCOMPILE_ENABLE_BACKWARDS_COMPATIBILITY, 0, binary, messages);
}

Outcome compile(const Api& api, const Job& job) {
    ID3DBlob* binary = nullptr;
    ID3DBlob* messages = nullptr;
    Outcome outcome;
    Includes includes(job);
    outcome.result = compiled(api, job, includes, &binary, &messages);
    outcome.included = includes.files();
    outcome.compiled.messages = textOf(messages);
    outcome.ok = SUCCEEDED(outcome.result) && binary != nullptr;
    if (outcome.ok) outcome.compiled.binary = bytesOf(*binary);
    if (outcome.ok && !job.listing.empty() && !list(api, binary->GetBufferPointer(), binary->GetBufferSize(), outcome.compiled.listing))
        lose(outcome, "\ncannot disassemble: error\n");
    if (outcome.ok && hasReflection(job)) outcome.compiled.reflection = hlslc::reflection(api.reflect, *binary);
    if (binary != nullptr) binary->Release();
    if (messages != nullptr) messages->Release();
    return outcome;
}

/// The text behind the preprocessor, with the lines that say where it stands in files, and without them. Empty where there is none.
struct Text {
    std::string placed;
    std::string bare;
    std::set<std::string> included;
};

std::string withoutPlaces(const std::string& text) {
    std::string bare;
    for (const std::string& line : split(text, '\n'))
        if (line.rfind("#line", 0) != 0 && line.find_first_not_of(" \t\r") != std::string::npos) bare += line + '\n';
    return bare;
}

Text preprocess(const Api& api, const Job& job) {
    Includes includes(job);
    std::string source;
    ID3DBlob* code = nullptr;
    ID3DBlob* messages = nullptr;
    Text text;
    if (readSource(job, source) &&
        SUCCEEDED(api.preprocess(source.data(), source.size(), job.source.c_str(), macrosOf(job).data(), &includes, &code, &messages)))
        text.placed = textOf(code), text.bare = withoutPlaces(text.placed);
    text.included = includes.files();
    if (code != nullptr) code->Release();
    if (messages != nullptr) messages->Release();
    return text;
}

/// Entry points of one file share its text.
const Text& textFor(const Api& api, const Job& job) {
    static std::map<std::string, Text> known;
    std::string name = job.source + (job.compatible ? "|/Gec" : "");
    for (const std::string& folder : job.folders)
        name += '|' + folder;
    for (const auto& [macro, value] : job.defines)
        name += '\t' + macro + '=' + value;
    const auto found = known.find(name);
    return found != known.end() ? found->second : known.emplace(name, preprocess(api, job)).first->second;
}

std::string keyFor(const Job& job, const std::string& text) {
    if (text.empty()) return {};
    return hlslc::hash(job.profile + '\n' + job.entry + '\n' + (job.listing.empty() ? "" : "listing") + '\n' +
                       (job.compatible ? "/Gec\n" : "") + text);
}

/// Without the one that every effect gets: effects are deprecated.
std::string withoutDeprecation(const std::string& messages) {
    std::string rest;
    for (const std::string& line : split(messages, '\n'))
        if (line.find("X4717") == std::string::npos && line.find_first_not_of(" \t\r") != std::string::npos) rest += line + '\n';
    return rest;
}

/// A message names places: it holds for the text with its places only. What was refused is tried again: its text is about to change.
Outcome compileOnce(const Api& api, const hlslc::Store& store, const Job& job) {
    if (!store.open()) return compile(api, job);
    const Text& text = textFor(api, job);
    const std::string anywhere = keyFor(job, text.bare);
    const std::string here = keyFor(job, text.placed);
    for (const std::string& key : {anywhere, here})
        if (auto found = store.find(key)) return {S_OK, true, true, std::move(*found), text.included};
    Outcome outcome = compile(api, job);
    outcome.compiled.messages = withoutDeprecation(outcome.compiled.messages);
    if (outcome.ok) store.keep(outcome.compiled.messages.empty() ? anywhere : here, outcome.compiled);
    return outcome;
}

void write(const Job& job, Outcome& outcome) {
    const bool binary = job.profile == "listing" || save(job.output, outcome.compiled.binary);
    if (!binary || (!job.listing.empty() && !save(job.listing, outcome.compiled.listing)))
        lose(outcome, "\ncannot write the output file: error\n");
}

std::string run(const Api& api, const hlslc::Store& store, const Job& job) {
    const double start = seconds();
    Outcome outcome = job.profile == "listing" ? disassemble(api, job) : compileOnce(api, store, job);
    if (outcome.ok) write(job, outcome);
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "{\"ok\":%s,\"kept\":%s,\"result\":%lu,\"ms\":%.3f,", outcome.ok ? "true" : "false",
                  outcome.found ? "true" : "false", static_cast<unsigned long>(outcome.result), (seconds() - start) * 1000);
    std::string included;
    for (const std::string& file : outcome.included)
        included += (included.empty() ? "" : ",") + jsonString(file);
    return numbers + ("\"messages\":" + jsonString(outcome.compiled.messages)) + ",\"reflection\":" + outcome.compiled.reflection +
           ",\"included\":[" + included + "]}";
}

std::string narrow(const std::wstring& text) {
    const int length = static_cast<int>(text.size());
    std::string result(static_cast<std::size_t>(WideCharToMultiByte(CP_UTF8, 0, text.data(), length, nullptr, 0, nullptr, nullptr)), '\0');
    WideCharToMultiByte(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()), nullptr, nullptr);
    return result;
}

void say(const std::string& line) {
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fputc('\n', stdout);
    std::fflush(stdout);
}

/// True for the one process that asks first.
bool claim(const std::wstring& folder, std::size_t job) {
    const std::wstring name = folder + L"\\" + std::to_wstring(job);
    const HANDLE file = CreateFileW(name.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) return false;
    CloseHandle(file);
    return true;
}

} // namespace

int wmain(int count, wchar_t** arguments) {
    if (count != 3 && count != 4) return 2;
    const HMODULE module = LoadLibraryW(L"d3dcompiler_47.dll");
    Api api{};
    if (module == nullptr || !load(module, "D3DCompileFromFile", api.compileFromFile) || !load(module, "D3DDisassemble", api.disassemble) ||
        !load(module, "D3DReflect", api.reflect) || !load(module, "D3DPreprocess", api.preprocess) ||
        !load(module, "D3DCompile", api.compile))
        return 3;
    std::string list;
    FILE* jobs = _wfopen(arguments[1], L"rb");
    if (jobs == nullptr) return 4;
    for (int letter = std::fgetc(jobs); letter != EOF; letter = std::fgetc(jobs))
        list += static_cast<char>(letter);
    std::fclose(jobs);

    _setmode(_fileno(stdout), _O_BINARY);
    const hlslc::Store store(count == 4 ? narrow(arguments[3]) : "");
    const std::vector<std::string> lines = split(list, '\n');
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!claim(arguments[2], i)) continue;
        say("begin " + std::to_string(i));
        say(run(api, store, readJob(lines[i])));
    }
    say("end");
    return 0;
}
