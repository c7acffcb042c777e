#include "renderers/methods/photon-mapping/tracing/wavefront.h"

#include <algorithm>
#include <cmath>

#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/records.h"
#include "renderers/passes/scan/scan.h"
#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::Field;
using graph::FieldType;
using graph::GraphBuilder;
using graph::PassContext;
using graph::Slice;

constexpr int max_bounces = 15;  ///< what a photon has bits for
/// Mirrors that one path may meet, where the scene has any; each costs a wavefront.
constexpr int max_mirrors = 4;
constexpr std::int64_t first_slice = 4096;
constexpr std::uint64_t sums_words = 12 * 16;  ///< tally.glsl

/// By the factors alone: texels below a factor that is no mirror are cut where paths meet them, and counted.
bool may_be_mirror(const scene::Material& m, Transport::Materials model) {
    if (model == Transport::Materials::lambert || m.unlit) return false;
    const bool has_interface = model == Transport::Materials::gltf || m.metallic > 0;
    return has_interface && m.roughness * m.roughness < passes::mirror_alpha;
}

void note_limits(GraphBuilder& builder, const Transport& transport) {
    if (transport.max_bounces > max_bounces)
        builder.note("photons are traced over " + std::to_string(max_bounces) + " of " +
                     std::to_string(transport.max_bounces) + " bounces; set max_bounces lower");
    if (transport.min_bounces > transport.max_bounces && transport.paths != Transport::Paths::direct)
        builder.note("no photon is stored: min_bounces exceeds max_bounces; raise max_bounces");
    if (transport.materials == Transport::Materials::lambert) return;
    const auto& materials = builder.inputs().scene->materials;
    const auto glass = std::count_if(materials.begin(), materials.end(),
                                     [](const scene::Material& m) { return m.transmission > 0; });
    if (glass > 0)
        builder.note("photons are absorbed by glass: of " + std::to_string(glass) +
                     " transmissive materials only the opaque part scatters");
}

graph::BufferRef declare(GraphBuilder& builder, const std::string& part, const std::string& label,
                         std::vector<Field> fields, std::uint64_t elements, bool cleared = false) {
    return builder.buffer({.text = {.key = "photons." + part, .label = label},
                           .fields = std::move(fields),
                           .elements = elements,
                           .cleared = cleared});
}

unsigned folded(std::uint64_t seed) {
    return static_cast<unsigned>(seed) ^ static_cast<unsigned>(seed >> 32);
}

template <class Enum>
int index_of(Enum choice) {
    return static_cast<int>(choice);
}

}  // namespace

CullingView culling_view(const scene::View& view, const Parameters& parameters, float scene_radius) {
    const auto rows = glm::transpose(view.clip_from_world());
    CullingView result;
    const glm::vec4 planes[4] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]};
    for (int i = 0; i < 4; ++i) result.sides[i] = planes[i] / glm::length(glm::vec3(planes[i]));
    const bool is_perspective = rows[3] != glm::vec4(0, 0, 0, 1);
    const auto backwards = glm::vec3(glm::transpose(view.view_from_world)[2]);
    result.eye_ws = is_perspective ? glm::vec4(view.eye_ws, 1) : glm::vec4(backwards, 0);
    const float longest = std::max({1.0f, parameters.stretch_max, parameters.normal_axis});
    const float radius = std::max(parameters.radius_min, parameters.radius_max) * scene_radius;
    result.reach = longest * radius * std::sqrt(parameters.kernel_scale);
    const auto divisor = static_cast<float>(1 << index_of(parameters.splat_resolution));
    const float texel = divisor * 2 / (std::abs(view.clip_from_view[1][1]) * static_cast<float>(view.height));
    // at the right and lower edge a texel may end outside of the picture
    result.texel_reach = longest * std::max(1.0f, parameters.radius_texels) * texel;
    return result;
}

Wavefront::Wavefront(GraphBuilder& builder, const passes::SceneBuffers& scene, const SamplePoints& samples,
                     const Parameters& parameters)
    : scene_(scene), samples_(samples), parameters_(parameters) {
    const auto& transport = parameters.transport;
    note_limits(builder, transport);
    bounces_ = std::min(transport.max_bounces, max_bounces);
    const auto& materials = builder.inputs().scene->materials;
    const bool has_mirrors = std::any_of(materials.begin(), materials.end(), [&](const auto& m) {
        return may_be_mirror(m, transport.materials);
    });
    mirrors_ = has_mirrors ? max_mirrors : 0;
    surfaces_ = passes::hit_surfaces(builder, scene);
    rays_ = passes::declare_rays(builder, "photons", samples.paths);
    paths_ =
        declare(builder, "paths", "Paths of photons",
                {{"power", FieldType::f32, 3}, {"way"}, {"bits", FieldType::u32}, {"seed", FieldType::u32}},
                samples.paths);
    landed_ = declare(builder, "landed", "Photons where they landed last", photon_fields(), samples.paths);
    flags_ =
        declare(builder, "stored", "Whether photons are stored", {{"stored", FieldType::u32}}, samples.paths);
    bases_ = declare(builder, "bases", "Photons stored before each surface", {{"count", FieldType::u32}},
                     static_cast<std::uint64_t>(surfaces()) + 1);
    sums_ =
        declare(builder, "sums", "Counts and power by bounce", {{"word", FieldType::u32}}, sums_words, true);
}

