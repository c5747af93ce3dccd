#pragma once
// Textures that are made once and kept in the cache folder, by a hash of what they are made from.

#include "host/support/result.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tegument::assets {

/// Is told what was made, in how many seconds, and where it lies.
using Say = std::function<void(const std::string&)>;

/// Hash of a version and of everything that a file is made from, in order. A change of the maker takes another version.
class CacheKey {
public:
    explicit CacheKey(int version);
    CacheKey& add(std::string_view bytes);
    template <class T>
    CacheKey& add(const std::vector<T>& values) {
        return add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
    }
    [[nodiscard]] std::string text() const;

private:
    std::string all_;
};

/// FOLDER/made/NAME.dds of the cache folder: `make` writes it where it is absent or cut short. `what`: for `say`.
[[nodiscard]] Result<std::filesystem::path> cachedDds(const std::string& folder, const std::string& name, const std::string& what,
                                                      const Say& say,
                                                      const std::function<Result<void>(const std::filesystem::path&)>& make);

} // namespace tegument::assets
