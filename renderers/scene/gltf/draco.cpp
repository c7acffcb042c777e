#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>

#include "renderers/scene/gltf/compression.h"
#include "renderers/scene/gltf/expansion_budget.h"

namespace ir::scene::gltf {
namespace {

struct Announced {
    std::uint32_t faces;
    bool is_edgebreaker;
};

/// Number of faces that a bitstream announces [Draco bitstream 2.2, "Decode Header", "Decode Connectivity
/// Data"]. The library takes memory for as many before it reads them. Nothing where the stream is no mesh of
/// that version.
std::optional<Announced> announced_faces(const std::uint8_t* bytes, std::size_t length) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes), length);
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return {};
    if (header.version_major != 2 || header.version_minor != 2) return {};
    if (header.encoder_type != draco::TRIANGULAR_MESH) return {};
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    if (header.flags & METADATA_FLAG_MASK) {
        draco::GeometryMetadata ignored;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored)) return {};
    }
    std::uint32_t vertices = 0, faces = 0;
    const bool is_edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    if (is_edgebreaker) {
        std::uint8_t traversal;
        if (!buffer.Decode(&traversal) || !draco::DecodeVarint(&vertices, &buffer)) return {};
    }
    if (!draco::DecodeVarint(&faces, &buffer)) return {};
    return Announced{faces, is_edgebreaker};
}

/// Takes the memory of attributes only where so much is left: a stream tells how many values follow, and may
/// have none.
template <class Decoder>
class BoundedDecoder : public Decoder {
  public:
    explicit BoundedDecoder(std::size_t left) : left_(left) {}
    std::size_t wanted() const { return wanted_; }

  protected:
    bool DecodeAllAttributes() override {
        const auto& mesh = *this->point_cloud();
        std::size_t point_bytes = sizeof(std::uint32_t);
        for (int i = 0; i < mesh.num_attributes(); ++i) {
            const auto* attribute = mesh.attribute(i);
            const auto value_bytes = static_cast<std::size_t>(draco::DataTypeLength(attribute->data_type()));
            // As read, as a number of the prediction, and which point has it.
            point_bytes +=
                static_cast<std::size_t>(attribute->num_components()) * (value_bytes + sizeof(std::int32_t)) +
                sizeof(std::uint32_t);
        }
        wanted_ = point_bytes * mesh.num_points();
        return wanted_ <= left_ && Decoder::DecodeAllAttributes();
    }

  private:
    const std::size_t left_;
    std::size_t wanted_ = 0;
};

template <class T>
bool copy_values(const draco::PointAttribute& attribute, std::uint32_t points, int components,
                 Bytes& result) {
    std::vector<T> value(components);
    result.resize(std::size_t{points} * components * sizeof(T));
    for (std::uint32_t point = 0; point < points; ++point) {
        const auto index = attribute.mapped_index(draco::PointIndex(point));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(index, static_cast<std::int8_t>(components), value.data()))
            return false;
        std::memcpy(result.data() + std::size_t{point} * components * sizeof(T), value.data(),
                    components * sizeof(T));
    }
    return true;
}

/// All values of an attribute as a glTF component type; false where they are not.
bool values_of(const draco::PointAttribute& attribute, std::uint32_t points, int components, int type,
               Bytes& result) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return copy_values<std::int8_t>(attribute, points, components, result);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return copy_values<std::uint8_t>(attribute, points, components, result);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return copy_values<std::int16_t>(attribute, points, components, result);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return copy_values<std::uint16_t>(attribute, points, components, result);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return copy_values<std::uint32_t>(attribute, points, components, result);
        default:
            return copy_values<float>(attribute, points, components, result);
    }
}

Bytes indices_of(const draco::Mesh& mesh) {
    Bytes result(std::size_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t));
    auto* written = result.data();
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
        for (const auto& point : mesh.face(draco::FaceIndex(i))) {
            const auto index = point.value();
            std::memcpy(written, &index, sizeof index);
            written += sizeof index;
        }
    return result;
}

/// Decodes the primitives of one document.
class DracoReader {
  public:
    DracoReader(Document& document, Checking& checking)
        : document_(document), checking_(checking), budget_(document) {}

