#include "renderers/methods/photon-mapping/emission/traced.h"

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/photon-mapping/emission/points.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::PassContext;

constexpr std::int64_t first_slice = 1 << 14;

/// What the passes over the points share.
struct Emitter {
    passes::SceneBuffers scene;
    Sources sources;
    EmissionPoints points;
    passes::RayBuffers rays;
    passes::HitSurfaces surfaces;
    Parameters parameters;

    const gl::Program& use(const PassContext& p, gl::ProgramSource source) const {
        const auto& program = p.use(source);
        set_emission_set(program, p.inputs(), sources, points, parameters);
        return program;
    }

    void make_rays(const PassContext& p, graph::Slice slice) const {
        const auto& program = use(p, {{"methods/photon-mapping/emission/rays.comp"}});
        program.set("bounds_radius", p.inputs().world->bounds.radius());
        gl::dispatch_items(program, slice.begin, slice.end);
    }

    const gl::Program& use_hits(const PassContext& p, bool packs) const {
        gl::ProgramSource source{{"methods/photon-mapping/emission/hits.comp"}};
        source.defines["PACKS"] = packs ? "1" : "0";
        const auto& program = use(p, source);
        set_surface_rules(program, parameters);
        program.set("normal_maps", parameters.transport.normal_maps ? 1 : 0);
        return program;
    }

    void find_survivors(const PassContext& p, graph::Slice slice) const {
        const auto& program = use_hits(p, false);
        gl::dispatch_items(program, slice.begin, slice.end);
    }

    void pack(const PassContext& p, graph::Slice slice) const {
        const auto& program = use_hits(p, true);
        program.set("capacity", static_cast<unsigned>(p.capacity(points.samples.points)));
        program.set("power_unit", points.samples.power_unit);
        program.set("photons_per_point", static_cast<float>(points.samples.photons_per_point));
        program.set("bounds_radius", p.inputs().world->bounds.radius());
        gl::dispatch_items(program, slice.begin, slice.end);
    }
};

}  // namespace

SamplePoints emit_traced(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                         const Parameters& parameters) {
    const auto sources = traced_lights(*builder.inputs().scene, *builder.inputs().world);
    for (const auto& note : sources.notes()) builder.note(note);
    auto points = declare_points(builder, sources, parameters);
    divide_points(builder, sources, points, nullptr, parameters);
    Emitter emitter{scene, sources, points, {}, {}, parameters};
    emitter.rays = passes::declare_rays(builder, "emission", std::max<std::uint64_t>(1, points.count));
    const auto items = static_cast<std::int64_t>(points.count);

    builder.pass("emission rays")
        .reads("Sources", points.samples.sources)
        .reads(scene.lights)
        .writes("Rays", emitter.rays.rays)
        .execute_sliced(
            items, [=](PassContext& p, graph::Slice slice) { emitter.make_rays(p, slice); }, first_slice);
    passes::trace_rays(builder, "trace emission", scene, parameters.tracer, emitter.rays);
    emitter.surfaces = passes::hit_surfaces(builder, scene);

    const auto reads = [&](graph::PassBuilder& pass) {
        emitter.surfaces.read_by(pass);
        pass.reads("Sources", points.samples.sources)
            .reads(scene.lights)
            .reads("Rays", emitter.rays.rays)
            .reads("Hits", emitter.rays.hits);
    };
    auto survive = builder.pass("emission points");
    reads(survive);
    survive.writes("Survivors", points.survivors)
        .execute_sliced(
            items, [=](PassContext& p, graph::Slice slice) { emitter.find_survivors(p, slice); },
            first_slice);
    find_places(builder, points);
    emitter.points = points;
    auto pack = builder.pass("sample points");
    reads(pack);
    pack.reads("Places", points.places)
        .writes("Samples", points.samples.points)
        .execute_sliced(
            items, [=](PassContext& p, graph::Slice slice) { emitter.pack(p, slice); }, first_slice);
    return points.samples;
}

}  // namespace ir::methods::photon_mapping
