// Under LeakSanitizer, Debian's validation layer (1.3.239) leaks state of every command buffer when synchronization validation is on. It
// stays loaded, so that its frames have a name, and that name is passed over. Mesa's lavapipe stays loaded because it keeps 56 bytes behind
// a pointer of its own, which unloading it would take away. It loses 8 KB of compiled shader now and then, six at once where FurRoots is
// drawn in many scenes, no frame of ours among them; so does its LLVM. Objects of ours that are left over are the object tracker's to find.

#include <dlfcn.h>

namespace {

const void* const kLayer = ::dlopen("libVkLayer_khronos_validation.so", RTLD_NOW | RTLD_NODELETE);
const void* const kDriver = ::dlopen("libvulkan_lvp.so", RTLD_NOW | RTLD_NODELETE);

} // namespace

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return kLayer || kDriver ? "leak:libVkLayer_khronos_validation.so\nleak:libvulkan_lvp.so\nleak:libLLVM\n" : "";
}
