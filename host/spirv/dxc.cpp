#include "host/spirv/backend.h"

#include "host/spirv/messages.h"
#include "host/support/children.h"
#include "host/support/file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#ifdef TEGUMENT_HAVE_DXC
#include "host/spirv/dxc_api.h"
#include "host/support/system.h"

#include <atomic>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <new>
#include <shared_mutex>
#endif

namespace tegument::dxc {

#ifdef TEGUMENT_HAVE_DXC

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> candidates() {
    if (const char* own = std::getenv("TEGUMENT_DXC"); own != nullptr && *own != '\0') return {own};
    const std::string name = libraryName("dxcompiler");
    std::vector<fs::path> all = {programFile().parent_path() / name, cacheFolder() / "tools/dxc" / name};
    if (const fs::path built(TEGUMENT_DXC_DIR); !built.empty()) all.insert(all.begin(), built / name);
    return all;
}

/// Loaded once and never unloaded: the library keeps thread-local state that would outlive it.
struct Library {
    DxcCreateInstanceProc create = nullptr;
    fs::path path;
    std::string why; // there is none

    Library() {
        for (const fs::path& candidate : candidates()) {
            void* handle = openLibrary(candidate, why);
            if (handle == nullptr) continue;
            create = reinterpret_cast<DxcCreateInstanceProc>(functionOf(handle, "DxcCreateInstance"));
            path = candidate;
            CComPtr<IDxcCompiler3> compiler;
            if (create != nullptr && SUCCEEDED(create(CLSID_DxcCompiler, __uuidof(IDxcCompiler3), reinterpret_cast<void**>(&compiler))))
                return;
            why = candidate.string() + (create == nullptr ? " is no DXC" : " is a DXC of another version: it has no IDxcCompiler3");
            create = nullptr;
        }
    }
};

const Library& library() {
    static const Library kLibrary;
    return kLibrary;
}

/// DXC's own exceptions do not leave it.
void throwWhereMemoryEnded(HRESULT result) {
    if (result == E_OUTOFMEMORY) throw std::bad_alloc();
}

template <class T>
CComPtr<T> instance(REFCLSID type) {
    CComPtr<T> made;
    if (library().create != nullptr) throwWhereMemoryEnded(library().create(type, __uuidof(T), reinterpret_cast<void**>(&made)));
    return made;
}

/// wchar_t holds UTF-32 here, whatever the locale, and UTF-16 on Windows; an invalid byte becomes '?'.
std::wstring wide(std::string_view text) {
    std::wstring result;
    const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(text[at])); };
    for (std::size_t at = 0; at < text.size();) {
        const unsigned first = byte(at++);
        const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
        unsigned value = more == 0 ? first : first & (0x3fU >> static_cast<unsigned>(more));
        int left = more;
        for (; left > 0 && at < text.size() && (byte(at) & 0xc0U) == 0x80U; --left)
            value = value << 6U | (byte(at++) & 0x3fU);
        if (left > 0 || (more == 0 && first >= 0x80)) value = '?';
        constexpr unsigned kPairs = 0x10000; // beyond it UTF-16 takes two
        const bool pair = sizeof(wchar_t) == 2 && value >= kPairs;
        if (pair) result += static_cast<wchar_t>(0xd800U + ((value - kPairs) >> 10U));
        result += static_cast<wchar_t>(pair ? 0xdc00U + (value & 0x3ffU) : value);
    }
    return result;
}

std::string narrow(const wchar_t* text) {
    std::string result;
    for (; *text != 0; ++text) {
        const auto c = static_cast<char32_t>(*text);
        const auto tail = [&](unsigned shift) { result += static_cast<char>(0x80U | ((c >> shift) & 0x3fU)); };
        if (c < 0x80) {
            result += static_cast<char>(c);
        } else if (c < 0x800) {
            result += static_cast<char>(0xc0U | (c >> 6U));
            tail(0);
        } else if (c < 0x10000) {
            result += static_cast<char>(0xe0U | (c >> 12U));
            tail(6);
            tail(0);
        } else {
            result += static_cast<char>(0xf0U | (c >> 18U));
            tail(12);
            tail(6);
            tail(0);
        }
    }
    return result;
}

