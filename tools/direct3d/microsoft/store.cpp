#include "store.h"

#include "files.h"

#include <bcrypt.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace hlslc {

namespace {

constexpr std::size_t kDigits = 64; // of a hash

void append(std::string& bytes, const std::string& part) {
    const std::uint64_t size = part.size();
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes += part;
}

bool take(std::string_view& bytes, std::string& part) {
    std::uint64_t size = 0;
    if (bytes.size() < sizeof size) return false;
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes.remove_prefix(sizeof size);
    if (size > bytes.size()) return false;
    part = bytes.substr(0, size);
    bytes.remove_prefix(size);
    return true;
}

BCRYPT_ALG_HANDLE sha256() {
    static BCRYPT_ALG_HANDLE algorithm = nullptr;
    if (algorithm == nullptr) BCryptOpenAlgorithmProvider(&algorithm, BCRYPT_SHA256_ALGORITHM, nullptr, 0);
    return algorithm;
}

} // namespace

std::string hash(std::string_view bytes) {
    std::array<unsigned char, kDigits / 2> digest{};
    BCRYPT_HASH_HANDLE running = nullptr;
    auto* input = reinterpret_cast<PUCHAR>(const_cast<char*>(bytes.data()));
    const bool good = BCryptCreateHash(sha256(), &running, nullptr, 0, nullptr, 0, 0) == 0 &&
                      BCryptHashData(running, input, static_cast<ULONG>(bytes.size()), 0) == 0 &&
                      BCryptFinishHash(running, digest.data(), static_cast<ULONG>(digest.size()), 0) == 0;
    if (running != nullptr) BCryptDestroyHash(running);
    std::string text;
    for (const unsigned char byte : digest)
        for (const int digit : {byte >> 4, byte & 15})
            text += "0123456789abcdef"[digit];
    return good ? text : "";
}

std::optional<Compiled> Store::find(const std::string& key) const {
    std::string file;
    if (!open() || key.empty() || !readFile(folder_ + "\\" + key, file) || file.size() < kDigits) return {};
    std::string_view bytes(file);
    if (hash(bytes.substr(kDigits)) != bytes.substr(0, kDigits)) return {};
    bytes.remove_prefix(kDigits);
    Compiled compiled;
    for (std::string* part : {&compiled.binary, &compiled.listing, &compiled.reflection, &compiled.messages})
        if (!take(bytes, *part)) return {};
    return compiled;
}

void Store::keep(const std::string& key, const Compiled& compiled) const {
    if (!open() || key.empty()) return;
    std::string bytes;
    for (const std::string* part : {&compiled.binary, &compiled.listing, &compiled.reflection, &compiled.messages})
        append(bytes, *part);
    const std::string path = folder_ + "\\" + key;
    const std::string temporary = path + "." + std::to_string(GetCurrentProcessId());
    if (save(temporary, hash(bytes) + bytes)) MoveFileExW(wide(temporary).c_str(), wide(path).c_str(), MOVEFILE_REPLACE_EXISTING);
}

} // namespace hlslc
