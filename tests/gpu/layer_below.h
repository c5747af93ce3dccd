#pragma once
// What a Vulkan layer of ours calls. One instance and one device are enough for the programs under test; further ones share the driver's
// functions.

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace tegument::test {

struct LayerBelow {
    PFN_vkGetInstanceProcAddr instanceProc = nullptr;
    PFN_vkGetDeviceProcAddr deviceProc = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;

    template <class Function>
    Function ofInstance(const char* name) const {
        return reinterpret_cast<Function>(instanceProc(instance, name));
    }

    template <class Function>
    Function ofDevice(const char* name) const {
        return reinterpret_cast<Function>(deviceProc(device, name));
    }

    VkResult createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator, VkInstance* made) {
        auto* link = linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
        if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
        instanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
        link->u.pLayerInfo = link->u.pLayerInfo->pNext;
        const auto create = reinterpret_cast<PFN_vkCreateInstance>(instanceProc(VK_NULL_HANDLE, "vkCreateInstance"));
        const VkResult result = create(info, allocator, made);
        if (result == VK_SUCCESS) instance = *made;
        return result;
    }

    VkResult createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info, const VkAllocationCallbacks* allocator,
                          VkDevice* made) {
        auto* link = linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
        if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
        deviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
        link->u.pLayerInfo = link->u.pLayerInfo->pNext;
        const VkResult result = ofInstance<PFN_vkCreateDevice>("vkCreateDevice")(physical, info, allocator, made);
        if (result == VK_SUCCESS) device = *made;
        return result;
    }

private:
    /// The loader's link for this layer, in the chain behind a create info.
    template <class Link>
    static Link* linkOf(const void* chain, VkStructureType type) {
        auto* link = static_cast<Link*>(const_cast<void*>(chain));
        while (link != nullptr && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
            link = static_cast<Link*>(const_cast<void*>(link->pNext));
        return link;
    }
};

} // namespace tegument::test
