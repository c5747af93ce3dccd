#include "host/direct3d/wine.h"

namespace tegument {

std::string wineMissing() {
    return {};
}

Result<ProcessCommand> wineProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    ProcessCommand command{.arguments = {program.string()}, .environment = {}};
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    return command;
}

Result<ProcessResult> runInWine(const std::filesystem::path& program, const std::vector<std::string>& arguments, double timeoutSeconds) {
    const auto command = wineProcess(program, arguments);
    return runProcess(*command, timeoutSeconds);
}

} // namespace tegument
