#pragma once
// Runs the built program as a user would: arguments in, exit code and both streams out.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tegument::test {

// Exit codes: what the program was given is wrong, how it was called is wrong, the machine lacks something.
inline constexpr int kInput = 1;
inline constexpr int kUsage = 2;
inline constexpr int kMachine = 3;

struct Ran {
    int code = -1;
    std::string out;
    std::string err;

    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// `environment` is added to this process's own.
[[nodiscard]] Ran tegument(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment = {});

/// The exit code, and words of what it said.
void expectSaid(const Ran& ran, int code, const std::vector<std::string>& words);

/// A folder of this test process's own, removed at its end.
[[nodiscard]] const std::filesystem::path& scratch();

/// Path of a file below scratch(), written or not.
[[nodiscard]] std::string out(const std::string& name);

/// Writes a file below scratch() and returns its path.
[[nodiscard]] std::string write(const std::string& name, const std::string& text);

/// A closed, bumpy head-sized ball (radius 110 mm) with two UV charts and a gutter between them, as OBJ text: a mesh that every test has.
[[nodiscard]] std::string ballObj(int rings = 48, double radius = 110);

/// Path of ballObj() written once, and of a workspace beside it that names it and a grey colour map.
[[nodiscard]] const std::string& ballMesh();
[[nodiscard]] const std::string& ballWorkspace();

} // namespace tegument::test
