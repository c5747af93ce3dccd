#pragma once
// JSON-RPC as editors speak it: `Content-Length: N`, an empty line, N bytes of JSON.

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace tegument::lsp {

using Json = nlohmann::json;

/// Messages out of a file descriptor.
class Input {
public:
    explicit Input(int descriptor) : descriptor_(descriptor) {}

    /// The text of the next message; none at the end of the input, or where what comes is no message and cannot be skipped.
    [[nodiscard]] std::optional<std::string> next();
    /// Whether something comes within this time.
    [[nodiscard]] bool waits(int milliseconds) const;

private:
    [[nodiscard]] bool more();

    int descriptor_;
    std::string bytes_;
};

/// False where nobody reads any more.
[[nodiscard]] bool send(int descriptor, const Json& message);

[[nodiscard]] Json answer(const Json& id, Json result);
[[nodiscard]] Json refusal(const Json& id, int code, const std::string& text);
[[nodiscard]] Json notification(const std::string& method, Json parameters);

inline constexpr int kParseError = -32700;
inline constexpr int kInvalidRequest = -32600;
inline constexpr int kMethodNotFound = -32601;

} // namespace tegument::lsp
