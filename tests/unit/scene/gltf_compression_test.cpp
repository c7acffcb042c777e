#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>

#include "renderers/core/error.h"
#include "tests/unit/scene/gltf_builder.h"

namespace {

using namespace ir;
using test::GltfBuilder;
using test::Json;
using test::load;

/// A curved strip of squares along x.
struct Strip {
    std::vector<float> positions, normals;
    std::vector<std::uint32_t> indices;
};

Strip strip() {
    Strip result;
    constexpr std::uint32_t squares = 40;
    for (std::uint32_t i = 0; i <= squares; ++i)
        for (const float z : {0.0f, 1.0f}) {
            const float x = 0.125f * static_cast<float>(i);
            result.positions.insert(result.positions.end(), {x, std::sin(x), z});
            const auto normal = glm::normalize(glm::vec3(-std::cos(x), 1, 0));
            result.normals.insert(result.normals.end(), {normal.x, normal.y, normal.z});
        }
    for (std::uint32_t i = 0; i < squares; ++i)
        for (const std::uint32_t corner : {0, 1, 2, 2, 1, 3}) result.indices.push_back(2 * i + corner);
    return result;
}

scene::Scene uncompressed() {
    GltfBuilder builder;
    const auto plain = strip();
    const Json attributes = {{"POSITION", builder.floats(plain.positions, "VEC3")},
                             {"NORMAL", builder.floats(plain.normals, "VEC3")}};
    const int indices =
        builder.accessor(builder.view(plain.indices), test::type_uint, "SCALAR", plain.indices.size());
    builder.draw(attributes, indices);
    return load(builder);
}

/// Sorted corners of triangles: compressors may turn triangles and change their order.
std::vector<std::array<float, 18>> triangles(const scene::Mesh& mesh) {
    std::vector<std::array<float, 18>> result;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<std::array<float, 6>, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto p = mesh.positions[mesh.indices[i + c]], n = mesh.normals[mesh.indices[i + c]];
            corners[c] = {p.x, p.y, p.z, n.x, n.y, n.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        auto& triangle = result.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            std::copy(corners[c].begin(), corners[c].end(), triangle.begin() + static_cast<long>(6 * c));
    }
    std::sort(result.begin(), result.end());
    return result;
}

void expect_same_triangles(const scene::Mesh& mesh, const scene::Mesh& other, float tolerance) {
    const auto a = triangles(mesh), b = triangles(other);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 18; ++k) EXPECT_NEAR(a[i][k], b[i][k], tolerance) << i << ", " << k;
}

/// A view of `count` elements of which the first buffer holds the compressed bytes; the buffer that it names
/// is not there.
int compressed_view(GltfBuilder& builder, const std::vector<std::uint8_t>& compressed, const char* mode,
                    std::size_t count, std::size_t stride) {
    const int view = builder.view(compressed);
    auto& fields = builder.json["bufferViews"][view];
    fields["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                       {"byteOffset", fields["byteOffset"]},
                                                       {"byteLength", compressed.size()},
                                                       {"byteStride", stride},
                                                       {"count", count},
                                                       {"mode", mode}};
    fields["buffer"] = 1;
    fields["byteOffset"] = 0;
    fields["byteLength"] = count * stride;
    return view;
}

