// Any bytes are what Microsoft's compiler says: messages, a listing, a reflection. It runs in Wine, and may die in the middle of a word.

#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/microsoft_reflection.h"
#include "tools/direct3d/sm3.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const tegument::Messages messages = tegument::readMicrosoftMessages(text, "a.fx", {}, tegument::Roots{});
    for (const auto* list : {&messages.errors, &messages.warnings})
        for (const tegument::Diagnostic& message : *list)
            if (message.at.line < 0 || message.at.column < 0 || tegument::format(message).empty()) std::abort();
    if (const auto usage = tegument::readSm3Listing(text); usage && (usage->instructionSlots < 0 || usage->constants < 0)) std::abort();
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_discarded()) (void)tegument::readSm5Reflection(json);
    return 0;
}
