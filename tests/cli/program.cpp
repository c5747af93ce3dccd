#include "tests/cli/program.h"

#include "host/image/image.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <numbers>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT: POSIX declares it nowhere

namespace tegument::test {

namespace fs = std::filesystem;

namespace {

struct Scratch {
    Scratch() : path(fs::temp_directory_path() / fmt::format("tegument-app-{}", ::getpid())) { fs::create_directories(path); }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() { fs::remove_all(path); }
    fs::path path;
};

std::string slurp(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
    std::vector<char*> list;
    for (std::string& text : strings)
        list.push_back(text.data());
    list.push_back(nullptr);
    return list;
}

std::vector<std::string> mergedEnvironment(const std::map<std::string, std::string>& added) {
    std::vector<std::string> merged;
    for (char** variable = environ; *variable; ++variable) {
        const std::string text = *variable;
        if (!added.contains(text.substr(0, text.find('=')))) merged.push_back(text);
    }
    for (const auto& [name, value] : added)
        merged.push_back(fmt::format("{}={}", name, value));
    return merged;
}

/// Bumps keep the ball from being so symmetric that a flipped axis goes unseen.
double bumpyRadius(double radius, double theta, double phi) {
    return radius * (1 + 0.05 * std::sin(3 * theta) * std::cos(2 * phi + 0.5));
}

} // namespace

const fs::path& scratch() {
    static const Scratch kScratch;
    return kScratch.path;
}

std::string out(const std::string& name) {
    return (scratch() / name).string();
}

std::string write(const std::string& name, const std::string& text) {
    const fs::path path = scratch() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

Ran tegument(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment) {
    std::vector<std::string> command = {TEGUMENT_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables = mergedEnvironment(environment);
    const std::string out = (scratch() / "stdout.txt").string();
    const std::string err = (scratch() / "stderr.txt").string();

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t child = 0;
    const int spawned = posix_spawn(&child, command[0].c_str(), &actions, nullptr, pointers(command).data(), pointers(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    Ran ran;
    if (spawned != 0) {
        ADD_FAILURE() << "cannot start " << command[0];
        return ran;
    }
    int status = 0;
    waitpid(child, &status, 0);
    ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ran.out = slurp(out);
    ran.err = slurp(err);
    return ran;
}

std::string ballObj(int rings, double radius) {
    constexpr double kPi = std::numbers::pi;
    std::string positions;
    std::string uvs;
    std::string faces;
    int index = 1;
    for (int chart = 0; chart < 2; ++chart) {
        for (int i = 0; i <= rings; ++i) {
            for (int j = 0; j <= rings; ++j, ++index) {
                const double v = static_cast<double>(i) / rings;
                const double u = static_cast<double>(j) / rings;
                const double theta = kPi * v;               // from the top
                const double phi = kPi * (u + chart) - kPi; // chart 1 faces +z
                const double r = bumpyRadius(radius, theta, phi);
                const double x = -std::cos(phi) * std::sin(theta);
                positions += fmt::format("v {:.9g} {:.9g} {:.9g}\n", r * x, r * std::cos(theta), r * std::sin(phi) * std::sin(theta));
                uvs += fmt::format("vt {:.9g} {:.9g}\n", 0.02 + 0.5 * chart + 0.46 * u, 1 - (0.02 + 0.96 * v));
                if (i == rings || j == rings) continue;
                const int down = index + rings + 1;
                if (i > 0) faces += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", index, down, index + 1);
                if (i + 1 < rings) faces += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", index + 1, down, down + 1);
            }
        }
    }
    return positions + uvs + faces;
}

const std::string& ballMesh() {
    static const std::string kPath = write("ball.obj", ballObj());
    return kPath;
}

const std::string& ballWorkspace() {
    static const std::string kPath = [] {
        Image grey{.width = 64, .height = 64, .channels = 3, .pixels = std::vector<float>(64 * 64 * 3, 0.5F)};
        for (std::size_t i = 0; i < grey.pixels.size(); ++i)
            grey.pixels[i] += 0.2F * std::sin(static_cast<float>(i));
        EXPECT_TRUE(writePng(scratch() / "grey.png", grey, PngEncoding::Raw));
        return write("ball.json", fmt::format(R"({{"mesh": "{}", "unit_mm": 1, "textures": {{"DIFFUSE": "grey.png"}},
 "camera": {{"position": [1, 0.5, 5]}}, "light": {{"position": [-3, 2, 5]}}}})",
                                              ballMesh()));
    }();
    return kPath;
}

void expectSaid(const Ran& ran, int code, const std::vector<std::string>& words) {
    EXPECT_EQ(ran.code, code) << ran.err;
    for (const std::string& word : words)
        EXPECT_NE(ran.err.find(word), std::string::npos) << "missing: " << word << "\n" << ran.err;
}

} // namespace tegument::test
