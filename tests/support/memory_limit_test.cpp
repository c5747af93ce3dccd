#include "host/support/memory_limit.h"

#include "host/support/file.h"
#include "host/support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

using namespace tegument;

namespace {

constexpr std::uint64_t kGibibyte = 1ULL << 30U;

rlim_t limitNow() {
    rlimit limit{};
    ::getrlimit(RLIMIT_DATA, &limit);
    return limit.rlim_cur;
}

} // namespace

TEST(MemoryLimit, is_by_default_what_is_free_and_no_more_than_the_machine_has) {
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t all = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * page;
    EXPECT_LE(memoryToBeHad(), all);
    EXPECT_GE(memoryToBeHad(), std::min(all, kGibibyte) / 2) << "half: a container may have less than the machine";
    const auto said = readFile("/proc/meminfo");
    const std::size_t line = said ? said->find("MemAvailable:") : std::string::npos;
    if (line == std::string::npos) return;
    const std::uint64_t available = std::stoull(said->substr(line + 13)) * 1024;
    const std::uint64_t swap = std::stoull(said->substr(said->find("SwapFree:") + 9)) * 1024;
    constexpr std::uint64_t kMeanwhile = kGibibyte; // others take and give back while we ask
    EXPECT_LE(memoryToBeHad(), std::max(kGibibyte, available + swap) + kMeanwhile);
}

TEST(MemoryLimit, of_ours_may_be_made_wider_and_the_callers_not) {
    if (!kMemoryCanBeLimited) return;
    const rlim_t callers = limitNow();
    limitMemoryTo(8 * kGibibyte);
    EXPECT_EQ(limitNow(), std::min<rlim_t>(callers, 8 * kGibibyte));
    limitMemoryTo(16 * kGibibyte);
    EXPECT_EQ(limitNow(), std::min<rlim_t>(callers, 16 * kGibibyte)) << "--max-memory may be more than the default";
    limitMemoryTo(kNoMemoryLimit);
    EXPECT_EQ(limitNow(), callers);
}
