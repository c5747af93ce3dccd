#include "host/view/kept_buffers.h"

#include <algorithm>

namespace tegument::view {

Result<gpu::Buffer*> KeptBuffers::with(gpu::BufferUsage usage, std::span<const std::byte> bytes) {
    const auto found =
        std::ranges::find_if(buffers_, [&](const Kept& kept) { return kept.usage == usage && std::ranges::equal(kept.bytes, bytes); });
    if (found != buffers_.end()) {
        found->unused = 0;
        return &found->buffer;
    }
    auto made = device_.createBuffer(usage, bytes);
    if (!made) return made.error();
    buffers_.push_back({.usage = usage, .bytes = {bytes.begin(), bytes.end()}, .buffer = std::move(*made)});
    return &buffers_.back().buffer;
}

void KeptBuffers::nextDraw() {
    buffers_.remove_if([](Kept& kept) { return ++kept.unused > kKept; });
}

} // namespace tegument::view
