#include "renderers/passes/rsm/rsm_on_host.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "renderers/core/half_float.h"
#include "renderers/core/parallel_for.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "renderers/passes/surface/surface.h"
#include "shaders/passes/rsm/opacity.glsl.h"

namespace ir::passes {
namespace {

/// Texels along a side of the squares that a packet of rays goes through; resolutions are multiples of it.
constexpr int packet_side = 4;

/// One layer on its way into its images.
class HostLayer {
  public:
    HostLayer(const graph::PassContext& context, const Rsm& rsm, const RsmOptions& options, int layer,
              const Bvh& bvh, const SurfaceLookup& surfaces)
        : options_(options),
          resolution_(rsm.resolution),
          bvh_(bvh),
          surfaces_(surfaces),
          normals_(context.pixels<std::uint64_t>(rsm.normal_metalness, layer)),
          depths_(context.pixels<float>(rsm.depth, layer)) {
        if (options.exact_albedo)
            exact_albedos_ = context.pixels<std::uint64_t>(rsm.albedo_roughness, layer);
        else
            albedos_ = context.pixels<std::uint32_t>(rsm.albedo_roughness, layer);
        if (options.geometric_normal)
            geometric_normals_ = context.pixels<glm::vec4>(rsm.geometric_normal, layer);
        if (static_cast<std::size_t>(layer) >= options.views.size()) return;
        view_ = &options.views[static_cast<std::size_t>(layer)];
        cone_ = light_cone(*context.inputs().world, *view_);
    }

    /// Rows first … first + packet_side - 1.
    void fill_rows(int first) const {
        for (int x = 0; x < resolution_; x += packet_side) fill(x, first);
    }

  private:
    struct Ray {
        glm::vec3 origin, direction;  ///< which advances by 1 along the map's axis
    };
    /// As texel_direction of texel.glsl.
    Ray ray(float x, float y) const {
        const auto ndc = (glm::vec2(x, y) / static_cast<float>(resolution_) * 2.0f - 1.0f) * glm::vec2(1, -1);
        const auto lateral = ndc.x * view_->right_ws + ndc.y * view_->up_ws;
        if (view_->perspective != 0) return {view_->origin_ws, view_->forward_ws + lateral};
        return {view_->origin_ws + lateral, view_->forward_ws};
    }

    /// As cone.glsl.
    bool is_outside_cone(glm::vec3 direction, float length) const {
        return glm::dot(direction, cone_.cone_axis_ws) < cone_.cone_cosine * length;
    }

    void fill(int first_x, int first_y) const {
        Bvh::Packet16 packet;
        Hit hits[packet_side * packet_side];
        bool is_lit = false;
        for (int i = 0; view_ && i < packet_side * packet_side; ++i) {
            const auto [origin, direction] = ray(static_cast<float>(first_x + i % packet_side) + 0.5f,
                                                 static_cast<float>(first_y + i / packet_side) + 0.5f);
            const float length = glm::length(direction);
            packet.ox[i] = origin.x, packet.oy[i] = origin.y, packet.oz[i] = origin.z;
            packet.dx[i] = direction.x / length, packet.dy[i] = direction.y / length;
            packet.dz[i] = direction.z / length;
            packet.near[i] = view_->near * length, packet.far[i] = view_->far * length;
            packet.active[i] = is_outside_cone(direction, length) ? 0 : -1;
            is_lit = is_lit || packet.active[i];
        }
        if (is_lit) bvh_.closest_hits16(packet, true, hits);
        for (int i = 0; i < packet_side * packet_side; ++i) {
            const int x = first_x + i % packet_side, y = first_y + i / packet_side;
            const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(resolution_) +
                               static_cast<std::size_t>(x);
            clear(texel);
            if (hits[i].is_hit())
                set(texel, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, hits[i]);
        }
    }

