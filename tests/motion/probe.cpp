// motion_probe FILE OUT.bin ANIMATION SECONDS...: where the vertices of a mesh are at each of the times, in the file's unit, as doubles:
// time by time, vertex by vertex, x y z. ANIMATION: a name, a number, or "-" for none. Prints how many vertices there are.

#include "host/mesh/motion.h"
#include "host/support/file.h"
#include "host/support/result.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <string>

int main(int count, char** arguments) {
    using namespace tegument;
    if (count < 5) return 2;
    const auto rest = loadMesh(arguments[1]);
    if (!rest) {
        fmt::print(stderr, "{}\n", format(rest.error()));
        return 1;
    }
    std::string bytes;
    for (int i = 4; i < count; ++i) {
        Mesh mesh = *rest;
        PoseChoice choice;
        if (std::strcmp(arguments[3], "-") != 0) {
            choice.animation = arguments[3];
            choice.time = std::atof(arguments[i]);
        }
        if (const auto posed = poseMesh(mesh, choice); !posed) {
            fmt::print(stderr, "{}\n", format(posed.error()));
            return 1;
        }
        for (const glm::vec3& position : mesh.positions) {
            const glm::dvec3 p = (glm::dvec3(position) + mesh.origin) / mesh.unitMm;
            bytes.append(reinterpret_cast<const char*>(&p), sizeof p);
        }
    }
    fmt::print("{}\n", rest->positions.size());
    return writeFile(arguments[2], bytes) ? 0 : 1;
}
