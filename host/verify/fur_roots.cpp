// Module FurRoots.

#include "host/verify/fur_regression.h"
#include "host/verify/work.h"

namespace tegument::verify {

Result<ModuleReport> verifyFurRoots(const Context& context) {
    ModuleReport report{
        .module = "FurRoots",
        .summary = "Every pixel against the fragments of every layer by rays, each swept through the strands near it, blended in order"};
    if (const auto checked = checkSwept(report, context); !checked) return checked.error();
    return report;
}

} // namespace tegument::verify