    void clear(std::size_t texel) const {
        depths_[texel] = 1;
        normals_[texel] = 0;
        if (options_.exact_albedo)
            exact_albedos_[texel] = 0;
        else
            albedos_[texel] = 0;
        if (options_.geometric_normal) geometric_normals_[texel] = glm::vec4(0);
    }

    void set(std::size_t texel, float x, float y, const Hit& hit) const {
        const auto centre = ray(x, y);
        const float length = glm::length(centre.direction);
        const auto [normal, anchor] = surfaces_.plane(hit.triangle);
        const float met = hit.distance / length;
        const auto depth_on_plane = [&, plane = normal, corner = anchor](const Ray& other) {
            const float depth = glm::dot(plane, corner - other.origin) / glm::dot(plane, other.direction);
            return std::isfinite(depth) ? depth : met;
        };
        const auto place = [&](const Ray& other) {
            return other.origin + depth_on_plane(other) * other.direction;
        };
        const auto position = centre.origin + met * centre.direction;
        const auto s = surfaces_.at(hit, centre.direction / length,
                                    {place(ray(x + 1, y)) - position, place(ray(x, y + 1)) - position});
        const bool is_edge_on = std::abs(glm::dot(normal, centre.direction)) < 1e-3f * length;
        depths_[texel] = (is_edge_on ? met : depth_on_plane(centre)) / view_->far;
        const float glass = s.is_unlit ? 0 : s.transmission * (1 - s.metallic);
        const bool scatters = !s.is_unlit && (options_.opaque_only || glass <= mostly_glass);
        const glm::vec4 albedo(s.base_colour, s.roughness);
        if (options_.exact_albedo)
            exact_albedos_[texel] = pack_halves(albedo);
        else
            albedos_[texel] = glm::packUnorm4x8(albedo);
        normals_[texel] = pack_halves(glm::vec4(
            s.shading_normal_ws, (scatters ? 1.0f : -1.0f) * (1 + std::clamp(s.metallic, 0.0f, 1.0f))));
        if (!options_.geometric_normal) return;
        const bool has_glass = !options_.opaque_only && glass > 0;
        geometric_normals_[texel] = glm::vec4(
            s.geometric_normal_ws, has_glass ? 1 - glass : opaque_index + surfaces_.material(s.material).ior);
    }

    const RsmOptions& options_;
    int resolution_;
    const Bvh& bvh_;
    const SurfaceLookup& surfaces_;
    const ShadowViewData* view_ = nullptr;
    LightCone cone_;
    std::span<std::uint32_t> albedos_;
    std::span<std::uint64_t> exact_albedos_, normals_;
    std::span<glm::vec4> geometric_normals_;
    std::span<float> depths_;
};

}  // namespace

void rsm_on_host(graph::GraphBuilder& builder, const Rsm& rsm, const RsmOptions& options) {
    const auto hierarchy = bvh(builder);
    const auto surfaces = host_surfaces(builder, options.normal_maps);
    auto pass = builder.pass("RSM", graph::Queue::cpu);
    if (options.geometric_normal) pass.writes(rsm.geometric_normal);
    pass.has_two_bodies()
        .reads(hierarchy, surfaces)
        .writes(rsm.albedo_roughness, rsm.normal_metalness, rsm.depth, rsm.views)
        .execute_sliced(
            rsm.layers,
            [=](graph::PassContext& context, graph::Slice slice) {
                if (slice.first)
                    std::ranges::copy(options.views, context.elements<ShadowViewData>(rsm.views).begin());
                const auto tree = context.object<Bvh>(hierarchy);
                const auto lookup = context.object<SurfaceLookup>(surfaces);
                for (auto layer = slice.begin; layer < slice.end; ++layer) {
                    const HostLayer filled(context, rsm, options, static_cast<int>(layer), *tree, *lookup);
                    parallel_for(
                        context.inputs().threads, 0, rsm.resolution / packet_side,
                        [&](std::int64_t block) { filled.fill_rows(static_cast<int>(block) * packet_side); });
                }
            },
            1);
}

}  // namespace ir::passes
