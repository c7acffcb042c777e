#include "renderers/methods/photon-mapping/emission/traced.h"

#include "renderers/methods/photon-mapping/emission/points.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::photon_mapping {
namespace {

/// Constants of rays.comp.
struct LightRays {
    EmissionSets sets;
    float bounds_radius;
    IR_FIELDS(sets, bounds_radius)
};

/// Constants of hits.comp.
struct LightHits {
    LightRays rays;
    SurfaceRules rules;
    bool normal_maps;
    unsigned capacity;  ///< 0 where only survivors are found
    float power_unit, photons_per_point;
    IR_FIELDS(rays, rules, normal_maps, capacity, power_unit, photons_per_point)
};

gl::ProgramSource source_of_hits(bool packs) {
    return {{"methods/photon-mapping/emission/hits.comp"}, {{"PACKS", packs ? "1" : "0"}}};
}

}  // namespace

SamplePoints emit_traced(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                         const Parameters& parameters) {
    const auto& inputs = builder.inputs();
    const auto sources = traced_lights(*inputs.scene, *inputs.world);
    for (const auto& note : sources.notes()) builder.note(note);
    auto points = declare_points(builder, sources, parameters);
    const auto& samples = points.samples;
    divide_points(builder, sources, points, nullptr, parameters);
    const auto rays = passes::declare_rays(builder, "emission", std::max<std::uint64_t>(1, points.count));
    const auto items = static_cast<std::int64_t>(points.count);

    const LightRays light_rays{emission_sets(inputs, sources, points, parameters),
                               inputs.world->bounds.radius()};
    auto emission = builder.pass("emission rays");
    emission.reads("Sources", samples.sources).reads(scene.lights).writes("Rays", rays.rays);
    emission.compute_sliced({{"methods/photon-mapping/emission/rays.comp"}}, items, light_rays,
                            first_points_slice);
    passes::trace_rays(builder, "trace emission", scene, parameters.tracer, rays);
    const auto surfaces = passes::hit_surfaces(builder, scene);

    const auto reads = [&](graph::PassBuilder& pass) {
        surfaces.read_by(pass);
        pass.reads("Sources", samples.sources)
            .reads(scene.lights)
            .reads("Rays", rays.rays)
            .reads("Hits", rays.hits);
    };
    LightHits hits{.rays = light_rays,
                   .rules = surface_rules(parameters),
                   .normal_maps = parameters.transport.normal_maps,
                   .capacity = 0,
                   .power_unit = samples.power_unit,
                   .photons_per_point = static_cast<float>(samples.photons_per_point)};
    auto survive = builder.pass("emission points");
    reads(survive);
    survive.writes("Survivors", points.survivors);
    survive.compute_sliced(source_of_hits(false), items, hits, first_points_slice);
    find_places(builder, points);
    auto pack = builder.pass("sample points");
    reads(pack);
    pack.reads("Places", points.places).writes("Samples", samples.points);
    pack.compute_sliced(
        source_of_hits(true), items,
        [hits, packed = samples.points](const graph::PassContext& p) {
            auto constants = hits;
            constants.capacity = static_cast<unsigned>(p.capacity(packed));
            return constants;
        },
        first_points_slice);
    return samples;
}

}  // namespace ir::methods::photon_mapping
