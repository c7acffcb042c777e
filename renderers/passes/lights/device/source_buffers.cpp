#include "renderers/passes/lights/device/source_buffers.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "renderers/core/record.h"
#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/light_choice.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/lights/triangle_lights.h"
#include "shaders/passes/lights/sources.glsl.h"

namespace ir::passes {
namespace {

/// A world's sources as the shaders read them.
class FlattenedSources {
  public:
    FlattenedSources(const graph::FrameInputs& inputs, const LightSampler::Options& options)
        : scene_(*inputs.scene),
          world_(*inputs.world),
          surfaces_(scene_, world_, false, false),
          sampler_(surfaces_, options),
          nodes_(sampler_.choice().tree().flattened()) {
        if (const auto* light = sampler_.environment_light()) environment_ = light->tables();
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            if (i == 0 || nodes_[i].children > 0) continue;
            node_of_.resize(std::max<std::size_t>(node_of_.size(), nodes_[i].source + 1), no_light_node);
            node_of_[nodes_[i].source] = i;
        }
    }

    SourceTotals totals() const {
        const auto* triangles = sampler_.triangles();
        const auto* environment = sampler_.environment_light();
        return {.sky = environment ? environment->radiance({0, 1, 0}) : glm::vec3(0),
                .tree_weight = sampler_.choice().tree_weight(),
                .environment_weight = sampler_.choice().environment_weight(),
                .lamps = static_cast<std::uint32_t>(sampler_.lamps().size()),
                .triangles = triangles ? static_cast<std::uint32_t>(triangles->size()) : 0,
                .map_width = environment_.width,
                .map_height = environment_.height};
    }
    const std::vector<LightNode>& nodes() const { return nodes_; }
    const EnvironmentLight::Tables& environment() const { return environment_; }

    std::vector<LampData> lamps() const {
        std::vector<LampData> result;
        for (const auto& lamp : sampler_.lamps())
            result.push_back({.centre_ws = lamp.centre_ws(),
                              .half_width = lamp.half_size().x,
                              .normal_ws = lamp.normal_ws(),
                              .half_height = lamp.half_size().y,
                              .width_ws = lamp.width_ws(),
                              .area = lamp.area(),
                              .height_ws = lamp.height_ws(),
                              .is_disk = lamp.is_disk() ? 1u : 0u,
                              .radiance = lamp.radiance(),
                              .node = node_of(result.size())});
        return result;
    }

    std::vector<EmissiveTriangle> triangles() const {
        std::vector<EmissiveTriangle> result;
        const auto* triangles = sampler_.triangles();
        const auto lamps = sampler_.lamps().size();
        for (std::size_t i = 0; triangles && i < triangles->size(); ++i)
            result.push_back(triangle((*triangles)[i], node_of(lamps + i)));
        return result;
    }

    std::vector<std::uint32_t> numbers() const {
        const auto* triangles = sampler_.triangles();
        if (!triangles || triangles->size() == 0) return {no_light_node};
        std::vector<std::uint32_t> result(world_.triangles(), no_light_node);
        for (std::size_t i = 0; i < triangles->size(); ++i)
            result[(*triangles)[i].index] = static_cast<std::uint32_t>(i);
        return result;
    }

  private:
    std::uint32_t node_of(std::size_t source) const {
        return source < node_of_.size() ? node_of_[source] : no_light_node;
    }

    /// Of the corners, in a texture.
    std::array<glm::vec2, 3> uv_of(std::uint32_t triangle, const scene::TextureSlot& slot) const {
        const auto& uvs = slot.uv_set == 1 ? world_.uv1 : world_.uv0;
        std::array<glm::vec2, 3> result{};
        for (std::size_t c = 0; c < result.size(); ++c)
            result[c] = scene::transformed_uv(slot, uvs[world_.indices[3 * std::size_t{triangle} + c]]);
        return result;
    }

    EmissiveTriangle triangle(const TriangleLights::Triangle& t, std::uint32_t node) const {
        const auto number = world_.triangle_materials[t.index];
        const auto& material = scene_.materials[number];
        EmissiveTriangle result{.corner_ws = t.corner,
                                .node = node,
                                .edge_u_ws = t.edge_u,
                                .texture = material.emission_texture.texture,
                                .edge_v_ws = t.edge_v,
                                .mask = t.index < world_.opaque_triangles ? 0 : number + 1,
                                .emission = material.emission,
                                .triangle = t.index};
        if (result.texture >= 0) result.uv = uv_of(t.index, material.emission_texture);
        if (result.mask > 0) result.mask_uv = uv_of(t.index, material.base_colour_texture);
        return result;
    }

