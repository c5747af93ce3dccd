#pragma once
// What every back end needs of Windows: owned interfaces, and calls that must succeed.

#include <windows.h>

#include <string>
#include <utility>

namespace client {

/// Writes the reason into the results and ends the program: the job that was running has failed.
[[noreturn]] void fail(const std::string& reason);

/// `what` names the call in the message.
void must(HRESULT result, const std::string& what);

/// Owns one reference.
template <class T>
class Com {
public:
    Com() = default;
    explicit Com(T* object) : object_(object) {}
    Com(Com&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    Com& operator=(Com&& other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    Com(const Com&) = delete;
    Com& operator=(const Com&) = delete;
    ~Com() {
        if (object_) object_->Release();
    }

    T* get() const { return object_; }
    T* operator->() const { return object_; }
    explicit operator bool() const { return object_ != nullptr; }
    /// For functions that hand out a reference.
    T** put() {
        *this = Com();
        return &object_;
    }

private:
    T* object_ = nullptr;
};

} // namespace client
