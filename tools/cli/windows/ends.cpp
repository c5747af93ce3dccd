#include "tools/cli/ends.h"

#include "host/support/temporary.h"
#include "tools/cli/output.h"
#include "tools/direct3d/windows/own_driver.h"

#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

int _dowildcard = -1; // NOLINT: the C library's name for it: files*.fx are spelt out before main, as shells do elsewhere

namespace tegument::app {

namespace {

constexpr int kInterrupted = 130; // 128 + SIGINT, as elsewhere

/// On a thread of the system's own: the others are held up or ended.
BOOL WINAPI interrupted(DWORD) {
    removeTemporaries();
    say("tegument: interrupted; every file that stands there is whole");
    std::_Exit(kInterrupted);
}

} // namespace

void begin() {
    driveWhereAsked();
    for (std::FILE* stream : {stdin, stdout, stderr})
        if (::_fileno(stream) >= 0) ::_setmode(::_fileno(stream), _O_BINARY); // the same bytes as elsewhere
    ::SetConsoleOutputCP(CP_UTF8);
    ::SetConsoleCtrlHandler(interrupted, TRUE);
}

} // namespace tegument::app
