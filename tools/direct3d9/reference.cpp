#include "tools/direct3d9/reference.h"

#include "host/run/pixels.h"
#include "host/support/file.h"
#include "host/support/system.h"
#include "meshprep/adopt/adopt.h"
#include "tools/direct3d/microsoft.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/wine.h"
#include "tools/direct3d9/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace tegument {

namespace fs = std::filesystem;

namespace {

constexpr const char* kClient = "d3d_client.exe";

/// Named by the environment, beside the program, where it was installed, where it was built.
fs::path client() {
    const char* own = std::getenv("TEGUMENT_D3D_CLIENT");
    const fs::path here = programFile().parent_path();
    const fs::path built = fs::path("tests/d3d") / kClient;
    const auto build = folderAboveProgramWith(built);
    std::error_code code;
    if (own != nullptr && *own != '\0') return fs::is_regular_file(own, code) ? fs::absolute(own, code) : fs::path();
    for (const fs::path& candidate : {here / kClient, here / "../lib/tegument" / kClient, build ? *build / built : fs::path()})
        if (!candidate.empty() && fs::is_regular_file(candidate, code)) return fs::absolute(candidate, code);
    return {};
}

AuthorsNumbers authorsNumbers(const Effect& read) {
    AuthorsNumbers numbers;
    for (const Parameter& parameter : read.parameters)
        if (const auto* value = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr)
            numbers[parameter.name] = *value;
    return numbers;
}

/// Streams that no mesh has here and that the client's mesh would have otherwise: what stands in for them is told in the notes.
std::string streamLines(const std::vector<Diagnostic>& notes) {
    std::string lines;
    for (const Diagnostic& note : notes) {
        const std::string stream = note.text.substr(0, note.text.find(' '));
        for (const auto& [said, kind] : {std::pair(" is zero", "zero"), std::pair(" is the identity", "matrix")})
            if (note.code == 3404 && note.text.compare(stream.size(), std::string(said).size(), said) == 0)
                lines += fmt::format("stream {} {}\n", kind, stream);
    }
    return lines;
}

/// Effects of other hosts have one mesh.
Result<std::string> meshFile(Mesh mesh, bool turned, const fs::path& folder) {
    const std::string file = turned ? "turned.mesh" : "plain.mesh";
    std::error_code code;
    if (fs::exists(folder / file, code)) return file;
    for (std::size_t i = 0; turned && i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i], mesh.indices[i + 1]);
    if (const auto written = writeMeshFile(folder / file, mesh); !written) return written.error();
    return file;
}

/// What is drawn here, and its job. Error: it is not compared.
Result<void> drawHere(gpu::Device& device, const ReferencePicture& picture, const Mesh* mesh, const Workspace& workspace,
                      RunOptions options, const fs::path& folder) {
    LoadOptions load = picture.load;
    load.lenient = true;
    auto read = loadEffect(picture.file, load);
    if (!read) return read.error();
    if (read->ownDialect) return inputError(5260, {.file = picture.file.string()}, "it is written for this host");
    const AuthorsNumbers theirs = authorsNumbers(*read);
    const Adoption adoption = adopted(std::move(*read), {.width = options.width, .height = options.height, .direct3D9Centres = true});
    const Technique* technique = adoption.effect.defaultTechnique();
    if (!technique || technique->kind != TechniqueKind::D3D9)
        return inputError(5260, {.file = picture.file.string()}, "its technique is not of Direct3D 9");
    options.technique = technique->name;
    run::Stage stage(device, adoption.effect, {.mesh = mesh});
    auto staged = stage.prepare(workspace, options);
    if (!staged) return staged.error();
    const run::Prepared& prepared = staged->runs.front().prepared;
    const auto frame = frameLines(adoption.effect, prepared, theirs, options.width, options.height);
    if (!frame) return frame.error();
    if (const auto done = stage.draw(*staged, staged->frame.items.size()); !done) return done.error();
    const auto drawn = run::readBack(device, *stage.resources().picture());
    if (!drawn) return drawn.error();
    if (auto written = writeFloats(folder / (picture.name + ".vulkan.f32"), *drawn); !written) return written;
    const auto textures = writeTextures(device, stage, prepared, folder);
    if (!textures) return textures.error();
    std::string job = fmt::format("foreign\neffect {}.fxo\ntechnique {}\npicture {} {} 0 0 0\n", picture.name, technique->name,
                                  options.width, options.height);
    if (mesh) {
        const auto file = meshFile(*mesh, adoption.turned.contains(technique->name), folder);
        if (!file) return file.error();
        job += fmt::format("mesh {}\n", *file);
    }
    return writeFile(folder / (picture.name + ".job"), job + streamLines(adoption.notes) + *textures + *frame);
}

