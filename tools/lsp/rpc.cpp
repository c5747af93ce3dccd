#include "tools/lsp/rpc.h"

#include "host/support/system.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <unistd.h>

namespace tegument::lsp {

namespace {

constexpr std::size_t kLongestHeader = 4096;
constexpr std::size_t kLongestMessage = 64U << 20U; // a source of that length is none
constexpr std::string_view kLength = "content-length:";

/// N of the header's `Content-Length: N`; header names ignore case.
std::optional<std::size_t> lengthIn(std::string_view header) {
    std::string lower(header);
    for (char& letter : lower)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    std::size_t at = lower.find(kLength);
    if (at == std::string::npos) return std::nullopt;
    at = lower.find_first_not_of(" \t", at + kLength.size());
    std::size_t length = 0;
    if (at == std::string::npos || std::from_chars(lower.data() + at, lower.data() + lower.size(), length).ec != std::errc())
        return std::nullopt;
    return length <= kLongestMessage ? std::optional(length) : std::nullopt;
}

} // namespace

bool Input::more() {
    std::array<char, 65536> part{};
    ssize_t count = -1;
    do
        count = ::read(descriptor_, part.data(), part.size());
    while (count < 0 && errno == EINTR);
    if (count <= 0) return false;
    bytes_.append(part.data(), static_cast<std::size_t>(count));
    return true;
}

std::optional<std::string> Input::next() {
    std::size_t end = bytes_.find("\r\n\r\n");
    while (end == std::string::npos) {
        if (bytes_.size() > kLongestHeader || !more()) return std::nullopt;
        end = bytes_.find("\r\n\r\n");
    }
    const auto length = lengthIn(std::string_view(bytes_).substr(0, end));
    if (!length) return std::nullopt; // where the next message begins is not known
    const std::size_t first = end + 4;
    while (bytes_.size() < first + *length)
        if (!more()) return std::nullopt;
    std::string message = bytes_.substr(first, *length);
    bytes_.erase(0, first + *length);
    return message;
}

bool Input::waits(int milliseconds) const {
    if (!bytes_.empty()) return true;
    return inputWaits(descriptor_, milliseconds);
}

bool send(int descriptor, const Json& message) {
    const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::string bytes = "Content-Length: " + std::to_string(text.size()) + "\r\n\r\n" + text;
    for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t count = ::write(descriptor, bytes.data() + sent, static_cast<unsigned>(bytes.size() - sent)); // a message is smaller
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        sent += static_cast<std::size_t>(count);
    }
    return true;
}

Json answer(const Json& id, Json result) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

Json refusal(const Json& id, int code, const std::string& text) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", text}}}};
}

Json notification(const std::string& method, Json parameters) {
    return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(parameters)}};
}

} // namespace tegument::lsp
