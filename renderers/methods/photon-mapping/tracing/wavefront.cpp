#include "renderers/methods/photon-mapping/tracing/wavefront.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/record.h"
#include "renderers/methods/photon-mapping/specular.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/lib/scattering.glsl.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "shaders/methods/photon-mapping/splatting/kernel.glsl.h"
#include "shaders/methods/photon-mapping/tracing/follow.comp.h"
#include "shaders/methods/photon-mapping/tracing/path.glsl.h"
#include "shaders/methods/photon-mapping/tracing/tally.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::Field;
using graph::FieldType;
using graph::GraphBuilder;
using graph::PassContext;

static_assert(static_cast<int>(MicrofacetSampling::visible_normals) == passes::microfacets_visible_normals &&
              static_cast<int>(MicrofacetSampling::ggx) == passes::microfacets_ggx &&
              static_cast<int>(MicrofacetSampling::ggx_printed) == passes::microfacets_ggx_printed);

constexpr int max_bounces = 15;  ///< what a photon has bits for
constexpr std::int64_t first_slice = 4096;

void note_limits(GraphBuilder& builder, const Transport& transport) {
    if (transport.max_bounces > max_bounces)
        builder.note("photons are traced over " + std::to_string(max_bounces) + " of " +
                     std::to_string(transport.max_bounces) + " bounces; set max_bounces lower");
    if (transport.min_bounces > transport.max_bounces && transport.paths != Transport::Paths::direct)
        builder.note("no photon is stored: min_bounces exceeds max_bounces; raise max_bounces");
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

/// Constants of path.glsl.
struct PathRules {
    unsigned frame_seed;
    int materials, microfacet_sampling;
    bool per_channel;
    float max_distance;
    IR_FIELDS(frame_seed, materials, microfacet_sampling, per_channel, max_distance)
};

PathRules path_rules(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto& transport = parameters.transport;
    return {.frame_seed = folded(photon_seed(inputs, parameters)),
            .materials = index_of(transport.materials),
            .microfacet_sampling = index_of(parameters.microfacet_sampling),
            .per_channel = parameters.roulette == Roulette::per_channel,
            .max_distance = transport.max_distance};
}

/// What photons are culled by, as struct CullingView of culling.glsl.
struct Culling {
    glm::mat4 frustum_sides;  ///< columns: planes through the picture's edges, unit normals inwards
    glm::vec4 eye_ws;         ///< w = 1; for parallel rays the direction towards the camera, w = 0
    float kernel_reach;  ///< m: longest half-axis that a kernel can have where it is not widened to texels
    float texel_reach;   ///< the same of kernels that are: per m of distance, or for parallel rays m
    IR_FIELDS(frustum_sides, eye_ws, kernel_reach, texel_reach)
};

Culling culling_by(const scene::View& view, const Parameters& parameters, float scene_radius) {
    const auto rows = glm::transpose(view.clip_from_world());
    Culling result;
    const glm::vec4 planes[4] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]};
    for (int i = 0; i < 4; ++i) result.frustum_sides[i] = planes[i] / glm::length(glm::vec3(planes[i]));
    const bool is_perspective = rows[3] != glm::vec4(0, 0, 0, 1);
    const auto backwards = glm::vec3(glm::transpose(view.view_from_world)[2]);
    result.eye_ws = is_perspective ? glm::vec4(view.eye_ws, 1) : glm::vec4(backwards, 0);
    const float longest = std::max({1.0f, parameters.max_stretch, parameters.normal_axis});
    const float radius = std::max(parameters.min_radius, parameters.max_radius) * scene_radius;
    result.kernel_reach = longest * radius * std::sqrt(parameters.kernel_scale);
    const auto divisor = static_cast<float>(1 << index_of(parameters.splat_resolution));
    const float texel = divisor * 2 / (std::abs(view.clip_from_view[1][1]) * static_cast<float>(view.height));
    // at the right and lower edge a texel may end outside of the picture
    result.texel_reach =
        longest * std::max(1.0f, parameters.min_radius_texels / std::sqrt(least_facing)) * texel;
    return result;
}

