#include "tools/view/pass_times.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr double kNew = 0.25; // share of a new time in the smoothed one: four frames count most

struct FrameTimes {
    std::vector<PassTime> passes;
    std::vector<double> milliseconds;
};

FrameTimes timesOf(const SessionFrame& frame) {
    FrameTimes times;
    for (const SessionPass& pass : frame.passes) {
        if (times.passes.empty() || times.passes.back().name != pass.name) {
            times.passes.push_back({.name = pass.name, .runs = 0, .kept = true});
            times.milliseconds.push_back(0);
        }
        ++times.passes.back().runs;
        times.passes.back().kept &= pass.kept;
        times.milliseconds.back() += pass.milliseconds;
    }
    return times;
}

constexpr const char* kResolveRow = "resolve";

bool hasResolve(const std::vector<PassTime>& passes) {
    return !passes.empty() && passes.back().name == kResolveRow;
}

/// While something moves, a pixel has one sample and nothing is resolved: the row stays.
void addResolve(const std::optional<double>& milliseconds, bool known, FrameTimes& times) {
    if (!milliseconds && !known) return;
    times.passes.push_back({.name = kResolveRow, .kept = milliseconds.value_or(0) == 0});
    times.milliseconds.push_back(milliseconds.value_or(0));
}

bool samePasses(const std::vector<PassTime>& a, const std::vector<PassTime>& b) {
    return std::ranges::equal(a, b, [](const PassTime& x, const PassTime& y) { return x.name == y.name && x.runs == y.runs; });
}

} // namespace

void PassTimes::note(const SessionFrame& frame) {
    FrameTimes times = timesOf(frame);
    const bool known = hasResolve(passes_);
    addResolve(frame.resolveMilliseconds, known, times);
    if (!known && hasResolve(times.passes) && samePasses(passes_, {times.passes.begin(), times.passes.end() - 1}))
        passes_.push_back(times.passes.back());
    if (!samePasses(passes_, times.passes)) passes_ = times.passes;
    for (std::size_t i = 0; i < passes_.size(); ++i) {
        PassTime& pass = passes_[i];
        pass.kept = times.passes[i].kept;
        const double time = times.milliseconds[i];
        if (time > 0) pass.milliseconds = pass.milliseconds == 0 ? time : (1 - kNew) * pass.milliseconds + kNew * time;
    }
}

double PassTimes::drawn() const {
    double sum = 0;
    for (const PassTime& pass : passes_)
        sum += pass.kept ? 0 : pass.milliseconds;
    return sum;
}

double PassTimes::all() const {
    double sum = 0;
    for (const PassTime& pass : passes_)
        sum += pass.milliseconds;
    return sum;
}

} // namespace tegument::view
