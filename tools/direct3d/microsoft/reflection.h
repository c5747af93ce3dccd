#pragma once
// What D3DReflect says about a shader of model 4 or 5, as JSON.

#include <windows.h>

#include <d3dcompiler.h>

#include <string>

namespace hlslc {

using Reflect = HRESULT(WINAPI*)(LPCVOID, SIZE_T, REFIID, void**);

/// {"buffers", "resources", "inputs", "outputs", "threads"} in Direct3D's own numbers; "null" when the blob cannot be reflected.
std::string reflection(Reflect reflect, ID3DBlob& shader);

} // namespace hlslc
