#include "renderers/passes/gbuffer/gbuffer_on_host.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

#include "renderers/core/half_float.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/gbuffer/peeling.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "renderers/passes/surface/surface.h"
#include "shaders/passes/gbuffer/gbuffer.frag.h"

namespace ir::passes {
namespace {

/// Pixels of a side of the squares that a packet of rays goes through.
constexpr int side = 4;

struct Ray {
    glm::vec3 origin, direction;
};

/// A pixel's ray and where it meets a triangle's plane.
class PixelPlanes {
  public:
    PixelPlanes(const scene::View& view, const SurfaceLookup& surfaces)
        : surfaces_(surfaces), rays_(pixel_rays(view)) {}

    Ray ray(glm::vec2 at) const {
        return {rays_.origin + at.x * rays_.origin_dx + at.y * rays_.origin_dy,
                rays_.direction + at.x * rays_.direction_dx + at.y * rays_.direction_dy};
    }

    struct Met {
        glm::vec2 at;
        Ray centre;
        glm::vec3 unit, point;  ///< of the ray, of length one; where it was hit
        glm::vec3 normal, anchor;
    };
    Met meet(glm::vec2 at, const Hit& hit) const {
        Met met;
        met.at = at;
        met.centre = ray(at);
        met.unit = glm::normalize(met.centre.direction);
        std::tie(met.normal, met.anchor) = surfaces_.plane(hit.triangle);
        met.point = met.centre.origin + hit.distance * met.unit;
        return met;
    }
    /// Rasterisation interpolates from pixel to pixel, also beyond the triangle.
    Footprint footprint(const Met& met) const {
        return {on_plane(met, ray({met.at.x + 1, met.at.y})) - met.point,
                on_plane(met, ray({met.at.x, met.at.y + 1})) - met.point};
    }
    /// Where a pixel's ray meets the plane; edge-on, the point that was hit.
    static glm::vec3 on_plane(const Met& met, const Ray& ray) {
        const float along = glm::dot(met.normal, ray.direction);
        const float depth = glm::dot(met.normal, met.anchor - ray.origin) / along;
        return std::isfinite(depth) ? ray.origin + depth * ray.direction : met.point;
    }