    /// `primitive` is what is checked of it.
    void read(const std::string& place, const Json& source, Json& primitive) {
        const CheckedObject owner(document_.file, place, source);
        const auto* extension = owner.extension(draco_compression);
        if (!extension) return;
        if (const int mode = primitive.value("mode", TINYGLTF_MODE_TRIANGLES);
            mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP)
            owner.fail("mode", "must be 4 or 5, for Draco holds triangles; export the file again");
        CheckedObject object(document_.file, owner.place(std::string("extensions.") + draco_compression),
                             *extension);
        const auto mesh = decode(object);
        CheckedObject ids(document_.file, object.place("attributes"), object.required_object("attributes"));
        for (auto& [name, accessor] : primitive["attributes"].items())
            if (const auto id = ids.integer(name.c_str(), 0, UINT32_MAX))
                accessor = attribute(ids, name, *mesh, static_cast<std::uint32_t>(*id), accessor.get<int>());
        primitive["indices"] =
            add_accessor(indices_of(*mesh), {{"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                                             {"type", "SCALAR"},
                                             {"count", std::size_t{mesh->num_faces()} * 3}});
        primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
    }

  private:
    std::unique_ptr<draco::Mesh> decode(CheckedObject& object) {
        const auto view = object.required(
            object.index("bufferView", checking_.count("bufferViews"), "bufferViews"), "bufferView");
        const auto& fields = checking_.checked["bufferViews"][view];
        const auto& buffer = document_.buffers[fields["buffer"].get<std::size_t>()];
        if (!buffer.present) object.fail("bufferView", "lies in a buffer without data");
        const auto* bytes = buffer.bytes.data() + fields.value("byteOffset", std::size_t{0});
        const auto length = fields["byteLength"].get<std::size_t>();
        const auto announced = announced_faces(bytes, length);
        if (!announced)
            object.fail("bufferView", "holds no mesh of Draco's bitstream 2.2; export the file again");
        constexpr std::size_t face_bytes = 128;  // of the library's tables, and of what is read from them
        budget_.spend(announced->faces * face_bytes, object.place());
        draco::DecoderBuffer source;
        source.Init(reinterpret_cast<const char*>(bytes), length);
        auto mesh = std::make_unique<draco::Mesh>();
        const bool is_whole = announced->is_edgebreaker
                                  ? decode_by<draco::MeshEdgebreakerDecoder>(source, *mesh, object.place())
                                  : decode_by<draco::MeshSequentialDecoder>(source, *mesh, object.place());
        if (!is_whole || mesh->num_faces() == 0)
            object.fail("bufferView", "holds data that cannot be decoded; export the file again");
        return mesh;
    }

    template <class Decoder>
    bool decode_by(draco::DecoderBuffer& source, draco::Mesh& mesh, const std::string& place) {
        BoundedDecoder<Decoder> decoder(budget_.left());
        const bool is_whole = decoder.Decode(draco::DecoderOptions(), &source, &mesh).ok();
        budget_.spend(decoder.wanted(), place);
        return is_whole;
    }

    /// The accessor of what is decoded, in the type of the file's.
    int attribute(const CheckedObject& ids, const std::string& name, const draco::Mesh& mesh,
                  std::uint32_t id, int accessor) {
        if (!checking_.accessor_problems[accessor].empty()) return accessor;
        const auto* attribute = mesh.GetAttributeByUniqueId(id);
        if (!attribute) ids.fail(name, "names no attribute of the mesh; export the file again");
        auto fields = checking_.checked["accessors"][accessor];
        const int components =
            attribute->num_components() > 4 ? 0 : static_cast<int>(attribute->num_components());
        const auto type = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
        if (type != fields["type"])
            ids.fail(name, "has another number of components than its accessor; export the file again");
        const auto component_type = fields["componentType"].get<int>();
        budget_.spend(
            std::size_t{mesh.num_points()} * components * tinygltf::GetComponentSizeInBytes(component_type),
            ids.place(name));
        Bytes bytes;
        if (!values_of(*attribute, mesh.num_points(), components, component_type, bytes))
            ids.fail(name, "has values that its accessor's componentType cannot hold; export the file again");
        return add_accessor(std::move(bytes), {{"componentType", component_type},
                                               {"type", type},
                                               {"count", mesh.num_points()},
                                               {"normalized", fields.value("normalized", false)}});
    }

    int add_accessor(Bytes bytes, Json fields) {
        const auto length = bytes.size();
        const auto append = [&](const char* array, Json value) {
            checking_.checked[array].push_back(std::move(value));
            return static_cast<int>(checking_.checked[array].size()) - 1;
        };
        fields["bufferView"] = append(
            "bufferViews", {{"buffer", add_buffer(document_, std::move(bytes))}, {"byteLength", length}});
        checking_.accessor_problems.emplace_back();
        return append("accessors", std::move(fields));
    }

    Document& document_;
    Checking& checking_;
    ExpansionBudget budget_;
};

}  // namespace

void decode_draco(Document& document, Checking& checking) {
    DracoReader reader(document, checking);
    for (std::size_t m = 0; m < checking.count("meshes"); ++m) {
        const auto& sources = checking.source["meshes"][m]["primitives"];
        for (std::size_t p = 0; p < sources.size(); ++p)
            reader.read(element("meshes", m) + "." + element("primitives", p), sources[p],
                        checking.checked["meshes"][m]["primitives"][p]);
    }
}

}  // namespace ir::scene::gltf
