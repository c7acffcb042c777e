#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "renderers/core/constants.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/gloss/gloss.h"
#include "renderers/methods/ldm-indirect/gloss/hit_light.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/gbuffer/gbuffer_surfaces.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/ldm/host/map_rays.h"
#include "renderers/passes/ldm/host/trace_on_host.h"
#include "renderers/passes/ldm/regions.h"
#include "renderers/passes/raytracing/layered_depth_cube.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/highlights.h"
#include "renderers/passes/scattering/keep_interface.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/passes/scene/stands_still.h"
#include "renderers/passes/surface/host_surfaces.h"

namespace ir::methods::ldm_indirect {
namespace {

namespace ldm = passes::ldm;

/// How far before and behind a map's hit its surface is looked for, in texels: as far as depths of
/// neighbouring texels count as one surface (landing=plane); and about an entry, at its texel's centre.
constexpr float reach_texels = 3, entry_texels = 0.25f;
/// Items of work that are no maps, of each event of the paths.
constexpr std::int64_t parts = 64;
/// Of as many samples of a pixel the paths go on together, so that maps are built once for them.
constexpr std::size_t paths_together = 1 << 20;
/// Directions count as above a surface.
constexpr float least_cosine = 1e-3f;

/// What goes on from a surface.
struct Path {
    std::uint32_t pixel, sample;
    int scatterings;       ///< of the light on its way to the eye; mirrors are none
    glm::vec3 throughput;  ///< 0: it has ended
    glm::vec3 light;       ///< W/(m² sr), of what it has met
    glm::vec3 wished;      ///< unit direction
    float spread;          ///< directions that it stands for, sr; 0: mirrored
    ldm::MapRay from;      ///< where it is, and along which map it goes
};

/// What the pass reads and writes.
struct GlossResources {
    passes::GBuffer gbuffer;
    graph::ObjectRef bvh, surfaces;
    GlossImages images;
    std::optional<graph::ObjectRef> sources = {}, meshlets = {}, cube = {};
    graph::CounterRef lost = {};
};

/// The paths of a frame, which go on from event to event. [Aalund15 §6]
class Reflections {
  public:
    Reflections(ldm::MapsPointer maps, const Parameters& parameters, const graph::FrameInputs& inputs)
        : maps_(std::move(maps)),
          parameters_(parameters),
          is_whole_(parameters.transport.paths == Transport::Paths::full),
          by_maps_(parameters.gloss.tracer == GlossTracer::maps),
          seed_(passes::mixed(photon_seed(inputs, parameters))),
          share_(highlight_share(inputs, parameters)),
          viewer_(passes::viewer(inputs.view)),
          width_(inputs.view.width),
          height_(inputs.view.height),
          threads_(inputs.threads),
          regions_(parameters.maps.directions),
          into_regions_(glm::transpose(parameters.maps.rotation)),
          rays_(maps_, ldm::self_hit_rule(parameters.maps), ldm::host_threads(inputs)) {}

    /// Groups of samples, of each the events of a path, of each all maps and the parts of what comes then.
    std::int64_t items() const { return groups() * events() * of_event(); }
    std::int64_t first_slice() const { return rays_.first_slice(); }

    void run(const graph::PassContext& context, const GlossResources& r, graph::Slice slice) {
        const Frame frame(context, r, parameters_);
        if (slice.first) begin();
        for (auto item = slice.begin; item < slice.end;) {
            const auto within = item % of_event(), event = item / of_event() % events();
            if (within == 0)
                begin_event(frame, static_cast<int>(item / (events() * of_event())), static_cast<int>(event));
            const auto last = within < map_items() ? map_items() : of_event();
            const auto end = std::min(within + slice.end - item, last);
            if (within < map_items())
                rays_.trace(*frame.meshlets, within, end, context.cancel(), map_hits_);
            else
                go_on(frame, static_cast<int>(event), within - map_items(), end - map_items());
            item += end - within;
        }
        if (!slice.last) return;
        settle(true);
        write(context, r);
        context.add(r.lost, lost_);
    }

