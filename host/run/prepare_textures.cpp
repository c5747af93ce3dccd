// Textures of a run, loaded into memory: from files, from the mesh, from constants.

#include "host/run/pixels.h"
#include "host/run/prepare.h"
#include "host/run/procedures.h"
#include "host/support/file.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

namespace tegument::run {

namespace {

constexpr std::chrono::milliseconds kClockStep(20); // of the clock that dates files
constexpr double kByte = 1.0 / 255;                 // a map of 8 bits may be rounded up, and no more

/// Mip chains are made for textures that a sampler of this effect reads with a linear mip filter.
bool wantsMips(const Effect& effect, const std::string& texture) {
    return std::ranges::any_of(effect.samplers, [&](const Sampler& sampler) {
        return sampler.texture == texture && sampler.state.mipmapping && sampler.state.mipFilter == Filter::Linear;
    });
}

bool isSrgb(const Parameter& parameter) {
    return equalsIgnoreCase(parameter.annotations.string("ColorSpace").value_or("linear"), "sRGB");
}

bool isCube(const Parameter& parameter) {
    return parameter.type.base == BaseType::TextureCube;
}

TextureData fromImage(const Parameter& parameter, Image image, bool mips) {
    const bool srgb = isSrgb(parameter);
    TextureData texture{.image = std::move(image), .format = {}, .decode = false, .mips = mips, .file = {}};
    texture.format = formatFor(texture.image, srgb);
    texture.decode = srgb && texture.image.bitsPerChannel == 16; // float files are linear already, 8 bits are decoded by the sampler
    return texture;
}

/// A cube map, or the mip levels that a file brings, go to the GPU as they are.
TextureData fromDds(const Parameter& parameter, DdsTexture file, bool mips) {
    TextureData texture = fromImage(parameter, file.at(0, 0), mips && file.mips == 1);
    if (file.isCube() || file.mips > 1) texture.file = std::move(file);
    return texture;
}

TextureData fromConstant(const Parameter& parameter, const ConstantSource& constant) {
    const Image texel{.width = 1, .height = 1, .channels = 4, .pixels = {constant.begin(), constant.end()}};
    TextureData texture{.image = texel, .format = PixelFormat::RGBA32F, .decode = false, .mips = false, .file = {}};
    if (isCube(parameter)) texture.file = {.format = DdsFormat::Rgba32F, .faces = 6, .mips = 1, .images = std::vector<Image>(6, texel)};
    return texture;
}

TextureData fromProcedure(const Parameter& parameter, const std::string& name, bool mips) {
    if (!isCube(parameter)) return fromImage(parameter, plainPicture(name), mips);
    std::vector<Image> faces = plainCube(name);
    TextureData texture = fromImage(parameter, faces.front(), false);
    texture.format = PixelFormat::RGBA32F;
    texture.decode = false;
    texture.file = {.format = DdsFormat::Rgba32F, .faces = 6, .mips = 1, .images = std::move(faces)};
    return texture;
}

/// The effect says by UIMax what the first channel of a map may hold.
void warnOutside(const Parameter& parameter, const Image& image, std::vector<Diagnostic>& warnings) {
    const auto most = parameter.annotations.numbers("UIMax");
    if (!most || most->empty()) return;
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t count = image.pixels.size() / channels;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < count; ++i)
        beyond += static_cast<double>(image.pixels[i * channels]) > most->front() + kByte ? 1 : 0;
    if (beyond == 0) return;
    warnings.push_back(
        inputWarning(4034, parameter.at,
                     fmt::format("{:.2f} % of the texels of {} are above {:g}",
                                 100.0 * static_cast<double>(beyond) / static_cast<double>(count), parameter.name, most->front()),
                     parameter.annotations.string("UIHelp").value_or("the effect was tested up to UIMax only")));
}

/// What a look-up compares with is a depth: the first channel, in the one format that every device compares and the host can fill. Other
/// formats need not support it, in Vulkan as in Direct3D.
void toDepth(TextureData& texture) {
    const bool encoded = texture.decode || texture.format == PixelFormat::RGBA8Srgb;
    const auto convert = [&](Image& image) {
        for (float& value : image.pixels) {
            if (encoded) value = srgbToLinear(value);
            value = value >= 0 ? std::min(value, 1.0F) : 0.0F; // of NaN, too
        }
    };
    convert(texture.image);
    std::ranges::for_each(texture.file.images, convert);
    texture.format = PixelFormat::D32F;
    texture.decode = texture.mips = false;
}

/// What makes two textures of a scene the same: where it comes from, and what is made of it.
std::string keyOf(const TextureSource& source, const Parameter& parameter, bool mips) {
    if (const auto* constant = std::get_if<ConstantSource>(&source))
        return fmt::format("constant {} cube {}", fmt::join(*constant, " "), isCube(parameter));
    if (const auto* procedure = std::get_if<ProcedureSource>(&source))
        return fmt::format("procedure {} mips {} srgb {}", procedure->name, mips, isSrgb(parameter));
    std::string from;
    if (const auto* file = std::get_if<FileSource>(&source)) from = std::filesystem::weakly_canonical(file->path).string();
    if (const auto* embedded = std::get_if<const EmbeddedTexture*>(&source)) from = fmt::format("mesh {}", fmt::ptr(*embedded));
    return fmt::format("{} srgb {} mips {}", from, isSrgb(parameter), mips);
}

/// For people.
std::string originOf(const TextureSource& source) {
    if (const auto* file = std::get_if<FileSource>(&source)) {
        const std::string word = file->namedBy.ends_with("Generator") ? "made from the mesh, kept in" : "file";
        return fmt::format("{} {}", word, file->path.string());
    }
    if (const auto* embedded = std::get_if<const EmbeddedTexture*>(&source))
        return fmt::format("in the mesh's file, as {}", (*embedded)->role);
    if (const auto* producer = std::get_if<ProducerSource>(&source))
        return fmt::format("baked by {}: {}", producer->effect.filename().string(), producer->target);
    if (const auto* constant = std::get_if<ConstantSource>(&source)) return fmt::format("constant {:.3g}", fmt::join(*constant, " "));
    const auto* procedure = std::get_if<ProcedureSource>(&source);
    return procedure ? "plain picture " + procedure->name : "none";
}

/// Another host's effect names a file of a kind that only that host reads.
Diagnostic notLoaded(const Parameter& parameter, const Error& error, const std::string& standIn) {
    const std::string why = error.diagnostics.empty() ? std::string("it cannot be read") : error.diagnostics.front().text;
    const std::string name = parameter.annotations.string("ResourceName").value_or("");
    return inputWarning(4031, parameter.at,
                        fmt::format("{}, the texture of {}: {}; a plain picture, {}, stands in", name, parameter.name, why, standIn),
                        fmt::format("convert it to PNG and give that: --set {}=FILE", parameter.name));
}

Result<TextureData> fromSource(const Parameter& parameter, const TextureSource& source, bool mips, std::vector<Diagnostic>& warnings) {
    if (const auto* constant = std::get_if<ConstantSource>(&source)) return fromConstant(parameter, *constant);
    if (const auto* procedure = std::get_if<ProcedureSource>(&source)) return fromProcedure(parameter, procedure->name, mips);
    if (const auto* embedded = std::get_if<const EmbeddedTexture*>(&source)) {
        warnOutside(parameter, (*embedded)->image, warnings);
        return fromImage(parameter, (*embedded)->image, mips);
    }
    auto file = loadNamed(parameter, std::get<FileSource>(source));
    const auto standIn = parameter.annotations.string("Procedure");
    if (!file && standIn && std::get<FileSource>(source).namedBy == kResourceName) {
        warnings.push_back(notLoaded(parameter, file.error(), *standIn));
        return fromProcedure(parameter, *standIn, mips);
    }
    if (!file) return file.error();
    TextureData texture = file->texture.images.empty() ? fromImage(parameter, std::move(file->picture), mips)
                                                       : fromDds(parameter, std::move(file->texture), mips);
    warnOutside(parameter, texture.image, warnings);
    return texture;
}

/// How long the file took to make stands beside it, for whoever finds it later. Who finds it at once, as a second texture of the same
/// generator does, takes it for new: what is noted since it was written stays.
void noteBake(Bake& bake) {
    std::filesystem::path note = bake.file;
    note += ".ms";
    if (!bake.fromCache) {
        std::error_code none;
        if (std::filesystem::last_write_time(note, none) >= std::filesystem::last_write_time(bake.file, none)) return;
        (void)writeFile(note, fmt::format("{:.1f}\n", bake.milliseconds)); // without it nobody says
        return;
    }
    const auto text = readFile(note);
    double once = 0;
    if (text && std::from_chars(text->data(), text->data() + text->size(), once).ec == std::errc() && std::isfinite(once) && once > 0)
        bake.once = once;
}

std::optional<std::filesystem::path> madeBefore(const RunInput& input, const std::string& generator) {
    if (!input.known) return std::nullopt;
    const auto found = input.known->made.find({input.mesh, generator});
    std::error_code gone;
    if (found == input.known->made.end() || !std::filesystem::exists(found->second, gone)) return std::nullopt;
    return found->second;
}

/// What is made from the mesh is a file from here on; a file that somebody named must have been made from this mesh.
Result<TextureSource> madeFor(const RunInput& input, const Parameter& parameter, TextureSource source, Prepared& prepared) {
    if (const auto* made = std::get_if<GeneratorSource>(&source)) {
        if (const auto file = madeBefore(input, made->generator)) return TextureSource(FileSource{*file, "its annotation Generator"});
        const auto begin = std::chrono::steady_clock::now();
        const auto written = std::filesystem::file_time_type::clock::now();
        auto file = input.options.assets.make(made->generator, *input.mesh);
        if (!file) return namedBy("its annotation Generator", parameter, file.error());
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        std::error_code unknown;
        const bool old = std::filesystem::last_write_time(*file, unknown) < written - kClockStep;
        Bake bake{.milliseconds = took.count(), .fromCache = !unknown && old, .file = *file};
        noteBake(bake);
        if (input.known) input.known->made[{input.mesh, made->generator}] = *file;
        prepared.bakes[parameter.name] = std::move(bake);
        return TextureSource(FileSource{*file, "its annotation Generator"});
    }
    const auto generator = parameter.annotations.string("Generator");
    const auto* file = std::get_if<FileSource>(&source);
    if (!generator || !file || !input.mesh || !input.options.assets.check) return source;
    const std::tuple all(input.mesh, *generator, file->path);
    if (input.known && input.known->checked.contains(all)) return source;
    if (const auto checked = input.options.assets.check(*generator, file->path, *input.mesh); !checked)
        return namedBy(file->namedBy, parameter, checked.error());
    if (input.known) input.known->checked.insert(all);
    return source;
}

/// The caller's skin in place of the effect's own, where nothing gives it a colour.
void paint(const RunInput& input, const Parameter& parameter, TextureSource& source, std::vector<Diagnostic>& warnings) {
    auto* constant = std::get_if<ConstantSource>(&source);
    const auto& skin = input.options.plainSkin;
    if (!constant || !skin || !equalsIgnoreCase(parameter.semantic, "DIFFUSE")) return;
    *constant = *skin;
    const bool coloured = input.mesh && !input.mesh->colors.empty();
    warnings.push_back(
        inputWarning(4056, {.file = input.mesh ? input.mesh->name : input.effect.file.string()},
                     fmt::format("no colour map: the skin has one plain colour, ({:g}, {:g}, {:g}){}", (*skin)[0], (*skin)[1], (*skin)[2],
                                 coloured ? ", and the colours of the mesh's vertices are not drawn" : ""),
                     fmt::format("{}--set {}=FILE gives one", coloured ? "bake them into a picture: " : "", parameter.name)));
}

/// A texture that a library would make from the mesh, and a constant stands in: fur would be bald, and skin without its links.
void warnOfNothingMade(const RunInput& input, const Parameter& parameter, const TextureSource& source, std::vector<Diagnostic>& warnings) {
    const auto generator = parameter.annotations.string("Generator");
    if (!generator || !input.mesh || input.options.assets.make || !std::holds_alternative<ConstantSource>(source)) return;
    warnings.push_back(inputWarning(
        4080, parameter.at,
        fmt::format("nothing makes {} ('{}') for {}: a constant stands in for it", parameter.name, *generator, input.mesh->name),
        "set RunOptions::assets (Tegument::assets has meshAssets()), or give a file"));
}

Result<TextureSource> sourceOf(const RunInput& input, const Parameter& parameter, Prepared& prepared) {
    auto source = findTexture(parameter, input.effect, input.options, input.workspace, input.mesh);
    if (!source) return source;
    warnOfNothingMade(input, parameter, *source, prepared.warnings);
    paint(input, parameter, *source, prepared.warnings);
    return madeFor(input, parameter, std::move(*source), prepared);
}

Result<TextureData> load(const RunInput& input, const Parameter& parameter, const TextureSource& source, bool compared,
                         std::vector<Diagnostic>& warnings) {
    const bool mips = wantsMips(input.effect, parameter.name);
    std::string key = keyOf(source, parameter, mips) + (compared ? " depth" : "");
    const bool there = (input.uploaded && input.uploaded->contains(key)) || (input.loaded && input.loaded->contains(key));
    if (there) return TextureData{.format = {}, .key = std::move(key), .file = {}};
    auto texture = fromSource(parameter, source, mips, warnings);
    if (texture && compared) toDepth(*texture);
    if (texture) texture->key = std::move(key);
    return texture;
}

Result<void> find(const RunInput& input, const Parameter& parameter, Prepared& prepared) {
    const auto source = sourceOf(input, parameter, prepared);
    if (!source) return source.error();
    prepared.origins[parameter.name] = originOf(*source);
    const auto* producer = std::get_if<ProducerSource>(&*source);
    if (isCube(parameter) && (producer || std::holds_alternative<const EmbeddedTexture*>(*source)))
        return inputError(4038, parameter.at, fmt::format("{} is a TextureCube, and what would fill it is no cube map", parameter.name),
                          fmt::format("give a DDS file with six faces: --set {}=FILE", parameter.name));
    if (producer) {
        prepared.products.emplace(parameter.name, *producer);
        return {};
    }
    const bool compared =
        std::ranges::any_of(prepared.programs, [&](const auto& program) { return program.second->use.compared.contains(parameter.name); });
    auto texture = load(input, parameter, *source, compared, prepared.warnings);
    if (!texture) return texture.error();
    prepared.textures.emplace(parameter.name, std::move(*texture));
    return {};
}

} // namespace

Result<void> prepareTextures(const RunInput& input, Prepared& prepared) {
    std::set<std::string> names;
    for (const auto& program : prepared.programs)
        names.insert(program.second->use.sampled.begin(), program.second->use.sampled.end());
    for (const std::string& name : names) {
        if (prepared.targets.contains(name)) continue;
        const Parameter* parameter = input.effect.findParameter(name);
        if (!parameter)
            return inputError(4005, {.file = input.effect.file.string()},
                              fmt::format("a shader samples {}, which the effect does not declare outside FX_ENTRY", name),
                              "declare it outside the #ifdef");
        if (parameter->type.base != BaseType::Texture2D && !isCube(*parameter))
            return inputError(4032, parameter->at,
                              fmt::format("{} is a {}: this host loads Texture2D and TextureCube", name, parameter->type.name));
        if (const auto found = find(input, *parameter, prepared); !found) return found;
    }
    return {};
}

void forgetTexels(Prepared& prepared, std::set<std::string>& uploaded) {
    for (auto& [name, texture] : prepared.textures) {
        if (!prepared.products.contains(name)) uploaded.insert(texture.key);
        texture.image = {};
        texture.file = {};
    }
}

} // namespace tegument::run
