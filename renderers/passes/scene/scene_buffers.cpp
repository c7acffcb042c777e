#include "renderers/passes/scene/scene_buffers.h"

#include <bit>

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/scene/material_data.h"

namespace ir::passes {
namespace {

using graph::BufferDesc;
using graph::BufferRef;
using graph::Field;
using graph::FieldType;
using graph::GraphBuilder;
using graph::ImageRef;
using graph::PassContext;

static_assert(sizeof(glm::vec2) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::mat4) == 64,
              "world arrays are uploaded as they lie in memory");

static_assert(static_cast<int>(scene::LightType::point) == light_point &&
              static_cast<int>(scene::LightType::spot) == light_spot &&
              static_cast<int>(scene::LightType::directional) == light_directional &&
              static_cast<int>(scene::LightType::rectangle) == light_rectangle &&
              static_cast<int>(scene::LightType::disk) == light_disk);

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& data) {
    return std::as_bytes(std::span(data));
}

/// Where all stand still, one zero stands for all vertices.
std::span<const glm::vec3> ways_to_previous(const scene::World& world) {
    static const glm::vec3 none(0);
    return world.to_previous.empty() ? std::span(&none, 1) : std::span(world.to_previous);
}

BufferRef declare(GraphBuilder& builder, const std::string& part, const std::string& name,
                  const std::string& label, std::vector<Field> fields, std::size_t elements,
                  const std::string& unit = {}) {
    BufferDesc desc;
    desc.text = {.key = "scene." + part, .label = label, .unit = unit};
    desc.name = name;
    desc.fields = std::move(fields);
    desc.elements = elements;
    desc.fingerprint = builder.inputs().geometry_fingerprint;
    return builder.buffer(std::move(desc));
}

/// The world's lights change while its geometry stands still.
BufferRef declare_lights(GraphBuilder& builder) {
    BufferDesc desc;
    desc.text = {.key = "scene.lights", .label = "Lights"};
    desc.name = "Lights";
    desc.fields = record_fields<LightData>();
    desc.elements = builder.inputs().world->lights.size();
    desc.fingerprint = builder.inputs().world_fingerprint;
    return builder.buffer(std::move(desc));
}

SceneBuffers declare_buffers(GraphBuilder& builder) {
    const auto& scene = *builder.inputs().scene;
    const auto& world = *builder.inputs().world;
    const auto vertices = world.positions.size();
    const Field number{"index", FieldType::u32};
    SceneBuffers b;
    b.positions = declare(builder, "positions", "ScenePositions", "Vertex positions",
                          {{"position", FieldType::f32, 3}}, vertices, "m");
    b.normals = declare(builder, "normals", "SceneNormals", "Vertex normals", {{"normal", FieldType::f32, 3}},
                        vertices);
    b.tangents = declare(builder, "tangents", "SceneTangents", "Vertex tangents",
                         {{"tangent", FieldType::f32, 4}}, vertices);
    b.uv0 =
        declare(builder, "uv0", "SceneUv0", "Texture coordinates 0", {{"uv", FieldType::f32, 2}}, vertices);
    b.uv1 =
        declare(builder, "uv1", "SceneUv1", "Texture coordinates 1", {{"uv", FieldType::f32, 2}}, vertices);
    b.colours =
        declare(builder, "colours", "SceneColours", "Vertex colours", {{"rgba8", FieldType::u32}}, vertices);
    b.to_previous = declare(builder, "to_previous", "SceneToPrevious", "Way to the previous positions",
                            {{"way", FieldType::f32, 3}}, ways_to_previous(world).size(), "m");
    b.indices = declare(builder, "indices", "SceneIndices", "Triangles", {{"vertex", FieldType::u32, 3}},
                        world.triangles());
    b.triangle_materials = declare(builder, "triangle_materials", "SceneTriangleMaterials",
                                   "Material of each triangle", {number}, world.triangles());
    b.materials = declare(builder, "materials", "Materials", "Materials", record_fields<MaterialData>(),
                          scene.materials.size());
    b.lights = declare_lights(builder);
    b.opacity = declare(builder, "opacity", "Opacity", "Alpha mask of each material",
                        record_fields<OpacityData>(), scene.materials.size());
    b.opacity_words = declare(builder, "opacity_words", "OpacityWords", "Alpha masks, one bit a texel",
                              {{"bits", FieldType::u32}}, world.opacity_words.size());
    return b;
}

