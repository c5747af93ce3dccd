// Pipelines: Direct3D's states in Vulkan's words.

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/pipeline_layout.h"
#include "host/gpu/spirv.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tegument::gpu {

namespace detail {

namespace {

Result<void> checkShaders(const PipelineDesc& desc) {
    if (auto vertex = checkShader(desc.vertex.spirv, desc.vertex.entry, ShaderStage::Vertex, desc.name); !vertex) return vertex;
    if (desc.pixel.spirv.empty()) return {};
    return checkShader(desc.pixel.spirv, desc.pixel.entry, ShaderStage::Pixel, desc.name);
}

Result<void> checkAttachments(const DeviceState& device, const PipelineDesc& desc) {
    const std::size_t limit = std::min<std::size_t>(device.limits.maxColorAttachments, desc.state.targets.size());
    if (desc.colorFormats.size() > limit)
        return requestError(6026, fmt::format("pipeline '{}' writes {} colour targets, and {} allows {}", desc.name,
                                              desc.colorFormats.size(), device.info.name, limit));
    if (desc.colorFormats.empty() && !desc.depthFormat)
        return requestError(6026, fmt::format("pipeline '{}' has no target, neither colour nor depth", desc.name));
    if (std::ranges::any_of(desc.colorFormats, isDepth))
        return requestError(6026, fmt::format("pipeline '{}' has a depth format among its colour targets", desc.name));
    if (desc.depthFormat && !isDepth(*desc.depthFormat))
        return requestError(6026,
                            fmt::format("pipeline '{}' has depth target format {}, a colour format", desc.name, name(*desc.depthFormat)));
    return {};
}

/// Of both kinds of target: what is drawn with several samples has a depth target beside the colours, as a rule.
Result<void> checkSamples(const DeviceState& device, const PipelineDesc& desc) {
    const auto offered =
        static_cast<std::uint32_t>(device.limits.framebufferColorSampleCounts & device.limits.framebufferDepthSampleCounts);
    if (std::has_single_bit(desc.samples) && (offered & desc.samples) != 0) return {};
    return machineError(6016,
                        fmt::format("pipeline '{}' draws {} samples a pixel, and {} offers {}", desc.name, desc.samples, device.info.name,
                                    listedSamples(offered)),
                        "ask for one of these");
}

bool readsSecondSource(const TargetBlend& blend) {
    const auto second = [](BlendFactor factor) { return factor >= BlendFactor::Src1Color; };
    return blend.enable && (second(blend.src) || second(blend.dst) || second(blend.srcAlpha) || second(blend.dstAlpha));
}

std::string_view capabilityName(std::uint32_t capability) {
    switch (capability) { // as logical_device.cpp lists them
    case 2: return "geometry stage";
    case 25: return "gathering with offsets";
    case 32: return "clip distances";
    case 33: return "cull distances";
    case 55: return "reading of storage images without a format";
    case 56: return "writing of storage images without a format";
    case 4427: return "draw parameters";
    default: return "demotion to helper invocations";
    }
}

/// The first thing that the state asks for and the device lacks; empty: nothing.
std::string_view missingFeature(const DeviceState& device, const PipelineDesc& desc) {
    const auto used = std::span(desc.state.targets).first(desc.colorFormats.size());
    if (desc.state.fill != FillMode::Solid && !device.features.wireframe) return "fill modes other than Solid";
    if (!desc.state.depthClip && !device.features.depthClamp) return "rendering without depth clipping";
    if (std::ranges::any_of(used, readsSecondSource) && !device.features.dualSourceBlend) return "dual-source blending";
    const bool different = std::ranges::adjacent_find(used, std::not_equal_to<>()) != used.end();
    if (different && !device.features.independentBlend) return "different blend states on several targets";
    return {};
}

Result<void> checkBlendable(const DeviceState& device, const PipelineDesc& desc) {
    for (std::size_t i = 0; i < desc.colorFormats.size(); ++i) {
        if (!desc.state.targets[i].enable) continue;
        const auto features = device.physical.getFormatProperties(vulkanFormat(desc.colorFormats[i])).optimalTilingFeatures;
        if (!(features & vk::FormatFeatureFlagBits::eColorAttachmentBlend))
            return machineError(6025, fmt::format("pipeline '{}' blends into target {}, and {} cannot blend {}", desc.name, i,
                                                  device.info.name, name(desc.colorFormats[i])));
    }
    return {};
}

/// Capabilities of the module that the device lacks: TG6024.
Result<void> checkCapabilities(const DeviceState& device, std::span<const std::uint32_t> words, const std::string& pipeline) {
    constexpr std::size_t kHeader = 5;        // words before the first instruction
    constexpr std::uint32_t kCapability = 17; // OpCapability: all of them stand first
    for (std::size_t at = kHeader; at + 1 < words.size() && (words[at] & 0xffffU) == kCapability; at += 2)
        if (std::ranges::find(device.lacking, words[at + 1]) != device.lacking.end())
            return machineError(
                6024,
                fmt::format("pipeline '{}': {} has no {}, which a shader needs", pipeline, device.info.name, capabilityName(words[at + 1])),
                "choose another device, or another technique");
    return {};
}

/// Shaders, attachments and optional features: TG6020, TG6021, TG6024 to TG6026.
Result<void> checkPipeline(const DeviceState& device, const PipelineDesc& desc) {
    if (auto shaders = checkShaders(desc); !shaders) return shaders;
    for (const auto& words : {std::span<const std::uint32_t>(desc.vertex.spirv), std::span<const std::uint32_t>(desc.pixel.spirv)})
        if (auto capable = checkCapabilities(device, words, desc.name); !capable) return capable;
    if (auto attachments = checkAttachments(device, desc); !attachments) return attachments;
    if (auto samples = checkSamples(device, desc); !samples) return samples;
    if (const auto missing = missingFeature(device, desc); !missing.empty())
        return machineError(6024, fmt::format("pipeline '{}': {} has no {}", desc.name, device.info.name, missing));
    return checkBlendable(device, desc);
}

vk::CompareOp compare(CompareOp op) {
    return static_cast<vk::CompareOp>(op);
} // same order; asserted in sampler.cpp

vk::BlendFactor factor(BlendFactor value) {
    switch (value) {
    case BlendFactor::Zero: return vk::BlendFactor::eZero;
    case BlendFactor::One: return vk::BlendFactor::eOne;
    case BlendFactor::SrcColor: return vk::BlendFactor::eSrcColor;
    case BlendFactor::InvSrcColor: return vk::BlendFactor::eOneMinusSrcColor;
    case BlendFactor::SrcAlpha: return vk::BlendFactor::eSrcAlpha;
    case BlendFactor::InvSrcAlpha: return vk::BlendFactor::eOneMinusSrcAlpha;
    case BlendFactor::DestAlpha: return vk::BlendFactor::eDstAlpha;
    case BlendFactor::InvDestAlpha: return vk::BlendFactor::eOneMinusDstAlpha;
    case BlendFactor::DestColor: return vk::BlendFactor::eDstColor;
    case BlendFactor::InvDestColor: return vk::BlendFactor::eOneMinusDstColor;
    case BlendFactor::SrcAlphaSat: return vk::BlendFactor::eSrcAlphaSaturate;
    case BlendFactor::BlendFactor: return vk::BlendFactor::eConstantColor;
    case BlendFactor::InvBlendFactor: return vk::BlendFactor::eOneMinusConstantColor;
    case BlendFactor::Src1Color: return vk::BlendFactor::eSrc1Color;
    case BlendFactor::InvSrc1Color: return vk::BlendFactor::eOneMinusSrc1Color;
    case BlendFactor::Src1Alpha: return vk::BlendFactor::eSrc1Alpha;
    case BlendFactor::InvSrc1Alpha: return vk::BlendFactor::eOneMinusSrc1Alpha;
    }
    return vk::BlendFactor::eZero;
}

vk::BlendOp blendOp(BlendOp op) {
    switch (op) {
    case BlendOp::Add: return vk::BlendOp::eAdd;
    case BlendOp::Subtract: return vk::BlendOp::eSubtract;
    case BlendOp::RevSubtract: return vk::BlendOp::eReverseSubtract;
    case BlendOp::Min: return vk::BlendOp::eMin;
    case BlendOp::Max: return vk::BlendOp::eMax;
    }
    return vk::BlendOp::eAdd;
}

vk::StencilOp stencilOp(StencilOp op) {
    switch (op) {
    case StencilOp::Keep: return vk::StencilOp::eKeep;
    case StencilOp::Zero: return vk::StencilOp::eZero;
    case StencilOp::Replace: return vk::StencilOp::eReplace;
    case StencilOp::IncrSat: return vk::StencilOp::eIncrementAndClamp;
    case StencilOp::DecrSat: return vk::StencilOp::eDecrementAndClamp;
    case StencilOp::Invert: return vk::StencilOp::eInvert;
    case StencilOp::Incr: return vk::StencilOp::eIncrementAndWrap;
    case StencilOp::Decr: return vk::StencilOp::eDecrementAndWrap;
    }
    return vk::StencilOp::eKeep;
}

vk::StencilOpState stencilFace(const StencilFace& face, const PipelineState& state) {
    return {.failOp = stencilOp(face.fail),
            .passOp = stencilOp(face.pass),
            .depthFailOp = stencilOp(face.depthFail),
            .compareOp = compare(face.compare),
            .compareMask = state.stencilReadMask,
            .writeMask = state.stencilWriteMask,
            .reference = state.stencilReference};
}

vk::PolygonMode polygonMode(FillMode fill) {
    switch (fill) {
    case FillMode::Solid: return vk::PolygonMode::eFill;
    case FillMode::Wireframe: return vk::PolygonMode::eLine;
    case FillMode::Point: return vk::PolygonMode::ePoint;
    }
    return vk::PolygonMode::eFill;
}

vk::CullModeFlags cullMode(CullMode cull) {
    switch (cull) {
    case CullMode::None: return vk::CullModeFlagBits::eNone;
    case CullMode::Front: return vk::CullModeFlagBits::eFront;
    case CullMode::Back: return vk::CullModeFlagBits::eBack;
    }
    return vk::CullModeFlagBits::eNone;
}

vk::PipelineRasterizationStateCreateInfo rasterization(const PipelineState& state) {
    return {
        .depthClampEnable = !state.depthClip,
        .polygonMode = polygonMode(state.fill),
        .cullMode = cullMode(state.cull),
        // Vulkan judges winding in the target, after the viewport has been turned upright: exactly what Direct3D does.
        .frontFace = state.frontCounterClockwise ? vk::FrontFace::eCounterClockwise : vk::FrontFace::eClockwise,
        .depthBiasEnable = state.depthBias != 0 || state.slopeScaledDepthBias != 0,
        .depthBiasConstantFactor = state.depthBias,
        .depthBiasSlopeFactor = state.slopeScaledDepthBias,
        .lineWidth = 1.0f,
    };
}

vk::PipelineDepthStencilStateCreateInfo depthStencil(const PipelineDesc& desc) {
    const PipelineState& state = desc.state;
    return {
        .depthTestEnable = desc.depthFormat && state.depthTest,
        .depthWriteEnable = desc.depthFormat && state.depthWrite,
        .depthCompareOp = compare(state.depthCompare),
        .stencilTestEnable = desc.depthFormat && hasStencil(*desc.depthFormat) && state.stencilTest,
        .front = stencilFace(state.stencilFront, state),
        .back = stencilFace(state.stencilBack, state),
    };
}

vk::PipelineColorBlendAttachmentState blend(const TargetBlend& target) {
    return {
        .blendEnable = target.enable,
        .srcColorBlendFactor = factor(target.src),
        .dstColorBlendFactor = factor(target.dst),
        .colorBlendOp = blendOp(target.op),
        .srcAlphaBlendFactor = factor(target.srcAlpha),
        .dstAlphaBlendFactor = factor(target.dstAlpha),
        .alphaBlendOp = blendOp(target.opAlpha),
        .colorWriteMask = static_cast<vk::ColorComponentFlags>(target.writeMask & 15u), // the same bits
    };
}

std::vector<vk::VertexInputAttributeDescription> vertexAttributes(const PipelineDesc& desc) {
    constexpr std::array kFormats = {vk::Format::eR32Sfloat, vk::Format::eR32G32Sfloat, vk::Format::eR32G32B32Sfloat,
                                     vk::Format::eR32G32B32A32Sfloat};
    std::vector<vk::VertexInputAttributeDescription> list;
    for (const VertexAttribute& attribute : desc.attributes) {
        assert(attribute.components >= 1 && attribute.components <= 4);
        list.push_back({.location = attribute.location, .format = kFormats.at(attribute.components - 1), .offset = attribute.offset});
    }
    return list;
}

std::vector<vk::PipelineShaderStageCreateInfo> stages(const PipelineDesc& desc, const vk::raii::ShaderModule& vertex,
                                                      const vk::raii::ShaderModule& pixel) {
    std::vector<vk::PipelineShaderStageCreateInfo> list;
    list.push_back({.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = desc.vertex.entry.c_str()});
    if (!desc.pixel.spirv.empty())
        list.push_back({.stage = vk::ShaderStageFlagBits::eFragment, .module = *pixel, .pName = desc.pixel.entry.c_str()});
    return list;
}

/// The first output that no target takes. The alpha of output 0 may say what is covered, also where no target does.
std::uint32_t firstDropped(const PipelineDesc& desc) {
    return std::max(static_cast<std::uint32_t>(desc.colorFormats.size()), desc.state.alphaToCoverage ? 1U : 0U);
}

vk::raii::Pipeline makeGraphicsPipeline(const PipelineHandle& handle, const PipelineDesc& desc) {
    const vk::raii::Device& device = handle.device->device;
    const auto vertex = makeModule(*handle.device, desc.vertex.spirv);
    const auto dropped = withoutOutputsFrom(firstDropped(desc), desc.pixel.spirv);
    const auto pixel = desc.pixel.spirv.empty() ? vk::raii::ShaderModule(nullptr)
                                                : makeModule(*handle.device, dropped.empty() ? desc.pixel.spirv : std::span(dropped));
    const auto shaders = stages(desc, vertex, pixel);
    const auto attributes = vertexAttributes(desc);
    const vk::VertexInputBindingDescription stream{.binding = 0, .stride = desc.vertexStride, .inputRate = vk::VertexInputRate::eVertex};
    const vk::PipelineVertexInputStateCreateInfo vertexInput{
        .vertexBindingDescriptionCount = attributes.empty() ? 0u : 1u,
        .pVertexBindingDescriptions = &stream,
        .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size()),
        .pVertexAttributeDescriptions = attributes.data(),
    };
    const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = desc.topology == Topology::TriangleStrip
                                                                            ? vk::PrimitiveTopology::eTriangleStrip
                                                                            : vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo raster = rasterization(desc.state);
    const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples =
                                                                 static_cast<vk::SampleCountFlagBits>(desc.samples), // the same numbers
                                                             .alphaToCoverageEnable = desc.state.alphaToCoverage};
    const vk::PipelineDepthStencilStateCreateInfo depth = depthStencil(desc);
    std::vector<vk::PipelineColorBlendAttachmentState> blends;
    std::vector<vk::Format> colors;
    for (std::size_t i = 0; i < desc.colorFormats.size(); ++i) {
        blends.push_back(blend(desc.state.targets.at(i)));
        colors.push_back(vulkanFormat(desc.colorFormats[i]));
    }
    const vk::PipelineColorBlendStateCreateInfo colorBlend{.attachmentCount = static_cast<std::uint32_t>(blends.size()),
                                                           .pAttachments = blends.data(),
                                                           .blendConstants = desc.state.blendConstant};
    constexpr std::array kDynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = 2, .pDynamicStates = kDynamic.data()};
    const vk::Format depthFormat = desc.depthFormat ? vulkanFormat(*desc.depthFormat) : vk::Format::eUndefined;
    const vk::PipelineRenderingCreateInfo rendering{
        .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
        .pColorAttachmentFormats = colors.data(),
        .depthAttachmentFormat = depthFormat,
        .stencilAttachmentFormat = desc.depthFormat && hasStencil(*desc.depthFormat) ? depthFormat : vk::Format::eUndefined,
    };
    return device.createGraphicsPipeline(nullptr, {.pNext = &rendering,
                                                   .stageCount = static_cast<std::uint32_t>(shaders.size()),
                                                   .pStages = shaders.data(),
                                                   .pVertexInputState = &vertexInput,
                                                   .pInputAssemblyState = &assembly,
                                                   .pViewportState = &viewport,
                                                   .pRasterizationState = &raster,
                                                   .pMultisampleState = &multisample,
                                                   .pDepthStencilState = &depth,
                                                   .pColorBlendState = &colorBlend,
                                                   .pDynamicState = &dynamic,
                                                   .layout = *handle.layout});
}