/// Constants of leave.comp.
struct LeavePoints {
    PathRules rules;
    unsigned repeats, sample_capacity;
    IR_FIELDS(rules, repeats, sample_capacity)
};

/// What weights of texels are learned by, where land.comp does that.
struct Weighing {
    unsigned repeats = 1;
    int map_resolution = 0, seen_gain = 1;
    bool seen_by_picture = false;
    glm::mat4 pixel_from_world{1};
    float parallel_tolerance = 0;
    IR_FIELDS(repeats, map_resolution, seen_gain, seen_by_picture, pixel_from_world, parallel_tolerance)
};

Weighing weighing_by(const graph::FrameInputs& inputs, const SamplePoints& samples,
                     const Parameters& parameters) {
    if (!samples.weights) return {};
    return {.repeats = static_cast<unsigned>(samples.photons_per_point),
            .map_resolution = samples.weights->resolution,
            .seen_gain = parameters.seen_gain,
            .seen_by_picture = parameters.seen_by == SeenBy::picture,
            .pixel_from_world = passes::pixel_from_world(inputs.view),
            // a parallel view has no distance to the eye that depth_tolerance could be of
            .parallel_tolerance = 1e-3f * inputs.world->bounds.radius()};
}

/// Constants of land.comp.
struct LandPhotons {
    PathRules rules;
    unsigned surface_number, last_surface, min_bounces, max_bounces, max_mirrors;
    bool keeps_mirrored, normal_maps, culling;
    Culling view;
    Weighing weighing;
    IR_FIELDS(rules, surface_number, last_surface, min_bounces, max_bounces, max_mirrors, keeps_mirrored,
              normal_maps, culling, view, weighing)
};

/// Constants of follow.comp.
struct FollowPaths {
    unsigned surface_number, vertices_of_path;
    IR_FIELDS(surface_number, vertices_of_path)
};

/// Constants of store.comp.
struct StorePhotons {
    unsigned surface_number, capacity;
    IR_FIELDS(surface_number, capacity)
};

}  // namespace

Wavefront::Wavefront(GraphBuilder& builder, const passes::SceneBuffers& scene, const SamplePoints& samples,
                     const Parameters& parameters)
    : scene_(scene), samples_(samples), parameters_(parameters) {
    const auto& transport = parameters.transport;
    note_limits(builder, transport);
    bounces_ = std::min(transport.max_bounces, max_bounces);
    mirrors_ = max_specular_events(*builder.inputs().scene, transport.materials);
    surfaces_ = passes::hit_surfaces(builder, scene);
    rays_ = passes::declare_rays(builder, "photons", samples.paths);
    paths_ = declare(builder, "paths", "Paths of photons", record_fields<PathState>(), samples.paths);
    landed_ =
        declare(builder, "landed", "Photons where they landed last", record_fields<Photon>(), samples.paths);
    flags_ =
        declare(builder, "stored", "Whether photons are stored", {{"stored", FieldType::u32}}, samples.paths);
    bases_ = declare(builder, "bases", "Photons stored before each surface", {{"count", FieldType::u32}},
                     static_cast<std::uint64_t>(surfaces()) + 1);
    sums_ = declare(builder, "sums", "Counts and power by bounce", {{"word", FieldType::u32}},
                    tally_words * tally_rows, true);
    legs_.surfaces = surfaces();
    const auto vertices_of_path = static_cast<std::uint64_t>(surfaces()) + 1;
    legs_.paths =
        std::min(samples.paths, builder.max_buffer_bytes() / (vertices_of_path * sizeof(PathVertex)));
    legs_.vertices = declare(builder, "vertices", "Vertices of paths", record_fields<PathVertex>(),
                             std::max<std::uint64_t>(1, legs_.paths * vertices_of_path));
}

