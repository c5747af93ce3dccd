#include "tests/check/broken.h"

#include "host/spirv/compile.h"

namespace tegument::test {
namespace {

constexpr std::size_t kPromised = 20;

TEST(BrokenEffects, are_blamed_on_the_right_line_by_the_front_end_and_for_spirv) {
    const auto files = brokenEffects();
    ASSERT_GE(files.size(), kPromised);
    std::vector<Target> targets{Target::SpirvGlslang};
    if (compilerAvailable(Compiler::Dxc)) targets.insert(targets.end(), {Target::SpirvDxc, Target::Dxil});
    const CheckReport report = checkEffects(files, targets);
    for (const FileReport& file : report.files) {
        if (file.file.stem() == "layout" && targets.size() == 1) continue; // two compilers are compared there
        expectBlame(file);
    }
}

} // namespace
} // namespace tegument::test
