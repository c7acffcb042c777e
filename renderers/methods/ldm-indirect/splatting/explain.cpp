#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/methods/ldm-indirect/splatting/found.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr std::uint64_t expected_photons = 1024;

/// Photons and sum are first what the device found, and then what the host made of it: buffers of their own
/// in between would be kept where their keys are asked for, and the explanation of another pixel would find
/// them done.
struct Explanation {
    graph::CountedBuffer photons, sum, directions, paths;
};

Explanation declare(graph::GraphBuilder& builder, int maps) {
    const auto counter = [](const std::string& key, const std::string& label) {
        return graph::CounterDesc{.key = "indirect.explain." + key, .label = label};
    };
    return {
        .photons = builder.explanation("indirect.explain.photons",
                                       {.fields = record_fields<FoundPhoton>(), .elements = expected_photons},
                                       counter("photon_count", "Photons that light the pixel")),
        .sum = builder.explanation("indirect.explain.sum",
                                   {.fields = record_fields<PixelSum>(), .elements = 1, .cleared = true},
                                   counter("sum_count", "Pixels explained")),
        .directions = builder.explanation(
            "indirect.explain.directions",
            {.fields = record_fields<DirectionLight>(), .elements = 2 * static_cast<std::uint64_t>(maps)},
            counter("direction_count", "Directions explained")),
        .paths = builder.explanation("indirect.explain.paths",
                                     {.fields = record_fields<PathLine>(), .elements = 2 * expected_photons},
                                     counter("path_count", "Lines of paths"))};
}

/// Constants of explain.comp.
struct Explain {
    Footprints footprints;
    glm::ivec2 picked_pixel;
    IR_FIELDS(footprints, picked_pixel)
};

void gather(const graph::PassContext& p, graph::Slice slice, const StoredPhotons& photons) {
    gl::ProgramSource source{{"methods/ldm-indirect/splatting/explain.comp"}};
    define_clipped(source, photons);
    const auto& program = p.use(source);
    program.set(Explain{footprints(p.inputs(), photons), p.inputs().picked_pixel()});
    set_units(p, program, photons);
    passes::dispatch_photons(p, program, photons, slice);
}

/// As much as there is room for; the counter says how much there is.
template <class T>
void store(const graph::PassContext& p, const graph::CountedBuffer& buffer, const std::vector<T>& elements) {
    const auto room = p.elements<T>(buffer.elements);
    std::copy_n(elements.begin(), std::min(elements.size(), room.size()), room.begin());
    p.add(buffer.count, static_cast<std::uint32_t>(elements.size()));
}

void sort_and_add_up(const graph::PassContext& p, const Explanation& e) {
    const auto sums = p.elements<PixelSum>(e.sum.elements);
    if (sums.empty()) return;
    const auto found = found_photons(p, {e.photons.elements, e.sum.elements});
    passes::sort_found(found);
    add_up(found, sums[0]);
}

bool is_explained(const graph::PassContext& p, const passes::GBuffer& gbuffer) {
    const auto pixel = p.inputs().picked_pixel();
    if (pixel.x < 0) return false;
    const auto place = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(p.inputs().view.width) +
                       static_cast<std::size_t>(pixel.x);
    return glm::vec3(p.pixels<glm::vec4>(gbuffer.geometric_normal)[place]) != glm::vec3(0);
}

void show_light(const graph::PassContext& p, const passes::GBuffer& gbuffer, const Explanation& e,
                const passes::ldm::Options& maps, std::uint64_t texels) {
    if (!is_explained(p, gbuffer)) return;
    const auto found = found_photons(p, {e.photons.elements, e.sum.elements});
    store(p, e.directions, light_by_direction(found, maps));
    store(p, e.paths, paths_of(found, maps, *p.inputs().world, texels));
}

}  // namespace

PixelPhotons explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                     const Splat& splat, const Parameters& parameters) {
    const auto e = declare(builder, parameters.maps.directions);
    const auto stored = splatted_photons(photons, splat, parameters);
    auto pass = builder.pass("explain photons of the pixel");
    reads_footprints(pass, stored);
    reads_looks(pass, stored);
    pass.reads(gbuffer.position, gbuffer.geometric_normal)
        .reads("irradiance_image", splat.of_frame)
        .writes("FoundPhotons", e.photons.elements)
        .writes("PixelSum", e.sum.elements)
        .counts("PhotonCount", e.photons.count)
        .counts("SumCount", e.sum.count)
        .execute_sliced(passes::photon_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { gather(p, slice, stored); });
    builder.pass("sort photons of the pixel", graph::Queue::cpu)
        .reads(e.photons.elements, e.sum.elements)
        .writes(e.photons.elements, e.sum.elements)
        .execute([=](graph::PassContext& p) { sort_and_add_up(p, e); });
    builder.pass("light of the pixel by direction", graph::Queue::cpu)
        .reads(e.photons.elements, e.sum.elements, gbuffer.geometric_normal)
        .writes(e.directions.elements, e.paths.elements)
        .counts(e.directions.count)
        .counts(e.paths.count)
        .execute([=, maps = passes::ldm::Options(parameters.maps), texels = photons.texels](
                     graph::PassContext& p) { show_light(p, gbuffer, e, maps, texels); });
    return {e.photons.elements, e.sum.elements};
}

}  // namespace ir::methods::ldm_indirect
