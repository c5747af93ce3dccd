// A build without the laboratory (TEGUMENT_LAB): host/lab is left out.

#include "host/app/commands.h"

namespace tegument::app {

void addLab(CLI::App& /*program*/, Action& /*action*/) {}

} // namespace tegument::app
