// hlslc JOBS CLAIMS: runs d3dcompiler_47.dll over a list of jobs, on Windows or in Wine. No effect is known here: the host reads what the
// compiler wrote.
//
// JOBS holds one job a line, fields separated by tabs, paths in Windows form, UTF-8:
//     profile  entry  source  output  listing  folders  [NAME=VALUE ...]
// entry, listing and folders (of includes, separated by '|') may be empty. Profile `listing` disassembles a compiled shader.
// Several of these processes share the list: whoever creates the file CLAIMS\<number> does that job. On standard output, flushed after
// each line: `begin <number>`, then one JSON object with what came of it, at last `end`. A missing object tells which job brought the
// compiler down.

#include "reflection.h"
#include "text.h"

#include <fcntl.h>
#include <io.h>

#include <map>
#include <sstream>
#include <vector>

namespace {

using hlslc::jsonString;

struct Api {
    HRESULT(WINAPI* compileFromFile)(LPCWSTR, const D3D_SHADER_MACRO*, ID3DInclude*, LPCSTR, LPCSTR, UINT, UINT, ID3DBlob**, ID3DBlob**);
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
};

std::wstring wide(const std::string& text) {
    const int length = static_cast<int>(text.size());
    std::wstring result(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), length, nullptr, 0)), L'\0');
    MultiByteToWideChar(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()));
    return result;
}

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
    Job job{fields[0], fields[1], fields[2], fields[3], fields[4], split(fields[5], '|'), {}};
    for (std::size_t i = 6; i < fields.size(); ++i) {
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

bool save(const std::string& path, ID3DBlob* blob) {
    FILE* file = _wfopen(wide(path).c_str(), L"wb");
    if (file == nullptr) return false;
    const bool written = std::fwrite(blob->GetBufferPointer(), 1, blob->GetBufferSize(), file) == blob->GetBufferSize();
    return std::fclose(file) == 0 && written;
}

bool readFile(const std::string& path, std::string& bytes) {
    FILE* file = _wfopen(wide(path).c_str(), L"rb");
    if (file == nullptr) return false;
    char block[4096];
    for (std::size_t count = std::fread(block, 1, sizeof block, file); count > 0; count = std::fread(block, 1, sizeof block, file))
        bytes.append(block, count);
    return std::fclose(file) == 0;
}

std::string folderOf(const std::string& path) {
    const std::size_t slash = path.find_last_of("\\/");
    return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

/// Microsoft's own include handler knows no folders. This one looks beside the including file, beside the main file, then in the folders.
class Includes final : public ID3DInclude {
public:
    explicit Includes(const Job& job) : main_(folderOf(job.source)) {
        for (const std::string& folder : job.folders)
            folders_.push_back(folder + "\\");
    }

    HRESULT WINAPI Open(D3D_INCLUDE_TYPE, LPCSTR name, LPCVOID parent, LPCVOID* data, UINT* size) override {
        std::vector<std::string> folders{parent != nullptr && opened_.count(parent) != 0 ? opened_[parent].folder : main_, main_};
        folders.insert(folders.end(), folders_.begin(), folders_.end());
        for (const std::string& folder : folders) {
            auto text = std::string();
            if (!readFile(folder + name, text)) continue;
            char* copy = new char[text.size() + 1];
            text.copy(copy, text.size());
            opened_[copy] = {folderOf(folder + name)};
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

private:
    struct Opened {
        std::string folder;
    };
    std::string main_;
    std::vector<std::string> folders_;
    std::map<LPCVOID, Opened> opened_;
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
    std::string text;
    std::string reflection = "null";
};

bool list(const Api& api, const Job& job, LPCVOID shader, SIZE_T size) {
    ID3DBlob* listing = nullptr;
    return SUCCEEDED(api.disassemble(shader, size, 0, nullptr, &listing)) && save(job.listing, listing);
}

Outcome disassemble(const Api& api, const Job& job) {
    Outcome outcome;
    std::string shader;
    outcome.ok = readFile(job.source, shader) && list(api, job, shader.data(), shader.size());
    outcome.result = outcome.ok ? S_OK : E_FAIL;
    return outcome;
}

bool isEffect(const Job& job) {
    return job.profile.rfind("fx_", 0) == 0;
}

bool hasReflection(const Job& job) {
    return !isEffect(job) && (job.profile.find("_4_") != std::string::npos || job.profile.find("_5_") != std::string::npos);
}

Outcome compile(const Api& api, const Job& job) {
    std::vector<D3D_SHADER_MACRO> macros;
    for (const auto& [name, value] : job.defines)
        macros.push_back({name.c_str(), value.c_str()});
    macros.push_back({nullptr, nullptr});

    Includes own(job);
    ID3DInclude* includes = job.folders.empty() ? D3D_COMPILE_STANDARD_FILE_INCLUDE : &own;
    ID3DBlob* binary = nullptr;
    ID3DBlob* messages = nullptr;
    Outcome outcome;
    outcome.result = api.compileFromFile(wide(job.source).c_str(), macros.data(), includes, job.entry.empty() ? nullptr : job.entry.c_str(),
                                         job.profile.c_str(), 0, 0, &binary, &messages);
    outcome.text = textOf(messages);
    outcome.ok = SUCCEEDED(outcome.result) && binary != nullptr;
    if (outcome.ok && !save(job.output, binary)) outcome.ok = false, outcome.text += "\ncannot write the output file: error\n";
    if (outcome.ok && !job.listing.empty() && !list(api, job, binary->GetBufferPointer(), binary->GetBufferSize()))
        outcome.ok = false, outcome.text += "\ncannot disassemble: error\n";
    if (outcome.ok && hasReflection(job)) outcome.reflection = hlslc::reflection(api.reflect, *binary);
    if (binary != nullptr) binary->Release();
    if (messages != nullptr) messages->Release();
    return outcome;
}

std::string run(const Api& api, const Job& job) {
    const double start = seconds();
    const Outcome outcome = job.profile == "listing" ? disassemble(api, job) : compile(api, job);
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "{\"ok\":%s,\"result\":%lu,\"ms\":%.3f,", outcome.ok ? "true" : "false",
                  static_cast<unsigned long>(outcome.result), (seconds() - start) * 1000);
    return numbers + ("\"messages\":" + jsonString(outcome.text)) + ",\"reflection\":" + outcome.reflection + "}";
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
    if (count != 3) return 2;
    const HMODULE module = LoadLibraryW(L"d3dcompiler_47.dll");
    Api api{};
    if (module == nullptr || !load(module, "D3DCompileFromFile", api.compileFromFile) || !load(module, "D3DDisassemble", api.disassemble) ||
        !load(module, "D3DReflect", api.reflect))
        return 3;
    std::string list;
    FILE* jobs = _wfopen(arguments[1], L"rb");
    if (jobs == nullptr) return 4;
    for (int letter = std::fgetc(jobs); letter != EOF; letter = std::fgetc(jobs))
        list += static_cast<char>(letter);
    std::fclose(jobs);

    _setmode(_fileno(stdout), _O_BINARY);
    const std::vector<std::string> lines = split(list, '\n');
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!claim(arguments[2], i)) continue;
        say("begin " + std::to_string(i));
        say(run(api, readJob(lines[i])));
    }
    say("end");
    return 0;
}
