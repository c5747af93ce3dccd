#include "host/gpu/error.h"
#include "host/gpu/format.h"
#include "host/gpu/instance.h"

#include <algorithm>

namespace tegument::gpu::detail {

namespace {

using FeatureChain = vk::StructureChain<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features, vk::PhysicalDeviceVulkan12Features,
                                        vk::PhysicalDeviceVulkan13Features, vk::PhysicalDeviceCustomBorderColorFeaturesEXT>;

FeatureChain presentFeatures(const vk::raii::PhysicalDevice& device) {
    return device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features, vk::PhysicalDeviceVulkan12Features,
                               vk::PhysicalDeviceVulkan13Features, vk::PhysicalDeviceCustomBorderColorFeaturesEXT>();
}

/// Of what is present, only what this library and HLSL's usual capabilities use.
FeatureChain wantedFeatures(const FeatureChain& present) {
    FeatureChain wanted;
    const vk::PhysicalDeviceFeatures& has = present.get<vk::PhysicalDeviceFeatures2>().features;
    wanted.get<vk::PhysicalDeviceFeatures2>().features = vk::PhysicalDeviceFeatures{
        .robustBufferAccess = has.robustBufferAccess, // indices beyond the vertices read zeros instead of ending the process
        .independentBlend = has.independentBlend,
        .geometryShader = has.geometryShader, // SV_PrimitiveID in pixel shaders asks for it
        .dualSrcBlend = has.dualSrcBlend,
        .depthClamp = has.depthClamp,
        .fillModeNonSolid = has.fillModeNonSolid,
        .samplerAnisotropy = has.samplerAnisotropy,
        .fragmentStoresAndAtomics = has.fragmentStoresAndAtomics, // pixel shaders that count what they fetch (lab/bench/count.h)
        .shaderImageGatherExtended = has.shaderImageGatherExtended,
        .shaderStorageImageReadWithoutFormat = has.shaderStorageImageReadWithoutFormat,
        .shaderStorageImageWriteWithoutFormat = has.shaderStorageImageWriteWithoutFormat,
        .shaderClipDistance = has.shaderClipDistance,
        .shaderCullDistance = has.shaderCullDistance,
    };
    wanted.get<vk::PhysicalDeviceVulkan11Features>().shaderDrawParameters =
        present.get<vk::PhysicalDeviceVulkan11Features>().shaderDrawParameters;
    wanted.get<vk::PhysicalDeviceVulkan12Features>().samplerMirrorClampToEdge =
        present.get<vk::PhysicalDeviceVulkan12Features>().samplerMirrorClampToEdge;
    auto& vulkan13 = wanted.get<vk::PhysicalDeviceVulkan13Features>(); // these three are part of every Vulkan 1.3
    vulkan13.synchronization2 = true;
    vulkan13.dynamicRendering = true;
    vulkan13.maintenance4 = true; // a pixel shader may read fewer components than the vertex shader writes; every 1.3 device has it
    vulkan13.shaderDemoteToHelperInvocation = present.get<vk::PhysicalDeviceVulkan13Features>().shaderDemoteToHelperInvocation;
    const auto& border = present.get<vk::PhysicalDeviceCustomBorderColorFeaturesEXT>();
    auto& wantedBorder = wanted.get<vk::PhysicalDeviceCustomBorderColorFeaturesEXT>();
    wantedBorder.customBorderColors = border.customBorderColors && border.customBorderColorWithoutFormat;
    wantedBorder.customBorderColorWithoutFormat = wantedBorder.customBorderColors;
    return wanted;
}

/// Of SPIR-V's capabilities those that HLSL asks for and that this device does not offer; the numbers are the specification's.
std::vector<std::uint32_t> lackingCapabilities(const FeatureChain& enabled) {
    const vk::PhysicalDeviceFeatures& core = enabled.get<vk::PhysicalDeviceFeatures2>().features;
    const std::pair<std::uint32_t, vk::Bool32> all[] = {
        {2, core.geometryShader},
        {25, core.shaderImageGatherExtended},
        {32, core.shaderClipDistance},
        {33, core.shaderCullDistance},
        {55, core.shaderStorageImageReadWithoutFormat},
        {56, core.shaderStorageImageWriteWithoutFormat},
        {4427, enabled.get<vk::PhysicalDeviceVulkan11Features>().shaderDrawParameters},
        {5379, enabled.get<vk::PhysicalDeviceVulkan13Features>().shaderDemoteToHelperInvocation},
    };
    std::vector<std::uint32_t> lacking;
    for (const auto& [capability, offered] : all)
        if (offered != VK_TRUE) lacking.push_back(capability);
    return lacking;
}

Features summary(const FeatureChain& enabled) {
    const vk::PhysicalDeviceFeatures& core = enabled.get<vk::PhysicalDeviceFeatures2>().features;
    return {
        .wireframe = core.fillModeNonSolid == VK_TRUE,
        .depthClamp = core.depthClamp == VK_TRUE,
        .dualSourceBlend = core.dualSrcBlend == VK_TRUE,
        .independentBlend = core.independentBlend == VK_TRUE,
        .anisotropy = core.samplerAnisotropy == VK_TRUE,
        .mirrorOnce = enabled.get<vk::PhysicalDeviceVulkan12Features>().samplerMirrorClampToEdge == VK_TRUE,
        .customBorderColor = enabled.get<vk::PhysicalDeviceCustomBorderColorFeaturesEXT>().customBorderColors == VK_TRUE,
    };
}

/// Vulkan guarantees at least one of D24S8 and D32FS8 as a depth target.
Format packedDepthStencil(const vk::raii::PhysicalDevice& device) {
    const vk::FormatProperties properties = device.getFormatProperties(vulkanFormat(Format::D24S8));
    const bool supported = static_cast<bool>(properties.optimalTilingFeatures & vk::FormatFeatureFlagBits::eDepthStencilAttachment);
    return supported ? Format::D24S8 : Format::D32FS8;
}

} // namespace

bool hasExtension(const vk::raii::PhysicalDevice& device, std::string_view name) {
    return std::ranges::any_of(device.enumerateDeviceExtensionProperties(), [name](const vk::ExtensionProperties& extension) {
        return std::string_view(extension.extensionName) == name;
    });
}

Result<void> makeLogicalDevice(DeviceState& state) {
    const bool borderExtension = hasExtension(state.physical, VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME);
    FeatureChain features = wantedFeatures(presentFeatures(state.physical));
    std::vector<const char*> extensions;
    if (*state.surface) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (borderExtension)
        extensions.push_back(VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME);
    else
        features.unlink<vk::PhysicalDeviceCustomBorderColorFeaturesEXT>();
    constexpr float kPriority = 1.0f;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = state.queueFamily, .queueCount = 1, .pQueuePriorities = &kPriority};
    state.device = state.physical.createDevice({
        .pNext = &features.get<vk::PhysicalDeviceFeatures2>(),
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data(),
    });
    state.queue = state.device.getQueue(state.queueFamily, 0);
    state.commandPool = state.device.createCommandPool(
        {.flags = vk::CommandPoolCreateFlagBits::eTransient | vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
         .queueFamilyIndex = state.queueFamily});
    state.features = summary(features);
    state.lacking = lackingCapabilities(features);
    state.packedDepthStencil = packedDepthStencil(state.physical);
    return {};
}

} // namespace tegument::gpu::detail
