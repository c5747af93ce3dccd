// Module FurRoots.

#include "lab/verify/fur_exact.h"
#include "lab/verify/fur_regression.h"
#include "lab/verify/work.h"

namespace tegument::verify {

Result<ModuleReport> verifyFurRoots(const Context& context) {
    ModuleReport report{
        .module = "FurRoots",
        .summary =
            "Every pixel against rays that meet strands, cones that bend in space, and skin, several to a pixel, lit and shadowed by "
            "rays. Regression: the effect said again in double precision, fragment by fragment of every layer"};
    if (const auto judged = judgeStrands(report, context); !judged) return judged.error();
    if (const auto checked = checkSwept(report, context); !checked) return checked.error();
    return report;
}

} // namespace tegument::verify
