#pragma once
// Formats of Direct3D 10 and 11.

#include "job.h"
#include "pixels.h"

#include <dxgiformat.h>

namespace client {

struct TargetFormat {
    const char* name; // D3DFORMAT, as annotations spell it
    DXGI_FORMAT format;
    unsigned channels;
    bool halves;
};

const TargetFormat& targetFormat(const TargetShape& shape);
DXGI_FORMAT textureFormat(TexelFormat format);

/// Rows of a mapped target. Depth becomes one float of 0..1: Wine hands it out as OpenGL keeps it, above the stencil.
Pixels readRows(const TargetShape& shape, const void* rows, unsigned pitch);

} // namespace client
