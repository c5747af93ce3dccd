// The least of Direct3D 12 that effects need: one queue and one list, which is run to its end where something is read back or a ring is
// full; textures that know their state; rings of descriptors and of constants. An engine has better ones of its own.
#pragma once

#ifndef NOMINMAX
#define NOMINMAX // std::min and std::max
#endif
#include <windows.h>

#define WIDL_EXPLICIT_AGGREGATE_RETURNS // MinGW's header: structures come back as Windows returns them
#include <d3d12.h>
#include <wrl/client.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

using Microsoft::WRL::ComPtr;

inline void check(HRESULT result, const std::string& what) {
    char code[16];
    std::snprintf(code, sizeof code, "%08lx", static_cast<unsigned long>(result));
    if (FAILED(result)) throw std::runtime_error(what + " failed with " + code);
}

inline const D3D12_RESOURCE_STATES kRead = D3D12_RESOURCE_STATE_PIXEL_SHADER_RESOURCE | D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE;

/// What a texture is made for.
struct TextureShape {
    UINT width = 1, height = 1, levels = 1, faces = 1;
    DXGI_FORMAT format = DXGI_FORMAT_UNKNOWN;
    D3D12_RESOURCE_FLAGS flags = D3D12_RESOURCE_FLAG_NONE;

    bool depth() const { return (flags & D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL) != 0; }
    /// A depth target that shaders read has no type of its own.
    bool readableDepth() const { return depth() && format == DXGI_FORMAT_D32_FLOAT; }
    DXGI_FORMAT resourceFormat() const { return readableDepth() ? DXGI_FORMAT_R32_TYPELESS : format; }
    DXGI_FORMAT readFormat() const { return readableDepth() ? DXGI_FORMAT_R32_FLOAT : format; }
};

struct Texture {
    TextureShape shape;
    ComPtr<ID3D12Resource> resource;
    D3D12_RESOURCE_STATES state = D3D12_RESOURCE_STATE_COPY_DEST;
    D3D12_CPU_DESCRIPTOR_HANDLE target{};              // as colour or depth target
    std::vector<D3D12_CPU_DESCRIPTOR_HANDLE> levels{}; // of a colour target with mip levels
};

struct Rows {
    std::vector<std::uint8_t> bytes;
    UINT pitch = 0;
};

/// Descriptors or bytes that are handed out in turn.
struct Ring {
    UINT used = 0, size = 0;
    UINT take(UINT64 count) {
        if (count > size - used) throw std::runtime_error("a ring of the sample is too small");
        used += static_cast<UINT>(count);
        return used - static_cast<UINT>(count);
    }
};

