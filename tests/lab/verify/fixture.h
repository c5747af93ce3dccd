#pragma once
// What the tests of modules share: a device, and what a report must be.

#include "lab/verify/verify.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <string>

namespace tegument::test {

class Verify : public WithDevice {};

inline void expectPass(const Result<ModuleReport>& report) {
    ASSERT_TRUE(report) << format(report.error());
    EXPECT_FALSE(report->metrics.empty());
    for (const Metric& metric : report->metrics)
        EXPECT_TRUE(metric.pass) << metric.module << " (" << metric.setting << ") " << metric.name << " = " << metric.value << ", limit "
                                 << metric.limit << ": " << metric.why;
}

} // namespace tegument::test
