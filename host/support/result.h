#pragma once
// Errors as values. Everything that a user's file or machine can cause comes back as a Result; `assert` is for our own bugs.

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tegument {

/// Who has to act. The values are the program's exit codes.
enum class Blame { Input = 1, Usage = 2, Machine = 3 };

/// A place in a file. `line` and `column` count from 1; 0 means "the file as a whole". `byte` is set for binary files.
struct SourcePosition {
    std::string file;
    int line = 0;
    int column = 0;
    std::optional<std::size_t> byte;
};

enum class Severity { Note, Warning, Error };

/// One message: `file(line,col): error TGnnnn: text; hint`, with the source line and a caret where there is one.
/// Codes: 1xxx lexer and parser, 2xxx effect model and scripts, 3xxx compilers, 4xxx running an effect,
/// 5xxx scenes, meshes and images, 6xxx the GPU, 7xxx mesh preparation, 8xxx the command line.
struct Diagnostic {
    Severity severity = Severity::Error;
    int code = 0;
    SourcePosition at;
    std::string text;
    std::string hint;
    std::string sourceLine;
};

/// The message as one or three lines (with source line and caret), without a trailing newline.
[[nodiscard]] std::string format(const Diagnostic& diagnostic);

/// Why an operation failed: at least one diagnostic of severity Error.
struct Error {
    Blame blame = Blame::Input;
    std::vector<Diagnostic> diagnostics;
};

[[nodiscard]] std::string format(const Error& error);

[[nodiscard]] Diagnostic inputWarning(int code, SourcePosition at, std::string text, std::string hint = {});
[[nodiscard]] Error inputError(int code, SourcePosition at, std::string text, std::string hint = {});
[[nodiscard]] Error usageError(int code, std::string text, std::string hint = {});
[[nodiscard]] Error machineError(int code, std::string text, std::string hint = {});

/// Either a value or an Error. Check with `if (!result)`, then use `*result`, `result->` or `result.error()`.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    explicit operator bool() const { return std::holds_alternative<T>(state_); }

    T& operator*() & { return get(); }
    const T& operator*() const& { return get(); }
    T&& operator*() && { return std::move(get()); }
    T* operator->() { return &get(); }
    const T* operator->() const { return &get(); }

    const Error& error() const {
        assert(!*this);
        return *std::get_if<Error>(&state_);
    }

private:
    T& get() {
        assert(*this);
        return *std::get_if<T>(&state_);
    }
    const T& get() const {
        assert(*this);
        return *std::get_if<T>(&state_);
    }

    std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    explicit operator bool() const { return !error_; }
    const Error& error() const {
        assert(error_);
        return *error_;
    }

private:
    std::optional<Error> error_;
};

} // namespace tegument
