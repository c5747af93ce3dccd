// tegument prep shape: meshes with known counts to try preparation on.

#include "meshprep/prepare/shapes.h"
#include "meshprep/write/write_mesh.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/cli/prep_mesh.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace {

struct ShapeArguments {
    prep::Shape shape = prep::Shape::Cube;
    std::string output;
    int detail = 0;
};

int makeAndWrite(const ShapeArguments& arguments) {
    const auto can = checkOutput(arguments.output, {".ply"}, "tegument prep IN.ply -o OUT.glb makes a glb of it");
    if (!can) return fail(can.error(), false);
    const Mesh mesh = prep::makeShape(arguments.shape, arguments.detail);
    if (const auto written = writePly(arguments.output, mesh); !written) return fail(written.error(), false);
    fmt::print("{} vertices, {} triangles\nwrote {}\n", mesh.positions.size(), mesh.indices.size() / 3, arguments.output);
    return 0;
}

} // namespace

void addPrepShape(CLI::App& parent, Action& action) {
    using prep::Shape;
    auto arguments = std::make_shared<ShapeArguments>();
    CLI::App* command = parent.add_subcommand("shape", "Write a generated mesh as PLY: cube, torus, sphere, terrain (docs/meshprep.md)");
    command->add_option("shape", arguments->shape, "cube, torus, sphere or terrain")
        ->required()
        ->type_name("")
        ->transform(oneOf<Shape>({{"cube", Shape::Cube}, {"torus", Shape::Torus}, {"sphere", Shape::Sphere}, {"terrain", Shape::Terrain}}));
    command->add_option("-o,--output", arguments->output, "Where it goes")->required();
    command->add_option("--detail", arguments->detail, "Sphere: 20 N^2 triangles, default N = 224; terrain: 2 N^2, default 724")
        ->check(CLI::Range(1, 5000));
    addExamples(*command, {{"prep shape torus -o out/torus.ply", ""}, {"prep shape sphere --detail 32 -o out/ball.ply", ""}});
    command->callback([arguments, &action] { action = [arguments] { return makeAndWrite(*arguments); }; });
}

} // namespace tegument::app
