#include "host/gpu/instance.h"

#include "host/gpu/error.h"

#include <algorithm>
#include <stdexcept>

namespace tegument::gpu::detail {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoDeviceHint = "install a Vulkan driver; the Debian package mesa-vulkan-drivers has one that runs on the CPU";

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto* log = static_cast<MessageLog*>(user);
    const std::scoped_lock lock(log->mutex);
    log->messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

/// Validation messages only: the type General carries the loader's remarks on drivers that it passes over, and Performance carries
/// remarks that Direct3D effects cause rightly, such as a vertex shader output that the pixel shader does not read.
vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(MessageLog& log) {
    return {
        .messageSeverity = vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning | vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
        .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation,
        .pfnUserCallback = collect,
        .pUserData = &log,
    };
}

bool hasValidationLayer(const vk::raii::Context& context) {
    return std::ranges::any_of(context.enumerateInstanceLayerProperties(),
                               [](const vk::LayerProperties& layer) { return std::string_view(layer.layerName) == kValidationLayer; });
}

constexpr vk::ApplicationInfo kApplication{.pApplicationName = "tegument", .pEngineName = "tegument", .apiVersion = VK_API_VERSION_1_3};

vk::raii::Instance makePlainInstance(const vk::raii::Context& context) {
    return vk::raii::Instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &kApplication});
}

vk::raii::Instance makeValidatedInstance(const vk::raii::Context& context, MessageLog& log) {
    constexpr std::array kExtensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    constexpr vk::ValidationFeatureEnableEXT kSynchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::DebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(log); // hears of the instance's own creation and destruction
    const vk::ValidationFeaturesEXT features{
        .pNext = &messenger, .enabledValidationFeatureCount = 1, .pEnabledValidationFeatures = &kSynchronization};
    return vk::raii::Instance(context, vk::InstanceCreateInfo{
                                           .pNext = &features,
                                           .pApplicationInfo = &kApplication,
                                           .enabledLayerCount = 1,
                                           .ppEnabledLayerNames = &kValidationLayer,
                                           .enabledExtensionCount = static_cast<std::uint32_t>(kExtensions.size()),
                                           .ppEnabledExtensionNames = kExtensions.data(),
                                       });
}

/// The loader is opened by DeviceState's first member.
Result<std::shared_ptr<DeviceState>> openLoader() {
    try {
        return std::make_shared<DeviceState>();
    } catch (const std::runtime_error&) {
        return machineError(6001, "the Vulkan loader libvulkan.so.1 is not installed", "install the Debian package libvulkan1");
    }
}

} // namespace

Result<std::shared_ptr<DeviceState>> makeInstance(const DeviceOptions& options) {
    Result<std::shared_ptr<DeviceState>> opened = openLoader();
    if (!opened) return opened;
    DeviceState& state = **opened;
    try {
        if (!options.validation) {
            state.instance = makePlainInstance(state.context);
            return opened;
        }
        if (!hasValidationLayer(state.context))
            return machineError(6003, std::string("the Vulkan validation layer ") + kValidationLayer + " is not installed",
                                "install the Debian package vulkan-validationlayers, or run without validation");
        state.instance = makeValidatedInstance(state.context, *state.log);
        state.messenger = state.instance.createDebugUtilsMessengerEXT(messengerInfo(*state.log));
        return opened;
    } catch (const vk::IncompatibleDriverError&) {
        return machineError(6002, "no Vulkan device: no driver was found", kNoDeviceHint);
    }
}

} // namespace tegument::gpu::detail