/// Lives on the stack of compile(), which outlives every reference that the compiler takes.
class IncludeHandler : public IDxcIncludeHandler {
public:
    IncludeHandler(IncludeReader& reader, IDxcUtils* utils) : reader_(reader), utils_(utils) {}
    virtual ~IncludeHandler() = default;

    HRESULT LoadSource(LPCWSTR name, IDxcBlob** source) override {
        *source = nullptr;
        const auto found = reader_.open(narrow(name));
        if (!found) return E_FAIL;
        IDxcBlobEncoding* blob = nullptr;
        const HRESULT made = utils_->CreateBlob(found->text.data(), static_cast<UINT32>(found->text.size()), DXC_CP_UTF8, &blob);
        *source = blob;
        return made;
    }
    HRESULT QueryInterface(REFIID, void** object) override {
        *object = nullptr;
        return E_NOINTERFACE;
    }
    ULONG AddRef() override { return ++references_; }
    ULONG Release() override { return --references_; }

private:
    IncludeReader& reader_;
    IDxcUtils* utils_;
    std::atomic<ULONG> references_{1};
};

// HLSL 2021 makes `?:` and `&&` scalar, as the other compilers' users must not rely on; `-I .` hands names that are not found beside the
// including file to our own search; -fspv-reflect keeps the semantics. DXIL is signed by a library that exists on Windows only.
constexpr const char* kFlags[] = {"-HV", "2021", "-Wno-effects-syntax", "-I", ".", "-D", "FX_ENTRY=1"};
constexpr const char* kSpirvFlags[] = {"-spirv", "-fspv-target-env=vulkan1.1", "-fspv-reflect"};

std::vector<std::wstring> arguments(const ShaderRequest& request, Output output) {
    std::vector<std::wstring> list{L"-T", wide(fmt::format("{}_6_0", stageNames(request.stage).profile)), L"-E", wide(request.entry)};
    for (const char* flag : kFlags)
        list.push_back(wide(request.language2018 && std::string_view(flag) == "2021" ? "2018" : flag));
    if (output == Output::Spirv)
        for (const char* flag : kSpirvFlags)
            list.push_back(wide(flag));
    if (request.language2018)
        for (const wchar_t* quiet : {L"-Wno-conversion", L"-Wno-parentheses-equality"})
            list.emplace_back(quiet);
    for (const auto& [name, value] : request.defines) {
        list.emplace_back(L"-D");
        list.push_back(wide(fmt::format("{}={}", name, value)));
    }
    return list;
}

std::string logOf(IDxcResult* result) {
    CComPtr<IDxcBlobUtf8> log;
    if (FAILED(result->GetOutput(DXC_OUT_ERRORS, __uuidof(IDxcBlobUtf8), reinterpret_cast<void**>(&log), nullptr)) || !log) return {};
    return {log->GetStringPointer(), log->GetStringLength()};
}

void nameIncludedFiles(std::vector<Diagnostic>& messages, const IncludeReader& includes) {
    for (Diagnostic& message : messages)
        message.at.file = includes.pathOf(message.at.file);
}

/// What the compiler said and made, in one piece that another process can hand over.
struct Made {
    bool started = true;
    std::string log;
    std::string object;  // empty: it refused
    std::string listing; // of DXIL: its resources, in words
};

Made madeBy(IDxcResult* result) {
    Made made{.log = logOf(result)};
    HRESULT status = E_FAIL;
    CComPtr<IDxcBlob> object;
    result->GetStatus(&status);
    throwWhereMemoryEnded(status);
    if (SUCCEEDED(status)) result->GetOutput(DXC_OUT_OBJECT, __uuidof(IDxcBlob), reinterpret_cast<void**>(&object), nullptr);
    if (FAILED(status) || !object) return made;
    made.object.assign(static_cast<const char*>(object->GetBufferPointer()), object->GetBufferSize());
    return made;
}

