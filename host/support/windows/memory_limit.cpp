#include "host/support/memory_limit.h"

#include <windows.h>

namespace tegument {

std::uint64_t memoryToBeHad() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return ::GlobalMemoryStatusEx(&status) != 0 ? status.ullTotalPhys : kNoMemoryLimit;
}

/// What is reserved counts here, too. The job lasts as long as the program.
void limitMemoryTo(std::uint64_t bytes) {
    static HANDLE job = nullptr;
    if (job == nullptr) {
        job = ::CreateJobObjectW(nullptr, nullptr);
        ::AssignProcessToJobObject(job, ::GetCurrentProcess());
    }
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    limits.ProcessMemoryLimit = bytes;
    ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
}

} // namespace tegument
