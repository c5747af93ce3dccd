#pragma once
// What an effect file says, after preprocessing and parsing: parameters, textures, samplers, techniques, passes, states, scripts.
// Nothing here knows Vulkan, a compiler or a scene.

#include "host/effect/script.h"
#include "host/support/result.h"
#include "host/support/roots.h"
#include "host/support/state.h"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tegument {

enum class BaseType { Bool, Int, Uint, Float, String, Texture1D, Texture2D, Texture3D, TextureCube, Sampler, Struct, Other };

struct TypeMember;

/// Scalar: rows = columns = 1. float3: rows 1, columns 3. float4x3: rows 4, columns 3. elements 0: not an array.
struct Type {
    BaseType base = BaseType::Float;
    int rows = 1;
    int columns = 1;
    int elements = 0;
    std::string name;                                                 // as written: "float4x4"
    bool unsized = false;                                             // `[]`, and no initial value has said how many yet
    std::shared_ptr<const std::vector<TypeMember>> members = nullptr; // of a structure

    [[nodiscard]] bool isTexture() const {
        return base == BaseType::Texture1D || base == BaseType::Texture2D || base == BaseType::Texture3D || base == BaseType::TextureCube;
    }
    [[nodiscard]] bool isNumeric() const {
        return base == BaseType::Bool || base == BaseType::Int || base == BaseType::Uint || base == BaseType::Float;
    }
    /// Number of scalars in a value of this type; of a structure those of its numbers.
    [[nodiscard]] int scalarCount() const;
};

struct TypeMember {
    std::string name;
    Type type;
};

/// Numbers in row order (bool 0/1; int, uint and float exactly), or a string.
using Value = std::variant<std::vector<double>, std::string>;

struct Annotation {
    std::string name;
    Type type;
    Value value;
    SourcePosition at;
    std::vector<TextPiece> pieces; // of a string: where its literals stand
};

/// Case-insensitive look-up, as every DXSAS 0.8 host does it.
struct Annotations {
    std::vector<Annotation> list;

    [[nodiscard]] const Annotation* find(std::string_view name) const;
    [[nodiscard]] std::optional<std::string> string(std::string_view name) const;
    [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view name) const;
};

inline constexpr std::string_view kColorTarget = "RENDERCOLORTARGET"; // semantics of what is no input of a shader
inline constexpr std::string_view kDepthTarget = "RENDERDEPTHSTENCILTARGET";
inline constexpr std::string_view kStandardsGlobal = "STANDARDSGLOBAL";

/// A global variable that the host may set: numeric, string or texture. Samplers are apart.
struct Parameter {
    std::string name;
    Type type;
    std::string semantic; // as written, may be empty
    Annotations annotations;
    std::optional<Value> defaultValue; // compilers drop it silently; the host uploads it
    SourcePosition at;

    [[nodiscard]] bool hasSemantic(std::string_view name) const; // ignores case
    [[nodiscard]] bool isTarget() const { return type.isTexture() && (hasSemantic(kColorTarget) || hasSemantic(kDepthTarget)); }
};

struct Sampler {
    std::string name;
    std::string texture; // the `Texture = <X>` form; else by our convention: sampler X reads texture XMap; else empty
    SamplerState state;
    Annotations annotations;
    SourcePosition at;
};

/// `compile ps_3_0 F(2, true)`, `CompileShader(ps_5_0, F())`.
struct ShaderReference {
    std::string entry;
    std::string profile;
    std::vector<std::string> arguments; // for `uniform` parameters, as written
    SourcePosition at;
    std::string code;                             // a source of its own; empty: the effect's
    std::string original;                         // what the author calls the entry point, where that is another name
    std::shared_ptr<const Diagnostic> obstacle{}; // why it has no source
};

/// `AlphaTestEnable`, `AlphaFunc`, `AlphaRef`: no later Direct3D has them.
struct AlphaTest {
    bool enable = false;
    CompareOp compare = CompareOp::Always;
    unsigned reference = 0; // 0 to 255
    bool operator==(const AlphaTest&) const = default;
};

/// `RWTexture2D<float4> gBaseStore`: what compute shaders write.
struct StorageTexture {
    std::string name;
    /// The colour target behind it: annotation Stores, where "" is the application's own; else by our convention gXMap, of gXStore.
    std::optional<std::string> target;
    Annotations annotations;
    SourcePosition at;
};

struct Pass {
    std::string name;
    Annotations annotations;
    std::optional<ShaderReference> vertexShader;
    std::optional<ShaderReference> pixelShader;
    std::optional<ShaderReference> geometryShader;
    std::optional<ShaderReference> hullShader;
    std::optional<ShaderReference> domainShader;
    std::optional<ShaderReference> computeShader;
    int assemblyShaders = 0;   // stages written in assembly: Microsoft's compiler takes them, nothing else does
    bool streamOutput = false; // its geometry shader writes into buffers
    AlphaTest alphaTest;
    bool encodesSrgb = false;  // SRGBWriteEnable
    bool addsSpecular = false; // SpecularEnable: without a pixel shader COLOR1 is added
    bool fogs = false;         // FogEnable: before shader model 3 what FOG leaves of a colour gives way to fogColor
    std::array<double, 3> fogColor{};
    PipelineState state; // every assignment of the pass applied to the defaults of its Direct3D version
    Script script;       // default: Draw=Geometry;
    SourcePosition at;

