#include "host/run/run.h"

#include "host/run/execute.h"

namespace tegument {

Result<RunResult> runEffect(gpu::Device& device, const Effect& effect, const Mesh* mesh, const Workspace& workspace,
                            const RunOptions& options) {
    const run::RunInput input{
        .device = device, .effect = effect, .mesh = mesh, .workspace = workspace, .options = options, .producers = {}};
    auto prepared = run::prepare(input);
    if (!prepared) return prepared.error();
    if (const auto textures = run::prepareTextures(input, *prepared); !textures) return textures.error();
    return run::execute(input, *prepared);
}

} // namespace tegument