void close_meshopt(GltfBuilder& builder) {
    const auto first =
        Json{{"byteLength", builder.bytes.size()},
             {"uri", "data:application/octet-stream;base64," + GltfBuilder::base64(builder.bytes)}};
    builder.json["buffers"] = {
        first, {{"byteLength", 100000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_meshopt_compression"};
}

std::vector<std::uint8_t> packed_vertices(const std::vector<float>& values) {
    std::vector<std::uint8_t> result(meshopt_encodeVertexBufferBound(values.size() / 3, 12));
    result.resize(
        meshopt_encodeVertexBuffer(result.data(), result.size(), values.data(), values.size() / 3, 12));
    return result;
}

GltfBuilder meshopt_strip() {
    GltfBuilder builder;
    const auto plain = strip();
    const auto count = plain.positions.size() / 3;
    std::vector<std::uint8_t> indices(meshopt_encodeIndexBufferBound(plain.indices.size(), count));
    indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), plain.indices.data(),
                                             plain.indices.size()));
    Json attributes;
    for (const auto& [name, values] : {std::pair{"POSITION", &plain.positions}, {"NORMAL", &plain.normals}})
        attributes[name] =
            builder.accessor(compressed_view(builder, packed_vertices(*values), "ATTRIBUTES", count, 12),
                             test::type_float, "VEC3", count);
    builder.draw(attributes,
                 builder.accessor(compressed_view(builder, indices, "TRIANGLES", plain.indices.size(), 2),
                                  test::type_ushort, "SCALAR", plain.indices.size()));
    close_meshopt(builder);
    return builder;
}

void expect_refusal(const GltfBuilder& builder, const std::string& place, const std::string& part) {
    try {
        load(builder);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(GltfCompression, MeshoptKeepsAllBits) {
    const auto scene = load(meshopt_strip());
    expect_same_triangles(scene.meshes.at(0), uncompressed().meshes.at(0), 0);
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.extensions.size(), 1u);
    EXPECT_TRUE(scene.extensions[0].is_read);
}

TEST(GltfCompression, MeshoptSequencesOfIndices) {
    GltfBuilder builder;
    const auto plain = strip();
    std::vector<std::uint8_t> indices(meshopt_encodeIndexSequenceBound(plain.indices.size(), 82));
    indices.resize(meshopt_encodeIndexSequence(indices.data(), indices.size(), plain.indices.data(),
                                               plain.indices.size()));
    const Json attributes = {{"POSITION", builder.floats(plain.positions, "VEC3")},
                             {"NORMAL", builder.floats(plain.normals, "VEC3")}};
    builder.draw(attributes,
                 builder.accessor(compressed_view(builder, indices, "INDICES", plain.indices.size(), 4),
                                  test::type_uint, "SCALAR", plain.indices.size()));
    close_meshopt(builder);
    expect_same_triangles(load(builder).meshes.at(0), uncompressed().meshes.at(0), 0);
}

TEST(GltfCompression, MeshoptFiltersOfNormals) {
    GltfBuilder builder;
    const auto plain = strip();
    const auto count = plain.normals.size() / 3;
    std::vector<float> four;
    for (std::size_t i = 0; i < count; ++i)
        four.insert(four.end(),
                    {plain.normals[3 * i], plain.normals[3 * i + 1], plain.normals[3 * i + 2], 0});
    std::vector<std::int8_t> octahedral(4 * count);
    meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, four.data());
    std::vector<std::uint8_t> packed(meshopt_encodeVertexBufferBound(count, 4));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), octahedral.data(), count, 4));
    const int view = compressed_view(builder, packed, "ATTRIBUTES", count, 4);
    builder.json["bufferViews"][view]["byteStride"] = 4;
    builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]["filter"] = "OCTAHEDRAL";
    const Json attributes = {{"POSITION", builder.floats(plain.positions, "VEC3")},
                             {"NORMAL", builder.accessor(view, test::type_byte, "VEC3", count, 0, true)}};
    builder.draw(attributes, builder.accessor(builder.view(plain.indices), test::type_uint, "SCALAR",
                                              plain.indices.size()));
    close_meshopt(builder);
    expect_same_triangles(load(builder).meshes.at(0), uncompressed().meshes.at(0), 0.02f);
}

