// hlslc JOBS RESULTS: runs d3dcompiler_47.dll over a list of jobs, on Windows or in Wine. No effect or shader is known here: the host reads
// what the compiler wrote.
//
// JOBS holds one job a line, fields separated by tabs, paths in Windows form, UTF-8:
//     profile  entry  source  output  disassembly  [NAME=VALUE ...]      entry and disassembly may be empty
// RESULTS receives one JSON object a line, flushed after each job: a missing line tells which job brought the compiler down.

#include <windows.h>

#include <d3dcompiler.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Api {
    HRESULT(WINAPI* compileFromFile)(LPCWSTR, const D3D_SHADER_MACRO*, ID3DInclude*, LPCSTR, LPCSTR, UINT, UINT, ID3DBlob**, ID3DBlob**);
    HRESULT(WINAPI* disassemble)(LPCVOID, SIZE_T, UINT, LPCSTR, ID3DBlob**);
};

struct Job {
    std::string profile;
    std::string entry;
    std::string source;
    std::string output;
    std::string disassembly;
    std::vector<std::pair<std::string, std::string>> defines;
};

std::wstring wide(const std::string& text) {
    const int length = static_cast<int>(text.size());
    std::wstring result(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), length, nullptr, 0)), L'\0');
    MultiByteToWideChar(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()));
    return result;
}

template <class Function>
void load(HMODULE module, const char* name, Function& function) {
    function = reinterpret_cast<Function>(reinterpret_cast<void*>(GetProcAddress(module, name)));
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, '\t');)
        fields.push_back(field);
    return fields;
}

Job readJob(const std::string& line) {
    std::vector<std::string> fields = split(line);
    if (fields.size() < 5) fields.resize(5);
    Job job{fields[0], fields[1], fields[2], fields[3], fields[4], {}};
    for (std::size_t i = 5; i < fields.size(); ++i) {
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

/// Printable ASCII as it is, everything else as \u00XX: messages come in the system's code page.
std::string jsonString(const std::string& text) {
    std::string result = "\"";
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\') result += '\\';
        if (byte >= 0x20 && byte < 0x7f) {
            result += letter;
            continue;
        }
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\u%04x", byte);
        result += escaped;
    }
    return result + '"';
}

double seconds() {
    LARGE_INTEGER count;
    LARGE_INTEGER frequency;
    QueryPerformanceCounter(&count);
    QueryPerformanceFrequency(&frequency);
    return static_cast<double>(count.QuadPart) / static_cast<double>(frequency.QuadPart);
}

std::string run(const Api& api, const Job& job) {
    std::vector<D3D_SHADER_MACRO> macros;
    for (const auto& [name, value] : job.defines)
        macros.push_back({name.c_str(), value.c_str()});
    macros.push_back({nullptr, nullptr});

    ID3DBlob* binary = nullptr;
    ID3DBlob* messages = nullptr;
    const double start = seconds();
    const HRESULT result =
        api.compileFromFile(wide(job.source).c_str(), macros.data(), D3D_COMPILE_STANDARD_FILE_INCLUDE,
                            job.entry.empty() ? nullptr : job.entry.c_str(), job.profile.c_str(), 0, 0, &binary, &messages);
    const double milliseconds = (seconds() - start) * 1000;

    std::string text = textOf(messages);
    bool ok = SUCCEEDED(result) && binary != nullptr;
    if (ok && !save(job.output, binary)) ok = false, text += "\ncannot write the output file: error\n";
    ID3DBlob* listing = nullptr;
    if (ok && !job.disassembly.empty()) {
        ok = SUCCEEDED(api.disassemble(binary->GetBufferPointer(), binary->GetBufferSize(), 0, nullptr, &listing)) &&
             save(job.disassembly, listing);
        if (!ok) text += "\ncannot disassemble: error\n";
    }
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "{\"ok\":%s,\"result\":%lu,\"ms\":%.3f,\"messages\":", ok ? "true" : "false",
                  static_cast<unsigned long>(result), milliseconds);
    return numbers + jsonString(text) + "}";
}

} // namespace

int wmain(int count, wchar_t** arguments) {
    if (count != 3) return 2;
    const HMODULE module = LoadLibraryW(L"d3dcompiler_47.dll");
    if (module == nullptr) return 3;
    Api api{};
    load(module, "D3DCompileFromFile", api.compileFromFile);
    load(module, "D3DDisassemble", api.disassemble);
    if (api.compileFromFile == nullptr || api.disassemble == nullptr) return 3;

    FILE* jobsFile = _wfopen(arguments[1], L"rb");
    FILE* results = _wfopen(arguments[2], L"wb");
    if (jobsFile == nullptr || results == nullptr) return 4;
    std::string text;
    for (int letter = std::fgetc(jobsFile); letter != EOF; letter = std::fgetc(jobsFile))
        text += static_cast<char>(letter);
    std::istringstream jobs(text);
    for (std::string line; std::getline(jobs, line);) {
        std::fprintf(results, "%s\n", run(api, readJob(line)).c_str());
        std::fflush(results);
    }
    return std::fclose(results) == 0 ? 0 : 4;
}
