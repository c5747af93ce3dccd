#pragma once
// One effect on one version of Direct3D. Devices are made once for all jobs.

#include "job.h"
#include "script.h"

#include <map>
#include <memory>

namespace client {

std::unique_ptr<Engine> openDirect3D9(const Job& job);
/// Draws an effect of another host by the steps of its job; returns the picture.
Pixels drawForeign(const Job& job);
std::unique_ptr<Engine> openDirect3D10(const Job& job);
std::unique_ptr<Engine> openDirect3D11(const Job& job);
/// Draws by the sample of Direct3D 12; returns all targets that can be read.
std::map<std::string, Pixels> drawDirect3D12(const Job& job);

} // namespace client
