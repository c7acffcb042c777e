#include "renderers/methods/ldm-ao/direction_rays.h"
#include "renderers/methods/ldm-ao/passes.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/core/half_float.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "shaders/methods/ldm-ao/exact.glsl.h"

namespace ir::methods::ldm_ao {
namespace {

constexpr int lanes = 16;
/// A hit takes a byte: 0 is none, else its distance in steps of the reach.
constexpr int hits_per_word = 4;

int words_per_pixel(const passes::ldm::Maps& maps) {
    return (maps.layout.batch_maps + hits_per_word - 1) / hits_per_word;
}

/// Without a limit to the reach the distance does not matter: any hit closes. A reach of 0 has no hits.
std::uint32_t encoded(float distance, float reach) {
    if (distance == infinity || reach <= 0) return 0;
    if (reach == infinity) return 1;
    return 1 +
           static_cast<std::uint32_t>(std::lround(std::clamp(distance / reach, 0.0f, 1.0f) * exact_steps));
}

/// One pixel's hits in all directions of a batch.
class PixelTracer {
  public:
    PixelTracer(const passes::Bvh& bvh, const passes::ldm::Maps& maps, int batch, const ExactHits& exact,
                const Transport& transport)
        : bvh_(bvh), maps_(maps), batch_(batch), exact_(exact), transport_(transport) {}

    void run(const RayStart& x, std::span<std::uint32_t> words) const {
        for (int first = 0; first < maps_.batch_maps(batch_); first += lanes) run_packet(x, first, words);
    }

  private:
    const passes::ldm::MapFrame& frame(int map) const {
        return maps_.frames[static_cast<std::size_t>(maps_.first_map(batch_) + map)];
    }

    float reach(int map) const {
        const float reach = exact_reach(frame(map), exact_.exact, exact_.texels);
        return transport_.max_distance > 0 ? std::min(reach, transport_.max_distance) : reach;
    }

    void run_packet(const RayStart& x, int first, std::span<std::uint32_t> words) const {
        passes::Bvh::Packet16 packet{};
        const int count = std::min(lanes, maps_.batch_maps(batch_) - first);
        for (int lane = 0; lane < count; ++lane)
            put_ray(packet, lane, x, frame(first + lane), reach(first + lane));
        float distances[lanes];
        bvh_.closest16(packet, false, distances);
        for (int lane = 0; lane < count; ++lane) {
            const int map = first + lane;
            words[static_cast<std::size_t>(map / hits_per_word)] |= encoded(distances[lane], reach(map))
                                                                    << (8 * (map % hits_per_word));
        }
    }

    const passes::Bvh& bvh_;
    const passes::ldm::Maps& maps_;
    int batch_;
    const ExactHits& exact_;
    const Transport& transport_;
};

}  // namespace

float exact_reach(const passes::ldm::MapFrame& frame, Exact exact, float texels) {
    if (exact == Exact::all) return infinity;
    return texels * std::max(glm::length(glm::vec3(frame.step_u)), glm::length(glm::vec3(frame.step_v)));
}

ExactHits declare_exact_hits(graph::GraphBuilder& builder, const passes::ldm::Maps& maps,
                             const Parameters& parameters) {
    const auto& view = builder.inputs().view;
    graph::BufferDesc desc;
    desc.text = {.key = "ldm.exact_hits",
                 .label = "Exact hits",
                 .doc =
                     "Hits of exact rays by pixel and map, a byte each: 0 is none, 1 to 255 is the distance "
                     "from 0 to the reach of exact rays."};
    desc.fields = {{"hits_of_4_maps", graph::FieldType::u32}};
    desc.elements = static_cast<std::uint64_t>(view.width) * view.height * words_per_pixel(maps);
    return {builder.buffer(desc), passes::bvh(builder), parameters.exact, parameters.exact_texels};
}

ExactConstants exact_constants(const ExactHits& exact, const passes::ldm::Maps& maps) {
    return {static_cast<unsigned>(words_per_pixel(maps)), exact.exact == Exact::all ? -1.0f : exact.texels};
}

void trace_exact(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                 const ExactHits& exact, const Transport& transport) {
    const auto& view = builder.inputs().view;
    builder.pass("trace exact rays" + maps->batch_name(batch), graph::Queue::cpu)
        .reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal, exact.bvh)
        .writes(exact.hits)
        .execute_sliced(view.height, [=, width = view.width](graph::PassContext& p, graph::Slice slice) {
            const auto positions = p.pixels<glm::vec4>(gbuffer.position),
                       geometric = p.pixels<glm::vec4>(gbuffer.geometric_normal);
            const auto shading = p.pixels<std::uint64_t>(gbuffer.normal);
            const auto words = p.elements<std::uint32_t>(exact.hits);
            const auto per_pixel = static_cast<std::size_t>(words_per_pixel(*maps));
            const auto bvh = p.object<passes::Bvh>(exact.bvh);
            const PixelTracer tracer(*bvh, *maps, batch, exact, transport);
            const int threads = p.inputs().threads;
            parallel_for(threads, slice.begin, slice.end, [&](std::int64_t row) {
                if (p.cancel().is_cancelled()) return;
                for (int column = 0; column < width; ++column) {
                    const auto i = static_cast<std::size_t>(row * width + column);
                    const auto own = words.subspan(i * per_pixel, per_pixel);
                    std::fill(own.begin(), own.end(), 0u);
                    const auto normal = glm::vec3(geometric[i]);
                    if (normal == glm::vec3(0)) continue;
                    tracer.run({glm::vec3(positions[i]), normal, glm::vec3(unpack_halves(shading[i]))}, own);
                }
            });
            p.cancel().check();
        });
}

}  // namespace ir::methods::ldm_ao
