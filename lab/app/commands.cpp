#include "lab/app/commands.h"

#include <CLI/CLI.hpp>

namespace tegument::app {

void addLab(CLI::App& program, Action& action) {
    addVerify(program, action);
    addInvariance(program, action);
    addBench(program, action);
    program.footer(program.get_footer() + R"(
  tegument verify                             every module against double precision
  tegument invariance                         every technique in other units, turned, mirrored
  tegument bench                              every technique: milliseconds beside error)");
}

} // namespace tegument::app
