#pragma once
// Formats of targets and textures, as each Direct3D calls them.

#include "job.h"
#include "pixels.h"

#include <d3d9.h>
#include <dxgiformat.h>

namespace client {

struct TargetFormat {
    const char* name; // D3DFORMAT, as annotations spell it
    D3DFORMAT d3d;
    DXGI_FORMAT dxgi;
    unsigned channels;
    Stored stored;
};

/// Of a colour target.
const TargetFormat& colorFormat(const std::string& name);
const TargetFormat& targetFormat(const TargetShape& shape);
/// A depth target that Direct3D 10 and 11 can bind as a texture, too: its own format as such is typeless, as a texture
/// DXGI_FORMAT_R32_FLOAT.
bool isReadableDepth(const TargetShape& shape);

struct TextureFormat {
    D3DFORMAT d3d; // of eight bits: its sampler says whether they are sRGB
    DXGI_FORMAT dxgi;
};

TextureFormat textureFormat(TexelFormat format);

/// Rows of a mapped target. Depth becomes one float of 0..1: of D24S8 Wine hands it out as OpenGL keeps it, above the stencil.
Pixels readRows(const TargetShape& shape, const void* rows, unsigned pitch);

} // namespace client
