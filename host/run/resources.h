#pragma once
// The GPU's side of a prepared run: targets, textures, samplers, geometry, pipelines.
// Pipelines and samplers that sessions of one store have in common: an edit changes the passes that it touches, and all others are equal.

#include "host/gpu/gpu.h"
#include "host/run/geometry.h"
#include "host/run/prepare.h"
#include "host/run/program.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace tegument::run {

/// All that a pipeline is made from; of compute passes the program alone.
struct PipelineSource {
    std::shared_ptr<const PassProgram> program;
    PipelineState state{};
    std::vector<gpu::Format> formats{};
    std::optional<gpu::Format> depth{};
    std::uint32_t samples = 1;
};

class SharedPipelines {
public:
    /// Null: nobody has such a one any more.
    [[nodiscard]] std::shared_ptr<const gpu::Pipeline> find(const PipelineSource& source) const;
    void add(PipelineSource source, const std::shared_ptr<const gpu::Pipeline>& pipeline);
    [[nodiscard]] std::shared_ptr<const gpu::Sampler> find(const SamplerState& state) const;
    void add(const SamplerState& state, const std::shared_ptr<const gpu::Sampler>& sampler);

private:
    template <class Source, class Thing>
    struct Entry {
        Source source;
        std::weak_ptr<const Thing> thing;
    };
    std::vector<Entry<PipelineSource, gpu::Pipeline>> pipelines_;
    std::vector<Entry<SamplerState, gpu::Sampler>> samplers_;
};

/// Pipelines depend on the pass, on the formats and samples that it draws into, and on whether what it draws is mirrored.
using PipelineKey = std::tuple<const Pass*, std::vector<gpu::Format>, std::optional<gpu::Format>, std::uint32_t, bool>;

/// The vertex stream of a mesh.
struct Geometry {
    gpu::Buffer vertices;
    gpu::Buffer indices;
    std::uint32_t indexCount = 0;
};

/// Over a mesh's vertices.
struct FewerIndices {
    gpu::Buffer indices;
    std::uint32_t indexCount = 0;
};

/// What all effects of a session share, and the next session of the same scene may take over.
struct Store {
    std::map<std::string, std::shared_ptr<gpu::Texture>> textures; // by TextureData::key
    std::map<std::string, gpu::Texture*> products;                 // likewise; targets of the effects that draw them
    std::set<std::string> uploaded;                                // keys of `textures`
    std::map<std::string, TextureData> loaded;                     // by key: read by another thread, not on the device yet
    std::map<const Mesh*, std::shared_ptr<Geometry>> meshes;
    std::shared_ptr<const FewerTriangles> coarser;               // RunOptions::coarser, that these are of
    std::map<const Mesh*, std::shared_ptr<FewerIndices>> coarse; // of those meshes that a frame has drawn so
    std::shared_ptr<const Geometry> quad;
    SharedPipelines shared;
    KnownFiles known;
};

/// What the frames of one effect share, whatever their targets are.
struct Kit {
    Programs programs;
    std::map<std::string, std::shared_ptr<const gpu::Sampler>> samplers;
    std::map<const Pass*, std::shared_ptr<const gpu::Pipeline>> computes;
    std::map<PipelineKey, std::shared_ptr<const gpu::Pipeline>> pipelines; // draws point at them; made by buildFrame
};

/// An effect that draws textures for others, read and compiled once.
struct Producer {
    Effect effect;
    Kit kit;
};

struct Resources {
    gpu::Device& device;
    Store& store;
    Kit& kit;
    std::map<std::string, gpu::Texture> targets;

    /// What a parameter's name means to an object.
    [[nodiscard]] gpu::Texture* texture(const Prepared& prepared, const std::string& name);
    /// The caller's colour target as a frame leaves it, of one sample a pixel; null before anything is allocated.
    [[nodiscard]] gpu::Texture* picture();
};

/// Everything in `prepared.targets`, `prepared.textures` and what the passes sample with, as far as it is not there yet; the mesh only if a
/// pass draws it.
[[nodiscard]] Result<void> allocate(const RunInput& input, const Prepared& prepared, Resources& resources);

} // namespace tegument::run