std::unique_ptr<PipelineHandle> newHandle(const std::shared_ptr<DeviceState>& device, const std::string& name) {
    auto handle = std::make_unique<PipelineHandle>();
    handle->device = device;
    handle->name = name;
    return handle;
}

Result<std::unique_ptr<PipelineHandle>> makeGraphics(const std::shared_ptr<DeviceState>& device, const PipelineDesc& desc) {
    if (const auto possible = checkPipeline(*device, desc); !possible) return possible.error();
    auto handle = newHandle(device, desc.name);
    handle->vertexStride = desc.attributes.empty() ? 0 : desc.vertexStride;
    handle->colorFormats = desc.colorFormats;
    handle->depthFormat = desc.depthFormat;
    handle->samples = desc.samples;
    const auto layout = makeLayout(*handle, desc.bindings, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment);
    if (!layout) return layout.error();
    handle->pipeline = makeGraphicsPipeline(*handle, desc);
    return handle;
}

Result<std::unique_ptr<PipelineHandle>> makeCompute(const std::shared_ptr<DeviceState>& device, const ComputePipelineDesc& desc) {
    const auto shader = checkShader(desc.shader.spirv, desc.shader.entry, ShaderStage::Compute, desc.name);
    if (!shader) return shader.error();
    if (const auto capable = checkCapabilities(*device, desc.shader.spirv, desc.name); !capable) return capable.error();
    auto handle = newHandle(device, desc.name);
    handle->compute = true;
    const auto layout = makeLayout(*handle, desc.bindings, vk::ShaderStageFlagBits::eCompute);
    if (!layout) return layout.error();
    const auto module = makeModule(*device, desc.shader.spirv);
    handle->pipeline = device->device.createComputePipeline(
        nullptr, {.stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = desc.shader.entry.c_str()},
                  .layout = *handle->layout});
    return handle;
}

Result<Pipeline> wrap(Result<std::unique_ptr<PipelineHandle>> made) {
    if (!made) return made.error();
    Pipeline pipeline;
    pipeline.state = std::move(*made);
    return pipeline;
}

} // namespace
} // namespace detail

Pipeline::Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;
Pipeline::~Pipeline() = default;

Result<Pipeline> Device::createPipeline(const PipelineDesc& asked) {
    PipelineDesc desc = asked;
    if (desc.depthFormat) desc.depthFormat = state_->realFormat(*desc.depthFormat);
    return detail::guarded(fmt::format("creating pipeline '{}'", desc.name),
                           [&] { return detail::wrap(detail::makeGraphics(state_, desc)); });
}

Result<Pipeline> Device::createPipeline(const ComputePipelineDesc& desc) {
    return detail::guarded(fmt::format("creating pipeline '{}'", desc.name),
                           [&] { return detail::wrap(detail::makeCompute(state_, desc)); });
}

} // namespace tegument::gpu
