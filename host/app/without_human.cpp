// A build without the default human (TEGUMENT_HUMAN): prep_human.cpp is left out.

#include "host/app/prep_mesh.h"

namespace tegument::app {

void addPrepHuman(CLI::App& /*prep*/, Action& /*action*/) {}

} // namespace tegument::app