TEST(GltfCompression, BrokenMeshoptIsRefused) {
    const std::string place = "bufferViews[0].extensions.EXT_meshopt_compression";
    const auto with = [](const char* key, Json value) {
        auto builder = meshopt_strip();
        builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = std::move(value);
        return builder;
    };
    expect_refusal(with("byteLength", 7), place + ".buffer", "cannot be decoded");
    expect_refusal(with("byteLength", 1 << 20), place + ".byteLength", "beyond the end of buffers[0]");
    expect_refusal(with("count", 1 << 30), place, "expands to far more");
    expect_refusal(with("byteStride", 6), place + ".byteStride", "multiple of 4");
    expect_refusal(with("mode", "STRIPS"), place + ".mode", "unknown");
    expect_refusal(with("filter", "OCTAHEDRAL"), place + ".filter", "does not go with");
    expect_refusal(with("count", 10), place + ".buffer", "cannot be decoded");
}

std::vector<std::uint8_t> draco_bytes(int method, int position_bits) {
    const auto plain = strip();
    draco::TriangleSoupMeshBuilder soup;
    const auto faces = static_cast<std::int32_t>(plain.indices.size() / 3);
    soup.Start(faces);
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = soup.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    for (std::int32_t i = 0; i < faces; ++i) {
        const auto* corner = &plain.indices[3 * i];
        for (const auto& [id, values] : {std::pair{position, &plain.positions}, {normal, &plain.normals}})
            soup.SetAttributeValuesForFace(id, draco::FaceIndex(i), &(*values)[3 * corner[0]],
                                           &(*values)[3 * corner[1]], &(*values)[3 * corner[2]]);
    }
    const auto mesh = soup.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    if (position_bits > 0) {
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
    }
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

/// As exporters write it: accessors without a buffer view.
GltfBuilder draco_strip(const std::vector<std::uint8_t>& bytes) {
    GltfBuilder builder;
    const auto plain = strip();
    const int view = builder.view(bytes);
    const auto count = plain.positions.size() / 3;
    const Json attributes = {{"POSITION", builder.accessor(-1, test::type_float, "VEC3", count)},
                             {"NORMAL", builder.accessor(-1, test::type_float, "VEC3", count)}};
    const int mesh =
        builder.draw(attributes, builder.accessor(-1, test::type_ushort, "SCALAR", plain.indices.size()));
    builder.json["meshes"][mesh]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return builder;
}

TEST(GltfCompression, DracoHoldsTheSameMesh) {
    const auto plain = uncompressed();
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const auto scene = load(draco_strip(draco_bytes(method, 0)));
        expect_same_triangles(scene.meshes.at(0), plain.meshes.at(0), 0);
        EXPECT_TRUE(scene.warnings.empty());
    }
    const auto coarse = load(draco_strip(draco_bytes(draco::MESH_EDGEBREAKER_ENCODING, 14)));
    EXPECT_EQ(coarse.meshes.at(0).indices.size(), plain.meshes.at(0).indices.size());
    const auto a = scene::bounds_of(coarse, 0), b = scene::bounds_of(plain, 0);
    EXPECT_LT(glm::distance(a.min, b.min) + glm::distance(a.max, b.max), 1e-3f);
}