  private:
    /// What paths meet in a slice.
    struct Frame {
        Frame(const graph::PassContext& context, const GlossResources& r, const Parameters& parameters)
            : inputs(context.inputs()),
              cancel(context.cancel()),
              pixels(context, r.gbuffer),
              bvh(context.object<passes::Bvh>(r.bvh)),
              surfaces(context.object<passes::SurfaceLookup>(r.surfaces)) {
            if (r.sources) sources = context.object<passes::ExtendedEmitters>(*r.sources);
            if (r.meshlets) meshlets = context.object<ldm::HostScene>(*r.meshlets);
            if (r.cube) cube = context.object<passes::LayeredDepthCube>(*r.cube);
            light.emplace(inputs, *bvh, *surfaces, sources.get(),
                          passes::extended_light_options(parameters.light, parameters.transport));
        }
        const graph::FrameInputs& inputs;
        const CancelToken& cancel;
        passes::GBufferSurfaces pixels;
        std::shared_ptr<passes::Bvh> bvh;
        std::shared_ptr<passes::SurfaceLookup> surfaces;
        std::shared_ptr<passes::ExtendedEmitters> sources;
        std::shared_ptr<ldm::HostScene> meshlets;
        std::shared_ptr<passes::LayeredDepthCube> cube;
        std::optional<HitLight> light;
    };
    struct Met {
        passes::Hit hit;
        glm::vec3 direction;   ///< along which it is seen
        bool is_lost = false;  ///< no surface is where a map has an entry
    };

    std::int64_t events() const { return parameters_.transport.max_bounces + most_mirrors; }
    std::int64_t map_items() const { return by_maps_ ? maps_->layout.maps : 0; }
    std::int64_t of_event() const { return map_items() + parts; }
    int together() const {
        const auto most = paths_together / std::max<std::size_t>(pixel_count(), 1);
        return static_cast<int>(
            std::clamp<std::size_t>(most, 1, static_cast<std::size_t>(parameters_.gloss.samples)));
    }
    std::int64_t groups() const { return (parameters_.gloss.samples + together() - 1) / together(); }
    std::size_t pixel_count() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    void begin() {
        paths_.clear();
        sums_.assign(pixel_count(), glm::vec3(0));
        errors_.assign(pixel_count(), 0);
        met_at_.assign(pixel_count(), 0);
        lost_ = 0;
    }

    void begin_event(const Frame& frame, int group, int event) {
        if (event == 0) look_from_pixels(frame, group * together());
        settle(false);
        map_hits_.assign(paths_.size(), {});
        if (!by_maps_) return;
        map_rays_.clear();
        for (const auto& path : paths_) map_rays_.push_back(path.from);
        rays_.sort(map_rays_);
    }

    /// Adds the light of paths that have ended, or of all, to their pixels, and drops them.
    void settle(bool all) {
        std::erase_if(paths_, [&](const Path& path) {
            const bool has_ended = all || path.throughput == glm::vec3(0);
            if (has_ended) sums_[path.pixel] += path.light;
            return has_ended;
        });
    }

    void look_from_pixels(const Frame& frame, int first_sample) {
        settle(true);
        const auto count =
            static_cast<std::size_t>(std::min(together(), parameters_.gloss.samples - first_sample));
        paths_.assign(count * pixel_count(), Path{});
        const auto width = static_cast<std::size_t>(width_);
        parallel_for(threads_, 0, height_, [&](std::int64_t y) {
            if (frame.cancel.is_cancelled()) return;
            for (auto pixel = static_cast<std::size_t>(y) * width;
                 pixel < static_cast<std::size_t>(y + 1) * width; ++pixel)
                for (std::size_t i = 0; i < count; ++i) {
                    auto& path = paths_[pixel * count + i];
                    path.pixel = static_cast<std::uint32_t>(pixel);
                    path.sample = static_cast<std::uint32_t>(first_sample) + static_cast<std::uint32_t>(i);
                    if (!frame.pixels.is_background(pixel)) look_from(frame, path);
                }
        });
        frame.cancel.check();
    }

    passes::PathSampler sampler(const Path& path) const {
        const auto width = static_cast<std::uint32_t>(width_);
        return {passes::pixel_key(seed_, path.pixel % width, path.pixel / width), path.sample};
    }
    /// Of the direct light that an event meets.
    passes::PathSampler light_sampler(const Path& path, int event) const {
        const auto width = static_cast<std::uint32_t>(width_);
        const auto seed = seed_ + 1 + static_cast<std::uint64_t>(event);
        return {passes::pixel_key(seed, path.pixel % width, path.pixel / width), path.sample};
    }
    std::optional<passes::BsdfSample> drawn(const passes::Bsdf& bsdf, glm::vec3 wo, const Path& path,
                                            int event) const {
        const auto random = sampler(path);
        const auto dimension = 2 * static_cast<std::uint32_t>(event);
        return bsdf.sample(wo, random.pair(dimension).x, random.pair(dimension + 1));
    }

