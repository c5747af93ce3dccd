#pragma once
// The one device of Direct3D 9, and what is made on it.

#include "com.h"
#include "formats.h"

#include <d3d9.h>

#include <cstring>

namespace client::nine {

struct Target {
    Com<IDirect3DTexture9> texture;
    Com<IDirect3DSurface9> surface;
    TargetShape shape;
};

struct Mesh {
    Com<IDirect3DVertexBuffer9> vertices;
    Com<IDirect3DIndexBuffer9> indices;
    unsigned vertexCount = 0;
    unsigned triangleCount = 0;
};

IDirect3DDevice9* device();

/// Also of cube maps.
Com<IDirect3DBaseTexture9> upload(const TextureFile& file);
Mesh upload(const MeshFile& file);
Target makeTarget(const TargetShape& shape);

template <class T>
void fillBuffer(T* buffer, const void* from, std::size_t bytes) {
    void* to = nullptr;
    must(buffer->Lock(0, 0, &to, 0), "Lock");
    std::memcpy(to, from, bytes);
    must(buffer->Unlock(), "Unlock");
}

} // namespace client::nine
