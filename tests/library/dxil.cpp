#include "tests/library/dxil.h"

#ifdef TEGUMENT_DXC_DIR
#define __EMULATE_UUID // NOLINT(bugprone-reserved-identifier): the header's own switch for compilers without __declspec(uuid)
#include <dlfcn.h>
#include <dxcapi.h>

#include <vector>
#endif

namespace tegument::test {

namespace fs = std::filesystem;

#ifdef TEGUMENT_DXC_DIR

namespace {

DxcCreateInstanceProc creator() {
    static void* const kLibrary = dlopen((fs::path(TEGUMENT_DXC_DIR) / "libdxcompiler.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    return kLibrary == nullptr ? nullptr : reinterpret_cast<DxcCreateInstanceProc>(dlsym(kLibrary, "DxcCreateInstance"));
}

template <class T>
CComPtr<T> instance(REFCLSID type) {
    CComPtr<T> made;
    if (creator() != nullptr) creator()(type, __uuidof(T), reinterpret_cast<void**>(&made));
    return made;
}

std::string messagesOf(IDxcResult& result) {
    CComPtr<IDxcBlobUtf8> messages;
    result.GetOutput(DXC_OUT_ERRORS, __uuidof(IDxcBlobUtf8), reinterpret_cast<void**>(&messages), nullptr);
    return messages && messages->GetStringLength() > 0 ? messages->GetStringPointer() : "the compiler failed without a word";
}

} // namespace

std::string dxilMissing() {
    return creator() == nullptr ? "libdxcompiler.so cannot be loaded" : "";
}

std::string compileDxil(const fs::path& source, const std::string& profile) {
    const auto utilities = instance<IDxcUtils>(CLSID_DxcUtils);
    const auto compiler = instance<IDxcCompiler3>(CLSID_DxcCompiler);
    if (!utilities || !compiler) return "DXC gives no compiler";
    CComPtr<IDxcBlobEncoding> text;
    CComPtr<IDxcIncludeHandler> includes;
    if (FAILED(utilities->LoadFile(source.wstring().c_str(), nullptr, &text))) return "cannot read " + source.string();
    if (FAILED(utilities->CreateDefaultIncludeHandler(&includes))) return "DXC gives no include handler";
    const std::wstring file = source.wstring();
    const std::wstring folder = source.parent_path().wstring();
    const std::wstring target(profile.begin(), profile.end());
    std::vector<const wchar_t*> arguments = {file.c_str(), L"-T", target.c_str(), L"-E", L"main", L"-I", folder.c_str(), L"-Vd"};
    const DxcBuffer buffer{text->GetBufferPointer(), text->GetBufferSize(), DXC_CP_UTF8};
    CComPtr<IDxcResult> result;
    if (FAILED(compiler->Compile(&buffer, arguments.data(), static_cast<UINT32>(arguments.size()), includes, __uuidof(IDxcResult),
                                 reinterpret_cast<void**>(&result))))
        return "DXC refused the call";
    HRESULT status = E_FAIL;
    result->GetStatus(&status);
    if (FAILED(status)) return messagesOf(*result);
    CComPtr<IDxcBlob> object;
    result->GetOutput(DXC_OUT_OBJECT, __uuidof(IDxcBlob), reinterpret_cast<void**>(&object), nullptr);
    return object && object->GetBufferSize() > 0 ? "" : "DXC made nothing";
}

#else

std::string dxilMissing() {
    return "DXC was left out of this build (./bootstrap test brings it): there is nothing to run here";
}

std::string compileDxil(const fs::path&, const std::string&) {
    return dxilMissing();
}

#endif

} // namespace tegument::test
