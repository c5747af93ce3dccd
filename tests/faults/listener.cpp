// A Vulkan layer that listens: what the validation layer says to any process, whether the program asks for validation or not, goes into the
// file TEGUMENT_HEARD, one line each, and with it what there was to judge: devices made, and work given to them. Without that a 0 would
// mean nothing. It is an implicit layer, and so above all others. tests/tools/listened.py reads the file.

#include "tests/gpu/layer_below.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#define LISTENER_EXPORTED extern "C" __attribute__((visibility("default"))) VKAPI_ATTR

namespace {

std::recursive_mutex heardMutex;
tegument::test::LayerBelow heardBelow;
std::map<VkInstance, VkDebugUtilsMessengerEXT> ears;
// The layers below serve every instance and device by the same functions; an instance or a device that they were asked of may be gone.
PFN_vkGetPhysicalDeviceProperties belowProperties = nullptr;
PFN_vkQueueSubmit belowSubmit = nullptr;
PFN_vkQueueSubmit2 belowSubmit2 = nullptr;
PFN_vkCmdPipelineBarrier2 belowBarrier = nullptr;
std::atomic<std::int64_t> submissions = 0;
std::atomic<std::int64_t> barriers = 0;

std::string onOneLine(std::string text) {
    for (char& character : text)
        if (character == '\n' || character == '\r' || character == '\t' || character == '\0') character = ' ';
    return text;
}

std::string commandLine() {
    std::ifstream in("/proc/self/cmdline", std::ios::binary);
    return onOneLine({std::istreambuf_iterator<char>(in), {}});
}

/// One write, so that the lines of many processes do not mix.
void note(const std::string& kind, const std::string& text) {
    const char* file = std::getenv("TEGUMENT_HEARD");
    if (file == nullptr) return;
    const int descriptor = ::open(file, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) return;
    const std::string line = kind + "\t" + std::to_string(::getpid()) + "\t" + commandLine() + "\t" + onOneLine(text) + "\n";
    [[maybe_unused]] const ssize_t written = ::write(descriptor, line.data(), line.size());
    ::close(descriptor);
}

/// How many submissions and barriers the process made; nothing of one that is killed.
struct NotedAtExit {
    ~NotedAtExit() {
        if (submissions > 0) note("work", std::to_string(submissions) + " " + std::to_string(barriers));
    }
};
const NotedAtExit notedAtExit;

VKAPI_ATTR VkBool32 VKAPI_CALL hear(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    const std::string name = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
    note("message", name + ": " + (data->pMessage != nullptr ? data->pMessage : ""));
    return VK_FALSE;
}

/// As host/gpu asks for them.
VkDebugUtilsMessengerCreateInfoEXT wanted() {
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .pNext = nullptr,
            .flags = 0,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
            .pfnUserCallback = hear,
            .pUserData = nullptr};
}

std::vector<const char*> withDebugUtils(const VkInstanceCreateInfo& info) {
    std::vector<const char*> names(info.ppEnabledExtensionNames, info.ppEnabledExtensionNames + info.enabledExtensionCount);
    for (const char* name : names)
        if (std::string_view(name) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME) return names;
    names.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    return names;
}

VKAPI_ATTR VkResult VKAPI_CALL listenToInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                                VkInstance* instance) {
    const std::scoped_lock lock(heardMutex);
    const std::vector<const char*> names = withDebugUtils(*info);
    VkInstanceCreateInfo heard = *info;
    heard.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
    heard.ppEnabledExtensionNames = names.data();
    const VkResult result = heardBelow.createInstance(&heard, allocator, instance);
    if (result != VK_SUCCESS) return result;
    belowProperties = heardBelow.ofInstance<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties");
    const auto create = heardBelow.ofInstance<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT");
    const VkDebugUtilsMessengerCreateInfoEXT messenger = wanted();
    if (create == nullptr || create(*instance, &messenger, nullptr, &ears[*instance]) != VK_SUCCESS) note("deaf", "no messenger");
    return result;
}

