// A Vulkan layer that fails on purpose: TEGUMENT_FAULT=KIND:N makes the N-th call of a kind fail, and of "lost" all behind it.
//   memory  vkAllocateMemory: VK_ERROR_OUT_OF_DEVICE_MEMORY
//   host    vkCreateImage, vkCreateBuffer: VK_ERROR_OUT_OF_HOST_MEMORY
//   lost    vkQueueSubmit, vkQueueSubmit2, vkWaitForFences, vkWaitSemaphores: VK_ERROR_DEVICE_LOST
//   barrier vkCmdPipelineBarrier2 changes layouts and waits for nothing; of "barrier:0" every one
//   old     every device offers Vulkan 1.1 only
//   bare    every device is without optional features
//   count   nothing fails
// It counts what lives on the device: tegumentLiveObjects().
//   crash   vkCreateGraphicsPipelines: the process is ended by a signal, as by a driver's own fault

#include "tests/faults/live_objects.h"
#include "tests/gpu/layer_below.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#define EXPORTED extern "C" __attribute__((visibility("default"))) VKAPI_ATTR

namespace {

struct Fault {
    std::string kind;
    int at = 0; // 1: the first call
    std::atomic<int> calls = 0;

    Fault() {
        const char* given = std::getenv("TEGUMENT_FAULT");
        const std::string text = given != nullptr ? given : "";
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos) return;
        kind = text.substr(0, colon);
        at = std::atoi(text.c_str() + colon + 1);
    }

    /// Whether this call of the kind fails.
    bool strikes(std::string_view asked, bool forEver = false) {
        if (kind != asked) return false;
        const int call = ++calls;
        return call == at || (forEver && call > at);
    }
};

Fault& fault() {
    static Fault fault;
    return fault;
}

std::mutex mutex;
tegument::test::LayerBelow next;
PFN_vkGetPhysicalDeviceProperties nextProperties = nullptr; // asked for before the loader puts ours into the instance
PFN_vkGetPhysicalDeviceFeatures2 nextFeatures2 = nullptr;

} // namespace

template <class Function>
Function tegument::test::below(const char* name) {
    return next.ofDevice<Function>(name);
}

namespace {

using tegument::test::below;
using tegument::test::liveObjects;

VkResult counted(VkResult result, int objects = 1) {
    if (result == VK_SUCCESS) liveObjects += objects;
    return result;
}

/// A lost device has no work left: what the driver still does must end before the program takes its memory away.
bool isLost() {
    if (!fault().strikes("lost", true)) return false;
    below<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(next.device);
    return true;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkInstance* instance) {
    const VkResult result = next.createInstance(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
    nextProperties = next.ofInstance<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties");
    nextFeatures2 = next.ofInstance<PFN_vkGetPhysicalDeviceFeatures2>("vkGetPhysicalDeviceFeatures2");
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    return next.createDevice(physical, info, allocator, device);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkDeviceMemory* memory) {
    if (fault().strikes("memory")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return counted(below<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, allocator, memory));
}

VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice device, const VkImageCreateInfo* info, const VkAllocationCallbacks* allocator,
                                           VkImage* image) {
    if (fault().strikes("host")) return VK_ERROR_OUT_OF_HOST_MEMORY;
    return counted(below<PFN_vkCreateImage>("vkCreateImage")(device, info, allocator, image));
}

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks* allocator,
                                            VkBuffer* buffer) {
    if (fault().strikes("host")) return VK_ERROR_OUT_OF_HOST_MEMORY;
    return counted(below<PFN_vkCreateBuffer>("vkCreateBuffer")(device, info, allocator, buffer));
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    if (isLost()) return VK_ERROR_DEVICE_LOST;
    return below<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL submit2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
    if (isLost()) return VK_ERROR_DEVICE_LOST;
    return below<PFN_vkQueueSubmit2>("vkQueueSubmit2")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                             std::uint64_t limit) {
    if (isLost()) return VK_ERROR_DEVICE_LOST;
    return below<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, limit);
}

VKAPI_ATTR VkResult VKAPI_CALL waitSemaphores(VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t limit) {
    if (isLost()) return VK_ERROR_DEVICE_LOST;
    return below<PFN_vkWaitSemaphores>("vkWaitSemaphores")(device, info, limit);
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                               const VkGraphicsPipelineCreateInfo* infos, const VkAllocationCallbacks* allocator,
                                               VkPipeline* pipelines) {
    if (fault().strikes("crash")) {
        std::signal(SIGSEGV, SIG_DFL);
        ::kill(::getpid(), SIGSEGV);
    }
    const auto create = below<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines");
    return counted(create(device, cache, count, infos, allocator, pipelines), static_cast<int>(count));
}

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines) {
    const auto create = below<PFN_vkCreateComputePipelines>("vkCreateComputePipelines");
    return counted(create(device, cache, count, infos, allocator, pipelines), static_cast<int>(count));
}