/// The container names its resources inside of its LLVM module only.
std::string listingOf(IDxcCompiler3* compiler, const std::string& object) {
    const DxcBuffer buffer{object.data(), object.size(), 0};
    CComPtr<IDxcResult> result;
    CComPtr<IDxcBlobUtf8> text;
    compiler->Disassemble(&buffer, __uuidof(IDxcResult), reinterpret_cast<void**>(&result));
    if (result) result->GetOutput(DXC_OUT_DISASSEMBLY, __uuidof(IDxcBlobUtf8), reinterpret_cast<void**>(&text), nullptr);
    return text ? std::string(text->GetStringPointer(), text->GetStringLength()) : std::string();
}

Made make(const ShaderRequest& request, Output output, IncludeReader& includes) {
    const auto compiler = instance<IDxcCompiler3>(CLSID_DxcCompiler);
    const auto utils = instance<IDxcUtils>(CLSID_DxcUtils);
    if (!compiler || !utils) return {.started = false};
    const std::vector<std::wstring> list = arguments(request, output);
    std::vector<LPCWSTR> pointers;
    pointers.reserve(list.size());
    for (const std::wstring& argument : list)
        pointers.push_back(argument.c_str());
    const DxcBuffer source{request.code.data(), request.code.size(), DXC_CP_UTF8};
    IncludeHandler handler(includes, utils);
    CComPtr<IDxcResult> result;
    throwWhereMemoryEnded(compiler->Compile(&source, pointers.data(), static_cast<UINT32>(pointers.size()), &handler, __uuidof(IDxcResult),
                                            reinterpret_cast<void**>(&result)));
    if (!result) return {.started = false};
    Made made = madeBy(result);
    if (output == Output::Dxil && !made.object.empty()) made.listing = listingOf(compiler, made.object);
    return made;
}

/// Strings one after the other, each behind its length.
std::string packed(const std::vector<std::string_view>& parts) {
    std::string bytes;
    for (const std::string_view part : parts)
        bytes += fmt::format("{} {}", part.size(), part);
    return bytes;
}

std::vector<std::string> unpacked(std::string_view bytes) {
    std::vector<std::string> parts;
    while (!bytes.empty()) {
        std::size_t size = 0;
        const auto [end, error] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), size);
        const auto head = static_cast<std::size_t>(end - bytes.data()) + 1;
        if (error != std::errc() || head + size > bytes.size()) return {};
        parts.emplace_back(bytes.substr(head, size));
        bytes.remove_prefix(head + size);
    }
    return parts;
}

constexpr std::string_view kNoMemory = "memory";

/// In the other process. Such code has its includes in it.
std::string answerTo(std::string_view message) {
    const std::vector<std::string> parts = unpacked(message);
    if (parts.size() < 6) return {};
    ShaderRequest request{.code = parts[0], .file = parts[1], .entry = parts[2], .language2018 = parts[5] == "2018"};
    request.stage = static_cast<ShaderStage>(std::atoi(parts[3].c_str()));
    for (std::size_t i = 6; i + 1 < parts.size(); i += 2)
        request.defines.emplace_back(parts[i], parts[i + 1]);
    IncludeReader includes(request.file, {});
    try {
        const Made made = make(request, static_cast<Output>(std::atoi(parts[4].c_str())), includes);
        return packed({made.started ? "1" : "0", made.log, made.object, made.listing});
    } catch (const std::bad_alloc&) {
        return packed({kNoMemory, "", "", ""});
    }
}

constexpr double kLongest = 120; // seconds for one shader; the longest seen takes four

/// Held while this process compiles.
std::shared_mutex& compiling() {
    static std::shared_mutex kMutex;
    return kMutex;
}

Error broughtDown(const ShaderRequest& request, const ChildAnswer& answer) {
    const std::string how = answer.timedOut      ? fmt::format("did not end in {} s", kLongest)
                            : answer.signal != 0 ? fmt::format("was ended by signal {} ({})", answer.signal, signalName(answer.signal))
                                                 : std::string("left without an answer");
    return inputError(3008, lastLineDirective(request.code, request.file), fmt::format("DXC {} while it compiled {}", how, request.entry),
                      "the code is one that DXC does not survive: write it differently, or try --compiler glslang");
}

