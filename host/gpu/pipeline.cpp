// Pipelines: Direct3D's states in Vulkan's words.

#include "host/gpu/device_state.h"
#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/pipeline_check.h"
#include "host/gpu/pipeline_layout.h"
#include "host/gpu/spirv.h"

#include <fmt/format.h>

namespace tegument::gpu {

namespace detail {

namespace {

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