    /// From a pixel's interface.
    void look_from(const Frame& frame, Path& path) {
        auto surface = frame.pixels.at(path.pixel);
        if (surface.is_unlit) return;
        const auto& material = frame.surfaces->material(surface.material);
        const auto model = parameters_.transport.materials;
        const float part = passes::keep_interface(surface, material.ior, model);
        if (!(part > 0)) return;
        const auto wo = viewer_.seen_from(surface.position_ws);
        const bool is_mirror = surface.roughness * surface.roughness < passes::mirror_alpha;
        auto throughput = glm::vec3(part);
        glm::vec3 wished;
        if (parameters_.gloss.kind == Gloss::mirror) {
            const float cosine = glm::dot(surface.shading_normal_ws, wo);
            wished = 2 * cosine * surface.shading_normal_ws - wo;
            throughput *= passes::directional_albedo(surface.base_colour, surface.roughness,
                                                     std::clamp(cosine, 0.0f, 1.0f));
        } else {
            const auto next = drawn(passes::Bsdf(surface, material, model), wo, path, 0);
            if (!next) return;
            wished = next->wi;
            throughput *= next->weight;
            path.spread = spread_of(*next);
        }
        path.scatterings = is_mirror ? 0 : 1;
        if (!aim(path, surface, wished)) return;
        path.throughput = throughput;
        if (by_maps_)
            errors_[path.pixel] +=
                glm::degrees(std::acos(std::clamp(glm::dot(wished, along(path.from)), -1.0f, 1.0f))) /
                static_cast<float>(parameters_.gloss.samples);
    }

    /// What a ray stands for of the directions that its surface may send it to, sr.
    float spread_of(const passes::BsdfSample& sample) const {
        return sample.is_specular ? 0 : share_ / sample.pdf;
    }

    glm::vec3 along(const ldm::MapRay& ray) const {
        const glm::vec3 v(maps_->frames[ray.map].direction);
        return ray.forward ? v : -v;
    }

    /// Whether it goes out of the surface.
    bool aim(Path& path, const passes::Surface& surface, glm::vec3 wished) const {
        path.wished = glm::normalize(wished);
        path.from = {surface.position_ws, surface.geometric_normal_ws, 0, true};
        if (glm::dot(path.wished, path.from.normal_ws) <= 0) return false;
        return !by_maps_ || choose_map(path);
    }

    /// The direction in whose region the wished one lies, or the nearest one that leaves the surface.
    bool choose_map(Path& path) const {
        auto& from = path.from;
        const auto region = regions_.find(into_regions_ * glm::dvec3(path.wished));
        from.map = static_cast<std::uint32_t>(region / 2);
        from.forward = region % 2 == 0;
        if (glm::dot(along(from), from.normal_ws) > least_cosine) return true;
        float nearest = -2;
        for (std::uint32_t map = 0; map < maps_->frames.size(); ++map) {
            const glm::vec3 v(maps_->frames[map].direction);
            const float cosine = glm::dot(v, from.normal_ws), sign = cosine > 0 ? 1.0f : -1.0f;
            const float near = sign * glm::dot(v, path.wished);
            if (std::abs(cosine) <= least_cosine || near <= nearest) continue;
            nearest = near;
            from.map = map;
            from.forward = cosine > 0;
        }
        return nearest > -2;
    }

    /// A texel's longer side, m.
    float texel(const Path& path) const {
        const auto& map = maps_->frames[path.from.map];
        return std::max(glm::length(glm::vec3(map.step_u)), glm::length(glm::vec3(map.step_v)));
    }

    Met meet(const Frame& frame, const Path& path, const ldm::MapHit& found) const {
        const auto origin = passes::offset_origin(path.from.position_ws, path.from.normal_ws);
        if (frame.cube) return {frame.cube->closest_hit(origin, path.wished, infinity), path.wished};
        const float near = by_maps_ ? parameters_.gloss.near * texel(path) : infinity;
        const auto exact = near > 0 ? frame.bvh->closest_hit(origin, path.wished, 0, near) : passes::Hit{};
        if (exact.is_hit() || !by_maps_) return {exact, path.wished};
        if (!(found.distance < infinity)) return {{}, path.wished};
        return meet_by_map(frame, path, origin, found);
    }

