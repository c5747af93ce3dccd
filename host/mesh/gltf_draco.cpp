// KHR_draco_mesh_compression (Khronos registry), decoded by Google's library.

#include "host/mesh/gltf_draco.h"

#include <fmt/format.h>

#include <draco/compression/decode.h>

namespace tegument::meshfile {

namespace {

/// `accessor`: of the same attribute. Only it says whether whole numbers stand for 0 to 1: many encoders do not pass that on.
Result<DracoMesh::Values> valuesOf(const draco::Mesh& mesh, std::uint32_t id, const GltfValue& from, const GltfValue& accessor) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
    if (!attribute) return from.wrong(fmt::format("names attribute {}, which the compressed mesh has not", id));
    DracoMesh::Values values{.components = static_cast<std::size_t>(attribute->num_components())};
    values.numbers.resize(values.components * mesh.num_points());
    for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex at = attribute->mapped_index(draco::PointIndex(point));
        const auto components = static_cast<std::int8_t>(values.components);
        if (!attribute->ConvertValue<float>(at, components, &values.numbers[values.components * point]))
            return from.wrong(fmt::format("has an attribute {} whose values cannot be read", id));
    }
    if (!attribute->normalized() && draco::IsDataTypeIntegral(attribute->data_type()))
        for (float& number : values.numbers)
            number = GltfDocument::normalised(number, accessor);
    return values;
}

} // namespace

Result<DracoMesh> readDraco(const GltfDocument& document, const GltfValue& primitive) {
    const GltfValue extension = primitive["extensions"]["KHR_draco_mesh_compression"];
    const auto view = extension.whole("bufferView", SIZE_MAX, {});
    if (!view) return view.error();
    const auto bytes = document.view(*view);
    if (!bytes) return bytes.error();
    draco::DecoderBuffer buffer;
    buffer.Init(bytes->data(), bytes->size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return extension.wrong(fmt::format("cannot be decoded: {}", decoded.status().error_msg_string()));
    const draco::Mesh& mesh = *decoded.value();
    if (mesh.num_points() > kMaxVertices || std::size_t{mesh.num_faces()} * 3 > kMaxIndices) return tooLarge(extension.source().whole());
    DracoMesh result{.vertices = mesh.num_points()};
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (int c = 0; c < 3; ++c) {
            result.corners.push_back(mesh.face(draco::FaceIndex(f))[static_cast<std::size_t>(c)].value());
            if (result.corners.back() >= result.vertices) return extension.wrong("has a face of a vertex that it has not");
        }
    const GltfValue names = extension["attributes"];
    if (!names.json().is_object()) return extension.wrong("has no list of attributes");
    const GltfValue accessors = document.root()["accessors"];
    for (const auto& [name, unused] : names.json().items()) {
        const auto own = primitive["attributes"].whole(name.c_str(), accessors.size(), {});
        const auto id = names.whole(name.c_str(), UINT32_MAX, {});
        if (!id) return id.error();
        auto values = valuesOf(mesh, static_cast<std::uint32_t>(*id), extension, own ? accessors[*own] : extension);
        if (!values) return values.error();
        result.attributes.emplace(name, std::move(*values));
    }
    return result;
}

} // namespace tegument::meshfile
