// An effect of this project in a Direct3D 12 engine: what `tegument check --emit` writes. Shaders, registers, states and root signatures
// come from the manifest, scripts run by the script player. States, views and constants are set anew for each draw.
#pragma once

#include "device.h"
#include "pipeline.h"

#include <algorithm>
#include <functional>
#include <map>

class Effect : script_player::Engine {
public:
    /// Draws the mesh, or a full-screen quad, so many times; of a pass with the annotation Part that part of the mesh.
    using Draw = std::function<void(const script_player::Pass& pass, bool mesh, UINT instances)>;
    using Json = script_player::Json;

    Effect(Device& device, const std::string& folder) : device_(device), folder_(folder) {
        manifest_ = script_player::readManifest(textOf(folder + "\\manifest.json"));
        kind_ = device.takesDxil() && manifest_.at("shaders").list().at(0).find("dxil") ? "dxil" : "sm5";
        for (const Json& parameter : manifest_.at("parameters").list())
            values_[parameter.at("name").text()] = script_player::defaultOf(parameter);
    }

    Texture& target(const std::string& name) { return targets_.at(name); }
    std::map<std::string, Texture>& targets() { return targets_; }
    void setTexture(const std::string& name, Texture* texture) { textures_[name] = texture; }

    /// Everything that the effect asks for: `value` gives the numbers for a parameter, by its name, semantic, annotation Object; none where
    /// the scene has none, and the effect's default holds. Matrices as row vectors want them, mul(v, M), row after row.
    template <class Value>
    void setValues(const Value& value) {
        for (const Json& parameter : manifest_.at("parameters").list())
            if (std::vector<float> numbers = value(parameter); !numbers.empty()) values_[parameter.at("name").text()].numbers = numbers;
    }

    void makeTargets(UINT pictureWidth, UINT pictureHeight) {
        for (const Json& parameter : manifest_.at("parameters").list()) {
            const std::string semantic = script_player::detail::upper(parameter.at("semantic").text());
            if (semantic != "RENDERCOLORTARGET" && semantic != "RENDERDEPTHSTENCILTARGET") continue;
            const Json& said = parameter.at("annotations");
            const bool depth = semantic != "RENDERCOLORTARGET";
            auto flags = depth ? D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL : D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
            if (!depth && manifest_.find("storages")) flags |= D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
            const Json* levels = depth ? nullptr : said.find("MipLevels");
            const DXGI_FORMAT format = targetFormat(said.textOr("Format", depth ? "D24S8" : "A8R8G8B8"));
            const UINT width = targetSize(said, 0, "Width", pictureWidth), height = targetSize(said, 1, "Height", pictureHeight);
            const TextureShape shape{width, height, levelsOf(levels ? levels->whole() : 1, width, height), 1, format, flags};
            targets_[parameter.at("name").text()] = device_.texture(shape);
        }
    }

    void run(const std::string& technique, Texture& picture, Texture& depth, const Draw& draw) {
        picture_ = &picture;
        pictureDepth_ = &depth;
        draw_ = &draw;
        technique_ = &script_player::named(manifest_.at("techniques"), technique);
        script_player::play(script_player::techniqueOf(manifest_, technique), *this);
    }

private:
    /// MipLevels 0: down to one texel.
    static UINT levelsOf(UINT asked, UINT width, UINT height) {
        UINT all = 1;
        while (std::max(width, height) >> all > 0)
            ++all;
        return asked == 0 ? all : std::min(asked, all);
    }

    // ---- What scripts ask for.

    void setTargets(const script_player::Targets& targets) override {
        colors_.clear();
        for (const auto& name : targets.colors) {
            if (!name) break;
            colors_.push_back(name->empty() ? picture_ : &targets_.at(nameOf(*name)));
        }
        depth_ = !targets.depth ? nullptr : targets.depth->empty() ? pictureDepth_ : &targets_.at(nameOf(*targets.depth));
        const TextureShape& size = colors_.at(0)->shape;
        if (depth_ && (depth_->shape.width != size.width || depth_->shape.height != size.height)) depth_ = nullptr;
        viewport_ = {static_cast<float>(size.width), static_cast<float>(size.height)};
    }