    /// The surface near a map's hit, or where that is none on the ray's own way the one of the entry: what a
    /// node would be that knows its triangle. Nodes know depths alone, so short rays find it.
    Met meet_by_map(const Frame& frame, const Path& path, glm::vec3 origin, const ldm::MapHit& found) const {
        const float reach = reach_texels * texel(path), about = entry_texels * texel(path);
        const auto look = [&](glm::vec3 direction, float at) {
            return frame.bvh->closest_hit(origin, direction, std::max(at - reach, 0.0f), at + reach);
        };
        const auto direction = along(path.from);
        auto hit = look(direction, found.distance);
        if (!hit.is_hit()) {
            hit = frame.bvh->closest_hit(found.node_ws - about * direction, direction, 0, 2 * about);
            if (!hit.is_hit()) return {{}, direction, true};
            hit.distance = found.distance;
        }
        if (parameters_.gloss.landing == GlossLanding::plane) {
            const auto [normal, corner] = frame.surfaces->plane(hit.triangle);
            const float to_plane = glm::dot(normal, corner - origin) / glm::dot(normal, path.wished);
            if (to_plane > 0 && to_plane < infinity)
                if (const auto moved = look(path.wished, to_plane); moved.is_hit())
                    return {moved, path.wished};
        }
        return {hit, direction};
    }

    /// Lights what was met, and draws where paths go on.
    void go_on(const Frame& frame, int event, std::int64_t first_part, std::int64_t end_part) {
        const auto count = static_cast<std::int64_t>(paths_.size());
        std::atomic<std::uint32_t> lost{0};
        constexpr std::int64_t together = 64;
        const auto begin = count * first_part / parts, end = count * end_part / parts;
        parallel_for(threads_, 0, (end - begin + together - 1) / together, [&](std::int64_t block) {
            if (frame.cancel.is_cancelled()) return;
            const auto first = begin + block * together, last = std::min(first + together, end);
            for (auto i = first; i < last; ++i) {
                auto& path = paths_[static_cast<std::size_t>(i)];
                const auto met = meet(frame, path, map_hits_[static_cast<std::size_t>(i)]);
                if (met.is_lost) ++lost;
                if (met.hit.is_hit())
                    arrive(frame, path, event, met);
                else
                    path.throughput = glm::vec3(0);
            }
        });
        frame.cancel.check();
        lost_ += lost;
    }

    void arrive(const Frame& frame, Path& path, int event, const Met& met) {
        if (event == 0 && path.sample == 0) met_at_[path.pixel] = met.hit.distance;
        const auto surface = frame.surfaces->at(met.hit, met.direction);
        const passes::Bsdf bsdf(surface, frame.surfaces->material(surface.material),
                                parameters_.transport.materials);
        const auto throughput = std::exchange(path.throughput, glm::vec3(0));
        const bool is_seen = path.scatterings == 0;  // in mirrors
        if (surface.is_unlit) {
            if (is_seen && is_whole_) path.light += throughput * surface.base_colour;
            return;
        }
        if (!is_seen || is_whole_)
            path.light += throughput * light_of(frame, path, event, met, surface, bsdf);
        const auto next = drawn(bsdf, -met.direction, path, event + 1);
        if (!next || next->is_transmitted) return;
        path.scatterings += next->is_specular ? 0 : 1;
        path.spread += spread_of(*next);
        if (path.scatterings > parameters_.transport.max_bounces || !aim(path, surface, next->wi)) return;
        path.throughput = throughput * next->weight;
    }

    /// Direct light that a surface reflects, with highlights as wide as what the ray stands for. Mirrors show
    /// no lights without extent, and others only where that counts: as wide as from a rough surface.
    glm::vec3 light_of(const Frame& frame, const Path& path, int event, const Met& met,
                       const passes::Surface& surface, const passes::Bsdf& bsdf) const {
        const auto sampler = light_sampler(path, event);
        const auto wo = -met.direction;
        const bool is_mirror = surface.roughness * surface.roughness < passes::mirror_alpha;
        if (!(path.spread > 0) || (is_mirror && !mirrored_light_counts(path)))
            return frame.light->reflected(surface, bsdf, wo, sampler);
        auto wide = surface;
        wide.roughness = passes::widened_roughness(
            surface.roughness,
            passes::slope_variance(*frame.inputs.world, met.hit.triangle, met.hit.distance, path.spread));
        const float gain =
            passes::widened_gain(surface.roughness, wide.roughness, glm::dot(surface.shading_normal_ws, wo));
        wide.base_colour *= std::lerp(1.0f, gain, surface.metallic);  // of dielectrics most is diffuse
        const passes::Bsdf widened(wide, frame.surfaces->material(surface.material),
                                   parameters_.transport.materials);
        return frame.light->reflected(wide, is_mirror ? bsdf : widened, wo, sampler);
    }

