// d3d_client 9|10|11|12 FOLDER JOBS RESULTS: runs effects on a Direct3D device and writes every target as raw floats.
//
// JOBS, a file in FOLDER, names a job file and a prefix for the targets' files on each line. RESULTS receives one line for each job,
// flushed: "ok", or why it failed; after a failure the program ends, and a line that is missing tells which job brought it down.

#include "backends.h"
#include "com.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace client {

namespace {

FILE* results = nullptr;

/// One line, whatever it says.
void report(std::string line) {
    std::replace_if(
        line.begin(), line.end(), [](char letter) { return letter == '\n' || letter == '\r'; }, ' ');
    std::fprintf(results, "%s\n", line.c_str());
    std::fflush(results);
}

std::unique_ptr<Engine> open(const std::string& version, const Job& job) {
    if (version == "9") return openDirect3D9(job);
    if (version == "10") return openDirect3D10(job);
    if (version == "11") return openDirect3D11(job);
    fail("no Direct3D " + version);
}

void run(const std::string& version, const std::string& folder, const std::string& file, const std::string& prefix) {
    const Job job = readJob(folder, file);
    if (job.foreign) return writePixels(job.path(prefix + "picture.f32"), drawForeign(job));
    if (version == "12") {
        for (const auto& [name, pixels] : drawDirect3D12(job))
            writePixels(job.path(prefix + name + ".f32"), pixels);
        return;
    }
    const std::unique_ptr<Engine> engine = open(version, job);
    runTechnique(*engine);
    for (const std::string& target : engine->targets())
        writePixels(job.path(prefix + (target.empty() ? "picture" : target) + ".f32"), engine->read(target));
}

} // namespace

void fail(const std::string& reason) {
    report(reason);
    std::exit(1);
}

void must(HRESULT result, const std::string& what) {
    if (SUCCEEDED(result)) return;
    char code[16];
    std::snprintf(code, sizeof code, "%08lx", static_cast<unsigned long>(result));
    fail(what + " failed with " + code);
}

} // namespace client

int main(int count, char** arguments) {
    if (count != 5) return 2;
    const std::string folder = arguments[2];
    client::results = std::fopen((folder + "\\" + arguments[4]).c_str(), "wb");
    if (client::results == nullptr) return 2;
    std::ifstream jobs(folder + "\\" + arguments[3]);
    for (std::string text; std::getline(jobs, text);) {
        std::istringstream line(text);
        std::string file;
        std::string prefix;
        line >> file >> prefix;
        client::run(arguments[1], folder, file, prefix);
        client::report("ok");
    }
    return std::fclose(client::results);
}