void upload_world(const PassContext& p, const SceneBuffers& b) {
    const auto& scene = *p.inputs().scene;
    const auto& world = *p.inputs().world;
    p.upload(b.positions, bytes_of(world.positions));
    p.upload(b.normals, bytes_of(world.normals));
    p.upload(b.tangents, bytes_of(world.tangents));
    p.upload(b.uv0, bytes_of(world.uv0));
    p.upload(b.uv1, bytes_of(world.uv1));
    p.upload(b.colours, bytes_of(world.colours));
    p.upload(b.to_previous, std::as_bytes(ways_to_previous(world)));
    p.upload(b.indices, bytes_of(world.indices));
    p.upload(b.triangle_materials, bytes_of(world.triangle_materials));
    p.upload(b.materials, bytes_of(material_data(scene)));
    p.upload(b.opacity, bytes_of(opacity_data(scene, world)));
    p.upload(b.opacity_words, bytes_of(world.opacity_words));
}

int level_count(const scene::Texture& texture) {
    if (!texture.sampler.mipmaps) return 1;
    return std::bit_width(static_cast<unsigned>(std::max(texture.width, texture.height)));
}

std::vector<ImageRef> declare_textures(GraphBuilder& builder) {
    const auto& scene = *builder.inputs().scene;
    std::vector<ImageRef> refs;
    for (const auto& texture : scene.textures) {
        const auto number = std::to_string(refs.size());
        graph::ImageDesc desc;
        desc.text = {.key = "scene.texture." + number,
                     .label = texture.name.empty() ? "Texture " + number : "Texture " + texture.name};
        desc.format = texture.srgb ? gl::Format::srgba8 : gl::Format::rgba8;
        desc.extent = graph::Extent::fixed(texture.width, texture.height);
        desc.levels = level_count(texture);
        // the textures of an animated scene stay while its world changes
        desc.fingerprint = scene.content_hash.empty() ? "" : scene.content_hash + " texture " + number;
        refs.push_back(builder.image(std::move(desc)));
    }
    return refs;
}

void upload_textures(const PassContext& p, const std::vector<ImageRef>& refs) {
    const auto& textures = p.inputs().scene->textures;
    for (std::size_t i = 0; i < refs.size(); ++i) {
        p.upload(refs[i], std::as_bytes(std::span(textures[i].rgba)));
        if (p.shape(refs[i]).levels > 1) p.api().GenerateTextureMipmap(p.image(refs[i]));
    }
}

}  // namespace

SceneBuffers upload_scene(GraphBuilder& builder) {
    auto buffers = declare_buffers(builder);
    buffers.textures = declare_textures(builder);
    builder.pass("upload scene")
        .writes(buffers.positions, buffers.normals, buffers.tangents, buffers.uv0, buffers.uv1,
                buffers.colours, buffers.to_previous, buffers.indices, buffers.triangle_materials,
                buffers.materials, buffers.opacity, buffers.opacity_words)
        .execute([buffers](PassContext& p) { upload_world(p, buffers); });
    builder.pass("upload lights").writes(buffers.lights).execute([lights = buffers.lights](PassContext& p) {
        p.upload(lights, bytes_of(light_data(p.inputs().world->lights)));
    });
    if (buffers.textures.empty()) return buffers;
    auto textures = builder.pass("upload textures");
    for (const auto texture : buffers.textures) textures.writes(texture);
    textures.execute([refs = buffers.textures](PassContext& p) { upload_textures(p, refs); });
    return buffers;
}

}  // namespace ir::passes
