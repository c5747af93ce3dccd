// effects/peers as Direct3D 9, 10 and 11, in every setting and in both forms.

#include "tests/peers/forms.h"
#include "tools/check/check.h"

#include <gtest/gtest.h>

namespace tegument::test {
namespace {

TEST(PeerMatrix, every_peer_passes_as_direct3d_9_10_and_11_in_every_form) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    expectEveryPeerPasses({Target::Fx2, Target::Fx4, Target::Fx5, Target::Sm5});
}

} // namespace
} // namespace tegument::test