class Device {
public:
    Device() {
        check(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_11_0, IID_PPV_ARGS(&device_)), "D3D12CreateDevice");
        const D3D12_COMMAND_QUEUE_DESC queue{};
        check(device_->CreateCommandQueue(&queue, IID_PPV_ARGS(&queue_)), "CreateCommandQueue");
        check(device_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT, IID_PPV_ARGS(&allocator_)), "CreateCommandAllocator");
        check(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator_.Get(), nullptr, IID_PPV_ARGS(&list_)),
              "CreateCommandList");
        check(device_->CreateFence(0, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(&fence_)), "CreateFence");
        makeHeap(D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 1024);
        makeHeap(D3D12_DESCRIPTOR_HEAP_TYPE_DSV, 256);
        makeHeap(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 8192);
        makeHeap(D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER, 1024);
        constants_.size = 4U << 20;
        constantBuffer_ = buffer(constants_.size, D3D12_HEAP_TYPE_UPLOAD);
        check(constantBuffer_->Map(0, nullptr, reinterpret_cast<void**>(&constantBytes_)), "Map");
    }

    ID3D12Device* operator->() const { return device_.Get(); }
    ID3D12GraphicsCommandList* list() const { return list_.Get(); }

    /// Shader model 6 needs DXIL; without it there is DXBC.
    bool takesDxil() const {
        D3D12_FEATURE_DATA_SHADER_MODEL model{D3D_SHADER_MODEL_6_0};
        return SUCCEEDED(device_->CheckFeatureSupport(D3D12_FEATURE_SHADER_MODEL, &model, sizeof model)) &&
               model.HighestShaderModel >= D3D_SHADER_MODEL_6_0;
    }

    ComPtr<ID3D12Resource> buffer(UINT64 bytes, D3D12_HEAP_TYPE heap, const void* content = nullptr) {
        D3D12_RESOURCE_DESC desc{};
        desc.Dimension = D3D12_RESOURCE_DIMENSION_BUFFER;
        desc.Width = bytes;
        desc.Height = desc.DepthOrArraySize = desc.MipLevels = 1;
        desc.SampleDesc.Count = 1;
        desc.Layout = D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
        const auto state = heap == D3D12_HEAP_TYPE_UPLOAD ? D3D12_RESOURCE_STATE_GENERIC_READ : D3D12_RESOURCE_STATE_COPY_DEST;
        ComPtr<ID3D12Resource> made = resource(desc, heap, state);
        void* to = nullptr;
        if (!content) return made;
        check(made->Map(0, nullptr, &to), "Map");
        std::memcpy(to, content, bytes);
        made->Unmap(0, nullptr);
        return made;
    }

    Texture texture(const TextureShape& shape) {
        D3D12_RESOURCE_DESC desc{};
        desc.Dimension = D3D12_RESOURCE_DIMENSION_TEXTURE2D;
        desc.Width = shape.width;
        desc.Height = shape.height;
        desc.DepthOrArraySize = static_cast<UINT16>(shape.faces);
        desc.MipLevels = static_cast<UINT16>(shape.levels);
        desc.Format = shape.resourceFormat();
        desc.SampleDesc.Count = 1;
        desc.Flags = shape.flags;
        Texture made{
            shape, resource(desc, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COPY_DEST), D3D12_RESOURCE_STATE_COPY_DEST, {}, {}};
        if (shape.depth()) {
            D3D12_DEPTH_STENCIL_VIEW_DESC view{};
            view.Format = shape.format;
            view.ViewDimension = D3D12_DSV_DIMENSION_TEXTURE2D;
            made.target = next(D3D12_DESCRIPTOR_HEAP_TYPE_DSV);
            device_->CreateDepthStencilView(made.resource.Get(), &view, made.target);
        } else if ((shape.flags & D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET) != 0)
            for (UINT level = 0; level < made.shape.levels; ++level)
                made.levels.push_back(colorView(made, level));
        if (!made.levels.empty()) made.target = made.levels[0];
        return made;
    }

    D3D12_CPU_DESCRIPTOR_HANDLE colorView(const Texture& texture, UINT level) {
        D3D12_RENDER_TARGET_VIEW_DESC view{};
        view.Format = texture.shape.format;
        view.ViewDimension = D3D12_RTV_DIMENSION_TEXTURE2D;
        view.Texture2D.MipSlice = level;
        const D3D12_CPU_DESCRIPTOR_HANDLE handle = next(D3D12_DESCRIPTOR_HEAP_TYPE_RTV);
        device_->CreateRenderTargetView(texture.resource.Get(), &view, handle);
        return handle;
    }

    /// Rows without gaps: of each face its levels, the largest first.
    template <class Image>
    Texture uploaded(const TextureShape& shape, UINT bytesPerTexel, const Image& image) {
        Texture made = texture(shape);
        std::vector<ComPtr<ID3D12Resource>> kept; // until the list has run
        for (UINT i = 0; i < shape.faces * shape.levels; ++i) {
            const UINT level = i % shape.levels, height = std::max(1U, shape.height >> level);
            const UINT pitch = std::max(1U, shape.width >> level) * bytesPerTexel;
            D3D12_TEXTURE_COPY_LOCATION from = footprint(made, i), to{made.resource.Get(), D3D12_TEXTURE_COPY_TYPE_SUBRESOURCE_INDEX, {}};
            to.SubresourceIndex = i;
            std::vector<std::uint8_t> rows(std::size_t{from.PlacedFootprint.Footprint.RowPitch} * height);
            for (UINT y = 0; y < height; ++y)
                std::memcpy(&rows[std::size_t{y} * from.PlacedFootprint.Footprint.RowPitch], image(i) + std::size_t{y} * pitch, pitch);
            kept.push_back(buffer(rows.size(), D3D12_HEAP_TYPE_UPLOAD, rows.data()));
            from.pResource = kept.back().Get();
            list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
        }
        transition(made, kRead);
        run();
        return made;
    }

    Rows read(Texture& texture) {
        D3D12_TEXTURE_COPY_LOCATION to = footprint(texture, 0);
        const D3D12_TEXTURE_COPY_LOCATION from{texture.resource.Get(), D3D12_TEXTURE_COPY_TYPE_SUBRESOURCE_INDEX, {}};
        Rows rows{{}, to.PlacedFootprint.Footprint.RowPitch};
        rows.bytes.resize(std::size_t{rows.pitch} * texture.shape.height);
        const ComPtr<ID3D12Resource> copy = buffer(rows.bytes.size(), D3D12_HEAP_TYPE_READBACK);
        to.pResource = copy.Get();
        transition(texture, D3D12_RESOURCE_STATE_COPY_SOURCE);
        list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
        run();
        void* bytes = nullptr;
        check(copy->Map(0, nullptr, &bytes), "Map");
        std::memcpy(rows.bytes.data(), bytes, rows.bytes.size());
        copy->Unmap(0, nullptr);
        return rows;
    }

    void transition(Texture& texture, D3D12_RESOURCE_STATES state) {
        if (texture.state == state && state != D3D12_RESOURCE_STATE_UNORDERED_ACCESS) return;
        barrier(texture, texture.state, state, D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES);
        texture.state = state;
    }
    /// What was stored before is there for who stores next.
    void barrier(const Texture& texture, D3D12_RESOURCE_STATES before, D3D12_RESOURCE_STATES after, UINT level) {
        D3D12_RESOURCE_BARRIER barrier{};
        if (before == after) {
            barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_UAV;
            barrier.UAV.pResource = texture.resource.Get();
        } else
            barrier.Transition = {texture.resource.Get(), level, before, after};
        list_->ResourceBarrier(1, &barrier);
    }

    /// Runs the list to its end; the rings are empty again where one is more than half full, as before each draw.
    void run() {
        check(list_->Close(), "Close");
        ID3D12CommandList* const lists[] = {list_.Get()};
        queue_->ExecuteCommandLists(1, lists);
        check(queue_->Signal(fence_.Get(), ++runs_), "Signal");
        check(fence_->SetEventOnCompletion(runs_, nullptr), "SetEventOnCompletion"); // none: it waits
        check(allocator_->Reset(), "Reset");
        check(list_->Reset(allocator_.Get(), nullptr), "Reset");
        heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV].ring.used = heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER].ring.used = constants_.used =
            0;
    }
    void beginDraw() {
        const auto full = [](const Ring& ring) { return ring.used > ring.size / 2; };
        if (full(constants_) || full(heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV].ring) ||
            full(heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER].ring))
            run();
        ID3D12DescriptorHeap* const heaps[] = {heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV].heap.Get(),
                                               heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER].heap.Get()};
        list_->SetDescriptorHeaps(2, heaps);
    }

    struct Table {
        D3D12_CPU_DESCRIPTOR_HANDLE cpu{};
        D3D12_GPU_DESCRIPTOR_HANDLE gpu{};
        UINT step = 0;
        D3D12_CPU_DESCRIPTOR_HANDLE at(UINT index) const { return {cpu.ptr + std::size_t{index} * step}; }
    };
    /// In the heaps that shaders see, until the list has run.
    Table table(bool samplers, UINT64 count) {
        const auto type = samplers ? D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER : D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV;
        Heap& heap = heaps_[type];
        const UINT64 first = UINT64{heap.ring.take(count)} * heap.step;
        return {{heap.heap->GetCPUDescriptorHandleForHeapStart().ptr + static_cast<SIZE_T>(first)},
                {heap.heap->GetGPUDescriptorHandleForHeapStart().ptr + first},
                heap.step};
    }
    D3D12_GPU_VIRTUAL_ADDRESS constants(const std::vector<char>& bytes) {
        const UINT at = constants_.take((UINT64{bytes.size()} + 255) / 256 * 256);
        std::memcpy(constantBytes_ + at, bytes.data(), bytes.size());
        return constantBuffer_->GetGPUVirtualAddress() + at;
    }

