#include "host/gpu/pipeline_check.h"

#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/spirv.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tegument::gpu::detail {

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

} // namespace

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

} // namespace tegument::gpu::detail
