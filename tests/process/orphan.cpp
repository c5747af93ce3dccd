// Starts a program beside itself from a thread that ends, says which, and is killed before anything is tidied up: for process_test.cpp.

#include "tools/process/process.h"

#include <csignal>
#include <cstdio>
#include <thread>

int main() {
    std::thread([] {
        auto child = tegument::BackgroundProcess::start({.arguments = {"sh", "-c", "echo $$; exec sleep 60"}});
        if (!child) return;
        std::puts(child->readLine(20).value_or("nothing").c_str());
        std::fflush(stdout);
        std::raise(SIGKILL);
    }).join();
    return 1;
}
