#include "direct3d9_device.h"

#include <algorithm>

namespace client::nine {

namespace {

/// Direct3D 9 keeps blue first.
void copyRow(const std::uint8_t* from, std::uint8_t* to, std::size_t bytes, bool swap) {
    std::memcpy(to, from, bytes);
    if (!swap) return;
    for (std::size_t i = 0; i < bytes; i += 4)
        std::swap(to[i], to[i + 2]);
}

void copyLevel(const TextureFile& file, unsigned face, unsigned level, const D3DLOCKED_RECT& to) {
    const std::size_t bytes = file.pitchOf(level);
    for (unsigned y = 0; y < file.heightOf(level); ++y)
        copyRow(file.image(face, level) + y * bytes, static_cast<std::uint8_t*>(to.pBits) + y * static_cast<std::size_t>(to.Pitch), bytes,
                textureFormat(file.format).d3d == D3DFMT_A8R8G8B8);
}

Com<IDirect3DBaseTexture9> uploadCube(const TextureFile& file) {
    IDirect3DCubeTexture9* texture = nullptr;
    must(device()->CreateCubeTexture(file.width, file.levels, 0, textureFormat(file.format).d3d, D3DPOOL_MANAGED, &texture, nullptr),
         "CreateCubeTexture");
    for (unsigned i = 0; i < 6 * file.levels; ++i) {
        const auto face = static_cast<D3DCUBEMAP_FACES>(i / file.levels);
        D3DLOCKED_RECT locked{};
        must(texture->LockRect(face, i % file.levels, &locked, nullptr, 0), "LockRect");
        copyLevel(file, i / file.levels, i % file.levels, locked);
        must(texture->UnlockRect(face, i % file.levels), "UnlockRect");
    }
    return Com<IDirect3DBaseTexture9>(texture);
}

} // namespace

IDirect3DDevice9* device() {
    static Com<IDirect3DDevice9> made;
    if (made) return made.get();
    const HWND window = CreateWindowA("STATIC", "d3d_client", WS_OVERLAPPEDWINDOW, 0, 0, 64, 64, nullptr, nullptr, nullptr, nullptr);
    static Com<IDirect3D9> direct3D(Direct3DCreate9(D3D_SDK_VERSION));
    if (!direct3D) fail("there is no Direct3D 9");
    D3DPRESENT_PARAMETERS parameters{};
    parameters.Windowed = TRUE;
    parameters.SwapEffect = D3DSWAPEFFECT_DISCARD;
    parameters.BackBufferFormat = D3DFMT_X8R8G8B8;
    parameters.BackBufferWidth = parameters.BackBufferHeight = 64;
    parameters.hDeviceWindow = window;
    must(direct3D->CreateDevice(D3DADAPTER_DEFAULT, D3DDEVTYPE_HAL, window, D3DCREATE_HARDWARE_VERTEXPROCESSING, &parameters, made.put()),
         "CreateDevice");
    return made.get();
}

Com<IDirect3DBaseTexture9> upload(const TextureFile& file) {
    if (file.faces == 6) return uploadCube(file);
    IDirect3DTexture9* texture = nullptr;
    must(device()->CreateTexture(file.width, file.height, file.levels, 0, textureFormat(file.format).d3d, D3DPOOL_MANAGED, &texture,
                                 nullptr),
         "CreateTexture");
    for (unsigned level = 0; level < file.levels; ++level) {
        D3DLOCKED_RECT locked{};
        must(texture->LockRect(level, &locked, nullptr, 0), "LockRect");
        copyLevel(file, 0, level, locked);
        must(texture->UnlockRect(level), "UnlockRect");
    }
    return Com<IDirect3DBaseTexture9>(texture);
}

Mesh upload(const MeshFile& file) {
    Mesh mesh;
    const std::size_t vertexBytes = file.vertices.size() * sizeof(float);
    const std::size_t indexBytes = file.indices.size() * sizeof(std::uint32_t);
    must(device()->CreateVertexBuffer(static_cast<UINT>(vertexBytes), 0, 0, D3DPOOL_MANAGED, mesh.vertices.put(), nullptr),
         "CreateVertexBuffer");
    must(device()->CreateIndexBuffer(static_cast<UINT>(indexBytes), 0, D3DFMT_INDEX32, D3DPOOL_MANAGED, mesh.indices.put(), nullptr),
         "CreateIndexBuffer");
    fillBuffer(mesh.vertices.get(), file.vertices.data(), vertexBytes);
    fillBuffer(mesh.indices.get(), file.indices.data(), indexBytes);
    mesh.vertexCount = static_cast<unsigned>(file.vertices.size() / kVertexFloats);
    mesh.triangleCount = static_cast<unsigned>(file.indices.size() / 3);
    return mesh;
}

Target makeTarget(const TargetShape& shape) {
    Target target{{}, {}, shape};
    const D3DFORMAT format = targetFormat(shape).d3d;
    const DWORD usage = shape.depth         ? D3DUSAGE_DEPTHSTENCIL // sampled, it compares: a shadow map
                        : shape.levels == 1 ? D3DUSAGE_RENDERTARGET
                                            : D3DUSAGE_RENDERTARGET | D3DUSAGE_AUTOGENMIPMAP;
    must(device()->CreateTexture(shape.width, shape.height, shape.levels, usage, format, D3DPOOL_DEFAULT, target.texture.put(), nullptr),
         "CreateTexture");
    must(target.texture->GetSurfaceLevel(0, target.surface.put()), "GetSurfaceLevel");
    return target;
}

} // namespace client::nine