  private:
    const SurfaceLookup& surfaces_;
    PixelRays rays_;
};

glm::vec2 centre_of(int x, int y) {
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

/// Where things were in the previous frame.
glm::vec4 position_before(const scene::World& world, const Hit& hit, glm::vec3 position) {
    if (world.to_previous.empty()) return glm::vec4(position, 1);
    const auto* corner = &world.indices[3 * static_cast<std::size_t>(hit.triangle)];
    const auto way = [&](int i) { return world.to_previous[corner[i]]; };
    return glm::vec4(position + (1 - hit.u - hit.v) * way(0) + hit.u * way(1) + hit.v * way(2), 1);
}

/// What the rays go through, and the pixels that they fill.
class HostGBuffer {
  public:
    /// `nearer`: positions of the layer before; the first layer has none.
    HostGBuffer(const graph::PassContext& context, const GBuffer& g, const Bvh& bvh,
                const SurfaceLookup& surfaces, std::vector<Hit>& hits, std::span<const glm::vec4> nearer)
        : inputs_(context.inputs()),
          bvh_(bvh),
          surfaces_(surfaces),
          planes_(inputs_.view, surfaces),
          has_glass_(has_glass(inputs_)),
          previous_depth_row_(-glm::vec4(glm::transpose(inputs_.previous_view.view_from_world)[2])),
          hits_(hits),
          nearer_(nearer),
          position_(context.pixels<glm::vec4>(g.position)),
          geometric_normal_(context.pixels<glm::vec4>(g.geometric_normal)),
          normal_(context.pixels<std::uint64_t>(g.normal)),
          valid_(context.pixels<std::uint8_t>(g.valid)) {}

    void fill_rows(int first, int end) const {
        for (int x = 0; x < inputs_.view.width; x += side) fill(x, first, end);
    }

  private:
    void fill(int first_x, int first_y, int end_y) const {
        Bvh::Packet16 packet;
        for (int i = 0; i < side * side; ++i) {
            const int x = first_x + i % side, y = first_y + i / side;
            const auto [origin, direction] = planes_.ray(centre_of(x, y));
            const float length = glm::length(direction);
            packet.ox[i] = origin.x, packet.oy[i] = origin.y, packet.oz[i] = origin.z;
            packet.dx[i] = direction.x / length, packet.dy[i] = direction.y / length;
            packet.dz[i] = direction.z / length;
            packet.near[i] = inputs_.view.near_plane * length;
            packet.far[i] = inputs_.view.far_plane * length;
            packet.active[i] = x < inputs_.view.width && y < end_y ? -1 : 0;
            if (packet.active[i] == 0 || nearer_.empty()) continue;
            const auto& before = nearer_[static_cast<std::size_t>(y) * inputs_.view.width + x];
            packet.near[i] =
                std::max(packet.near[i], peeled_beyond * glm::distance(glm::vec3(before), origin));
            if (before.w <= 0) packet.active[i] = 0;
        }
        Hit hits[side * side];
        bvh_.closest_hits16(packet, true, hits);
        for (int i = 0; i < side * side; ++i) {
            if (packet.active[i] == 0) continue;
            const int x = first_x + i % side, y = first_y + i / side;
            const auto pixel = static_cast<std::size_t>(y) * inputs_.view.width + x;
            hits_[pixel] = hits[i];
            if (hits[i].is_hit()) set(pixel, centre_of(x, y), hits[i]);
        }
    }

    /// Pixels of the background stay zero.
    void set(std::size_t pixel, glm::vec2 at, const Hit& hit) const {
        const auto met = planes_.meet(at, hit);
        const bool is_mapped = surfaces_.has_normal_map(hit.triangle);
        const auto towards = nearer_.empty() ? met.unit : -met.normal;
        const auto s =
            surfaces_.shape(hit, towards, is_mapped ? planes_.footprint(met) : Footprint(), met.normal);
        const bool is_edge_on = std::abs(glm::dot(met.normal, met.unit)) < 1e-3f;
        const auto position = is_edge_on ? met.point : PixelPlanes::on_plane(met, met.centre);
        position_[pixel] = glm::vec4(position, glm::distance(position, inputs_.view.eye_ws));
        const auto before = position_before(*inputs_.world, hit, position);
        geometric_normal_[pixel] = glm::vec4(s.geometric_normal_ws, glm::dot(previous_depth_row_, before));
        normal_[pixel] = pack_halves(glm::vec4(s.shading_normal_ws, 0));
        valid_[pixel] = has_glass_ && is_glass(hit, planes_.footprint(met)) ? 0 : 255;
    }

    bool is_glass(const Hit& hit, const Footprint& footprint) const {
        const auto s = surfaces_.reflectance(hit, footprint);
        return !s.is_unlit && s.transmission * (1 - s.metallic) > mostly_glass;
    }

    const graph::FrameInputs& inputs_;
    const Bvh& bvh_;
    const SurfaceLookup& surfaces_;
    PixelPlanes planes_;
    bool has_glass_;
    glm::vec4 previous_depth_row_;
    std::vector<Hit>& hits_;
    std::span<const glm::vec4> nearer_;
    std::span<glm::vec4> position_, geometric_normal_;
    std::span<std::uint64_t> normal_;
    std::span<std::uint8_t> valid_;
};

/// What many methods do not ask for.
class HostMaterials {
  public:
    HostMaterials(const graph::PassContext& context, const GBuffer& g, const SurfaceLookup& surfaces,
                  const std::vector<Hit>& hits)
        : inputs_(context.inputs()),
          surfaces_(surfaces),
          planes_(inputs_.view, surfaces),
          clip_from_world_(inputs_.view.clip_from_world()),
          previous_clip_from_world_(inputs_.previous_view.clip_from_world()),
          hits_(hits),
          position_(context.pixels<glm::vec4>(g.position)),
          depth_(context.pixels<float>(g.depth)),
          albedo_(context.pixels<std::uint64_t>(g.albedo)),
          material_(context.pixels<std::uint64_t>(g.material)),
          emission_(context.pixels<std::uint64_t>(g.emission)),
          velocity_(context.pixels<std::uint32_t>(g.velocity)) {}

    void fill_row(int y) const {
        for (int x = 0; x < inputs_.view.width; ++x) {
            const auto pixel = static_cast<std::size_t>(y) * inputs_.view.width + x;
            if (hits_[pixel].is_hit())
                set(pixel, centre_of(x, y), hits_[pixel]);
            else
                depth_[pixel] = 1;
        }
    }

  private:
    void set(std::size_t pixel, glm::vec2 at, const Hit& hit) const {
        const bool is_filtered = surfaces_.has_textures(hit.triangle);
        const auto s =
            surfaces_.reflectance(hit, is_filtered ? planes_.footprint(planes_.meet(at, hit)) : Footprint());
        albedo_[pixel] = pack_halves(glm::vec4(s.base_colour, s.transmission));
        material_[pixel] = pack_halves({s.metallic, s.roughness, s.is_unlit ? 1 : 0, float(s.material)});
        emission_[pixel] = pack_halves(glm::vec4(s.emission, 0));
        const glm::vec3 position(position_[pixel]);
        const auto clip = clip_from_world_ * glm::vec4(position, 1);
        depth_[pixel] = clip.z / clip.w;
        const auto before = position_before(*inputs_.world, hit, position);
        velocity_[pixel] = pack_halves(velocity(at, previous_clip_from_world_ * before));
    }

    /// Pixels that the point moved since the previous frame; 0 where it was behind the camera.
    glm::vec2 velocity(glm::vec2 at, glm::vec4 before) const {
        if (before.w <= 0) return glm::vec2(0);
        const glm::vec2 size(inputs_.view.width, inputs_.view.height);
        return at - (glm::vec2(before) / before.w * glm::vec2(0.5f, -0.5f) + 0.5f) * size;
    }

    const graph::FrameInputs& inputs_;
    const SurfaceLookup& surfaces_;
    PixelPlanes planes_;
    glm::mat4 clip_from_world_, previous_clip_from_world_;
    const std::vector<Hit>& hits_;
    std::span<const glm::vec4> position_;
    std::span<float> depth_;
    std::span<std::uint64_t> albedo_, material_, emission_;
    std::span<std::uint32_t> velocity_;
};

}  // namespace

bool has_host_body(const graph::FrameInputs& inputs, const GBufferOptions& options) {
    return !options.sees_through_glass || !has_glass(inputs);
}

void gbuffer_on_host(graph::GraphBuilder& builder, const GBuffer& g, const GBufferOptions& options,
                     const GBuffer* nearer, int layer) {
    const auto hierarchy = bvh(builder);
    const auto surfaces = host_surfaces(builder, options.normal_maps);
    const auto hits =
        builder.object({.text = of_layer({.key = "gbuffer.hits",
                                          .label = "Hits",
                                          .doc = "Triangle, place on it and distance of each pixel's ray."},
                                         layer)});
    const auto& view = builder.inputs().view;
    const int width = view.width, height = view.height, blocks = (height + side - 1) / side;
    const auto before = nearer ? nearer->position : graph::ImageRef{};
    auto pass = builder.pass(pass_of_layer("G-buffer", layer), graph::Queue::cpu);
    if (nearer) pass.reads(before);
    pass.has_two_bodies()
        .reads(hierarchy, surfaces)
        .writes(g.position, g.normal, g.geometric_normal, g.valid, hits)
        .execute_sliced(blocks, [=](graph::PassContext& context, graph::Slice slice) {
            if (slice.first) {
                const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
                context.store(hits, std::make_shared<std::vector<Hit>>(count), count * sizeof(Hit));
            }
            const auto tree = context.object<Bvh>(hierarchy);
            const auto lookup = context.object<SurfaceLookup>(surfaces);
            const auto found = context.object<std::vector<Hit>>(hits);
            const auto positions =
                before.index >= 0 ? context.pixels<const glm::vec4>(before) : std::span<const glm::vec4>();
            const HostGBuffer filled(context, g, *tree, *lookup, *found, positions);
            parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t block) {
                const int first = static_cast<int>(block) * side;
                filled.fill_rows(first, std::min(first + side, height));
            });
        });
    builder.pass(pass_of_layer("G-buffer, materials", layer), graph::Queue::cpu)
        .has_two_bodies()
        .reads(surfaces, hits, g.position)
        .writes(g.depth, g.albedo, g.material, g.emission, g.velocity)
        .execute_sliced(height, [=](graph::PassContext& context, graph::Slice slice) {
            const auto lookup = context.object<SurfaceLookup>(surfaces);
            const auto found = context.object<std::vector<Hit>>(hits);
            const HostMaterials filled(context, g, *lookup, *found);
            parallel_for(context.inputs().threads, slice.begin, slice.end,
                         [&](std::int64_t row) { filled.fill_row(static_cast<int>(row)); });
        });
}

}  // namespace ir::passes
