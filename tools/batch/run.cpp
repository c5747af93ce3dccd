#include "tools/batch/run.h"

#include "host/support/parallel.h"
#include "host/support/process.h"
#include "host/support/system.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iterator>
#include <mutex>
#include <optional>

namespace tegument::batch {

namespace {

constexpr std::size_t kTail = 4096;

std::string tail(const std::string& text) {
    return text.size() <= kTail ? text : text.substr(text.size() - kTail);
}

std::string now() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

/// The record of before, if it is of the same identity and need not be made again.
std::optional<Record> kept(const Batch& batch, const std::string& input, const std::vector<std::string>& command,
                           const std::string& identity) {
    auto record = readRecord(recordFile(batch.results, input, command));
    if (!record || record->identity != identity) return {};
    if (!isDone(*record) && !batch.keepsFailed) return {};
    return std::move(*record);
}

std::string ownIdentity(const Batch& batch, const std::string& input) {
    return identityOf(batch.words, input, batch.with, batch.programIdentity, batch.filesBehind);
}

Result<Record> run(const Batch& batch, const std::string& input, std::vector<std::string> command, std::string identity) {
    ProcessCommand process{.arguments = {batch.program}, .environment = {}, .errorsApart = true, .maxBytes = batch.maxBytes};
    process.arguments.insert(process.arguments.end(), command.begin(), command.end());
    const auto begun = std::chrono::steady_clock::now();
    auto ran = runProcess(process, batch.timeLimit);
    if (!ran) return ran.error();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    const bool json = nlohmann::json::accept(ran->output);
    return Record{.input = input,
                  .command = std::move(command),
                  .identity = std::move(identity),
                  .exitCode = ran->exitCode,
                  .outOfTime = ran->timedOut,
                  .seconds = took.count(),
                  .processorSeconds = ran->processorSeconds,
                  .peakBytes = ran->peakBytes,
                  .result = json ? std::move(ran->output) : tail(ran->output),
                  .messages = tail(ran->errors),
                  .host = hostName(),
                  .ended = now()};
}

void add(Sums& sums, const Record& record, bool wasKept) {
    if (!isDone(record)) {
        ++sums.failed;
        sums.worst = std::max(sums.worst, record.exitCode);
    } else {
        ++(wasKept ? sums.kept : sums.done);
    }
}

} // namespace

Result<Sums> runBatch(const std::vector<std::string>& inputs, const Batch& batch, const Heard& heard) {
    Sums sums;
    std::mutex mutex;
    const auto one = [&](std::size_t i) -> Result<void> {
        const std::string& input = inputs[i];
        std::vector<std::string> command = commandFor(batch.words, input);
        std::string identity = ownIdentity(batch, input);
        auto before = kept(batch, input, command, identity);
        const bool wasKept = before.has_value();
        auto record = wasKept ? Result<Record>(std::move(*before)) : run(batch, input, std::move(command), std::move(identity));
        if (!record) return record.error();
        if (!wasKept)
            if (auto written = writeRecord(batch.results, *record); !written) return written.error();
        const std::scoped_lock lock(mutex);
        add(sums, *record, wasKept);
        if (heard) heard(*record, wasKept);
        return {};
    };
    if (const auto all = tryEachInParallel(inputs.size(), one, {}, batch.jobs); !all) return all.error();
    return sums;
}

std::vector<Pending> pendingOf(const std::vector<std::string>& inputs, const Batch& batch) {
    std::vector<Pending> pending;
    for (const std::string& input : inputs) {
        const std::vector<std::string> command = commandFor(batch.words, input);
        std::string identity = ownIdentity(batch, input);
        if (!kept(batch, input, command, identity))
            pending.push_back({input, recordFile(batch.results, input, command), std::move(identity)});
    }
    return pending;
}

std::vector<Pending> stillPending(const std::vector<Pending>& pending) {
    std::vector<Pending> still;
    std::ranges::copy_if(pending, std::back_inserter(still), [](const Pending& one) {
        const auto record = readRecord(one.record);
        return !record || record->identity != one.identity;
    });
    return still;
}

} // namespace tegument::batch
