#include "renderers/passes/gbuffer/gbuffer_on_host.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "renderers/core/threads.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {
namespace {

/// Pixels of a side of the squares that a packet of rays goes through.
constexpr int side = 4;

/// What the rays go through, and the pixels that they fill.
class HostGBuffer {
  public:
    HostGBuffer(const graph::PassContext& context, const GBuffer& g, const Bvh& bvh,
                const SurfaceLookup& surfaces)
        : inputs_(context.inputs()),
          bvh_(bvh),
          surfaces_(surfaces),
          rays_(pixel_rays(inputs_.view)),
          clip_from_world_(inputs_.view.clip_from_world()),
          previous_clip_from_world_(inputs_.previous_view.clip_from_world()),
          previous_depth_row_(-glm::vec4(glm::transpose(inputs_.previous_view.view_from_world)[2])),
          depth_(context.pixels<float>(g.depth)),
          position_(context.pixels<glm::vec4>(g.position)),
          geometric_normal_(context.pixels<glm::vec4>(g.geometric_normal)),
          normal_(context.pixels<std::uint64_t>(g.normal)),
          albedo_(context.pixels<std::uint64_t>(g.albedo)),
          material_(context.pixels<std::uint64_t>(g.material)),
          emission_(context.pixels<std::uint64_t>(g.emission)),
          velocity_(context.pixels<std::uint32_t>(g.velocity)),
          valid_(context.pixels<std::uint8_t>(g.valid)) {}

    void fill_rows(int first, int end) const {
        for (int x = 0; x < inputs_.view.width; x += side) fill(x, first, end);
    }

  private:
    struct Ray {
        glm::vec3 origin, direction;
    };
    Ray ray(float x, float y) const {
        return {rays_.origin + x * rays_.origin_dx + y * rays_.origin_dy,
                rays_.direction + x * rays_.direction_dx + y * rays_.direction_dy};
    }

    void fill(int first_x, int first_y, int end_y) const {
        Bvh::Packet16 packet;
        for (int i = 0; i < side * side; ++i) {
            const int x = first_x + i % side, y = first_y + i / side;
            const auto [origin, direction] = ray(float(x) + 0.5f, float(y) + 0.5f);
            const float length = glm::length(direction);
            packet.ox[i] = origin.x, packet.oy[i] = origin.y, packet.oz[i] = origin.z;
            packet.dx[i] = direction.x / length, packet.dy[i] = direction.y / length;
            packet.dz[i] = direction.z / length;
            packet.near[i] = inputs_.view.near_plane * length;
            packet.far[i] = inputs_.view.far_plane * length;
            packet.active[i] = x < inputs_.view.width && y < end_y ? -1 : 0;
        }
        Hit hits[side * side];
        bvh_.closest_hits16(packet, true, hits);
        for (int i = 0; i < side * side; ++i) {
            if (packet.active[i] == 0) continue;
            const int x = first_x + i % side, y = first_y + i / side;
            const auto pixel = static_cast<std::size_t>(y) * inputs_.view.width + x;
            if (hits[i].is_hit())
                set(pixel, {float(x) + 0.5f, float(y) + 0.5f}, hits[i]);
            else
                clear(pixel);
        }
    }

    void clear(std::size_t pixel) const {
        depth_[pixel] = 1;
        position_[pixel] = geometric_normal_[pixel] = glm::vec4(0);
        normal_[pixel] = albedo_[pixel] = material_[pixel] = emission_[pixel] = 0;
        velocity_[pixel] = 0;
        valid_[pixel] = 0;
    }

    /// Where a pixel's ray meets the plane; `otherwise` edge-on.
    glm::vec3 on_plane(glm::vec3 normal, glm::vec3 anchor, const Ray& ray, glm::vec3 otherwise) const {
        const float along = glm::dot(normal, ray.direction);
        const float depth = glm::dot(normal, anchor - ray.origin) / along;
        return std::isfinite(depth) ? ray.origin + depth * ray.direction : otherwise;
    }

