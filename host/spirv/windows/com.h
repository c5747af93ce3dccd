#pragma once
// What DXC's header takes from Microsoft's compiler and its libraries, for MinGW-w64: identifiers of interfaces, and CComPtr.

#include <cstddef>
#include <utility>

#include <windows.h>

#include <unknwn.h>

namespace tegument::com {

constexpr unsigned digitOf(char letter) {
    return static_cast<unsigned>(letter <= '9' ? letter - '0' : (letter | 0x20) - 'a' + 10);
}

/// Of "8BA5FB08-5195-40e2-AC58-0D989C3A0102".
constexpr GUID identifierOf(const char* text) {
    const auto number = [&](std::size_t count) {
        unsigned value = 0;
        for (; count > 0; ++text)
            if (*text != '-') value = value * 16 + digitOf(*text), --count;
        return value;
    };
    GUID identifier{};
    identifier.Data1 = number(8);
    identifier.Data2 = static_cast<unsigned short>(number(4));
    identifier.Data3 = static_cast<unsigned short>(number(4));
    for (unsigned char& byte : identifier.Data4)
        byte = static_cast<unsigned char>(number(2));
    return identifier;
}

} // namespace tegument::com

#ifndef _Maybenull_ // an annotation that its headers lack
#define _Maybenull_
#endif
#define CROSS_PLATFORM_UUIDOF(interface, spec)                                                                                             \
    struct interface;                                                                                                                      \
    template <>                                                                                                                            \
    struct __mingw_uuidof_s<interface> {                                                                                                   \
        static constexpr GUID __uuid_inst = tegument::com::identifierOf(spec);                                                             \
    };                                                                                                                                     \
    template <>                                                                                                                            \
    constexpr const GUID& __mingw_uuidof<interface>() {                                                                                    \
        return __mingw_uuidof_s<interface>::__uuid_inst;                                                                                   \
    }

/// As much of Microsoft's class of that name as this program uses.
template <class T>
class CComPtr {
public:
    CComPtr() = default;
    CComPtr(CComPtr&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    CComPtr(const CComPtr&) = delete;
    CComPtr& operator=(const CComPtr&) = delete;
    ~CComPtr() {
        if (object_ != nullptr) object_->Release();
    }
    T** operator&() { return &object_; }
    T* operator->() const { return object_; }
    operator T*() const { return object_; }

private:
    T* object_ = nullptr;
};
