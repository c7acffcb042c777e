#include "renderers/methods/ldm-indirect/tracing/splitting.h"

#include <algorithm>

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/ldm-indirect/splatting/ellipses.h"
#include "renderers/methods/ldm-indirect/tracing/first_hits.h"
#include "renderers/methods/ldm-indirect/tracing/landing.h"
#include "renderers/passes/ldm/host/trace_on_host.h"
#include "renderers/passes/scan/scan.h"

namespace ir::methods::ldm_indirect {
namespace {

using graph::FieldType;
using graph::GraphBuilder;
using graph::PassContext;
using graph::Slice;

/// Maps of one dispatch: as many as devices have uniforms for.
constexpr std::int64_t group_maps = 16;
/// Photons whose hits are kept at once, 8 bytes each; with rays, which take 48 bytes more.
constexpr std::int64_t part_slots = std::int64_t{1} << 22, part_rays = std::int64_t{1} << 20;

graph::BufferRef scratch(GraphBuilder& builder, const std::string& key, const std::string& label,
                         std::vector<graph::Field> fields, std::int64_t elements) {
    graph::BufferDesc desc;
    desc.text.key = "indirect." + key;
    desc.text.label = label;
    desc.fields = std::move(fields);
    desc.elements = static_cast<std::uint64_t>(std::max<std::int64_t>(1, elements));
    return builder.buffer(std::move(desc));
}

/// Constants of trace.comp.
struct Trace {
    LandingConstants landing;
    passes::ldm::FrameConstants frames;
    unsigned batch_maps, group_count, first_primary, chunk, map_group, first_map, map_count;
    IR_FIELDS(landing, frames, batch_maps, group_count, first_primary, chunk, map_group, first_map, map_count)
};

/// Constants of rays.comp.
struct LeaveRays {
    unsigned first_primary, end_primary, first_frame, batch_maps;
    float ray_start;
    IR_FIELDS(first_primary, end_primary, first_frame, batch_maps, ray_start)
};

/// Constants of trace.comp with RAYS alone.
struct RayStart {
    float ray_start;
    IR_FIELDS(ray_start)
};

/// Constants of store.comp; without RAYS it has Ellipses, too.
struct Store {
    unsigned first_primary, first_frame, batch_maps, map_groups, maps_of_group, chunk, capacity;
    IR_FIELDS(first_primary, first_frame, batch_maps, map_groups, maps_of_group, chunk, capacity)
};

/// Constants of store_direct.comp.
struct StoreDirect {
    unsigned capacity;
    IR_FIELDS(capacity)
};

std::int64_t groups_of(std::int64_t maps) {
    return (maps + group_maps - 1) / group_maps;
}

}  // namespace

Splitter::Splitter(GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
                   passes::ldm::MapsPointer maps, const Primaries& primaries, const Photons& photons,
                   const Parameters& parameters)
    : scene_(scene),
      gbuffer_(gbuffer),
      maps_(std::move(maps)),
      primaries_(primaries),
      photons_(photons),
      parameters_(parameters) {
    const std::int64_t batch_maps = maps_->layout.batch_maps;
    const auto tracer = ray_tracer(parameters_);
    part_photons_ = std::clamp<std::int64_t>((tracer ? part_rays : part_slots) / batch_maps, 1,
                                             static_cast<std::int64_t>(primaries_.count()));
    if (tracer)
        rays_ = Rays{*tracer,
                     passes::declare_rays(builder, "indirect.split",
                                          static_cast<std::uint64_t>(part_photons_ * batch_maps)),
                     passes::hit_surfaces(builder, scene_)};
    hits_ = scratch(builder, "hits", "Hits of photons", {{"distance"}, {"normal", FieldType::u32}},
                    part_photons_ * batch_maps);
    counts_ = scratch(builder, "counts", "Photons to store", {{"count", FieldType::u32}},
                      part_photons_ * groups_of(batch_maps));
    bases_ = scratch(builder, "bases", "Photons stored before each part", {{"count", FieldType::u32}},
                     std::int64_t{maps_->layout.batches()} * parts());
}

int Splitter::parts() const {
    const auto count = static_cast<std::int64_t>(primaries_.count());
    return static_cast<int>((count + part_photons_ - 1) / part_photons_);
}

Splitter::Part Splitter::part(int batch, int index) const {
    Part result;
    result.name = maps_->batch_name(batch);
    if (parts() > 1) result.name += ", part " + std::to_string(index + 1) + " of " + std::to_string(parts());
    result.batch = batch;
    result.chunk = batch * parts() + index;
    result.first = index * part_photons_;
    result.end = std::min(result.first + part_photons_, static_cast<std::int64_t>(primaries_.count()));
    result.batch_maps = maps_->batch_maps(batch);
    result.groups = groups_of(result.batch_maps);
    return result;
}

void Splitter::split(GraphBuilder& builder, int batch) const {
    for (int index = 0; index < parts(); ++index) {
        const auto p = part(batch, index);
        if (rays_) trace_rays(builder, p);
        trace(builder, p);
        const auto places =
            passes::exclusive_scan(builder, "indirect.part" + std::to_string(p.chunk + 1), counts_,
                                   static_cast<std::uint64_t>((p.end - p.first) * p.groups), photons_.count);
        store(builder, p, places);
    }
}

void Splitter::define(const PassContext& context, gl::ProgramSource& source) const {
    if (rays_)
        source.defines["RAYS"] = "1";
    else
        source.defines = passes::ldm::defines_of(context, *maps_);
}

void Splitter::trace_rays(GraphBuilder& builder, const Part& part) const {
    const auto rays = static_cast<std::int64_t>(rays_->buffers.capacity);
    builder.pass("rays of photons" + part.name)
        .reads(maps_->frame_buffer)
        .reads("Primaries", primaries_.records)
        .writes("Rays", rays_->buffers.rays)
        .compute_sliced({{"methods/ldm-indirect/tracing/rays.comp"}}, rays,
                        LeaveRays{static_cast<unsigned>(part.first), static_cast<unsigned>(part.end),
                                  static_cast<unsigned>(maps_->first_map(part.batch)),
                                  static_cast<unsigned>(part.batch_maps), ray_start(*maps_)},
                        4096);
    passes::trace_rays(builder, "trace rays" + part.name, scene_, rays_->tracer, rays_->buffers,
                       parameters_.cube);
}

void Splitter::trace(GraphBuilder& builder, const Part& part) const {
    auto pass = builder.pass("trace photons" + part.name);
    if (passes::ldm::has_host_body(maps_->options) && traces_on_host(parameters_)) pass.has_two_bodies();
    if (rays_)
        pass.reads(maps_->frame_buffer)
            .reads("RayHits", rays_->buffers.hits)
            .reads(rays_->surfaces.vertices)
            .reads("HitIndices", rays_->surfaces.indices);
    else
        passes::ldm::reads_maps(pass, *maps_);
    pass.reads(gbuffer_.position, gbuffer_.geometric_normal)
        .reads("Primaries", primaries_.records)
        .writes("Hits", hits_)
        .writes("Counts", counts_)
        .writes("Bases", bases_)
        .writes("AllShares", primaries_.shares)
        .counts("StoredCount", photons_.count);
    const auto run = [self = *this, part, landed = landing_constants(builder.inputs(), parameters_)](
                         PassContext& context, Slice slice) {
        gl::ProgramSource source{{"methods/ldm-indirect/tracing/trace.comp"}};
        self.define(context, source);
        const auto& program = context.use(source);
        if (self.rays_) program.set(RayStart{ray_start(*self.maps_)});
        for (std::int64_t group = 0; group < part.groups; ++group) {
            const auto first = group * group_maps, count = std::min(group_maps, part.batch_maps - first);
            const auto first_frame = self.maps_->first_map(part.batch) + first;
            program.set(Trace{.landing = landed,
                              .frames = passes::ldm::frame_constants(*self.maps_, first_frame, count),
                              .batch_maps = static_cast<unsigned>(part.batch_maps),
                              .group_count = static_cast<unsigned>(part.groups),
                              .first_primary = static_cast<unsigned>(part.first),
                              .chunk = static_cast<unsigned>(part.chunk),
                              .map_group = static_cast<unsigned>(group),
                              .first_map = static_cast<unsigned>(first),
                              .map_count = static_cast<unsigned>(count)});
            gl::dispatch_items(program, part.first + slice.begin, part.first + slice.end);
            context.barrier();
        }
    };
    pass.execute_sliced(part.end - part.first, run, 256);
}

void Splitter::store(GraphBuilder& builder, const Part& part, graph::BufferRef places) const {
    auto pass = builder.pass("store photons" + part.name);
    if (rays_)
        pass.reads(maps_->frame_buffer);
    else
        passes::ldm::reads_maps(pass, *maps_);
    pass.reads("Primaries", primaries_.records)
        .reads("Hits", hits_)
        .reads("Places", places)
        .reads("Bases", bases_)
        .writes("Photons", photons_.records);
    const auto run = [self = *this, part](PassContext& context, Slice slice) {
        gl::ProgramSource source{{"methods/ldm-indirect/tracing/store.comp"}};
        self.define(context, source);
        const auto& program = context.use(source);
        if (!self.rays_) program.set(ellipses(context.inputs(), self.parameters_));
        program.set(Store{.first_primary = static_cast<unsigned>(part.first),
                          .first_frame = static_cast<unsigned>(self.maps_->first_map(part.batch)),
                          .batch_maps = static_cast<unsigned>(part.batch_maps),
                          .map_groups = static_cast<unsigned>(part.groups),
                          .maps_of_group = static_cast<unsigned>(group_maps),
                          .chunk = static_cast<unsigned>(part.chunk),
                          .capacity = static_cast<unsigned>(context.capacity(self.photons_.records))});
        gl::dispatch_items(program, slice.begin, slice.end);
    };
    pass.execute_sliced((part.end - part.first) * part.groups, run, 4096);
}

graph::BufferRef store_directly(GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                const Primaries& primaries, const Photons& photons,
                                const Parameters& parameters) {
    const auto count = static_cast<std::int64_t>(primaries.from_images);
    const auto hits = scratch(builder, "direct_hits", "Hits of primary photons",
                              {{"distance"}, {"normal", FieldType::u32}}, count);
    const auto counts =
        scratch(builder, "direct_counts", "Primary photons to store", {{"count", FieldType::u32}}, count);
    const auto fates =
        scratch(builder, "direct_fates", "Fates of primary photons", {{"cause", FieldType::u32}}, count);
    builder.pass("see primary photons")
        .reads(gbuffer.position, gbuffer.geometric_normal)
        .reads("Primaries", primaries.records)
        .writes("Hits", hits)
        .writes("Counts", counts)
        .writes("Fates", fates)
        .compute_sliced({{"methods/ldm-indirect/tracing/direct.comp"}}, count,
                        landing_constants(builder.inputs(), parameters), 4096);
    const auto places =
        passes::exclusive_scan(builder, "indirect.direct", counts, primaries.from_images, photons.count);
    builder.pass("store primary photons")
        .reads("Primaries", primaries.records)
        .reads("Hits", hits)
        .reads("Counts", counts)
        .reads("Places", places)
        .writes("Photons", photons.records)
        .compute_sliced(
            {{"methods/ldm-indirect/tracing/store_direct.comp"}}, count,
            [records = photons.records](const PassContext& context) {
                return StoreDirect{static_cast<unsigned>(context.capacity(records))};
            },
            4096);
    return fates;
}

}  // namespace ir::methods::ldm_indirect
