#pragma once
// How the program begins and ends, whatever is done to it.

namespace tegument::app {

/// Before anything else. Standard streams that are closed are opened on /dev/null, so that no file gets their numbers. SIGINT, SIGTERM and
/// SIGHUP remove what is temporary, are said, and end the program as they would have; a second one ends it at once. A file beyond the
/// limit (`ulimit -f`) is a failed write.
void begin();

/// The program's exit code: `code`, or that of the machine with TG8090 where what was printed did not reach its place.
[[nodiscard]] int ended(int code);

} // namespace tegument::app
