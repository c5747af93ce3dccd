// Writes the tables of docs/design/skin-error.md: skin_accuracy > tables.md, from the repository's root.

#include "lab/verify/errata.h"

#include <cstdio>

int main() {
    auto device = tegument::gpu::Device::create();
    if (!device) {
        std::fputs(format(device.error()).c_str(), stderr);
        return 3;
    }
    const auto errata = tegument::measureErrata(*device, {.compiler = tegument::defaultCompiler()});
    if (!errata) {
        std::fputs(format(errata.error()).c_str(), stderr);
        return 1;
    }
    std::printf("%s, %s\n\n%s", device->info().name.c_str(), tegument::compilerName(tegument::defaultCompiler()).c_str(),
                errataMarkdown(*errata).c_str());
}