    void clear(script_player::Clear what, std::optional<std::size_t> place, const std::vector<float>& value) override {
        if (what == script_player::Clear::Color) {
            for (std::size_t i = 0; i < colors_.size(); ++i) {
                if (place.value_or(i) != i) continue;
                device_.transition(*colors_[i], D3D12_RESOURCE_STATE_RENDER_TARGET);
                device_.list()->ClearRenderTargetView(colors_[i]->target, value.data(), 0, nullptr);
            }
        } else if (depth_) {
            device_.transition(*depth_, D3D12_RESOURCE_STATE_DEPTH_WRITE);
            const auto flags = what == script_player::Clear::Depth ? D3D12_CLEAR_FLAG_DEPTH : D3D12_CLEAR_FLAG_STENCIL;
            const auto stencil = static_cast<UINT8>(std::clamp(value[0], 0.0F, 255.0F));
            device_.list()->ClearDepthStencilView(depth_->target, flags, value[0], stencil, 0, nullptr);
        }
    }

    script_player::Value value(const std::string& parameter) override { return values_.at(nameOf(parameter)); }
    void setNumber(const std::string& parameter, float number) override { values_.at(nameOf(parameter)).numbers = {number}; }

    void draw(const script_player::Pass& played, script_player::Draw what) override {
        const Json& pass = script_player::named(technique_->at("passes"), played.name);
        if (what == script_player::Draw::Compute) return compute(pass);
        device_.beginDraw();
        ID3D12GraphicsCommandList* const list = device_.list();
        const Pipeline& pipeline = pipelineOf(pass);
        list->SetPipelineState(pipeline.state.Get());
        list->SetGraphicsRootSignature(pipeline.root.signature.Get());
        setBlendAndStencil(list, pass.at("states"));
        bind(pass, pipeline.root, false);
        std::vector<D3D12_CPU_DESCRIPTOR_HANDLE> views;
        for (Texture* color : colors_) {
            device_.transition(*color, D3D12_RESOURCE_STATE_RENDER_TARGET);
            views.push_back(color->target);
        }
        if (depth_) device_.transition(*depth_, D3D12_RESOURCE_STATE_DEPTH_WRITE);
        list->OMSetRenderTargets(static_cast<UINT>(views.size()), views.data(), FALSE, depth_ ? &depth_->target : nullptr);
        const D3D12_VIEWPORT viewport{0, 0, viewport_[0], viewport_[1], 0, 1};
        const D3D12_RECT all{0, 0, static_cast<LONG>(viewport_[0]), static_cast<LONG>(viewport_[1])};
        list->RSSetViewports(1, &viewport);
        list->RSSetScissorRects(1, &all);
        const std::string instances = pass.at("annotations").textOr("Instances", "");
        (*draw_)(played, what != script_player::Draw::Quad, instances.empty() ? 1U : countOf(value(instances).numbers.at(0)));
        for (Texture* color : colors_)
            if (color->shape.levels > 1) mips_.make(device_, *color);
    }

    /// So many groups as the pass's annotations say: docs/effect-files.md, "Compute passes".
    void compute(const Json& pass) {
        const Json& said = pass.at("annotations");
        const Json& shader = script_player::named(manifest_.at("shaders"), pass.at("compute_shader").text());
        const std::string texels = said.textOr("Threads", "");
        UINT groups[3] = {1, 1, 1};
        if (const Json* counted = said.find("Groups")) {
            for (std::size_t i = 0; i < std::min<std::size_t>(3, counted->list().size()); ++i)
                groups[i] = counted->items[i].whole();
        } else if (const Json* parameter = said.find("GroupCount")) {
            const std::vector<float> counts = value(parameter->text()).numbers;
            for (std::size_t i = 0; i < std::min<std::size_t>(3, counts.size()); ++i)
                groups[i] = countOf(counts[i]);
        } else {
            const TextureShape& shape = targets_.at(nameOf(texels)).shape;
            const auto along = [&](UINT size, std::size_t axis) {
                const UINT threads = std::max(1U, shader.at("threads").list().at(axis).whole());
                return (size + threads - 1) / threads;
            };
            groups[0] = along(shape.width, 0);
            groups[1] = along(shape.height, 1);
        }
        const std::string sized = said.textOr("Viewport", texels);
        const TextureShape& viewport = sized.empty() ? picture_->shape : targets_.at(nameOf(sized)).shape;
        viewport_ = {static_cast<float>(viewport.width), static_cast<float>(viewport.height)};
        device_.beginDraw();
        const Pipeline& pipeline = pipelineOf(pass);
        device_.list()->SetPipelineState(pipeline.state.Get());
        device_.list()->SetComputeRootSignature(pipeline.root.signature.Get());
        bind(pass, pipeline.root, true);
        if (groups[0] > 0 && groups[1] > 0 && groups[2] > 0) device_.list()->Dispatch(groups[0], groups[1], groups[2]);
    }

