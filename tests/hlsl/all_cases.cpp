#include "tests/hlsl/function_case.h"

namespace tegument::test {

Cases allCases() {
    return together(specularCases(), lightCases(), softShadowCases(), surfaceCases(), workspaceCases(), shadowCases(), gaussianCases(),
                    poissonCases(), scatterCases(), postCases(), pyramidCases(), cullCases(), furCases(), furRootsCases(), furRibbonCases(),
                    peerScreenCases(), peerDiscCases(), peerTableCases(), lockCases(), lockLightCases(), ribbonPassCases(),
                    strandPassCases(), computePassCases(), furShellCases(), furSweepCases(), furLayerCases(), furMotionCases(),
                    lockPassCases(), strandRibbonCases(), furNotedCases(), pyramidPassCases(), pyramidLinkCases(), pyramidFinalCases(),
                    skinPassCases(), skinMapCases(), lampPassCases(), toneCases(), fibreCases());
}

} // namespace tegument::test
