#pragma once
// What tests/tools/mutate_cpp.py writes into copies of sources: each mutant is there, and TEGUMENT_MUTANT=N switches on one of them. Not
// part of any build of this tree. `a + b` becomes `a + ::tgm::Add<17>{} + b`: an operator of the same precedence on both sides, so that
// nothing has to be parsed. What is evaluated by the compiler stays as it is.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <type_traits>
#include <unistd.h>
#include <utility>

// The copies are compiled with the tree's warnings, which are about what people write.
#pragma GCC diagnostic ignored "-Wnarrowing"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"

namespace tgm {

inline constexpr int kMost = 4096;
enum Seen : std::uint8_t { Never = 0, Same = 1, Reached = 2 }; // Same: the other form does not compile, so there is no such mutant

inline int gActive = 0;
inline std::uint8_t* gSeen = nullptr; // shared with whoever asks: TEGUMENT_MUTANTS_SEEN names the file

/// Before everything that other sources initialise.
__attribute__((constructor(101))) inline void begin() {
    if (const char* number = std::getenv("TEGUMENT_MUTANT")) gActive = std::atoi(number);
    const char* path = std::getenv("TEGUMENT_MUTANTS_SEEN");
    if (path == nullptr || gSeen != nullptr) return;
    const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0 || ftruncate(file, kMost) != 0) return;
    void* bytes = mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (bytes != MAP_FAILED) gSeen = static_cast<std::uint8_t*>(bytes);
    close(file);
}

template <Seen What = Reached>
constexpr bool on(int number) {
    if (std::is_constant_evaluated()) return false;
    if (gSeen != nullptr && gSeen[number] < What) gSeen[number] = What;
    return gActive == number;
}

template <int N, class T>
constexpr T number(T original, T mutant) {
    return on(N) ? mutant : original;
}

template <int N, class T>
constexpr bool condition(T&& value) {
    const bool holds = static_cast<bool>(std::forward<T>(value));
    return on(N) ? !holds : holds;
}

#define TGM_OPERATOR(Name, op, other)                                                                                                      \
    template <int N>                                                                                                                       \
    struct Name {};                                                                                                                        \
    template <int N, class A>                                                                                                              \
    struct Name##Left {                                                                                                                    \
        A&& left;                                                                                                                          \
    };                                                                                                                                     \
    template <int N, class A>                                                                                                              \
    constexpr Name##Left<N, A> operator op(A&& left, Name<N>) {                                                                            \
        return {std::forward<A>(left)};                                                                                                    \
    }                                                                                                                                      \
    template <int N, class A, class B>                                                                                                     \
    constexpr auto operator op(Name##Left<N, A> a, B&& b) {                                                                                \
        using Value = decltype(std::forward<A>(a.left) op std::forward<B>(b));                                                             \
        if constexpr (requires { static_cast<Value>(std::forward<A>(a.left) other std::forward<B>(b)); }) {                                \
            if (on(N)) return static_cast<Value>(std::forward<A>(a.left) other std::forward<B>(b));                                        \
        } else {                                                                                                                           \
            (void)on<Same>(N);                                                                                                             \
        }                                                                                                                                  \
        return std::forward<A>(a.left) op std::forward<B>(b);                                                                              \
    }

TGM_OPERATOR(Add, +, -)
TGM_OPERATOR(Subtract, -, +)
TGM_OPERATOR(Multiply, *, /)
TGM_OPERATOR(Divide, /, *)
TGM_OPERATOR(Less, <, >=)
TGM_OPERATOR(Greater, >, <=)
TGM_OPERATOR(AtMost, <=, >)
TGM_OPERATOR(AtLeast, >=, <)
TGM_OPERATOR(Equal, ==, !=)
TGM_OPERATOR(Unequal, !=, ==)

#define TGM_FUNCTION(Name, original, mutant)                                                                                               \
    template <int N, class... T>                                                                                                           \
    constexpr auto Name(T&&... values) {                                                                                                   \
        return on(N) ? mutant : original;                                                                                                  \
    }

TGM_FUNCTION(min, std::min(std::forward<T>(values)...), std::max(std::forward<T>(values)...))
TGM_FUNCTION(max, std::max(std::forward<T>(values)...), std::min(std::forward<T>(values)...))
TGM_FUNCTION(sqrt, std::sqrt(values...), (values, ...))
TGM_FUNCTION(abs, std::abs(values...), (values, ...))
TGM_FUNCTION(sin, std::sin(values...), std::cos(values...))
TGM_FUNCTION(cos, std::cos(values...), std::sin(values...))
TGM_FUNCTION(exp, std::exp(values...), std::exp2(values...))

} // namespace tgm
