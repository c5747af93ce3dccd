#pragma once
// A limit of memory, so that a hostile file ends this program and not the machine.

namespace CLI {
class App;
}

namespace tegument::app {

/// Limits this process to what is free of the memory of the machine, or of the container, and adds `--max-memory MiB` to every command that
/// has no such option of its own. Beyond it allocations fail: TG8001. What is only reserved, or mapped to be read, does not count
/// (RLIMIT_DATA).
void limitMemory(CLI::App& program);

} // namespace tegument::app
