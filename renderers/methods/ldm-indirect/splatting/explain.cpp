#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/ldm-indirect/splatting/found.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr std::uint64_t expected_photons = 1024;

/// Photons and sum are first what the device found, and then what the host made of it: buffers of their own
/// in between would be kept where their keys are asked for, and the explanation of another pixel would find
/// them done.
struct Explanation {
    graph::BufferRef photons, sum, directions, paths;
    graph::CounterRef photon_count, sum_count, direction_count, path_count;
};

graph::BufferRef declare_buffer(graph::GraphBuilder& builder, const std::string& key, OutputKind kind,
                                std::vector<graph::Field> fields, std::uint64_t elements,
                                bool cleared = false) {
    return builder.output(key, {.kind = kind,
                                .fields = std::move(fields),
                                .elements = elements,
                                .growable = true,
                                .cleared = cleared});
}

graph::CounterRef count_of(graph::GraphBuilder& builder, const std::string& key, const std::string& label,
                           graph::BufferRef buffer) {
    return builder.counter({.key = "indirect.explain." + key,
                            .label = label,
                            .doc = "0 while no pixel is picked, and where it shows no surface.",
                            .growth_of = buffer});
}

Explanation declare(graph::GraphBuilder& builder, int maps) {
    Explanation e;
    e.photons = declare_buffer(builder, "indirect.explain.photons", OutputKind::glyphs,
                               record_fields<FoundPhoton>(), expected_photons);
    e.sum = declare_buffer(builder, "indirect.explain.sum", OutputKind::table, record_fields<PixelSum>(), 1,
                           true);
    e.directions = declare_buffer(builder, "indirect.explain.directions", OutputKind::sphere_values,
                                  record_fields<DirectionLight>(), 2 * static_cast<std::uint64_t>(maps));
    e.paths = declare_buffer(builder, "indirect.explain.paths", OutputKind::line_set,
                             record_fields<PathLine>(), 2 * expected_photons);
    e.photon_count = count_of(builder, "photon_count", "Photons that light the pixel", e.photons);
    e.sum_count = count_of(builder, "sum_count", "Pixels explained", e.sum);
    e.direction_count = count_of(builder, "direction_count", "Directions explained", e.directions);
    e.path_count = count_of(builder, "path_count", "Lines of paths", e.paths);
    return e;
}

/// Constants of explain.comp.
struct Explain {
    Footprints footprints;
    glm::ivec2 picked_pixel;
    IR_FIELDS(footprints, picked_pixel)
};

void gather(const graph::PassContext& p, graph::Slice slice, const StoredPhotons& photons) {
    const auto& program = p.use({{"methods/ldm-indirect/splatting/explain.comp"}});
    program.set(Explain{footprints(p.inputs(), photons.parameters), p.inputs().picked_pixel()});
    const auto range = photons_of(p, photons, slice);
    gl::dispatch_items(program, range.first, range.end);
}

/// As much as there is room for; the counter says how much there is.
template <class T>
void store(const graph::PassContext& p, graph::BufferRef buffer, graph::CounterRef count,
           const std::vector<T>& elements) {
    const auto room = p.elements<T>(buffer);
    std::copy_n(elements.begin(), std::min(elements.size(), room.size()), room.begin());
    p.add(count, static_cast<std::uint32_t>(elements.size()));
}

void sort_and_add_up(const graph::PassContext& p, const Explanation& e) {
    const auto sums = p.elements<PixelSum>(e.sum);
    const auto photons = p.elements<FoundPhoton>(e.photons);
    if (sums.empty()) return;
    const auto found = photons.first(std::min<std::size_t>(photons.size(), sums[0].photons));
    sort_found(found);
    add_up(found, sums[0]);
}

bool is_explained(const graph::PassContext& p, const passes::GBuffer& gbuffer) {
    const auto pixel = p.inputs().picked_pixel();
    if (pixel.x < 0) return false;
    const auto place = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(p.inputs().view.width) +
                       static_cast<std::size_t>(pixel.x);
    return glm::vec3(p.pixels<glm::vec4>(gbuffer.geometric_normal)[place]) != glm::vec3(0);
}

void show_light(const graph::PassContext& p, const passes::GBuffer& gbuffer, const Explanation& e, int maps) {
    const auto sums = p.elements<PixelSum>(e.sum);
    if (sums.empty() || !is_explained(p, gbuffer)) return;
    const auto photons = p.elements<FoundPhoton>(e.photons);
    const auto found = photons.first(std::min<std::size_t>(photons.size(), sums[0].photons));
    store(p, e.directions, e.direction_count, light_by_direction(found, maps));
    store(p, e.paths, e.path_count, paths_of(found, maps, *p.inputs().world));
}

}  // namespace

void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
             const Splat& splat, const Parameters& parameters) {
    const int maps = parameters.maps.directions;
    const auto e = declare(builder, maps);
    const StoredPhotons stored{photons.records, splat.stored, splat.arrivals, parameters};
    auto pass = builder.pass("explain photons of the pixel");
    reads_footprints(pass, stored);
    pass.reads(gbuffer.position, gbuffer.geometric_normal)
        .reads("irradiance_image", splat.irradiance)
        .writes("FoundPhotons", e.photons)
        .writes("PixelSum", e.sum)
        .counts("PhotonCount", e.photon_count)
        .counts("SumCount", e.sum_count)
        .execute_sliced(photon_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { gather(p, slice, stored); });
    builder.pass("sort photons of the pixel", graph::Queue::cpu)
        .reads(e.photons, e.sum)
        .writes(e.photons, e.sum)
        .execute([=](graph::PassContext& p) { sort_and_add_up(p, e); });
    builder.pass("light of the pixel by direction", graph::Queue::cpu)
        .reads(e.photons, e.sum, gbuffer.geometric_normal)
        .writes(e.directions, e.paths)
        .counts(e.direction_count)
        .counts(e.path_count)
        .execute([=](graph::PassContext& p) { show_light(p, gbuffer, e, maps); });
}

}  // namespace ir::methods::ldm_indirect