void Wavefront::leave(GraphBuilder& builder, const Photons& photons) const {
    // where no bounce is stored the list of photons is empty, and still there
    auto pass = builder.pass("leave sample points");
    pass.reads("Samples", samples_.points)
        .writes("Rays", rays_.rays)
        .writes("Paths", paths_)
        .writes("Tally", sums_)
        .writes(photons.records)
        .counts("SampleCount", samples_.count);
    const auto rules = path_rules(builder.inputs(), parameters_);
    pass.compute_sliced(
        {{"methods/photon-mapping/tracing/leave.comp"}}, static_cast<std::int64_t>(samples_.paths),
        [rules, samples = samples_](const PassContext& context) {
            return LeavePoints{rules, static_cast<unsigned>(samples.photons_per_point),
                               static_cast<unsigned>(context.capacity(samples.points))};
        },
        first_slice);
}

void Wavefront::advance(GraphBuilder& builder, int number, const Photons& photons) const {
    const auto name = std::to_string(number);
    passes::trace_rays(builder, "trace " + name, scene_, tracer_of(builder.inputs(), parameters_), rays_,
                       parameters_.cube);
    follow(builder, number);
    land(builder, number, photons);
    if (number < parameters_.transport.min_bounces && !keeps_mirrored()) return;
    const auto places =
        passes::exclusive_scan(builder, "photons.surface" + name, flags_, samples_.paths, photons.count);
    store(builder, number, places, photons);
}

void Wavefront::follow(GraphBuilder& builder, int number) const {
    auto pass = builder.pass("follow paths " + std::to_string(number));
    pass.reads("Rays", rays_.rays).reads("Hits", rays_.hits).writes("Vertices", legs_.vertices);
    pass.compute_sliced(
        {{"methods/photon-mapping/tracing/follow.comp"}}, static_cast<std::int64_t>(legs_.paths),
        FollowPaths{static_cast<unsigned>(number), static_cast<unsigned>(legs_.surfaces) + 1}, first_slice);
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
    gl::ProgramSource source{{"methods/photon-mapping/tracing/land.comp"}};
    const auto& weights = samples_.weights;
    if (weights) {
        source.defines["WEIGHS"] = "1";
        pass.reads("Samples", samples_.points).writes("Sums", weights->sums).reads(weights->surfaces);
    }
    const auto& inputs = builder.inputs();
    const auto& transport = parameters_.transport;
    pass.compute_sliced(
        source, static_cast<std::int64_t>(samples_.paths),
        LandPhotons{.rules = path_rules(inputs, parameters_),
                    .surface_number = static_cast<unsigned>(number),
                    .last_surface = static_cast<unsigned>(surfaces()),
                    .min_bounces = static_cast<unsigned>(transport.min_bounces),
                    .max_bounces = static_cast<unsigned>(bounces_),
                    .max_mirrors = static_cast<unsigned>(mirrors_),
                    .keeps_mirrored = keeps_mirrored(),
                    .normal_maps = transport.normal_maps,
                    .culling = parameters_.culling,
                    .view = culling_by(inputs.view, parameters_, inputs.world->bounds.radius()),
                    .weighing = weighing_by(inputs, samples_, parameters_)},
        first_slice);
}

void Wavefront::store(GraphBuilder& builder, int number, graph::BufferRef places,
                      const Photons& photons) const {
    auto pass = builder.pass("store photons " + std::to_string(number));
    pass.reads("Landed", landed_)
        .reads("Flags", flags_)
        .reads("Places", places)
        .reads("Bases", bases_)
        .writes("Records", photons.records);
    pass.compute_sliced(
        {{"methods/photon-mapping/tracing/store.comp"}}, static_cast<std::int64_t>(samples_.paths),
        [number, records = photons.records](const PassContext& context) {
            return StorePhotons{static_cast<unsigned>(number),
                                static_cast<unsigned>(context.capacity(records))};
        },
        first_slice);
}

}  // namespace ir::methods::photon_mapping
