// A Vulkan layer for Wine's Direct3D 12 on lavapipe. Wine 8 (vkd3d 1.6) binds descriptor tables only where the device lists
// VK_EXT_descriptor_indexing, also in its mode VKD3D_CONFIG=virtual_heaps, which uses nothing of that extension. lavapipe of Mesa 22.3 does
// not list it. This layer does, and takes the name away again when the device is made; every feature of it stays off.

#include "tests/gpu/layer_below.h"

#include <cstdint>
#include <cstring>
#include <mutex>
#include <vector>

#define LAYER_EXPORTED extern "C" __attribute__((visibility("default"))) VKAPI_ATTR

namespace {

std::mutex listedMutex;
tegument::test::LayerBelow listedBelow;
PFN_vkEnumerateDeviceExtensionProperties belowExtensions = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL makeInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                            VkInstance* instance) {
    const VkResult result = listedBelow.createInstance(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
    belowExtensions = listedBelow.ofInstance<PFN_vkEnumerateDeviceExtensionProperties>("vkEnumerateDeviceExtensionProperties");
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL listExtensions(VkPhysicalDevice physical, const char* layer, std::uint32_t* count,
                                              VkExtensionProperties* into) {
    if (layer != nullptr && std::strcmp(layer, "VK_LAYER_TEGUMENT_listed") == 0) {
        *count = 0;
        return VK_SUCCESS;
    }
    std::uint32_t own = 0;
    if (const VkResult counted = belowExtensions(physical, layer, &own, nullptr); counted != VK_SUCCESS) return counted;
    std::vector<VkExtensionProperties> all(own + 1);
    if (const VkResult listed = belowExtensions(physical, layer, &own, all.data()); listed != VK_SUCCESS) return listed;
    std::strcpy(all[own].extensionName, VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME);
    all[own].specVersion = VK_EXT_DESCRIPTOR_INDEXING_SPEC_VERSION;
    const auto many = static_cast<std::uint32_t>(all.size());
    const std::uint32_t given = into == nullptr || *count > many ? many : *count;
    if (into != nullptr) std::memcpy(into, all.data(), given * sizeof(VkExtensionProperties));
    *count = given;
    return given < many ? VK_INCOMPLETE : VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL makeDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                          VkDevice* device) {
    std::vector<const char*> extensions;
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i)
        if (std::strcmp(info->ppEnabledExtensionNames[i], VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME) != 0)
            extensions.push_back(info->ppEnabledExtensionNames[i]);
    VkDeviceCreateInfo without = *info;
    without.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    without.ppEnabledExtensionNames = extensions.data();
    return listedBelow.createDevice(physical, &without, allocator, device);
}

} // namespace

LAYER_EXPORTED PFN_vkVoidFunction VKAPI_CALL listedDeviceProcAddr(VkDevice device, const char* name) {
    const std::scoped_lock lock(listedMutex);
    return std::strcmp(name, "vkGetDeviceProcAddr") == 0 ? reinterpret_cast<PFN_vkVoidFunction>(listedDeviceProcAddr)
                                                         : listedBelow.deviceProc(device, name);
}

LAYER_EXPORTED PFN_vkVoidFunction VKAPI_CALL listedInstanceProcAddr(VkInstance instance, const char* name) {
    const std::pair<const char*, PFN_vkVoidFunction> own[] = {
        {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(listedInstanceProcAddr)},
        {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(listedDeviceProcAddr)},
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(makeInstance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(makeDevice)},
        {"vkEnumerateDeviceExtensionProperties", reinterpret_cast<PFN_vkVoidFunction>(listExtensions)}};
    for (const auto& [known, function] : own)
        if (std::strcmp(name, known) == 0) return function;
    return listedBelow.instanceProc != nullptr ? listedBelow.instanceProc(instance, name) : nullptr;
}

LAYER_EXPORTED VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
    versions->loaderLayerInterfaceVersion = 2;
    versions->pfnGetInstanceProcAddr = listedInstanceProcAddr;
    versions->pfnGetDeviceProcAddr = listedDeviceProcAddr;
    versions->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
