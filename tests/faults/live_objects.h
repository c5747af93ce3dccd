#pragma once
// How many objects of a Vulkan device live: what the layer's functions that make and destroy them count.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

namespace tegument::test {

inline std::atomic<std::int64_t> liveObjects = 0;

template <class Function>
Function below(const char* name);

/// The name of a function as a template's argument.
template <std::size_t kLength>
struct Name {
    char text[kLength] = {};
    // NOLINTNEXTLINE(google-explicit-constructor)
    constexpr Name(const char (&from)[kLength]) { std::copy_n(from, kLength, text); }
};

template <Name kName, class Info, class Handle>
VKAPI_ATTR VkResult VKAPI_CALL made(VkDevice device, const Info* info, const VkAllocationCallbacks* allocator, Handle* handle) {
    using Function = VkResult(VKAPI_PTR*)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*);
    const VkResult result = below<Function>(kName.text)(device, info, allocator, handle);
    if (result == VK_SUCCESS) ++liveObjects;
    return result;
}

template <Name kName, class Handle>
VKAPI_ATTR void VKAPI_CALL destroyed(VkDevice device, Handle handle, const VkAllocationCallbacks* allocator) {
    using Function = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);
    if (handle != VK_NULL_HANDLE) --liveObjects;
    below<Function>(kName.text)(device, handle, allocator);
}

using Functions = std::map<std::string_view, PFN_vkVoidFunction>;

template <Name kCreate, Name kDestroy, class Info, class Handle>
void addKind(Functions& functions) {
    functions[kCreate.text] = reinterpret_cast<PFN_vkVoidFunction>(made<kCreate, Info, Handle>);
    functions[kDestroy.text] = reinterpret_cast<PFN_vkVoidFunction>(destroyed<kDestroy, Handle>);
}

/// Without those of which the layer fails some: memory, images, buffers, graphics pipelines; it counts what it lets through.
inline Functions countedFunctions() {
    Functions functions;
    addKind<"vkCreateImageView", "vkDestroyImageView", VkImageViewCreateInfo, VkImageView>(functions);
    addKind<"vkCreateSampler", "vkDestroySampler", VkSamplerCreateInfo, VkSampler>(functions);
    addKind<"vkCreateShaderModule", "vkDestroyShaderModule", VkShaderModuleCreateInfo, VkShaderModule>(functions);
    addKind<"vkCreatePipelineLayout", "vkDestroyPipelineLayout", VkPipelineLayoutCreateInfo, VkPipelineLayout>(functions);
    addKind<"vkCreateDescriptorSetLayout", "vkDestroyDescriptorSetLayout", VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout>(
        functions);
    addKind<"vkCreateDescriptorPool", "vkDestroyDescriptorPool", VkDescriptorPoolCreateInfo, VkDescriptorPool>(functions);
    addKind<"vkCreateCommandPool", "vkDestroyCommandPool", VkCommandPoolCreateInfo, VkCommandPool>(functions);
    addKind<"vkCreateFence", "vkDestroyFence", VkFenceCreateInfo, VkFence>(functions);
    addKind<"vkCreateSemaphore", "vkDestroySemaphore", VkSemaphoreCreateInfo, VkSemaphore>(functions);
    addKind<"vkCreateQueryPool", "vkDestroyQueryPool", VkQueryPoolCreateInfo, VkQueryPool>(functions);
    functions["vkDestroyImage"] = reinterpret_cast<PFN_vkVoidFunction>(destroyed<"vkDestroyImage", VkImage>);
    functions["vkDestroyBuffer"] = reinterpret_cast<PFN_vkVoidFunction>(destroyed<"vkDestroyBuffer", VkBuffer>);
    functions["vkDestroyPipeline"] = reinterpret_cast<PFN_vkVoidFunction>(destroyed<"vkDestroyPipeline", VkPipeline>);
    functions["vkFreeMemory"] = reinterpret_cast<PFN_vkVoidFunction>(destroyed<"vkFreeMemory", VkDeviceMemory>);
    return functions;
}

} // namespace tegument::test
