#include "host/gpu/instance.h"

#include "host/gpu/advice.h"
#include "host/gpu/error.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace tegument::gpu::detail {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

/// Takes the types of C in Vulkan-Hpp 1.3, those of C++ in 1.4.
template <class Severity, class Types, class Data>
VKAPI_ATTR vk::Bool32 VKAPI_CALL collect(Severity, Types, const Data* data, void* user) {
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

vk::raii::Instance makePlainInstance(const vk::raii::Context& context, const std::vector<const char*>& extensions) {
    return vk::raii::Instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &kApplication,
                                                              .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                              .ppEnabledExtensionNames = extensions.data()});
}

vk::raii::Instance makeValidatedInstance(const vk::raii::Context& context, std::vector<const char*> extensions, MessageLog& log) {
    extensions.insert(extensions.end(), {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME});
    constexpr vk::ValidationFeatureEnableEXT kSynchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::DebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(log); // hears of the instance's own creation and destruction
    const vk::ValidationFeaturesEXT features{
        .pNext = &messenger, .enabledValidationFeatureCount = 1, .pEnabledValidationFeatures = &kSynchronization};
    return vk::raii::Instance(context, vk::InstanceCreateInfo{
                                           .pNext = &features,
                                           .pApplicationInfo = &kApplication,
                                           .enabledLayerCount = 1,
                                           .ppEnabledLayerNames = &kValidationLayer,
                                           .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                           .ppEnabledExtensionNames = extensions.data(),
                                       });
}

/// The loader is opened by DeviceState's first member.
Result<std::shared_ptr<DeviceState>> openLoader() {
    try {
        return std::make_shared<DeviceState>();
    } catch (const std::runtime_error&) {
        return machineError(6001, std::string("the Vulkan loader ") + advice().loader + " is not installed", advice().toGetLoader);
    }
}

/// From a process's second device on an instance stays that nobody uses, and with it the driver's library. NVIDIA's (580.159) could be
/// opened some 32 times by a process and then no more: each time it takes of the room that the C library has for variables of threads.
void keepDriver() {
    struct Kept {
        vk::raii::Context context;
        vk::raii::Instance instance = makePlainInstance(context, {});
    };
    static std::mutex mutex;
    static bool isFirst = true;
    static const Kept* kept = nullptr; // never destroyed: when a process ends, drivers are gone before static objects are
    const std::scoped_lock lock(mutex);
    if (!std::exchange(isFirst, false) && kept == nullptr) kept = new Kept;
}

std::vector<const char*> windowExtensions(const DeviceOptions& options) {
    std::vector<const char*> names;
    if (options.window)
        for (const std::string& name : options.window->instanceExtensions)
            names.push_back(name.c_str());
    return names;
}

Result<void> createInstance(DeviceState& state, const DeviceOptions& options) {
    if (!options.validation) {
        state.instance = makePlainInstance(state.context, windowExtensions(options));
        return {};
    }
    if (!hasValidationLayer(state.context))
        return machineError(6003, std::string("the Vulkan validation layer ") + kValidationLayer + " is not installed",
                            "install the Debian package vulkan-validationlayers, or run without validation");
    state.instance = makeValidatedInstance(state.context, windowExtensions(options), *state.log);
    state.messenger = state.instance.createDebugUtilsMessengerEXT(messengerInfo(*state.log));
    return {};
}

Result<void> createSurface(DeviceState& state, const WindowSurface& window) {
    const auto surface = window.create(static_cast<VkInstance>(*state.instance));
    if (!surface) return surface.error();
    // A pointer or a 64-bit number, as the platform has it; a C cast serves both.
    state.surface = vk::raii::SurfaceKHR(state.instance, (VkSurfaceKHR)*surface); // NOLINT(performance-no-int-to-ptr)
    return {};
}

} // namespace

Result<std::shared_ptr<DeviceState>> makeInstance(const DeviceOptions& options) {
    Result<std::shared_ptr<DeviceState>> opened = openLoader();
    if (!opened) return opened;
    try {
        keepDriver();
        if (const auto created = createInstance(**opened, options); !created) return created.error();
        if (options.window)
            if (const auto created = createSurface(**opened, *options.window); !created) return created.error();
        return opened;
    } catch (const vk::IncompatibleDriverError&) {
        return machineError(6002, "no Vulkan device: no driver was found", advice().toGetDriver);
    } catch (const vk::InitializationFailedError&) {
        return machineError(6002, "no Vulkan device: its driver cannot be started", advice().toGetDriver);
    }
}

} // namespace tegument::gpu::detail
