// Exact hits for the few pixels that maps get wrong: those that have much within a texel or two, where an
// entry tells where a surface is at a texel's centre only.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/core/half_float.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-ao/direction_rays.h"
#include "renderers/methods/ldm-ao/passes.h"

namespace ir::methods::ldm_ao {
namespace {

constexpr int packet_rays = 16;
/// A pixel is selected where so much of what few short rays see is closed.
constexpr float probe_texels = 1.5f, closed_part = 0.2f;

/// Rays along the maps' directions.
class DirectionRays {
  public:
    DirectionRays(const passes::Bvh& bvh, const passes::ldm::Maps& maps, const Transport& transport)
        : bvh_(bvh), maps_(maps), transport_(transport), probe_reach_(probe_texels * largest_texel(maps)) {
        if (transport.max_distance > 0) probe_reach_ = std::min(probe_reach_, transport.max_distance);
    }

    bool is_selected(const RayStart& x) const {
        const int maps = static_cast<int>(maps_.frames.size()), count = std::min(maps, packet_rays);
        int numbers[packet_rays];
        for (int i = 0; i < count; ++i) numbers[i] = i * maps / count;
        const auto sums =
            open_part(x, std::span(numbers).first(static_cast<std::size_t>(count)), probe_reach_, false);
        return sums.y - sums.x > closed_part * sums.y;
    }

    /// Σ V cosθ and Σ cosθ, as trace.comp.
    glm::vec2 sums(const RayStart& x) const {
        const bool is_limited = transport_.max_distance > 0;
        const bool is_smooth = is_limited && transport_.falloff == Transport::Falloff::smooth;
        glm::vec2 sums(0);
        int numbers[packet_rays];
        const int maps = static_cast<int>(maps_.frames.size());
        for (int first = 0; first < maps; first += packet_rays) {
            const int count = std::min(maps - first, packet_rays);
            for (int i = 0; i < count; ++i) numbers[i] = first + i;
            sums += open_part(x, std::span(numbers).first(static_cast<std::size_t>(count)),
                              is_limited ? transport_.max_distance : infinity, is_smooth);
        }
        return sums;
    }

  private:
    static float largest_texel(const passes::ldm::Maps& maps) {
        float largest = 0;
        for (const auto& frame : maps.frames) largest = std::max(largest, exact_reach(frame, Exact::near, 1));
        return largest;
    }

    /// Of at most a packet of maps.
    glm::vec2 open_part(const RayStart& x, std::span<const int> maps, float reach, bool is_smooth) const {
        passes::Bvh::Packet16 packet{};
        float cosines[packet_rays]{};
        glm::vec2 sums(0);
        for (std::size_t lane = 0; lane < maps.size(); ++lane) {
            const auto& frame = maps_.frames[static_cast<std::size_t>(maps[lane])];
            const float cosine = put_ray(packet, static_cast<int>(lane), x, frame, reach);
            sums.y += cosine;
            if (packet.active[lane] != 0) cosines[lane] = cosine;  // below the triangle all is closed
        }
        if (!is_smooth) {
            const auto closed = bvh_.occluded16(packet, false);
            for (int lane = 0; lane < packet_rays; ++lane)
                if (!(closed >> lane & 1)) sums.x += cosines[lane];
            return sums;
        }
        float distances[packet_rays];
        bvh_.closest16(packet, false, distances);
        for (int lane = 0; lane < packet_rays; ++lane) {
            const float part = std::min(distances[lane] / reach, 1.0f);
            sums.x += cosines[lane] * part * part;
        }
        return sums;
    }

    const passes::Bvh& bvh_;
    const passes::ldm::Maps& maps_;
    const Transport& transport_;
    float probe_reach_;
};

}  // namespace

void trace_selected(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                    const Images& images, const Transport& transport) {
    const auto bvh = passes::bvh(builder);
    const auto selected = builder.counter({.key = "ldm.selected",
                                           .label = "Pixels of exact hits",
                                           .doc = "Pixels that have much within 1.5 texels of them."});
    builder.pass("trace selected pixels", graph::Queue::cpu)
        .reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal, bvh, images.sums)
        .writes(images.sums)
        .counts(selected)
        .execute_sliced(builder.inputs().view.height,
                        [=, sums = images.sums, width = builder.inputs().view.width](graph::PassContext& p,
                                                                                     graph::Slice slice) {
                            const auto positions = p.pixels<const glm::vec4>(gbuffer.position),
                                       geometric = p.pixels<const glm::vec4>(gbuffer.geometric_normal);
                            const auto shading = p.pixels<const std::uint64_t>(gbuffer.normal);
                            const auto out = p.pixels<glm::vec2>(sums);
                            const auto traced = p.object<passes::Bvh>(bvh);
                            const DirectionRays rays(*traced, *maps, transport);
                            std::atomic<std::uint32_t> count{0};
                            parallel_for(p.inputs().threads, slice.begin, slice.end, [&](std::int64_t row) {
                                if (p.cancel().is_cancelled()) return;
                                for (int column = 0; column < width; ++column) {
                                    const auto i = static_cast<std::size_t>(row * width + column);
                                    const auto normal = glm::vec3(geometric[i]);
                                    if (normal == glm::vec3(0)) continue;
                                    const RayStart x{glm::vec3(positions[i]), normal,
                                                     glm::normalize(glm::vec3(unpack_halves(shading[i])))};
                                    if (!rays.is_selected(x)) continue;
                                    out[i] = rays.sums(x);
                                    count.fetch_add(1, std::memory_order_relaxed);
                                }
                            });
                            p.cancel().check();
                            p.add(selected, count);
                        });
}

}  // namespace ir::methods::ldm_ao