    // ---- What shaders read.

    struct Pipeline {
        RootSignature root;
        ComPtr<ID3D12PipelineState> state;
    };

    const std::string& nameOf(const std::string& parameter) const {
        return script_player::named(manifest_.at("parameters"), parameter).at("name").text();
    }

    const Json& shaderOf(const Json& pass, const char* stage) const {
        return script_player::named(manifest_.at("shaders"), pass.at(stage).text()).at(kind_);
    }

    Pipeline& pipelineOf(const Json& pass) {
        const bool compute = pass.find("compute_shader") != nullptr;
        std::string key = technique_->at("name").text() + "/" + pass.at("name").text();
        for (std::size_t i = 0; i < colors_.size() && !compute; ++i)
            key += "/" + std::to_string(colors_[i]->shape.format);
        if (depth_ && !compute) key += "/" + std::to_string(depth_->shape.format);
        Pipeline& pipeline = pipelines_[key];
        if (pipeline.state) return pipeline;
        pipeline.root = rootSignature(device_, pass.at("root_signature").text());
        const auto code = [&](const char* stage) { return textOf(folder_ + "\\" + shaderOf(pass, stage).at("file").text()); };
        if (compute) {
            const std::string shader = code("compute_shader");
            D3D12_COMPUTE_PIPELINE_STATE_DESC desc{};
            desc.pRootSignature = pipeline.root.signature.Get();
            desc.CS = {shader.data(), shader.size()};
            check(device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(&pipeline.state)), key);
            return pipeline;
        }
        const std::string vertex = code("vertex_shader"), pixel = code("pixel_shader");
        D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = graphicsState(pass.at("states"));
        desc.pRootSignature = pipeline.root.signature.Get();
        desc.VS = {vertex.data(), vertex.size()};
        desc.PS = {pixel.data(), pixel.size()};
        for (const Texture* color : colors_)
            desc.RTVFormats[desc.NumRenderTargets++] = color->shape.format;
        if (depth_) desc.DSVFormat = depth_->shape.format;
        if (!depth_) desc.DepthStencilState.DepthEnable = desc.DepthStencilState.StencilEnable = FALSE;
        check(device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(&pipeline.state)), key);
        return pipeline;
    }

    /// What the root signature has a place for: blocks of constants, and tables of textures, stores and samplers. In its order.
    void bind(const Json& pass, const RootSignature& root, bool compute) {
        ID3D12GraphicsCommandList* const list = device_.list();
        for (UINT i = 0; i < root.desc()->NumParameters; ++i) {
            const D3D12_ROOT_PARAMETER& place = root.desc()->pParameters[i];
            const bool vertex = place.ShaderVisibility == D3D12_SHADER_VISIBILITY_VERTEX;
            const Json& shader = shaderOf(pass, compute ? "compute_shader" : vertex ? "vertex_shader" : "pixel_shader");
            if (place.ParameterType == D3D12_ROOT_PARAMETER_TYPE_CBV) {
                const auto address = device_.constants(blockOf(shader, place.Descriptor.ShaderRegister));
                compute ? list->SetComputeRootConstantBufferView(i, address) : list->SetGraphicsRootConstantBufferView(i, address);
            } else if (place.ParameterType != D3D12_ROOT_PARAMETER_TYPE_DESCRIPTOR_TABLE)
                throw std::runtime_error("a root signature that no manifest has");
            else {
                const auto table = tableOf(shader, place.DescriptorTable);
                compute ? list->SetComputeRootDescriptorTable(i, table) : list->SetGraphicsRootDescriptorTable(i, table);
            }
        }
    }

    std::vector<char> blockOf(const Json& shader, UINT at) const {
        for (const Json& block : shader.at("constants").list()) {
            if (block.at("register").number() != at) continue;
            std::vector<char> bytes(block.at("size").whole());
            for (const Json& member : block.at("members").list()) {
                const std::string& name = member.at("name").text();
                const auto value = values_.find(name);
                if (semanticOf(name) == "VIEWPORTPIXELSIZE")
                    writeMember(member, viewport_, bytes);
                else if (value != values_.end())
                    writeMember(member, value->second.numbers, bytes);
            }
            return bytes;
        }
        return std::vector<char>(256);
    }
    std::string semanticOf(const std::string& name) const {
        for (const Json& parameter : manifest_.at("parameters").list())
            if (parameter.at("name").text() == name) return script_player::detail::upper(parameter.at("semantic").text());
        return "";
    }

    D3D12_GPU_DESCRIPTOR_HANDLE tableOf(const Json& shader, const D3D12_ROOT_DESCRIPTOR_TABLE& wanted) {
        UINT64 count = 0;
        for (UINT i = 0; i < wanted.NumDescriptorRanges; ++i)
            count += wanted.pDescriptorRanges[i].NumDescriptors;
        const bool samplers = wanted.pDescriptorRanges[0].RangeType == D3D12_DESCRIPTOR_RANGE_TYPE_SAMPLER;
        const Device::Table table = device_.table(samplers, count);
        UINT place = 0;
        for (UINT i = 0; i < wanted.NumDescriptorRanges; ++i)
            for (UINT k = 0; k < wanted.pDescriptorRanges[i].NumDescriptors; ++k) {
                const D3D12_DESCRIPTOR_RANGE& range = wanted.pDescriptorRanges[i];
                fill(table.at(place++), range.RangeType, resourceAt(shader, range.RangeType, range.BaseShaderRegister + k));
            }
        return table.gpu;
    }

    /// Its name; none: nothing is read from this register.
    static std::string resourceAt(const Json& shader, D3D12_DESCRIPTOR_RANGE_TYPE type, UINT at) {
        for (const Json& resource : shader.at("resources").list()) {
            const std::string& kind = resource.at("kind").text();
            const auto own = kind == "Sampler" || kind == "CompareSampler" ? D3D12_DESCRIPTOR_RANGE_TYPE_SAMPLER
                             : kind == "StorageImage"                      ? D3D12_DESCRIPTOR_RANGE_TYPE_UAV
                                                                           : D3D12_DESCRIPTOR_RANGE_TYPE_SRV;
            if (own == type && resource.at("register").number() == at) return resource.at("name").text();
        }
        return "";
    }

    void fill(D3D12_CPU_DESCRIPTOR_HANDLE place, D3D12_DESCRIPTOR_RANGE_TYPE type, const std::string& name) {
        if (type == D3D12_DESCRIPTOR_RANGE_TYPE_SAMPLER) {
            if (name.empty()) return;
            const D3D12_SAMPLER_DESC desc = samplerState(script_player::named(manifest_.at("samplers"), name).at("states"));
            device_->CreateSampler(&desc, place);
        } else if (type == D3D12_DESCRIPTOR_RANGE_TYPE_UAV) {
            if (name.empty()) return;
            const std::string& target = script_player::named(manifest_.at("storages"), name).at("target").text();
            Texture& texture = target.empty() ? *picture_ : targets_.at(target);
            device_.transition(texture, D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
            D3D12_UNORDERED_ACCESS_VIEW_DESC view{};
            view.Format = texture.shape.format;
            view.ViewDimension = D3D12_UAV_DIMENSION_TEXTURE2D;
            device_->CreateUnorderedAccessView(texture.resource.Get(), nullptr, &view, place);
        } else {
            if (name.empty()) return readNothing(device_, place);
            const auto own = targets_.find(name);
            const auto given = textures_.find(name);
            if (own == targets_.end() && (given == textures_.end() || !given->second)) throw std::runtime_error("no texture " + name);
            Texture& texture = own != targets_.end() ? own->second : *given->second;
            device_.transition(texture, kRead);
            readView(device_, texture, 0, texture.shape.levels, place);
        }
    }

    Device& device_;
    std::string folder_;
    Json manifest_;
    std::string kind_; // of the shaders that the device takes
    std::map<std::string, script_player::Value> values_;
    std::map<std::string, Texture> targets_;
    std::map<std::string, Texture*> textures_;
    std::map<std::string, Pipeline> pipelines_;
    MipMaker mips_;
    const Json* technique_ = nullptr;
    Texture *picture_ = nullptr, *pictureDepth_ = nullptr; // the application's
    std::vector<Texture*> colors_;                         // bound
    Texture* depth_ = nullptr;
    std::vector<float> viewport_{1, 1};
    const Draw* draw_ = nullptr;
};
