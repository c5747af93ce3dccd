#include "host/lab/app/commands.h"

#include <CLI/CLI.hpp>

namespace tegument::app {

void addLab(CLI::App& program, Action& action) {
    addVerify(program, action);
    addInvariance(program, action);
    addBench(program, action);
    program.footer(program.get_footer() + R"(
  tegument verify                             every module against its reference in double precision
  tegument invariance                         every technique in metres, inches, turned, mirrored: the same picture
  tegument bench                              every technique: milliseconds and error against brute force)");
}

} // namespace tegument::app