VKAPI_ATTR void VKAPI_CALL leaveInstance(VkInstance instance, const VkAllocationCallbacks* allocator) {
    if (instance == VK_NULL_HANDLE) return;
    const auto proc = [&](const char* name) { return heardBelow.instanceProc(instance, name); };
    VkDebugUtilsMessengerEXT ear = VK_NULL_HANDLE;
    {
        const std::scoped_lock lock(heardMutex);
        ear = ears[instance];
        ears.erase(instance);
    }
    const auto destroyEar = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(proc("vkDestroyDebugUtilsMessengerEXT"));
    const auto destroy = reinterpret_cast<PFN_vkDestroyInstance>(proc("vkDestroyInstance"));
    if (destroyEar != nullptr && ear != VK_NULL_HANDLE) destroyEar(instance, ear, nullptr);
    destroy(instance, allocator);
}

/// Whether the validation layer is in this process, by its library.
bool isValidated() {
    void* library = ::dlopen("libVkLayer_khronos_validation.so", RTLD_NOW | RTLD_NOLOAD);
    if (library != nullptr) ::dlclose(library);
    if (library != nullptr) return true;
    std::ifstream maps("/proc/self/maps"); // a library opened by its path
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    return text.find("libVkLayer_khronos_validation.so") != std::string::npos;
}

VKAPI_ATTR VkResult VKAPI_CALL listenToDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDevice* device) {
    const std::scoped_lock lock(heardMutex);
    const VkResult result = heardBelow.createDevice(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    belowSubmit = heardBelow.ofDevice<PFN_vkQueueSubmit>("vkQueueSubmit");
    belowSubmit2 = heardBelow.ofDevice<PFN_vkQueueSubmit2>("vkQueueSubmit2");
    belowBarrier = heardBelow.ofDevice<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2");
    VkPhysicalDeviceProperties properties{};
    belowProperties(physical, &properties);
    note(isValidated() ? "device" : "unseen", properties.deviceName);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL countSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    ++submissions;
    return belowSubmit(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL countSubmit2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
    ++submissions;
    return belowSubmit2(queue, count, infos, fence);
}

VKAPI_ATTR void VKAPI_CALL countBarrier(VkCommandBuffer commands, const VkDependencyInfo* info) {
    ++barriers;
    belowBarrier(commands, info);
}

PFN_vkVoidFunction listening(std::string_view name) {
    static const std::map<std::string_view, PFN_vkVoidFunction> kListening = {
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(listenToInstance)},
        {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(leaveInstance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(listenToDevice)},
        {"vkCmdPipelineBarrier2", reinterpret_cast<PFN_vkVoidFunction>(countBarrier)},
        {"vkQueueSubmit", reinterpret_cast<PFN_vkVoidFunction>(countSubmit)},
        {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(countSubmit2)},
    };
    const auto found = kListening.find(name);
    return found == kListening.end() ? nullptr : found->second;
}

} // namespace

LISTENER_EXPORTED PFN_vkVoidFunction VKAPI_CALL listenerDeviceProcAddr(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(listenerDeviceProcAddr);
    if (const auto own = listening(name)) return own;
    return heardBelow.deviceProc(device, name);
}

LISTENER_EXPORTED PFN_vkVoidFunction VKAPI_CALL listenerInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(listenerInstanceProcAddr);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(listenerDeviceProcAddr);
    if (const auto own = listening(name)) return own;
    return heardBelow.instanceProc != nullptr ? heardBelow.instanceProc(instance, name) : nullptr;
}

LISTENER_EXPORTED VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
    versions->loaderLayerInterfaceVersion = 2;
    versions->pfnGetInstanceProcAddr = listenerInstanceProcAddr;
    versions->pfnGetDeviceProcAddr = listenerDeviceProcAddr;
    versions->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
