#pragma once
// What Direct3D 10 and 11 do in the same words: targets, textures and meshes, binding, clearing, drawing and reading back. Api names their
// types and says which object draws:
//
//   Device, Context, Texture, ColorView, DepthView, ResourceView, Buffer, Layout, and the descriptions of views
//   TextureDesc, BufferDesc, Data, Mapped, Viewport, Element
//   kColor, kDepth, kResource, kVertices, kIndices (what a resource is bound as), kMakeMips, kCube
//   kStore (what compute shaders write; 0 where there are none), kPerVertex, kTriangles, kClearDepth, kClearStencil, kDefault, kStaging,
//   kRead, kMapRead device(), context(), map(texture), unmap(texture)

#include "com.h"
#include "formats.h"
#include "script.h"

#include <map>

namespace client {

template <class Api>
typename Api::TextureDesc describe(unsigned width, unsigned height, unsigned levels, DXGI_FORMAT format, UINT bind) {
    typename Api::TextureDesc desc{};
    desc.Width = width;
    desc.Height = height;
    desc.MipLevels = levels;
    desc.ArraySize = 1;
    desc.Format = format;
    desc.SampleDesc.Count = 1;
    desc.BindFlags = bind;
    return desc;
}

template <class Api>
Com<typename Api::ResourceView> viewOf(typename Api::Texture* texture) {
    Com<typename Api::ResourceView> view;
    must(Api::device()->CreateShaderResourceView(texture, nullptr, view.put()), "CreateShaderResourceView");
    return view;
}

template <class Api>
Com<typename Api::ResourceView> uploadTexture(const TextureFile& file) {
    typename Api::TextureDesc desc = describe<Api>(file.width, file.height, file.levels, textureFormat(file.format).dxgi, Api::kResource);
    desc.ArraySize = file.faces;
    if (file.faces == 6) desc.MiscFlags = Api::kCube;
    std::vector<typename Api::Data> data;
    for (unsigned i = 0; i < file.faces * file.levels; ++i)
        data.push_back({file.images[i].data(), file.pitchOf(i % file.levels), 0});
    Com<typename Api::Texture> texture;
    must(Api::device()->CreateTexture2D(&desc, data.data(), texture.put()), "CreateTexture2D");
    return viewOf<Api>(texture.get());
}

template <class Api>
Com<typename Api::Buffer> makeBuffer(const void* data, std::size_t bytes, UINT bind) {
    typename Api::BufferDesc desc{};
    desc.ByteWidth = static_cast<UINT>(bytes);
    desc.Usage = Api::kDefault;
    desc.BindFlags = bind;
    const typename Api::Data initial{data, 0, 0};
    Com<typename Api::Buffer> buffer;
    must(Api::device()->CreateBuffer(&desc, &initial, buffer.put()), "CreateBuffer");
    return buffer;
}

/// For vertex shaders that were compiled to these bytes, or have this signature.
template <class Api>
Com<typename Api::Layout> vertexLayout(const void* shader, std::size_t bytes, const std::string& pass) {
    const typename Api::Element elements[] = {{"POSITION", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, Api::kPerVertex, 0},
                                              {"NORMAL", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 12, Api::kPerVertex, 0},
                                              {"TANGENT", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 0, 24, Api::kPerVertex, 0},
                                              {"TEXCOORD", 0, DXGI_FORMAT_R32G32_FLOAT, 0, 40, Api::kPerVertex, 0}};
    Com<typename Api::Layout> layout;
    must(Api::device()->CreateInputLayout(elements, 4, shader, bytes, layout.put()), "CreateInputLayout " + pass);
    return layout;
}

/// The targets and meshes of one job, and which targets are bound. No texture may be bound that becomes a target: who draws sees to that.
template <class Api>
class Canvas {
public:
    struct Target {
        TargetShape shape;
        Com<typename Api::Texture> texture;
        Com<typename Api::ColorView> color;
        Com<typename Api::DepthView> depth;
        Com<typename Api::ResourceView> resource;
    };