TEST(GltfCompression, BrokenDracoIsRefused) {
    const std::string place = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    const auto whole = draco_bytes(draco::MESH_EDGEBREAKER_ENCODING, 14);
    auto half = whole;
    half.resize(whole.size() / 2);
    expect_refusal(draco_strip(half), place + ".bufferView", "cannot be decoded");
    auto other = whole;
    other[0] = 'X';
    expect_refusal(draco_strip(other), place + ".bufferView", "no mesh of Draco");
    auto many = draco_bytes(draco::MESH_SEQUENTIAL_ENCODING, 0);
    constexpr std::size_t counts = 11;  // behind "DRACO", version, types and flags
    many.erase(many.begin() + counts);
    for (const std::uint8_t byte : {0x0f, 0xff, 0xff, 0xff, 0xff}) many.insert(many.begin() + counts, byte);
    expect_refusal(draco_strip(many), place, "expands to far more");
    auto points = draco_bytes(draco::MESH_SEQUENTIAL_ENCODING, 0);
    points.erase(points.begin() + counts + 1);
    for (const std::uint8_t byte : {0x07, 0xff, 0xff, 0xff, 0xff})
        points.insert(points.begin() + counts + 1, byte);
    expect_refusal(draco_strip(points), place + ".bufferView", "cannot be decoded");
    // Two thousand attributes of 255 doubles for each point, whose values do not follow.
    auto wide = draco_bytes(draco::MESH_SEQUENTIAL_ENCODING, 0);
    const std::vector<std::uint8_t> attributes{1, 2, 0, 9, 3, 0, 0, 1, 9, 3, 0, 1};
    const auto found = std::search(wide.begin(), wide.end(), attributes.begin(), attributes.end());
    ASSERT_NE(found, wide.end());
    std::vector<std::uint8_t> more;
    for (int k = 2; k < 2002; ++k)
        for (const int byte : {4, 10, 255, 0, 0x80 | (k & 127), k >> 7})
            more.push_back(static_cast<std::uint8_t>(byte));
    const auto count = found - wide.begin() + 1,
               end = count - 1 + static_cast<std::ptrdiff_t>(attributes.size());
    wide.insert(wide.begin() + end + 2, 2000, 0);  // how each is coded, behind those of the first two
    wide.insert(wide.begin() + end, more.begin(), more.end());
    wide[static_cast<std::size_t>(count)] = 0x80 | (2002 & 127);
    wide.insert(wide.begin() + count + 1, 2002 >> 7);
    expect_refusal(draco_strip(wide), place, "expands to far more");
    auto id = draco_strip(whole);
    auto& extension =
        id.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"];
    extension["NORMAL"] = 7;
    expect_refusal(id, place + ".attributes.NORMAL", "names no attribute");
    auto type = draco_strip(whole);
    type.json["accessors"][1]["type"] = "VEC2";
    expect_refusal(type, place + ".attributes.NORMAL", "number of components");
}

TEST(GltfCompression, InstancesStandWhereTheirAttributesSay) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}}, -1, 4, {{"translation", {0, 5, 0}}});
    builder.json["nodes"][0]["name"] = "leaf";
    const float half = std::sqrt(0.5f);
    const Json attributes = {{"TRANSLATION", builder.floats({1, 0, 0, 0, 0, 3}, "VEC3")},
                             {"ROTATION", builder.floats({0, 0, 0, 1, 0, 0, half, half}, "VEC4")},
                             {"SCALE", builder.floats({1, 1, 1, 2, 2, 2}, "VEC3")}};
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const auto scene = load(builder);
    EXPECT_EQ(scene.instanced_triangles(), 2);
    ASSERT_EQ(scene.nodes.size(), 3u);
    EXPECT_TRUE(scene.nodes[0].meshes.empty());
    EXPECT_EQ(scene.nodes[2].name, "leaf 2");
    const auto bounds = scene::bounds_of(scene, 0);  // the second is turned by 90° about z and twice as large
    EXPECT_LT(glm::distance(bounds.min, glm::vec3(-2, 5, 0)), 1e-5f);
    EXPECT_LT(glm::distance(bounds.max, glm::vec3(2, 7, 3)), 1e-5f);

    builder.json["accessors"][attributes["SCALE"].get<int>()]["count"] = 1;
    expect_refusal(builder, "nodes[0].extensions.EXT_mesh_gpu_instancing", "another number of instances");
    auto many = GltfBuilder();
    many.draw({{"POSITION", many.triangle_positions()}});
    many.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        many.accessor(-1, test::type_float, "VEC3", 2000000000);
    expect_refusal(many, "EXT_mesh_gpu_instancing", "expands to far more");
    many.json["accessors"].back()["count"] = 10000;
    many.json["nodes"][0]["name"] = std::string(100000, 'x');
    expect_refusal(many, "EXT_mesh_gpu_instancing", "expands to far more");
}

}  // namespace
