// A compiler library of another version: it has the function that the program looks for, and none of the interfaces.

#include <cstdint>

// NOLINTNEXTLINE(readability-identifier-naming): DXC's name
extern "C" __attribute__((visibility("default"))) std::int32_t DxcCreateInstance(const void*, const void*, void** made) {
    constexpr std::int32_t kNoInterface = static_cast<std::int32_t>(0x80004002U);
    *made = nullptr;
    return kNoInterface;
}