    explicit Canvas(const Job& job) : job_(job), quad_(upload(fullScreenQuad())) {
        stored_ = !job.stores.empty();
        targets_.emplace("", makeTarget({false, job.width, job.height, "A32B32G32R32F", 1}));
        pictureDepth_ = makeTarget({true, job.width, job.height, "D24S8", 1});
        for (const auto& [name, shape] : job.targets)
            targets_.emplace(name, makeTarget(shape));
        if (!job.mesh.empty()) mesh_ = upload(readMesh(job.path(job.mesh)));
        clearAll(job);
    }

    [[nodiscard]] const std::map<std::string, Target>& targets() const { return targets_; }

    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& [name, target] : targets_)
            names.push_back(name);
        return names;
    }

    /// Views of different sizes cannot be bound together: a depth target of another size is left out. Returns the viewport's size.
    Numbers bind(const Bound& bound) {
        boundColors_.clear();
        std::vector<typename Api::ColorView*> views;
        for (const auto& name : bound.colors) {
            if (!name) break;
            boundColors_.push_back(&targets_.at(*name));
            views.push_back(boundColors_.back()->color.get());
        }
        const TargetShape& first = boundColors_.at(0)->shape;
        boundDepth_ = !bound.depth ? nullptr : bound.depth->empty() ? &pictureDepth_ : &targets_.at(*bound.depth);
        if (boundDepth_ && (boundDepth_->shape.width != first.width || boundDepth_->shape.height != first.height)) boundDepth_ = nullptr;
        Api::context()->OMSetRenderTargets(static_cast<UINT>(views.size()), views.data(), boundDepth_ ? boundDepth_->depth.get() : nullptr);
        typename Api::Viewport viewport{};
        viewport.Width = static_cast<decltype(viewport.Width)>(first.width);
        viewport.Height = static_cast<decltype(viewport.Height)>(first.height);
        viewport.MaxDepth = 1;
        Api::context()->RSSetViewports(1, &viewport);
        return {static_cast<float>(first.width), static_cast<float>(first.height)};
    }

    void clear(Clear what, const Numbers& value) {
        if (what == Clear::Color) {
            for (const Target* target : boundColors_)
                Api::context()->ClearRenderTargetView(target->color.get(), value.data());
        } else if (boundDepth_) {
            const UINT flags = what == Clear::Depth ? Api::kClearDepth : Api::kClearStencil;
            Api::context()->ClearDepthStencilView(boundDepth_->depth.get(), flags, value[0], static_cast<UINT8>(value[0]));
        }
    }

    /// With the shaders and states that are set, what the pass draws of the mesh.
    void draw(Drawing drawing, const std::string& pass, typename Api::Layout* layout, UINT instances) {
        const Mesh& mesh = drawing == Drawing::Quad ? quad_ : mesh_;
        typename Api::Buffer* const vertices = mesh.vertices.get();
        const UINT stride = kVertexBytes;
        const UINT offset = 0;
        Api::context()->IASetInputLayout(layout);
        Api::context()->IASetVertexBuffers(0, 1, &vertices, &stride, &offset);
        Api::context()->IASetIndexBuffer(mesh.indices.get(), DXGI_FORMAT_R32_UINT, 0);
        Api::context()->IASetPrimitiveTopology(Api::kTriangles);
        const IndexRange range = drawing == Drawing::Quad ? IndexRange{0, mesh.indexCount} : job_.rangeOf(pass, mesh.indexCount);
        Api::context()->DrawIndexedInstanced(range.count, instances, range.first, 0, 0);
        for (const Target* target : boundColors_)
            if (target->shape.levels != 1) Api::context()->GenerateMips(target->resource.get());
    }

    Pixels read(const std::string& name) {
        const Target& target = targets_.at(name);
        const DXGI_FORMAT format = isReadableDepth(target.shape) ? DXGI_FORMAT_R32_TYPELESS : targetFormat(target.shape).dxgi;
        auto desc = describe<Api>(target.shape.width, target.shape.height, target.shape.levels, format, 0);
        desc.Usage = Api::kStaging;
        desc.CPUAccessFlags = Api::kRead;
        Com<typename Api::Texture> copy;
        must(Api::device()->CreateTexture2D(&desc, nullptr, copy.put()), "CreateTexture2D");
        Api::context()->CopyResource(copy.get(), target.texture.get());
        const typename Api::Mapped mapped = Api::map(copy.get());
        Pixels pixels = readRows(target.shape, mapped.pData, mapped.RowPitch);
        Api::unmap(copy.get());
        return pixels;
    }