/// Code of other hosts, in a process of its own: DXC does not survive every text.
Result<Made> makeApart(const ShaderRequest& request, Output output) {
    static Children kChildren(answerTo, compiling());
    const std::string stage = std::to_string(static_cast<int>(request.stage));
    const std::string kind = std::to_string(static_cast<int>(output));
    std::vector<std::string_view> parts{request.code, request.file, request.entry, stage, kind, request.language2018 ? "2018" : "2021"};
    for (const auto& [name, value] : request.defines)
        parts.insert(parts.end(), {name, value});
    const ChildAnswer answer = kChildren.ask(packed(parts), kLongest);
    if (!answer.answered) return broughtDown(request, answer);
    const std::vector<std::string> made = unpacked(answer.bytes);
    if (made.size() != 4) return Made{.started = false};
    if (made[0] == kNoMemory) throw std::bad_alloc();
    return Made{.started = made[0] == "1", .log = made[1], .object = made[2], .listing = made[3]};
}

Result<RawShader> finish(Made made, const ShaderRequest& request, const IncludeReader& includes) {
    if (!made.started) return machineError(3002, "DXC could not be started, or gave no result");
    Messages messages = readDxcMessages(made.log, request.code, request.file);
    if (made.log.find("missing entry point definition") != std::string::npos)
        return inputError(3001, {.file = request.file}, fmt::format("there is no function {} to start from", request.entry));
    nameIncludedFiles(messages.errors, includes);
    nameIncludedFiles(messages.warnings, includes);
    if (made.object.empty()) {
        if (messages.errors.empty())
            return inputError(3001, {.file = request.file}, fmt::format("DXC rejects {}: {}", request.entry, made.log));
        return Error{Blame::Input, shortened(std::move(messages.errors))};
    }
    RawShader shader{.words = std::vector<std::uint32_t>(made.object.size() / sizeof(std::uint32_t)),
                     .warnings = shortened(std::move(messages.warnings)),
                     .listing = std::move(made.listing),
                     .levelsRemoved = made.log.find("because of incompatible execution model") != std::string::npos};
    std::memcpy(shader.words.data(), made.object.data(), shader.words.size() * sizeof(std::uint32_t));
    return shader;
}

} // namespace

bool available() {
    return library().create != nullptr;
}

std::string whyNot() {
    return library().why;
}

std::string name() {
    const auto compiler = instance<IDxcCompiler3>(CLSID_DxcCompiler);
    CComPtr<IDxcVersionInfo> version;
    if (!compiler || FAILED(compiler->QueryInterface(__uuidof(IDxcVersionInfo), reinterpret_cast<void**>(&version)))) return {};
    UINT32 major = 0;
    UINT32 minor = 0;
    version->GetVersion(&major, &minor);
    CComPtr<IDxcVersionInfo2> commits;
    UINT32 count = 0;
    char* hash = nullptr;
    if (SUCCEEDED(version->QueryInterface(__uuidof(IDxcVersionInfo2), reinterpret_cast<void**>(&commits))))
        commits->GetCommitInfo(&count, &hash);
    const std::string commit = hash == nullptr ? "" : fmt::format(" ({})", std::string_view(hash).substr(0, 8));
    if (hash != nullptr) CoTaskMemFree(hash);
    return fmt::format("DXC {}.{}{}", major, minor, commit);
}

std::string identity() {
    static const std::string kHash = contentHashOfFile(library().path);
    return kHash;
}

std::string flags(Output output) {
    return fmt::format("{} {}", fmt::join(kFlags, " "),
                       output == Output::Spirv ? fmt::format("{}", fmt::join(kSpirvFlags, " ")) : "DXIL, bindings");
}

Result<RawShader> compile(const ShaderRequest& request, Output output, IncludeReader& includes) {
    if (!request.apart && (!request.language2018 || !request.includeFolders.empty())) {
        const std::shared_lock busy(compiling());
        return finish(make(request, output, includes), request, includes);
    }
    auto made = makeApart(request, output);
    return made ? finish(std::move(*made), request, includes) : Result<RawShader>(made.error());
}

#else

bool available() {
    return false;
}
std::string whyNot() {
    return "this program was built without it";
}
std::string name() {
    return {};
}
std::string identity() {
    return {};
}
std::string flags(Output) {
    return {};
}
Result<RawShader> compile(const ShaderRequest&, Output, IncludeReader&) {
    return machineError(3002, "this program was built without DXC");
}

#endif

} // namespace tegument::dxc
