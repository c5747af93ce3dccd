#include "host/run/run.h"

#include "host/run/pixels.h"
#include "host/run/plan.h"
#include "host/run/session.h"
#include "host/run/target_desc.h"

#include <cassert>

namespace tegument {

namespace {

std::vector<PassReport> passReports(const SessionFrame& frame) {
    std::vector<PassReport> reports;
    for (const SessionPass& pass : frame.passes)
        reports.push_back({.name = pass.name, .object = pass.object, .milliseconds = pass.milliseconds});
    if (frame.resolveMilliseconds) reports.push_back({.name = run::kResolve, .object = 0, .milliseconds = *frame.resolveMilliseconds});
    return reports;
}

void reportTargets(const EffectSession& session, RunResult& result) {
    for (const auto& [name, texture] : session.targets()) {
        const gpu::TextureDesc& desc = texture.desc();
        result.bytes += texture.bytes();
        result.targets.push_back({.name = name,
                                  .width = static_cast<int>(desc.width),
                                  .height = static_cast<int>(desc.height),
                                  .format = std::string(run::d3dName(desc.format)),
                                  .bytes = texture.bytes()});
    }
}

Result<void> readTargets(gpu::Device& device, EffectSession& session, const SessionFrame& frame, const std::vector<std::string>& dump,
                         RunResult& result) {
    auto image = run::readBack(device, *session.target({}));
    if (!image) return image.error();
    result.image = std::move(*image);
    result.image.metadata = frame.metadata;
    for (const std::string& name : dump) {
        auto target = run::readBack(device, *session.target(name));
        if (!target) return target.error();
        target->metadata = frame.metadata;
        target->metadata["target"] = name;
        result.dumped.emplace(name, std::move(*target));
    }
    return {};
}

Result<RunResult> runSession(gpu::Device& device, const Effect& effect, SessionScene scene, const Workspace& workspace,
                             const RunOptions& options) {
    EffectSession session(device, effect, scene);
    auto frame = session.draw(workspace, options);
    if (!frame) return frame.error();
    const auto dump = targetsToDump(effect, *frame, options.dump);
    if (!dump) return dump.error();
    RunResult result{.technique = frame->technique, .warnings = std::move(frame->warnings)};
    result.parameters = std::move(frame->parameters);
    for (const SessionTexture& texture : frame->textures)
        result.textures.push_back(texture.name);
    result.produced = !frame->produced.empty();
    result.passes = passReports(*frame);
    result.deviceBytes = device.allocatedBytes();
    reportTargets(session, result);
    if (const auto read = readTargets(device, session, *frame, *dump, result); !read) return read.error();
    return result;
}

} // namespace

Result<RunResult> runEffect(gpu::Device& device, const Effect& effect, const Mesh* mesh, const Workspace& workspace,
                            const RunOptions& options) {
    return runSession(device, effect, {.mesh = mesh}, workspace, options);
}

Result<RunResult> runScene(gpu::Device& device, const Effect& effect, std::span<const RunObject> objects, const Workspace& workspace,
                           const RunOptions& options) {
    assert(!objects.empty());
    return runSession(device, effect, {.mesh = nullptr, .objects = objects}, workspace, options);
}

} // namespace tegument
