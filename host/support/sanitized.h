#pragma once
// What programs that are built for a sanitizer cannot do.

namespace tegument {

/// AddressSanitizer and ThreadSanitizer reserve terabytes of addresses for their shadow, which limits of memory count (RLIMIT_AS,
/// RLIMIT_DATA): under such a limit a sanitized program ends before it does anything.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kMemoryCanBeLimited = false;
#else
inline constexpr bool kMemoryCanBeLimited = true;
#endif

/// They also keep for a while what was freed: the memory of the process says nothing of ours.
inline constexpr bool kMemoryCanBeMeasured = kMemoryCanBeLimited;

} // namespace tegument