void Wavefront::set_path_rules(const PassContext& context, const gl::Program& program) const {
    const auto& transport = parameters_.transport;
    program.set("frame_seed", folded(context.inputs().seed));
    program.set("materials", index_of(transport.materials));
    program.set("microfacet_sampling", index_of(parameters_.microfacet_sampling));
    program.set("per_channel", parameters_.roulette == Roulette::per_channel);
    program.set("max_distance", transport.max_distance);
}

void Wavefront::over_paths(const gl::Program& program, Slice slice) const {
    gl::dispatch_items(program, slice.begin, slice.end, "first_path", "end_path");
}

void Wavefront::leave(GraphBuilder& builder, const Photons& photons) const {
    // where no bounce is stored the list of photons is empty, and still there
    builder.pass("leave sample points")
        .reads("Samples", samples_.points)
        .reads("Sources", samples_.sources)
        .writes("Rays", rays_.rays)
        .writes("Paths", paths_)
        .writes("Tally", sums_)
        .writes(photons.records)
        .counts("SampleCount", samples_.count)
        .execute_sliced(
            static_cast<std::int64_t>(samples_.paths),
            [self = *this](PassContext& context, Slice slice) {
                const auto& program = context.use({{"methods/photon-mapping/tracing/leave.comp"}});
                self.set_path_rules(context, program);
                program.set("repeats", static_cast<unsigned>(self.samples_.photons_per_point));
                program.set("sample_capacity", static_cast<unsigned>(context.capacity(self.samples_.points)));
                self.over_paths(program, slice);
            },
            first_slice);
}

void Wavefront::advance(GraphBuilder& builder, int number, const Photons& photons) const {
    const auto name = std::to_string(number);
    passes::trace_rays(builder, "trace " + name, scene_, parameters_.tracer, rays_);
    land(builder, number, photons);
    if (number < parameters_.transport.min_bounces) return;
    const auto places =
        passes::exclusive_scan(builder, "photons.surface" + name, flags_, samples_.paths, photons.count);
    store(builder, number, places, photons);
}

void Wavefront::land(GraphBuilder& builder, int number, const Photons& photons) const {
    auto pass = builder.pass("land " + std::to_string(number));
    surfaces_.read_by(pass);
    pass.reads("Hits", rays_.hits)
        .writes("Rays", rays_.rays)
        .writes("Paths", paths_)
        .writes("Tally", sums_)
        .writes("Landed", landed_)
        .writes("Flags", flags_)
        .writes("Bases", bases_)
        .counts("StoredCount", photons.count);
    pass.execute_sliced(
        static_cast<std::int64_t>(samples_.paths),
        [self = *this, number](PassContext& context, Slice slice) {
            const auto& program = context.use({{"methods/photon-mapping/tracing/land.comp"}});
            const auto& parameters = self.parameters_;
            const auto& inputs = context.inputs();
            self.set_path_rules(context, program);
            program.set("surface_number", static_cast<unsigned>(number));
            program.set("last_surface", static_cast<unsigned>(self.surfaces()));
            program.set("min_bounces", static_cast<unsigned>(parameters.transport.min_bounces));
            program.set("max_bounces", static_cast<unsigned>(self.bounces_));
            program.set("max_mirrors", static_cast<unsigned>(self.mirrors_));
            program.set("normal_maps", parameters.transport.normal_maps);
            program.set("culling", parameters.culling);
            const auto view = culling_view(inputs.view, parameters, inputs.world->bounds.radius());
            program.set("frustum_sides", view.sides);
            program.set("eye_ws", view.eye_ws);
            program.set("kernel_reach", view.reach);
            program.set("texel_reach", view.texel_reach);
            self.over_paths(program, slice);
        },
        first_slice);
}

void Wavefront::store(GraphBuilder& builder, int number, graph::BufferRef places,
                      const Photons& photons) const {
    builder.pass("store photons " + std::to_string(number))
        .reads("Landed", landed_)
        .reads("Flags", flags_)
        .reads("Places", places)
        .reads("Bases", bases_)
        .writes("Records", photons.records)
        .execute_sliced(
            static_cast<std::int64_t>(samples_.paths),
            [self = *this, number, photons](PassContext& context, Slice slice) {
                const auto& program = context.use({{"methods/photon-mapping/tracing/store.comp"}});
                program.set("surface_number", static_cast<unsigned>(number));
                program.set("capacity", static_cast<unsigned>(context.capacity(photons.records)));
                self.over_paths(program, slice);
            },
            first_slice);
}

}  // namespace ir::methods::photon_mapping