private:
    struct Heap {
        ComPtr<ID3D12DescriptorHeap> heap;
        Ring ring;
        UINT step = 0;
    };

    void makeHeap(D3D12_DESCRIPTOR_HEAP_TYPE type, UINT size) {
        const bool seen = type == D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV || type == D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER;
        const D3D12_DESCRIPTOR_HEAP_DESC desc{type, size,
                                              seen ? D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE : D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
        check(device_->CreateDescriptorHeap(&desc, IID_PPV_ARGS(&heaps_[type].heap)), "CreateDescriptorHeap");
        heaps_[type].ring.size = size;
        heaps_[type].step = device_->GetDescriptorHandleIncrementSize(type);
    }
    D3D12_CPU_DESCRIPTOR_HANDLE next(D3D12_DESCRIPTOR_HEAP_TYPE type) {
        Heap& heap = heaps_[type];
        return {heap.heap->GetCPUDescriptorHandleForHeapStart().ptr + std::size_t{heap.ring.take(1)} * heap.step};
    }
    ComPtr<ID3D12Resource> resource(const D3D12_RESOURCE_DESC& desc, D3D12_HEAP_TYPE type, D3D12_RESOURCE_STATES state) {
        D3D12_HEAP_PROPERTIES heap{};
        heap.Type = type;
        ComPtr<ID3D12Resource> made;
        check(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr, IID_PPV_ARGS(&made)),
              "CreateCommittedResource");
        return made;
    }
    /// Of a subresource as rows in a buffer.
    D3D12_TEXTURE_COPY_LOCATION footprint(const Texture& texture, UINT subresource) const {
        D3D12_TEXTURE_COPY_LOCATION rows{nullptr, D3D12_TEXTURE_COPY_TYPE_PLACED_FOOTPRINT, {}};
        const D3D12_RESOURCE_DESC desc = texture.resource->GetDesc();
        device_->GetCopyableFootprints(&desc, subresource, 1, 0, &rows.PlacedFootprint, nullptr, nullptr, nullptr);
        return rows;
    }

    ComPtr<ID3D12Device> device_;
    ComPtr<ID3D12CommandQueue> queue_;
    ComPtr<ID3D12CommandAllocator> allocator_;
    ComPtr<ID3D12GraphicsCommandList> list_;
    ComPtr<ID3D12Fence> fence_;
    Heap heaps_[D3D12_DESCRIPTOR_HEAP_TYPE_NUM_TYPES];
    Ring constants_;
    ComPtr<ID3D12Resource> constantBuffer_;
    std::uint8_t* constantBytes_ = nullptr;
    UINT64 runs_ = 0;
};
