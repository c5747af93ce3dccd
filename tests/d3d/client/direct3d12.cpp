// Direct3D 12 by the sample of docs/samples/d3d12, from what `tegument check --emit` writes: everything that the effect needs stands in its
// manifest; the scene comes from the job.

#include "../../../docs/samples/d3d12/effect.h"

#include "backends.h"
#include "com.h"
#include "formats.h"

namespace client {

namespace {

Device& opened() {
    static Device device;
    return device;
}

struct Buffers {
    ComPtr<ID3D12Resource> vertices;
    ComPtr<ID3D12Resource> indices;
    UINT vertexBytes = 0;
    UINT indexCount = 0;

    void draw(UINT first, UINT count, UINT instances) const {
        ID3D12GraphicsCommandList* const list = opened().list();
        const D3D12_VERTEX_BUFFER_VIEW stream{vertices->GetGPUVirtualAddress(), vertexBytes, kVertexBytes};
        const D3D12_INDEX_BUFFER_VIEW order{indices->GetGPUVirtualAddress(), indexCount * 4, DXGI_FORMAT_R32_UINT};
        list->IASetVertexBuffers(0, 1, &stream);
        list->IASetIndexBuffer(&order);
        list->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
        list->DrawIndexedInstanced(count, instances, first, 0, 0);
    }
};

Buffers uploadMesh(const MeshFile& file) {
    const std::size_t vertexBytes = file.vertices.size() * sizeof(float);
    const std::size_t indexBytes = file.indices.size() * sizeof(std::uint32_t);
    return {opened().buffer(vertexBytes, D3D12_HEAP_TYPE_UPLOAD, file.vertices.data()),
            opened().buffer(indexBytes, D3D12_HEAP_TYPE_UPLOAD, file.indices.data()), static_cast<UINT>(vertexBytes),
            static_cast<UINT>(file.indices.size())};
}

std::vector<float> valueOf(const Job& job, const script_player::Json& parameter) {
    const std::string& type = parameter.at("type").text();
    const unsigned columns = type == "float4" ? 4 : 1; // a position or a colour may be wanted with a fourth number
    return job
        .valueOf(parameter.at("name").text(), parameter.at("semantic").text(), parameter.at("annotations").textOr("Object", ""), columns)
        .value_or(Numbers());
}

TextureShape shapeOf(const TextureFile& file) {
    return {file.width, file.height, file.levels, file.faces, textureFormat(file.format).dxgi, D3D12_RESOURCE_FLAG_NONE};
}

/// A frame depends on nothing that was there before.
void clearTarget(Texture& texture, const Numbers& color) {
    if (texture.shape.depth()) {
        opened().transition(texture, D3D12_RESOURCE_STATE_DEPTH_WRITE);
        return opened().list()->ClearDepthStencilView(texture.target, D3D12_CLEAR_FLAG_DEPTH, 1, 0, 0, nullptr);
    }
    opened().transition(texture, D3D12_RESOURCE_STATE_RENDER_TARGET);
    opened().list()->ClearRenderTargetView(texture.target, color.data(), 0, nullptr);
}

std::map<std::string, Pixels> drawnBy(const Job& job) {
    ::Effect effect(opened(), job.path(job.effect));
    effect.makeTargets(job.width, job.height);
    const auto both = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET | D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
    Texture picture = opened().texture({job.width, job.height, 1, 1, DXGI_FORMAT_R32G32B32A32_FLOAT, both});
    Texture depth = opened().texture({job.width, job.height, 1, 1, DXGI_FORMAT_D24_UNORM_S8_UINT, D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL});
    std::map<std::string, Texture> textures;
    for (const auto& [name, path] : job.textures) {
        const TextureFile file = readTexture(job.path(path));
        textures[name] = opened().uploaded(shapeOf(file), bytesPerTexel(file.format), [&](UINT i) { return file.images[i].data(); });
        effect.setTexture(name, &textures[name]);
    }
    clearTarget(picture, job.emptyColor(""));
    clearTarget(depth, {});
    for (auto& [name, target] : effect.targets())
        clearTarget(target, job.emptyColor(name));
    const Buffers quad = uploadMesh(fullScreenQuad());
    const Buffers mesh = job.mesh.empty() ? quad : uploadMesh(readMesh(job.path(job.mesh)));
    effect.setValues([&](const script_player::Json& parameter) { return valueOf(job, parameter); });
    effect.run(job.technique, picture, depth, [&](const script_player::Pass& pass, bool drawsMesh, UINT instances) {
        const IndexRange range = job.rangeOf(pass.name, mesh.indexCount);
        drawsMesh ? mesh.draw(range.first, range.count, instances) : quad.draw(0, quad.indexCount, 1);
    });
    std::map<std::string, Pixels> drawn;
    const auto read = [&](const std::string& name, const TargetShape& shape, Texture& texture) {
        const Rows rows = opened().read(texture);
        drawn[name] = readRows(shape, rows.bytes.data(), rows.pitch);
    };
    read("picture", {false, job.width, job.height, "A32B32G32R32F", 1}, picture);
    for (const auto& [name, shape] : job.targets) // of two planes, depth and stencil, the sample reads none
        if (!shape.depth || isReadableDepth(shape)) read(name, shape, effect.target(name));
    return drawn;
}

} // namespace

std::map<std::string, Pixels> drawDirect3D12(const Job& job) {
    try {
        return drawnBy(job);
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

} // namespace client