void waitForNothing(auto& barrier) {
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_NONE;
    barrier.srcAccessMask = barrier.dstAccessMask = VK_ACCESS_2_NONE;
}

/// Synchronization validation below has to find what it leaves unordered.
VKAPI_ATTR void VKAPI_CALL pipelineBarrier(VkCommandBuffer commands, const VkDependencyInfo* info) {
    const auto record = below<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2");
    if (!fault().strikes("barrier") && !(fault().kind == "barrier" && fault().at == 0)) return record(commands, info);
    std::vector<VkImageMemoryBarrier2> images(info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
    std::ranges::for_each(images, [](auto& barrier) { waitForNothing(barrier); });
    const VkDependencyInfo layouts{.sType = info->sType,
                                   .pNext = nullptr,
                                   .dependencyFlags = info->dependencyFlags,
                                   .memoryBarrierCount = 0,
                                   .pMemoryBarriers = nullptr,
                                   .bufferMemoryBarrierCount = 0,
                                   .pBufferMemoryBarriers = nullptr,
                                   .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
                                   .pImageMemoryBarriers = images.data()};
    record(commands, &layouts);
}

/// Not counted: every call answers so.
bool pretends(std::string_view kind) {
    return fault().kind == kind;
}

VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* into) {
    nextProperties(physical, into);
    if (pretends("old")) into->apiVersion = VK_API_VERSION_1_1;
}

VKAPI_ATTR void VKAPI_CALL features2(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* into) {
    nextFeatures2(physical, into);
    if (!pretends("bare")) return;
    into->features = {};
    for (auto* more = static_cast<VkBaseOutStructure*>(into->pNext); more != nullptr; more = more->pNext) {
        if (more->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES)
            reinterpret_cast<VkPhysicalDeviceVulkan11Features*>(more)->shaderDrawParameters = VK_FALSE;
        if (more->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(more)->samplerMirrorClampToEdge = VK_FALSE;
    }
}

PFN_vkVoidFunction ours(std::string_view name) {
    static const std::map<std::string_view, PFN_vkVoidFunction> kOurs = {
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(createInstance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(createDevice)},
        {"vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(properties)},
        {"vkGetPhysicalDeviceFeatures2", reinterpret_cast<PFN_vkVoidFunction>(features2)},
        {"vkGetPhysicalDeviceFeatures2KHR", reinterpret_cast<PFN_vkVoidFunction>(features2)},
        {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(allocateMemory)},
        {"vkCreateImage", reinterpret_cast<PFN_vkVoidFunction>(createImage)},
        {"vkCreateBuffer", reinterpret_cast<PFN_vkVoidFunction>(createBuffer)},
        {"vkQueueSubmit", reinterpret_cast<PFN_vkVoidFunction>(submit)},
        {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(submit2)},
        {"vkWaitForFences", reinterpret_cast<PFN_vkVoidFunction>(waitForFences)},
        {"vkWaitSemaphores", reinterpret_cast<PFN_vkVoidFunction>(waitSemaphores)},
        {"vkCmdPipelineBarrier2", reinterpret_cast<PFN_vkVoidFunction>(pipelineBarrier)},
        {"vkCreateGraphicsPipelines", reinterpret_cast<PFN_vkVoidFunction>(createPipelines)},
        {"vkCreateComputePipelines", reinterpret_cast<PFN_vkVoidFunction>(createComputePipelines)},
    };
    static const tegument::test::Functions kCounted = tegument::test::countedFunctions();
    if (const auto found = kOurs.find(name); found != kOurs.end()) return found->second;
    const auto found = kCounted.find(name);
    return found == kCounted.end() ? nullptr : found->second;
}

} // namespace

EXPORTED PFN_vkVoidFunction VKAPI_CALL faultDeviceProcAddr(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(faultDeviceProcAddr);
    const std::scoped_lock lock(mutex);
    if (const auto own = ours(name)) return own;
    return next.deviceProc(device, name);
}

EXPORTED PFN_vkVoidFunction VKAPI_CALL faultInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(faultInstanceProcAddr);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(faultDeviceProcAddr);
    const std::scoped_lock lock(mutex);
    if (const auto own = ours(name)) return own;
    return next.instanceProc != nullptr ? next.instanceProc(instance, name) : nullptr;
}

/// How many objects of the device live.
EXPORTED std::int64_t VKAPI_CALL tegumentLiveObjects() {
    return liveObjects;
}

EXPORTED VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
    versions->loaderLayerInterfaceVersion = 2;
    versions->pfnGetInstanceProcAddr = faultInstanceProcAddr;
    versions->pfnGetDeviceProcAddr = faultDeviceProcAddr;
    versions->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
