// In every program of a sanitized build. An exit code of its own: 1 is also what the program says of a faulty input, and tests expect that.
// LeakSanitizer of GCC 12 takes thread-local memory that begins 16 bytes behind a page for that of an old C library, reads its size from
// what lies before it, and crashes: without intercept_tls_get_addr it looks there through the C library's own pointers. DXC, whose library
// is not ours, deletes objects by the size of their base class when it writes DXIL: new_delete_type_mismatch.

extern "C" {

const char* __asan_default_options();
const char* __asan_default_options() {
    return "exitcode=86:detect_stack_use_after_return=1:check_initialization_order=1:strict_string_checks=1:intercept_tls_get_addr=0:"
           "new_delete_type_mismatch=0";
}

const char* __ubsan_default_options();
const char* __ubsan_default_options() {
    return "print_stacktrace=1";
}

const char* __tsan_default_options();
const char* __tsan_default_options() {
    return "exitcode=86:second_deadlock_stack=1";
}

// What libraries that are not built for ThreadSanitizer do with their own memory. oneTBB: its calls of memcmp and operator delete when its
// threads end. Never `race:libtbb`: that passes over every stack with a frame of oneTBB in it, and so over every race in a loop. The
// validation layer: it gives back what a driver's thread has used. lavapipe: a mutex that one of its threads destroys behind another; no
// code of ours is called from there, and of what its threads do with our memory only calls of the C library would be seen.
const char* __tsan_default_suppressions();
const char* __tsan_default_suppressions() {
    return "called_from_lib:libtbb.so.12\ncalled_from_lib:libVkLayer_khronos_validation.so\nrace:libvulkan_lvp.so\n";
}
}
