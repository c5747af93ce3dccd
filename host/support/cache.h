#pragma once
// What takes long to make is made once and kept under cacheFolder(), named by who makes it, in which version, and from what.

#include <concepts>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tegument {

template <class T>
concept PlainValue = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_convertible_v<const T&, std::string_view>;

template <PlainValue T>
[[nodiscard]] std::string_view bytesOf(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Hash of a maker and of everything that it makes a thing from, in order. The maker's name holds a number: "links 3". Whoever changes what
/// is made takes another.
class CacheKey {
public:
    explicit CacheKey(std::string_view maker);
    CacheKey& add(std::string_view bytes);
    template <PlainValue T>
    CacheKey& add(const T& value) {
        return add(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
    }
    template <PlainValue T>
    CacheKey& add(const std::vector<T>& values) {
        return add(bytesOf(values));
    }
    [[nodiscard]] std::string text() const;

private:
    std::string all_;
};

/// What was kept under this name below cacheFolder(); nothing where the file is absent, cut short or changed.
[[nodiscard]] std::optional<std::string> loadCached(const std::filesystem::path& name);
/// A full disk only costs the next run its time: failures are ignored.
void storeCached(const std::filesystem::path& name, std::string_view bytes);

/// Of a list that storeCached has been given by bytesOf.
template <PlainValue T>
[[nodiscard]] std::optional<std::vector<T>> loadCachedList(const std::filesystem::path& name) {
    const auto bytes = loadCached(name);
    if (!bytes || bytes->size() % sizeof(T) != 0) return {};
    std::vector<T> values(bytes->size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes->data(), bytes->size());
    return values;
}

} // namespace tegument