    [[nodiscard]] bool drawsGeometry() const; // or computes: anything but Draw=Buffer
};

enum class TechniqueKind { D3D9, D3D10, D3D11 };

struct Technique {
    std::string name;
    TechniqueKind kind = TechniqueKind::D3D9;
    Annotations annotations;
    std::vector<Pass> passes;
    Script script; // default: its passes in order
    SourcePosition at;

    [[nodiscard]] const Pass* findPass(std::string_view name) const; // ignores case
};

/// Its script asks for what lies below the effect: ScriptExternal.
[[nodiscard]] bool drawsScene(const Technique& technique);

/// The technique that meshprep/adopt adds for that: the mesh, plainly lit.
inline constexpr const char* kSceneTechnique = "<scene>";

/// The STANDARDSGLOBAL block.
struct StandardsGlobal {
    std::string name{};
    Annotations annotations{};
    double version = 0.8;
    std::string scriptClass = "sceneorobject";
    std::string scriptOrder = "standard";
    std::string scriptOutput = "color";
    Script script; // Technique=...;
    SourcePosition at;
};

/// A preprocessor switch whose values 0, 1, 2 ... have names: `#define FX_SETTINGS SWITCH name0 name1 ...` (docs/effect-files.md).
struct EffectSettings {
    std::string define;             // the switch
    std::vector<std::string> names; // of its values, at least one
    std::string current;            // of the value that it has; where that has no name, the value as written
};

struct Effect {
    std::filesystem::path file;
    std::vector<Parameter> parameters; // numeric, string and texture, in file order
    std::vector<Sampler> samplers;
    std::vector<StorageTexture> storages;
    std::vector<Technique> techniques;
    std::optional<StandardsGlobal> standardsGlobal;
    std::optional<EffectSettings> settings;
    /// What pictures say of the effect besides its parameters: entry, value. `#define FX_METADATA entry SWITCH ...`.
    std::map<std::string, std::string> metadata;

    /// Plain HLSL for DXC and glslang: preprocessed with FX_ENTRY=1, effect syntax blanked out with its lines kept,
    /// `#line N "file"` directives naming the sources.
    std::string code;
    std::vector<std::filesystem::path> includes;              // every file read besides `file`
    std::vector<std::pair<std::string, std::string>> defines; // as given at load
    std::vector<std::filesystem::path> includeFolders;        // likewise
    Roots roots;                                              // where files that it names may lie
    std::vector<Diagnostic> warnings;
    bool displayColours = false;   // its colours are those of a display, not radiance
    bool unitSize = false;         // it expects a mesh of radius 1 at the origin
    bool direct3D9Targets = false; // a pass may sample what it draws into, and a depth target may be larger than the colours beside it
    std::string shown;             // the technique that is drawn where nobody names one; empty: as scripts say, else the first
    bool reshade = false;          // it was ReShade FX: it changes a picture (host/effect/reshade.h)
    bool ownDialect = false;       // it asks for FX_ENTRY, FX_D3D10 or FX_D3D11: it is written for this host

    [[nodiscard]] const Parameter* findParameter(std::string_view name) const;    // exact
    [[nodiscard]] const Sampler* findSampler(std::string_view name) const;        // exact
    [[nodiscard]] const StorageTexture* findStorage(std::string_view name) const; // exact
    [[nodiscard]] const Technique*
    findTechnique(std::string_view name) const; // ignores case; by its names of before, too (annotation Formerly)
    /// The technique that the global script names, else `shown`, else the first one; null when there is none.
    [[nodiscard]] const Technique* defaultTechnique() const;
};

struct LoadOptions {
    std::vector<std::pair<std::string, std::string>> defines; // name, value
    std::vector<std::filesystem::path> includeFolders;        // searched after the including file's own folder
    std::string setting; // by its name in FX_SETTINGS, in addition to the defines; empty: as the effect and the defines have it
    /// What Microsoft's compiler reads and this host cannot draw, or has no use for, is a warning and no error. Effects that ask for
    /// FX_ENTRY, FX_D3D10 or FX_D3D11 are written for this host and are read strictly all the same.
    bool lenient = false;
    /// Where the files that it names may lie, besides its own folder, its project and includeFolders (rootsOf).
    Roots roots = {};
};

/// The D3DFORMAT that a `Format` annotation names: upper case, without D3DFMT_ or FMT_, known misspellings corrected. Nullopt when unknown.
/// The list is in docs/effect-files.md.
[[nodiscard]] std::optional<std::string> canonicalFormat(std::string_view name);

/// The first Direct3D 9 intrinsic or sampler type (tex2D, sampler2D, texture, ...) left in the effect's code: DXC and glslang do not know
/// it, so SPIR-V targets of such a file are reported as not checked.
[[nodiscard]] std::optional<Diagnostic> direct3D9Intrinsic(const Effect& effect);

/// The technique has something to draw with a mesh.
[[nodiscard]] bool drawsMesh(const Effect& effect, const Technique& technique);

/// Reads, preprocesses (metadata view with FX_D3D11, code view with FX_ENTRY=1) and parses an effect file. TG4051: it has no setting of
/// that name. TG1014: it includes a file that lies outside of where it may.
[[nodiscard]] Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options = {});

} // namespace tegument
