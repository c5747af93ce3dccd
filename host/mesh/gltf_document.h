#pragma once
// Inside host/mesh only: a glTF 2.0 file opened: its JSON, its buffers, and the accessors as numbers. Every offset and count is held
// against the bytes that are really there. tinygltf is not used: see docs/meshes.md.

#include "host/mesh/gltf_json.h"

#include <deque>
#include <map>
#include <memory>

namespace tegument::meshfile {

class GltfDocument {
public:
    [[nodiscard]] static Result<std::unique_ptr<GltfDocument>> open(const Source& source);

    [[nodiscard]] GltfValue root() const { return {*source_, json_, ""}; }
    [[nodiscard]] const Source& source() const { return *source_; }

    /// `components` numbers per element, converted to float (normalised integers to -1..1 or 0..1), sparse substitutions applied.
    [[nodiscard]] Result<std::vector<float>> floats(std::size_t accessor, std::size_t components) const;
    /// A number as the accessor's elements stand for: whole numbers to -1..1 or 0..1 where it says that they are normalised.
    [[nodiscard]] static float normalised(float value, const GltfValue& accessor);
    /// Unsigned integers of a SCALAR accessor.
    [[nodiscard]] Result<std::vector<std::uint32_t>> indices(std::size_t accessor) const;
    /// How many numbers an element of the accessor has, 1 to 4; 0 for matrices and accessors that do not exist.
    [[nodiscard]] std::size_t components(std::size_t accessor) const;
    /// The bytes of a buffer view; those of EXT_meshopt_compression unpacked.
    [[nodiscard]] Result<std::string_view> view(std::size_t bufferView) const;
    /// What a `uri` stands for: a data URI decoded, or a file beside this one.
    [[nodiscard]] Result<std::string> resolveUri(const GltfValue& owner, const std::string& uri) const;

private:
    /// One typed run of elements inside a buffer view.
    struct Run {
        std::string_view bytes; // from its first element on
        std::size_t stride = 0;
        std::size_t count = 0;
        std::size_t componentType = 0;
        std::size_t components = 0;
        bool normalized = false;
    };

    explicit GltfDocument(const Source& source) : source_(&source) {}
    std::optional<Error> readGlb();
    std::optional<Error> parse(std::string_view text, std::size_t offset);
    std::optional<Error> checkExtensions() const;
    std::optional<Error> readBuffers();
    [[nodiscard]] Result<Run> describe(const GltfValue& accessor, std::size_t components) const;
    [[nodiscard]] Result<Run> place(const GltfValue& owner, Run run) const;
    [[nodiscard]] std::optional<Error> applySparse(const GltfValue& accessor, const Run& shape, std::vector<float>& values) const;
    [[nodiscard]] Result<GltfValue> item(const char* list, std::size_t index) const;
    [[nodiscard]] Result<std::string_view> bytesOf(const GltfValue& view) const;
    [[nodiscard]] Result<std::string_view> unpacked(std::size_t bufferView, const GltfValue& packed) const;

    const Source* source_;
    Json json_;
    std::string_view glbBuffer_;
    bool hasGlbBuffer_ = false;
    std::deque<std::string> owned_; // buffers that are not part of the file
    std::vector<std::string_view> buffers_;
    mutable std::map<std::size_t, std::string> unpacked_; // by buffer view
};

/// A mesh of the file as a node draws it.
struct GltfPlace {
    std::size_t mesh = 0;
    glm::dmat4 matrix{1}; // to the world, times the unit
};
/// Of the default scene, one for each node or instance. TG5302 where nodes are no trees, TG5310 where they draw more than a mesh may hold.
/// `warnings` gets what is ignored.
[[nodiscard]] Result<std::vector<GltfPlace>> gltfPlaces(const GltfDocument& document, Mesh& warnings);

} // namespace tegument::meshfile
