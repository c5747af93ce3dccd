#include "tools/cli/progress.h"

#include "host/support/parallel.h"
#include "host/support/system.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace tegument::app {

namespace {

constexpr double kMoment = 2; // seconds that nobody minds
constexpr auto kTick = std::chrono::milliseconds(250);

struct Count {
    std::size_t done = 0;
    std::size_t total = 0;
};

std::optional<std::size_t> numberAt(std::string_view text) {
    std::size_t number = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    return parsed.ec == std::errc() ? std::optional(number) : std::nullopt;
}

/// The "3 of 13" in a text.
std::optional<Count> countIn(std::string_view text) {
    constexpr std::string_view kOf = " of ";
    for (std::size_t at = text.find(kOf); at != std::string_view::npos; at = text.find(kOf, at + 1)) {
        std::size_t first = at;
        while (first > 0 && text[first - 1] >= '0' && text[first - 1] <= '9')
            --first;
        const auto done = numberAt(text.substr(first, at - first));
        const auto total = numberAt(text.substr(at + kOf.size()));
        if (done && total && *done <= *total && *total > 0) return Count{*done, *total};
    }
    return std::nullopt;
}

} // namespace

std::string durationText(double seconds) {
    const long whole = std::lround(seconds);
    return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

void Estimate::expect(std::vector<std::pair<std::string, double>> steps) {
    steps_ = std::move(steps);
    step_.reset();
}

void Estimate::say(const std::string& text, double now) {
    if (text != text_) said_ = now;
    text_ = text;
    const auto found = std::ranges::find_if(steps_, [&](const auto& step) { return text.starts_with(step.first); });
    if (found != steps_.end()) {
        if (!step_) begun_ = now;
        step_ = static_cast<std::size_t>(found - steps_.begin());
        done_ = total_ = 0;
        return;
    }
    if (const auto counted = countIn(text))
        count(counted->done, counted->total, now);
    else if (steps_.empty())
        total_ = 0;
}

void Estimate::count(std::size_t done, std::size_t total, double now) {
    if (total != total_ || done < done_) {
        first_ = done;
        if (!step_) begun_ = now;
    }
    done_ = done;
    total_ = total;
}

double Estimate::share() const {
    return total_ > 0 ? static_cast<double>(done_) / static_cast<double>(total_) : 0;
}

std::optional<double> Estimate::left(double now) const {
    const double taken = now - begun_;
    if (!step_) {
        if (total_ == 0 || done_ <= first_) return std::nullopt;
        return taken * static_cast<double>(total_ - done_) / static_cast<double>(done_ - first_);
    }
    double before = 0;
    double all = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (i < *step_) before += steps_[i].second;
        all += steps_[i].second;
    }
    before += share() * steps_[*step_].second;
    if (before <= 0 || all <= 0) return std::nullopt;
    return taken * (all - before) / before;
}

std::string Estimate::line(double now) const {
    std::string text = text_;
    if (total_ > 0 && !countIn(text_)) text += fmt::format(", {:.0f} %", 100 * share());
    if (now - said_ >= kMoment) text += ", " + durationText(now - said_);
    const auto rest = left(now);
    if (rest && now - begun_ >= kMoment && *rest >= 1) text += fmt::format(", about {} left", durationText(*rest));
    return text;
}

struct Progress::Terminal {
    Terminal() : ticking([this] { tick(); }) {}
    ~Terminal() {
        {
            const std::scoped_lock lock(mutex);
            ended = true;
        }
        wake.notify_all();
        ticking.join();
    }

    [[nodiscard]] double now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

    /// As wide as the terminal has room for, over what stood there. Called with the lock.
    void show() {
        if (!shown) return;
        constexpr std::size_t kWidest = 99;
        const std::string line = estimate.line(now()).substr(0, kWidest);
        fmt::print(stderr, "\r{:<{}}", line, width);
        std::fflush(stderr);
        width = line.size();
    }
    void wipe() {
        if (width > 0) fmt::print(stderr, "\r{:<{}}\r", "", width);
        std::fflush(stderr);
        width = 0;
        shown = false;
    }
    void tick() {
        std::unique_lock lock(mutex);
        while (!wake.wait_for(lock, kTick, [this] { return ended; }))
            show();
    }

    std::mutex mutex;
    std::condition_variable wake;
    bool ended = false;
    bool shown = false;
    std::size_t width = 0;
    Estimate estimate;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::thread ticking; // last: it uses the others
};

Progress::Progress() {
    if (!isTerminal(STDERR_FILENO)) return;
    terminal_ = std::make_unique<Terminal>();
    watchLoops([terminal = terminal_.get()](std::size_t done, std::size_t total) {
        const std::scoped_lock lock(terminal->mutex);
        terminal->estimate.count(done, total, terminal->now());
    });
}

Progress::~Progress() {
    if (!terminal_) return;
    watchLoops({});
    clear();
}

void Progress::expect(std::vector<std::pair<std::string, double>> steps) {
    if (!terminal_) return;
    const std::scoped_lock lock(terminal_->mutex);
    terminal_->estimate.expect(std::move(steps));
}

void Progress::say(const std::string& line) {
    if (!terminal_) return;
    const std::scoped_lock lock(terminal_->mutex);
    terminal_->estimate.say(line, terminal_->now());
    terminal_->shown = true;
    terminal_->show();
}

void Progress::count(const std::string& what, std::size_t done, std::size_t total) {
    say(fmt::format("{} {} of {}", what, done, total));
}

void Progress::clear() {
    if (!terminal_) return;
    const std::scoped_lock lock(terminal_->mutex);
    terminal_->wipe();
}

} // namespace tegument::app
