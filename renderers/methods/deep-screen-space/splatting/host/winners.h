#pragma once

#include <span>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/image_layers.h"
#include "renderers/methods/deep-screen-space/splatting/host/splat_rules.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/methods/deep-screen-space/surfels/host/host_senders.h"
#include "renderers/methods/deep-screen-space/surfels/senders.h"
#include "shaders/methods/deep-screen-space/splatting/disc_light.glsl.h"

namespace ir::methods::deep_screen_space {
/// What discs send that stand for many surfels: disc_light.glsl and sent_by_disc of resolve.comp, on the
/// host.
struct DiscLights {
    std::span<const Surfel> surfels;
    std::span<const SurfelLight> lights;
    VisibleLevel rules;
    int levels;
    unsigned seed;
    bool averaged;

    glm::vec3 of_side(std::size_t index, bool is_front) const {
        const auto& side = is_front ? lights[index].front : lights[index].back;
        return {side[0], side[1], side[2]};
    }

    /// Which the disc was enlarged for: that in which the pixel's point lies.
    int shell(std::size_t index, glm::vec3 x_ws) const {
        auto any = rules;
        any.full_discs = true;
        const auto& s = surfels[index];
        return std::max(splat_shell(any, levels - 1, s.radius, x_ws, s.centre_ws), 0);
    }

    /// `ray`: pixel and sample.
    glm::vec3 sent(std::size_t index, int shell, bool is_front, glm::uvec3 ray) const {
        if (!averaged) return of_side(index, is_front);
        return mean(index, shell, is_front, passes::unit_float(passes::pcg4d({ray, seed}).w));
    }

    /// As disc_slope_variance.
    float slope_variance(std::size_t index, int shell, float distance_m) const {
        const float wide = averaged ? std::ldexp(surfels[index].radius, shell) / distance_m : 0;
        return wide * wide / 16;
    }

  private:
    glm::vec3 mean(std::size_t index, int shell, bool is_front, float random) const {
        const auto& s = surfels[index];
        const int around = 1 << 2 * shell, picks = std::min(around, disc_light_picks);
        const float reach = splat_disc_radius(rules, shell, s.radius);
        glm::vec3 sum(0);
        int count = 0;
        for (int i = 0; i < picks; ++i) {
            const auto step = static_cast<float>(i) + random;
            const auto other = static_cast<std::int64_t>(index) +
                               static_cast<int>(step * static_cast<float>(around / picks)) - around / 2;
            if (other < 0 || other >= static_cast<std::int64_t>(surfels.size())) continue;
            const auto& o = surfels[static_cast<std::size_t>(other)];
            const auto offset = o.centre_ws - s.centre_ws;
            if (o.radius == 0 || glm::dot(o.normal_ws, s.normal_ws) < disc_light_facing ||
                glm::dot(offset, offset) > reach * reach)
                continue;
            sum += of_side(static_cast<std::size_t>(other), is_front);
            ++count;
        }
        return count > 0 ? sum / static_cast<float>(count) : of_side(index, is_front);
    }
};

/// What "splats.nearest" says of a ray: the sender that it met. Thread-safe.
class Winners {
  public:
    /// For a pass of the cpu queue that reads surfels with their light, and positions.
    Winners(const graph::PassContext& context, const VisibleSplats& visible);

    struct Sender {
        std::uint32_t triangle;
        bool is_exact = false;     ///< the triangle itself was met, and no disc
        std::uint32_t surfel = 0;  ///< of a disc
        int shell = 0;             ///< that the disc was enlarged for
        glm::vec2 weights;         ///< of the triangle's second and third corner
        glm::vec3 position_ws;     ///< that asks for light
        float radius = 0;          ///< m, of the surfel
        float slope;               ///< of the ray along the normal by the winding
        bool is_front() const { return slope <= 0; }
    };
    /// `winner` is not 0; `ray`: its number among all, which is that of its pixel and as many for each layer
    /// before as there are pixels.
    Sender sender(std::uint32_t winner, glm::vec3 direction_ws, float distance_m, std::size_t ray) const;
    /// Whether it sends anything to the side that was met.
    bool shines(const Sender& sender) const { return sender.is_front() || !black_backs_; }
    /// What a disc stores for all sides alike.
    glm::vec3 stored(const Sender& sender, std::size_t ray) const;
    /// Variance of the slopes of half vectors, over which its highlight is averaged.
    float slope_variance(const Sender& sender, const SenderSurfaces& surfaces, const glm::vec4& direction,
                         float distance_m) const;