    void set(std::size_t pixel, glm::vec2 at, const Hit& hit) const {
        const auto centre = ray(at.x, at.y);
        const auto unit = glm::normalize(centre.direction);
        const auto [normal, anchor] = surfaces_.plane(hit.triangle);
        const auto met = centre.origin + hit.distance * unit;
        // Rasterisation interpolates from pixel to pixel, also beyond the triangle.
        const auto next_column = on_plane(normal, anchor, ray(at.x + 1, at.y), met);
        const auto next_row = on_plane(normal, anchor, ray(at.x, at.y + 1), met);
        const auto s = surfaces_.at(hit, unit, {next_column - met, next_row - met});
        const bool is_edge_on = std::abs(glm::dot(normal, unit)) < 1e-3f;
        const auto position = is_edge_on ? met : on_plane(normal, anchor, centre, met);
        const auto clip = clip_from_world_ * glm::vec4(position, 1);
        const auto& world = *inputs_.world;
        const auto instance = world.instances[world.indices[3 * std::size_t(hit.triangle)]];
        const auto before = world.motion[instance] * glm::vec4(position, 1);
        depth_[pixel] = clip.z / clip.w;
        position_[pixel] = glm::vec4(position, glm::distance(position, inputs_.view.eye_ws));
        geometric_normal_[pixel] = glm::vec4(s.geometric_normal_ws, glm::dot(previous_depth_row_, before));
        normal_[pixel] = glm::packHalf4x16(glm::vec4(s.shading_normal_ws, 0));
        albedo_[pixel] = glm::packHalf4x16(glm::vec4(s.base_colour, s.transmission));
        material_[pixel] =
            glm::packHalf4x16({s.metallic, s.roughness, s.is_unlit ? 1 : 0, float(s.material)});
        emission_[pixel] = glm::packHalf4x16(glm::vec4(s.emission, 0));
        velocity_[pixel] = glm::packHalf2x16(velocity(at, previous_clip_from_world_ * before));
        const float glass = s.is_unlit ? 0 : s.transmission * (1 - s.metallic);
        valid_[pixel] = glass > mostly_glass ? 0 : 255;
    }

    /// Pixels that the point moved since the previous frame; 0 where it was behind the camera.
    glm::vec2 velocity(glm::vec2 at, glm::vec4 before) const {
        if (before.w <= 0) return glm::vec2(0);
        const glm::vec2 size(inputs_.view.width, inputs_.view.height);
        return at - (glm::vec2(before) / before.w * glm::vec2(0.5f, -0.5f) + 0.5f) * size;
    }

    const graph::FrameInputs& inputs_;
    const Bvh& bvh_;
    const SurfaceLookup& surfaces_;
    PixelRays rays_;
    glm::mat4 clip_from_world_, previous_clip_from_world_;
    glm::vec4 previous_depth_row_;
    std::span<float> depth_;
    std::span<glm::vec4> position_, geometric_normal_;
    std::span<std::uint64_t> normal_, albedo_, material_, emission_;
    std::span<std::uint32_t> velocity_;
    std::span<std::uint8_t> valid_;
};

}  // namespace

bool has_host_body(const graph::FrameInputs& inputs, const GBufferOptions& options) {
    return !options.sees_through_glass || !has_glass(inputs);
}

void gbuffer_on_host(graph::GraphBuilder& builder, const GBuffer& g, const GBufferOptions& options) {
    const auto hierarchy = bvh(builder);
    const auto surfaces = host_surfaces(builder, options.normal_maps);
    const int height = builder.inputs().view.height, blocks = (height + side - 1) / side;
    builder.pass("G-buffer", graph::Queue::cpu)
        .has_two_bodies()
        .reads(hierarchy, surfaces)
        .writes(g.depth, g.position, g.normal, g.geometric_normal, g.albedo, g.material, g.emission,
                g.velocity, g.valid)
        .execute_sliced(blocks, [=](graph::PassContext& context, graph::Slice slice) {
            const auto tree = context.object<Bvh>(hierarchy);
            const auto lookup = context.object<SurfaceLookup>(surfaces);
            const HostGBuffer filled(context, g, *tree, *lookup);
            const int threads = context.inputs().threads;
            tbb::task_arena arena(arena_size(threads));
            arena.execute([&] {
                tbb::parallel_for(slice.begin, slice.end, [&](std::int64_t block) {
                    const int first = static_cast<int>(block) * side;
                    filled.fill_rows(first, std::min(first + side, height));
                });
            });
        });
}

}  // namespace ir::passes