private:
    struct Mesh {
        Com<typename Api::Buffer> vertices;
        Com<typename Api::Buffer> indices;
        unsigned indexCount = 0;
    };

    [[nodiscard]] Target makeTarget(const TargetShape& shape) const {
        if (isReadableDepth(shape)) return makeReadableDepth(shape);
        Target target{shape, {}, {}, {}, {}};
        const UINT bind = shape.depth ? Api::kDepth : Api::kColor | Api::kResource | (stored_ ? Api::kStore : 0U);
        auto desc = describe<Api>(shape.width, shape.height, shape.levels, targetFormat(shape).dxgi, bind);
        if (shape.levels != 1) desc.MiscFlags = Api::kMakeMips;
        must(Api::device()->CreateTexture2D(&desc, nullptr, target.texture.put()), "CreateTexture2D");
        if (shape.depth) {
            must(Api::device()->CreateDepthStencilView(target.texture.get(), nullptr, target.depth.put()), "CreateDepthStencilView");
            return target;
        }
        must(Api::device()->CreateRenderTargetView(target.texture.get(), nullptr, target.color.put()), "CreateRenderTargetView");
        target.resource = viewOf<Api>(target.texture.get());
        return target;
    }

    /// A texture without a type, and what it is to each of its views.
    static Target makeReadableDepth(const TargetShape& shape) {
        Target target{shape, {}, {}, {}, {}};
        const auto desc = describe<Api>(shape.width, shape.height, 1, DXGI_FORMAT_R32_TYPELESS, Api::kDepth | Api::kResource);
        must(Api::device()->CreateTexture2D(&desc, nullptr, target.texture.put()), "CreateTexture2D");
        typename Api::DepthViewDesc depth{};
        depth.Format = DXGI_FORMAT_D32_FLOAT;
        depth.ViewDimension = Api::kDepthView2D;
        must(Api::device()->CreateDepthStencilView(target.texture.get(), &depth, target.depth.put()), "CreateDepthStencilView");
        typename Api::ResourceViewDesc resource{};
        resource.Format = DXGI_FORMAT_R32_FLOAT;
        resource.ViewDimension = Api::kResourceView2D;
        resource.Texture2D.MipLevels = 1;
        must(Api::device()->CreateShaderResourceView(target.texture.get(), &resource, target.resource.put()), "CreateShaderResourceView");
        return target;
    }

    static Mesh upload(const MeshFile& file) {
        return {makeBuffer<Api>(file.vertices.data(), file.vertices.size() * sizeof(float), Api::kVertices),
                makeBuffer<Api>(file.indices.data(), file.indices.size() * sizeof(std::uint32_t), Api::kIndices),
                static_cast<unsigned>(file.indices.size())};
    }

    /// A frame depends on nothing that was there before.
    void clearAll(const Job& job) {
        const auto clearDepth = [](const Target& target) {
            Api::context()->ClearDepthStencilView(target.depth.get(), Api::kClearDepth | Api::kClearStencil, 1, 0);
        };
        for (const auto& [name, target] : targets_)
            if (target.color)
                Api::context()->ClearRenderTargetView(target.color.get(), job.emptyColor(name).data());
            else
                clearDepth(target);
        clearDepth(pictureDepth_);
    }

    std::map<std::string, Target> targets_;
    Target pictureDepth_;
    Mesh mesh_;
    const Job& job_;
    Mesh quad_;
    std::vector<const Target*> boundColors_;
    const Target* boundDepth_ = nullptr;
    bool stored_ = false; // compute shaders write some of the targets
};

} // namespace client
