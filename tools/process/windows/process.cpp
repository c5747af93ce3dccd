#include "tools/process/process.h"

#include "tools/process/any_process.h"

#include "host/support/windows/wide.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include <windows.h>

#include <psapi.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kTick = std::chrono::milliseconds(5);
constexpr std::size_t kLongestOutput = 64U << 20U; // what a program says beyond it is read and forgotten
constexpr UINT kKilled = 137;                      // 128 + SIGKILL, as elsewhere

Clock::time_point after(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

struct Close {
    void operator()(HANDLE handle) const { ::CloseHandle(handle); }
};
using Handle = std::unique_ptr<void, Close>;

/// A process and the job that it and what it starts belong to: they end with the job's handle, ours.
struct Started {
    Handle process;
    Handle job;
    Handle output;
    Handle errors; // none: they are in the output
};

/// As CommandLineToArgvW reads it.
std::wstring quoted(const std::wstring& word) {
    if (!word.empty() && word.find_first_of(L" \t\n\v\"") == std::wstring::npos) return word;
    std::wstring text = L"\"";
    std::size_t slashes = 0;
    for (const wchar_t letter : word) {
        if (letter == L'"') text.append(slashes + 1, L'\\');
        slashes = letter == L'\\' ? slashes + 1 : 0;
        text += letter;
    }
    text.append(slashes, L'\\');
    return text + L'"';
}

/// Our environment with the command's variables in place of ours, each ended by a zero.
std::wstring environmentOf(const ProcessCommand& command) {
    const auto before = [](const std::wstring& a, const std::wstring& b) { return ::_wcsicmp(a.c_str(), b.c_str()) < 0; };
    std::map<std::wstring, std::wstring, decltype(before)> variables(before);
    wchar_t* const own = ::GetEnvironmentStringsW();
    for (const wchar_t* entry = own; *entry != 0; entry += std::wcslen(entry) + 1) {
        const std::wstring_view text = entry;
        const std::size_t equals = text.find(L'=', 1); // names of drives begin with one
        if (equals != std::wstring_view::npos) variables[std::wstring(text.substr(0, equals))] = text.substr(equals + 1);
    }
    ::FreeEnvironmentStringsW(own);
    for (const auto& [name, value] : command.environment)
        variables[wideOf(name)] = wideOf(value);
    std::wstring all;
    for (const auto& [name, value] : variables)
        all.append(name).append(L"=").append(value).push_back(L'\0');
    return all + L'\0';
}

struct Pipe {
    Handle read;
    Handle write;
};

Pipe newPipe() {
    HANDLE read = nullptr;
    HANDLE write = nullptr;
    if (::CreatePipe(&read, &write, nullptr, 1U << 16U) == 0) return {};
    ::SetHandleInformation(write, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
    return {Handle(read), Handle(write)};
}

Handle newJob(std::size_t maxBytes) {
    Handle job(::CreateJobObjectW(nullptr, nullptr));
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    if (maxBytes > 0) limits.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    limits.ProcessMemoryLimit = maxBytes;
    ::SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
    return job;
}

Handle nothingToRead() {
    SECURITY_ATTRIBUTES inherited{.nLength = sizeof(SECURITY_ATTRIBUTES), .lpSecurityDescriptor = nullptr, .bInheritHandle = TRUE};
    return Handle(::CreateFileW(L"NUL", GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0, nullptr));
}

Result<Started> spawn(const ProcessCommand& command) {
    const std::string& name = command.arguments.at(0);
    const auto program = findProgram(name);
    if (!program) return machineError(5003, fmt::format("cannot start {}: there is no such program", name));
    std::wstring line = quoted(program->wstring());
    for (std::size_t i = 1; i < command.arguments.size(); ++i)
        line += L' ' + quoted(wideOf(command.arguments[i]));
    std::wstring environment = environmentOf(command);

    static std::mutex mutex; // ends that a child inherits are inherited by whatever starts meanwhile
    const std::scoped_lock lock(mutex);
    Pipe output = newPipe();
    Pipe errors = command.errorsApart ? newPipe() : Pipe{};
    const Handle input = nothingToRead();
    Handle job = newJob(command.maxBytes);
    STARTUPINFOW start{};
    start.cb = sizeof start;
    start.dwFlags = STARTF_USESTDHANDLES;
    start.hStdInput = input.get();
    start.hStdOutput = output.write.get();
    start.hStdError = command.errorsApart ? errors.write.get() : output.write.get();
    PROCESS_INFORMATION made{};
    constexpr DWORD kHow = CREATE_UNICODE_ENVIRONMENT | CREATE_SUSPENDED | CREATE_NO_WINDOW;
    if (::CreateProcessW(program->c_str(), line.data(), nullptr, nullptr, TRUE, kHow, environment.data(), nullptr, &start, &made) == 0)
        return machineError(5003, fmt::format("cannot start {}: {}", name, lastFailure()));
    ::AssignProcessToJobObject(job.get(), made.hProcess);
    ::ResumeThread(made.hThread);
    ::CloseHandle(made.hThread);
    return Started{Handle(made.hProcess), std::move(job), std::move(output.read), std::move(errors.read)};
}

bool runs(HANDLE process) {
    return ::WaitForSingleObject(process, 0) == WAIT_TIMEOUT;
}

/// Appends what is there. False: nothing is.
bool readSome(HANDLE file, std::string& into) {
    DWORD count = 0;
    if (file == nullptr || ::PeekNamedPipe(file, nullptr, 0, nullptr, &count, nullptr) == 0 || count == 0) return false;
    std::string bytes(count, '\0');
    if (::ReadFile(file, bytes.data(), count, &count, nullptr) == 0) return false;
    if (into.size() < kLongestOutput) into.append(bytes.data(), count);
    return true;
}

double seconds(const FILETIME& time) {
    return static_cast<double>((std::uint64_t{time.dwHighDateTime} << 32U) | time.dwLowDateTime) * 1e-7;
}

void measure(HANDLE process, ProcessResult& result) {
    FILETIME begun{};
    FILETIME ended{};
    FILETIME kernel{};
    FILETIME user{};
    if (::GetProcessTimes(process, &begun, &ended, &kernel, &user) != 0) result.processorSeconds = seconds(kernel) + seconds(user);
    PROCESS_MEMORY_COUNTERS memory{};
    if (::GetProcessMemoryInfo(process, &memory, sizeof memory) != 0) result.peakBytes = memory.PeakWorkingSetSize;
    DWORD code = 0;
    ::GetExitCodeProcess(process, &code);
    result.exitCode = static_cast<int>(code);
}

/// What a BackgroundProcess's numbers stand for.
Started* startedOf(pid_t id) {
    return id <= 0 ? nullptr : reinterpret_cast<Started*>(static_cast<std::intptr_t>(id));
}

} // namespace

std::optional<fs::path> findProgram(const std::string& name) {
    const auto executable = [](const fs::path& path) -> std::optional<fs::path> {
        std::error_code code;
        for (const fs::path& spelling : {path, fs::path(path).concat(".exe")})
            if (spelling.extension() == ".exe" && fs::is_regular_file(spelling, code)) return spelling;
        return std::nullopt;
    };
    if (name.find_first_of("/\\") != std::string::npos) return executable(name);
    const wchar_t* path = ::_wgetenv(L"PATH");
    return findInFolders(path == nullptr ? L"" : path, L';', name, executable);
}

Result<ProcessResult> runProcess(const ProcessCommand& command, double timeoutSeconds) {
    const auto started = spawn(command);
    if (!started) return started.error();
    const auto end = after(timeoutSeconds);
    ProcessResult result;
    const auto readAll = [&] {
        bool some = false;
        while (readSome(started->output.get(), result.output) || readSome(started->errors.get(), result.errors))
            some = true;
        return some;
    };
    while (runs(started->process.get())) {
        if (Clock::now() >= end) {
            result.timedOut = true;
            ::TerminateJobObject(started->job.get(), kKilled);
            ::WaitForSingleObject(started->process.get(), INFINITE);
            break;
        }
        if (!readAll()) ::WaitForSingleObject(started->process.get(), static_cast<DWORD>(kTick.count()));
    }
    readAll();
    measure(started->process.get(), result);
    return result;
}

Result<BackgroundProcess> BackgroundProcess::start(const ProcessCommand& command) {
    ProcessCommand joined = command;
    joined.errorsApart = false;
    auto started = spawn(joined);
    if (!started) return started.error();
    return BackgroundProcess(static_cast<pid_t>(reinterpret_cast<std::intptr_t>(new Started(std::move(*started)))), -1);
}

std::optional<std::string> BackgroundProcess::readLine(double timeoutSeconds) {
    const auto end = after(timeoutSeconds);
    const Started& started = *startedOf(id_);
    while (pending_.find('\n') == std::string::npos && Clock::now() < end) {
        const bool ran = runs(started.process.get());
        if (readSome(started.output.get(), pending_)) continue;
        if (!ran) break;
        ::WaitForSingleObject(started.process.get(), static_cast<DWORD>(kTick.count()));
    }
    return takeLine(pending_);
}

bool BackgroundProcess::running() {
    return id_ > 0 && runs(startedOf(id_)->process.get());
}

void BackgroundProcess::stop() {
    const std::unique_ptr<Started> started(startedOf(std::exchange(id_, -1)));
    if (started == nullptr) return;
    ::TerminateJobObject(started->job.get(), kKilled);
    ::WaitForSingleObject(started->process.get(), INFINITE);
}

} // namespace tegument