/// Those that have been drawn here.
Result<void> compile(const std::vector<ReferencePicture*>& pictures, const fs::path& folder) {
    std::vector<MicrosoftJob> jobs;
    for (const ReferencePicture* picture : pictures) {
        MicrosoftJob job{.profile = "fx_2_0",
                         .source = picture->file,
                         .defines = picture->load.defines,
                         .output = folder / (picture->name + ".fxo"),
                         .includeFolders = {picture->file.parent_path()},
                         .compatible = true};
        job.includeFolders.insert(job.includeFolders.end(), picture->load.includeFolders.begin(), picture->load.includeFolders.end());
        jobs.push_back(std::move(job));
    }
    const auto results = compileWithMicrosoft(jobs);
    if (!results) return results.error();
    for (std::size_t i = 0; i < pictures.size(); ++i)
        if (!(*results)[i].ok) pictures[i]->why = "Microsoft's compiler refuses it";
    return {};
}

} // namespace

std::string direct3dClientMissing() {
    if (std::string missing = microsoftCompilerMissing(); !missing.empty()) return missing;
    return client().empty() ? fmt::format("there is no {}", kClient) : "";
}

Result<fs::path> direct3dClientIn(const fs::path& folder) {
    std::error_code code;
    const fs::path linked = folder / kClient;
    const fs::path library = folder / "d3dcompiler_47.dll";
    fs::remove(linked, code);
    fs::remove(library, code);
    fs::create_symlink(client(), linked, code);
    if (!code) fs::create_symlink(microsoftCompilerLibrary(), library, code);
    if (code) return machineError(3104, fmt::format("cannot link the client into {}: {}", folder.string(), code.message()));
    return linked;
}

void drawForReference(gpu::Device& device, ReferencePicture& picture, const Mesh* mesh, const Workspace& workspace, RunOptions options,
                      const fs::path& folder) {
    const auto drawn = drawHere(device, picture, mesh, workspace, std::move(options), folder);
    if (!drawn) picture.why = drawn.error().diagnostics.empty() ? "?" : drawn.error().diagnostics.front().text;
}

Result<void> drawByMicrosoft(std::vector<ReferencePicture>& pictures, const fs::path& folder) {
    constexpr double kSeconds = 120;
    const auto program = direct3dClientIn(folder);
    if (!program) return program.error();
    std::vector<ReferencePicture*> left;
    const auto drop = [&] { std::erase_if(left, [](const ReferencePicture* picture) { return !picture->why.empty(); }); };
    for (ReferencePicture& picture : pictures)
        left.push_back(&picture);
    drop();
    if (const auto compiled = compile(left, folder); !compiled) return compiled;
    drop();
    while (!left.empty()) {
        std::string jobs;
        for (const ReferencePicture* picture : left)
            jobs += fmt::format("{0}.job {0}.\n", picture->name);
        std::error_code code;
        fs::remove(folder / "results", code);
        if (auto written = writeFile(folder / "jobs", jobs); !written) return written;
        const auto ran = runInWine(*program, {"9", windowsPath(fs::absolute(folder, code)), "jobs", "results"},
                                   kSeconds + static_cast<double>(left.size()));
        if (!ran) return ran.error();
        const auto said = readFile(folder / "results");
        std::istringstream results(said ? *said : "");
        std::size_t done = 0;
        bool failed = false;
        for (std::string line; !failed && done < left.size() && std::getline(results, line); ++done) {
            failed = line != "ok";
            if (failed) left[done]->why = line;
        }
        if (!failed && done < left.size()) left[done++]->why = fmt::format("the client ended with {} {}", ran->exitCode, ran->output);
        left.erase(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(done));
    }
    return {};
}

Result<ReferenceError> referenceError(const fs::path& folder, const std::string& name) {
    constexpr double kStep = 0.01; // of a display's 255: two and a half
    const auto ours = readFloats(folder / (name + ".vulkan.f32"));
    if (!ours) return ours.error();
    const auto theirs = readFloats(folder / (name + ".picture.f32"));
    if (!theirs) return theirs.error();
    const auto shown = [](const Image& image, std::size_t pixel, std::size_t channel) {
        const float value = image.pixels[pixel * static_cast<std::size_t>(image.channels) + channel];
        return std::isnan(value) ? 0.0 : std::clamp(static_cast<double>(value), 0.0, 1.0);
    };
    double squares = 0;
    double whole = 0;
    std::size_t beyond = 0;
    const std::size_t pixels = ours->pixels.size() / static_cast<std::size_t>(ours->channels);
    for (std::size_t i = 0; i < pixels; ++i) {
        double most = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double off = shown(*ours, i, c) - shown(*theirs, i, c);
            most = std::max(most, std::abs(off));
            squares += off * off;
            whole += shown(*theirs, i, c) * shown(*theirs, i, c);
        }
        beyond += most > kStep ? 1 : 0;
    }
    return ReferenceError{.black = whole == 0,
                          .relative = std::sqrt(squares / std::max(whole, 1e-12)),
                          .share = static_cast<double>(beyond) / static_cast<double>(pixels)};
}

} // namespace tegument