    /// A mirror is no scattering: what it shows of a source to a surface that is seen is direct light.
    bool mirrored_light_counts(const Path& path) const { return is_whole_ || path.scatterings > 1; }

    void write(const graph::PassContext& context, const GlossResources& r) const {
        std::ranges::copy(errors_, context.pixels<float>(r.images.error).begin());
        std::ranges::copy(met_at_, context.pixels<float>(r.images.distance).begin());
        const auto out = context.pixels<glm::vec4>(r.images.radiance);
        const auto part = 1 / static_cast<float>(parameters_.gloss.samples);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::vec4(part * sums_[i], 1);
        if (!parameters_.progressive || !context.has_previous() ||
            !passes::stands_still(context.inputs(), passes::Watched::surfaces_and_lights))
            return;
        const auto before = context.previous_contents<glm::vec4>(r.images.radiance);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const float frames = before[i].a;
            out[i] =
                glm::vec4((frames * glm::vec3(before[i]) + glm::vec3(out[i])) / (frames + 1), frames + 1);
        }
    }

    ldm::MapsPointer maps_;
    Parameters parameters_;
    bool is_whole_, by_maps_;
    std::uint64_t seed_;
    float share_;
    passes::Viewer viewer_;
    int width_, height_, threads_;
    ldm::Regions regions_;
    glm::dmat3 into_regions_;
    ldm::MapRays rays_;

    std::vector<Path> paths_;
    std::vector<ldm::MapRay> map_rays_;
    std::vector<ldm::MapHit> map_hits_;
    std::vector<glm::vec3> sums_;  ///< by pixel
    std::vector<float> errors_, met_at_;
    std::uint32_t lost_ = 0;
};

}  // namespace

void reflect_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const ldm::MapsPointer& maps, const GlossImages& images, const Parameters& parameters) {
    const auto light = passes::extended_light_options(parameters.light, parameters.transport);
    GlossResources r{.gbuffer = gbuffer,
                     .bvh = passes::bvh(builder),
                     .surfaces = passes::host_surfaces(builder, parameters.transport.normal_maps),
                     .images = images};
    r.lost = builder.counter({.key = "gloss.lost",
                              .label = "Gloss lost",
                              .doc = "Paths that end where a map has a node and no surface is near."});
    if (light.parameters.light_samples > 0 && passes::extended_sources(builder.inputs(), light).any())
        r.sources = passes::extended_emitters(builder, light);
    if (parameters.gloss.tracer == GlossTracer::maps)
        r.meshlets = ldm::declare_meshlets(builder, parameters.maps.detail);
    // A frame has one cube: that of the photons, if they have it.
    const auto cube = parameters.tracer == Tracer::cube ? parameters.cube : passes::CubeOptions{};
    if (parameters.gloss.tracer == GlossTracer::cube) r.cube = passes::layered_depth_cube(builder, cube);
    const auto reflections = std::make_shared<Reflections>(maps, parameters, builder.inputs());
    auto pass = builder.pass("gloss", graph::Queue::cpu);
    if (parameters.gloss.tracer == GlossTracer::rays) pass.has_two_bodies();
    pass.reads(r.bvh, r.surfaces).writes(images.radiance, images.error, images.distance).counts(r.lost);
    for (const auto& optional : {r.sources, r.meshlets, r.cube})
        if (optional) pass.reads(*optional);
    if (parameters.progressive) pass.reads_previous(images.radiance);
    passes::GBufferSurfaces::declare_reads(pass, gbuffer);
    pass.execute_sliced(
        reflections->items(),
        [=](graph::PassContext& context, graph::Slice slice) { reflections->run(context, r, slice); },
        reflections->first_slice());
}

}  // namespace ir::methods::ldm_indirect