    const scene::Scene& scene_;
    const scene::World& world_;
    SurfaceLookup surfaces_;
    LightSampler sampler_;
    std::vector<LightNode> nodes_;
    std::vector<std::uint32_t> node_of_;  ///< of each source
    EnvironmentLight::Tables environment_;
};

void upload_sources(const graph::PassContext& context, const SourceBuffers& to, bool environment) {
    const FlattenedSources made(context.inputs(), {.punctual = false, .environment = environment});
    const auto put = [&](auto ref, const auto& values) {
        if (!values.empty()) context.upload(ref, std::as_bytes(std::span(values)));
    };
    put(to.totals, std::vector{made.totals()});
    put(to.nodes, made.nodes());
    put(to.lamps, made.lamps());
    put(to.triangles, made.triangles());
    put(to.numbers, made.numbers());
    put(to.environment_rows, made.environment().rows);
    put(to.environment_map, made.environment().texels);
    put(to.environment_columns, made.environment().columns);
}

/// Keys begin with it. Pictures may have light with and without that of the environment.
std::string prefix_of(bool environment) {
    return environment ? "light." : "light.placed.";
}

/// Those of an earlier call for the same frame.
std::optional<SourceBuffers> declared_sources(const graph::GraphBuilder& builder, const std::string& prefix) {
    if (!graph::declared_buffer(builder, prefix + "sources")) return {};
    const auto buffer = [&](const char* part) {
        return graph::declared_buffer(builder, prefix + part).value();
    };
    const auto image = [&](const char* part) {
        return graph::declared_image(builder, prefix + part).value();
    };
    return SourceBuffers{.totals = buffer("sources"),
                         .nodes = buffer("nodes"),
                         .lamps = buffer("lamps"),
                         .triangles = buffer("triangles"),
                         .numbers = buffer("numbers"),
                         .environment_rows = buffer("environment_rows"),
                         .environment_map = image("environment_map"),
                         .environment_columns = image("environment_columns")};
}

}  // namespace

SourceBuffers source_buffers(graph::GraphBuilder& builder, bool environment, std::uint64_t max_triangles) {
    const auto prefix = prefix_of(environment);
    if (const auto known = declared_sources(builder, prefix)) return *known;
    const auto& inputs = builder.inputs();
    std::string fingerprint;
    if (!inputs.world_fingerprint.empty())
        fingerprint = inputs.world_fingerprint + " sources" + (environment ? " environment" : "");
    const auto buffer = [&](const std::string& part, const std::string& label,
                            std::vector<graph::Field> fields, std::uint64_t elements) {
        return builder.buffer({.text = {.key = prefix + part, .label = label},
                               .fields = std::move(fields),
                               .elements = std::max<std::uint64_t>(1, elements),
                               .fingerprint = fingerprint});
    };
    const auto image = [&](const std::string& part, const std::string& label, gl::Format format, int width,
                           int height) {
        return builder.image({.text = {.key = prefix + part, .label = label},
                              .format = format,
                              .extent = graph::Extent::fixed(width, height),
                              .fingerprint = fingerprint});
    };
    const auto& map = inputs.scene->environment.map;
    const bool has_map = environment && map && !map->empty();
    const int width = has_map ? map->width : 0, height = has_map ? map->height : 0;
    const std::uint64_t lamps = inputs.world->lights.size();
    SourceBuffers result;
    result.totals = buffer("sources", "Sources with an extent, together", record_fields<SourceTotals>(), 1);
    result.nodes =
        buffer("nodes", "Tree of light sources", record_fields<LightNode>(), 2 * (lamps + max_triangles) + 1);
    result.lamps = buffer("lamps", "Rectangles and disks", record_fields<LampData>(), lamps);
    result.triangles =
        buffer("triangles", "Emissive triangles", record_fields<EmissiveTriangle>(), max_triangles);
    result.numbers = buffer("numbers", "Which triangles are emissive", {{"number", graph::FieldType::u32}},
                            max_triangles > 0 ? inputs.world->triangles() : 1);
    result.environment_rows =
        buffer("environment_rows", "Distribution over the environment's rows",
               {{"value", graph::FieldType::f32}}, 3 * static_cast<std::uint64_t>(height) + 2);
    result.environment_map = image("environment_map", "Environment map", gl::Format::rgba32f,
                                   std::max(1, width), std::max(1, height));
    result.environment_columns =
        image("environment_columns", "Distribution over the texels of the environment's rows",
              gl::Format::r32f, std::max(1, width), std::max(1, height));
    builder.pass(environment ? "upload light sources" : "upload placed light sources")
        .writes(result.totals, result.nodes, result.lamps, result.triangles, result.numbers,
                result.environment_rows, result.environment_map, result.environment_columns)
        .execute([=](graph::PassContext& context) { upload_sources(context, result, environment); });
    return result;
}

}  // namespace ir::passes
