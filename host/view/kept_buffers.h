#pragma once
// Buffers of what the window was drawn from lately. From picture to picture nearly all of its text and shapes is the same, and a new buffer
// costs two allocations of memory and a submission that is waited for.

#include "host/gpu/gpu.h"

#include <cstddef>
#include <list>
#include <span>
#include <vector>

namespace tegument::view {

class KeptBuffers {
public:
    explicit KeptBuffers(gpu::Device& device) : device_(device) {}

    /// One with these bytes: of a draw before, or new. It stays until `nextDraw()` was called kKept times without it being asked for.
    [[nodiscard]] Result<gpu::Buffer*> with(gpu::BufferUsage usage, std::span<const std::byte> bytes);
    void nextDraw();
    [[nodiscard]] std::size_t count() const { return buffers_.size(); }

    static constexpr int kKept = 16; // a picture of the window takes three or four draws

private:
    struct Kept {
        gpu::BufferUsage usage;
        std::vector<std::byte> bytes;
        gpu::Buffer buffer;
        int unused = 0; // draws since
    };
    gpu::Device& device_;
    std::list<Kept> buffers_; // places stay
};

} // namespace tegument::view
