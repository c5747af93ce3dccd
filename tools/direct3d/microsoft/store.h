#pragma once
// What Microsoft's compiler has made, by the hash of what it was given: files in one folder, which belongs to one version of the compiler.

#include <optional>
#include <string>
#include <string_view>

namespace hlslc {

struct Compiled {
    std::string binary;
    std::string listing;
    std::string reflection; // JSON
    std::string messages;
};

/// SHA-256, in hexadecimal digits.
std::string hash(std::string_view bytes);

class Store {
public:
    /// No folder: nothing is found, nothing is kept.
    explicit Store(std::string folder) : folder_(std::move(folder)) {}

    /// A file that is cut short or changed counts as not there.
    [[nodiscard]] std::optional<Compiled> find(const std::string& key) const;
    /// Under another name first: processes that keep the same thing at the same time do not meet. A full disk costs the next run its time.
    void keep(const std::string& key, const Compiled& compiled) const;
    [[nodiscard]] bool open() const { return !folder_.empty(); }

private:
    std::string folder_;
};

} // namespace hlslc
