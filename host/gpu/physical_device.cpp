#include "host/gpu/advice.h"
#include "host/gpu/error.h"
#include "host/gpu/instance.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <utility>

namespace tegument::gpu::detail {

namespace {

struct Candidate {
    vk::raii::PhysicalDevice device{nullptr};
    std::string name;
    int rank = 0;
    std::string unfit; // why it cannot be used; empty: it can
    std::uint32_t queueFamily = 0;
};

int rank(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu: return 0;
    case vk::PhysicalDeviceType::eIntegratedGpu: return 1;
    case vk::PhysicalDeviceType::eVirtualGpu: return 2;
    case vk::PhysicalDeviceType::eCpu: return 3;
    default: return 4;
    }
}

/// Draws, dispatches and copies all go to one queue; Vulkan guarantees such a family wherever there is graphics. `surface`: to which the
/// family must be able to present, or null.
std::optional<std::uint32_t> drawingFamily(const vk::raii::PhysicalDevice& device, vk::SurfaceKHR surface) {
    constexpr vk::QueueFlags kNeeded = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    const auto families = device.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & kNeeded) == kNeeded && (!surface || device.getSurfaceSupportKHR(i, surface) == VK_TRUE)) return i;
    return std::nullopt;
}

Candidate examine(vk::raii::PhysicalDevice device, vk::SurfaceKHR surface) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    Candidate candidate{.name = properties.deviceName.data(), .rank = rank(properties.deviceType)};
    const bool canPresent = !surface || hasExtension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    const auto family = drawingFamily(device, canPresent ? surface : vk::SurfaceKHR{});
    if (properties.apiVersion < VK_API_VERSION_1_3)
        candidate.unfit = fmt::format("it offers Vulkan {}.{}, and 1.3 is needed", VK_API_VERSION_MAJOR(properties.apiVersion),
                                      VK_API_VERSION_MINOR(properties.apiVersion));
    else if (!canPresent || (surface && !family))
        candidate.unfit = "it cannot draw to this window";
    else if (!family)
        candidate.unfit = "it has no graphics queue";
    candidate.queueFamily = family.value_or(0);
    candidate.device = std::move(device);
    return candidate;
}

std::vector<Candidate> candidates(const DeviceState& state) {
    std::vector<Candidate> list;
    for (vk::raii::PhysicalDevice& device : state.instance.enumeratePhysicalDevices())
        list.push_back(examine(std::move(device), *state.surface));
    std::ranges::stable_sort(list, {}, &Candidate::rank);
    return list;
}

std::string wantedName(const DeviceOptions& options) {
    if (!options.prefer.empty()) return options.prefer;
    const char* variable = std::getenv("TEGUMENT_DEVICE");
    return variable ? variable : "";
}

/// "H200#2": the second of those with that in their names.
struct Wanted {
    std::string name; // in lower case
    std::size_t number = 1;
};

Wanted parsed(const std::string& text) {
    Wanted wanted{.name = toLower(text)};
    const std::size_t mark = wanted.name.rfind('#');
    if (mark == std::string::npos) return wanted;
    std::size_t number = 0;
    const char* end = wanted.name.data() + wanted.name.size();
    const auto read = std::from_chars(wanted.name.data() + mark + 1, end, number);
    if (read.ec == std::errc() && read.ptr == end && number > 0) wanted = {.name = wanted.name.substr(0, mark), .number = number};
    return wanted;
}

std::string listed(const std::vector<Candidate>& all) {
    std::string text;
    for (const Candidate& candidate : all)
        text +=
            fmt::format("{}'{}'{}", text.empty() ? "" : ", ", candidate.name, candidate.unfit.empty() ? "" : " (" + candidate.unfit + ")");
    return text;
}

/// "; did you mean 'llvmpipe'?": a word of a device's name.
std::string nearest(const std::string& wanted, const std::vector<Candidate>& all) {
    std::vector<std::string> words;
    for (const Candidate& candidate : all) {
        words.push_back(candidate.name);
        std::string word;
        for (const char c : candidate.name + " ") {
            if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
                word += c;
            } else if (!word.empty()) {
                words.push_back(std::exchange(word, {}));
            }
        }
    }
    const std::string near = didYouMean(wanted, words);
    return near.empty() ? "" : "; " + near;
}

std::string versionText(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version));
}

void adopt(DeviceState& state, Candidate chosen) {
    state.physical = std::move(chosen.device);
    state.queueFamily = chosen.queueFamily;
    const auto chain =
        state.physical
            .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties, vk::PhysicalDeviceVulkan12Properties>();
    const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceVulkan12Properties>();
    state.limits = properties.limits;
    state.maxAllocationSize = chain.get<vk::PhysicalDeviceVulkan11Properties>().maxMemoryAllocationSize;
    state.timestampBits = state.physical.getQueueFamilyProperties().at(chosen.queueFamily).timestampValidBits;
    state.info = {.name = chosen.name,
                  .driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data()),
                  .apiVersion = versionText(properties.apiVersion),
                  .cpu = properties.deviceType == vk::PhysicalDeviceType::eCpu,
                  .timestamps = state.timestampBits > 0};
}

} // namespace

Result<void> choosePhysicalDevice(DeviceState& state, const DeviceOptions& options) {
    std::vector<Candidate> all = candidates(state);
    if (all.empty()) return machineError(6002, "no Vulkan device: the installed drivers found none", advice().toGetDriver);
    const Wanted wanted = parsed(wantedName(options));
    std::size_t count = 0; // of those with that name
    const auto matches = [&](const Candidate& candidate) {
        return toLower(candidate.name).find(wanted.name) != std::string::npos && ++count >= wanted.number;
    };
    if (std::ranges::none_of(all, matches))
        return machineError(6004, fmt::format("no Vulkan device has '{}' in its name", wantedName(options)),
                            fmt::format("there are: {}{}", listed(all), nearest(wanted.name, all)));
    count = 0;
    const auto chosen =
        std::ranges::find_if(all, [&](const Candidate& candidate) { return matches(candidate) && candidate.unfit.empty(); });
    if (chosen == all.end()) return machineError(6005, "no Vulkan device can be used: " + listed(all), "update the graphics driver");
    adopt(state, std::move(*chosen));
    return {};
}

} // namespace tegument::gpu::detail
