#pragma once
// What takes longer than a moment says how far it is, on a terminal.

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument::app {

/// How far the work is and when it will be done. Knows no terminal and no clock: the times are seconds since it began.
class Estimate {
public:
    /// The steps to come, by what the texts that say() will get begin with, and what each takes of the whole in any unit. Steps that are
    /// not said count as passed over.
    void expect(std::vector<std::pair<std::string, double>> steps);
    /// What is being done. "3 of 13" in it is a count; of another total than before, or a smaller one, it begins anew.
    void say(const std::string& text, double now);
    /// How many items of the present step are done.
    void count(std::size_t done, std::size_t total, double now);
    /// Seconds until the end, of all expected steps or else of the present count; none while nobody can know.
    [[nodiscard]] std::optional<double> left(double now) const;
    /// "drawing the cube map, 12 s, about 30 s left": the time only of what has taken 2 s or more.
    [[nodiscard]] std::string line(double now) const;

private:
    [[nodiscard]] double share() const; // of the present step

    std::vector<std::pair<std::string, double>> steps_;
    std::optional<std::size_t> step_; // among them
    std::string text_;
    double begun_ = 0; // the present count, or the first of the expected steps
    double said_ = 0;  // the present step
    std::size_t done_ = 0;
    std::size_t total_ = 0;
    std::size_t first_ = 0; // done when the count began
};

/// "12 s", "3 min 05 s".
[[nodiscard]] std::string durationText(double seconds);

/// A line that replaces itself while standard error is a terminal, and says nothing otherwise. It has a clock of its own, and hears of the
/// long loops of the program (host/support/parallel.h). One at a time.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// As Estimate has them.
    void expect(std::vector<std::pair<std::string, double>> steps);
    void say(const std::string& line);
    void count(const std::string& what, std::size_t done, std::size_t total);
    /// Takes the line away, until the next one.
    void clear();

private:
    struct Terminal;
    std::unique_ptr<Terminal> terminal_; // none: nothing is said
};

} // namespace tegument::app
