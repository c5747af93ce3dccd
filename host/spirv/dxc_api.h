#pragma once
// DXC's own header, with what it takes for granted on each system.

#ifdef _WIN32
#include "host/spirv/windows/com.h"
#else
#define __EMULATE_UUID // NOLINT(bugprone-reserved-identifier): the header's own switch for compilers without __declspec(uuid)
#endif
#include <dxcapi.h>