  private:
    std::size_t pixels() const { return positions_.size(); }

    const scene::World& world_;
    bool black_backs_;
    DiscLights discs_;
    std::size_t width_;
    std::span<const glm::vec4> positions_;
};

/// Pixels of a sample that a thread does at a time.
inline constexpr std::int64_t winners_block = 256;

/// Declares that a pass reads the winners of a batch with their surfels, and writes `result` (rgba32f, a
/// layer per sample), in slices of blocks: RGB of `light(inputs of the pass)(winner, direction, distance,
/// ray)`, A 1; 0 where nothing was met.
template <class Light>
void fill_by_winners(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                     const VisibleSplats& visible, graph::ImageRef result, const Light& light) {
    const auto nearest = visible.nearest, distance = visible.samples.distance,
               directions = visible.directions.directions;
    pass.reads(visible.splats.surfels.records, visible.splats.surfels.stored, visible.splats.surfels.lights,
               visible.gbuffer.position, nearest, distance, directions)
        .writes(result);
    const auto& view = builder.inputs().view;
    const auto pixels = std::int64_t{view.width} * view.height;
    const auto blocks = (pixels + winners_block - 1) / winners_block;
    const auto first_sample = visible.splats.first_sample;
    pass.execute_sliced(
        blocks * visible.splats.samples, [=](graph::PassContext& context, graph::Slice slice) {
            const auto sent = light(context);
            const auto winners = graph::layers<const std::uint32_t>(context, nearest);
            const auto distances = graph::layers<const float>(context, distance);
            const auto rays = graph::layers<const glm::vec4>(context, directions);
            const auto results = graph::layers<glm::vec4>(context, result);
            parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t item) {
                const auto layer = item / blocks, first = item % blocks * winners_block;
                const auto at = static_cast<std::size_t>(layer);
                for (auto i = first; i < std::min(pixels, first + winners_block); ++i) {
                    const auto pixel = static_cast<std::size_t>(i);
                    const auto winner = winners[at][pixel];
                    const auto ray = static_cast<std::size_t>(pixels * (first_sample + layer) + i);
                    results[at][pixel] =
                        winner == 0 ? glm::vec4(0)
                                    : glm::vec4(sent(winner, rays[at][pixel], distances[at][pixel], ray), 1);
                }
            });
        });
}

/// The objects that light of sources with an extent needs; none where there are no such sources.
struct SourceObjects {
    graph::ObjectRef bvh, sources;
    bool are_there() const { return sources.index >= 0; }
};
SourceObjects source_objects(graph::GraphBuilder& builder, const Parameters& parameters);

/// What winners send of sources with an extent beyond what discs store: highlights, and of triangles also
/// what they reflect to all sides; by one sample each. Thread-safe.
class WinnersSourceLight {
  public:
    /// `objects` are there, and the pass reads them. Keeps a reference to `surfaces`.
    WinnersSourceLight(const graph::PassContext& context, const SourceObjects& objects,
                       const SenderSurfaces& surfaces, const Parameters& parameters);

    /// W/(m² sr), towards the ray's origin. `variance`: Winners::slope_variance().
    glm::vec3 sent(const Winners::Sender& sender, SenderSurfaces::Place place, glm::vec3 direction_ws,
                   float variance, std::uint64_t ray) const;

  private:
    glm::vec3 scattered(const Winners::Sender& sender, const SenderSurfaces::Place& place,
                        glm::vec3 direction_ws, std::uint64_t key) const;

    const SenderSurfaces& surfaces_;
    std::shared_ptr<passes::Bvh> bvh_;
    std::shared_ptr<passes::ExtendedEmitters> sources_;
    SourceIrradiance irradiance_;
    SourceHighlight highlight_;
    std::uint64_t seed_;
    bool mirrors_count_;  ///< what they reflect of sources is direct light, as they scatter none
};

}  // namespace ir::methods::deep_screen_space
