#include "renderers/passes/direct/direct_light_on_host.h"

#include <algorithm>
#include <array>
#include <vector>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/declared.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/direct/panes.h"
#include "renderers/passes/direct/peeled_light.h"
#include "renderers/passes/gbuffer/gbuffer_surfaces.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/bsdf.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "renderers/passes/surface/host_texture.h"

namespace ir::passes {
namespace {

class DirectLightOnHost {
  public:
    DirectLightOnHost(const graph::PassContext& context, const GBuffer& gbuffer, graph::ObjectRef bvh,
                      std::optional<graph::ObjectRef> behind_panes, Transport::Materials materials,
                      std::optional<graph::ImageRef> extended, graph::ImageRef radiance, bool is_peeled)
        : context_(context),
          is_peeled_(is_peeled),
          view_(context.inputs().view),
          viewer_(viewer(view_)),
          surfaces_(context, gbuffer),
          bvh_(context.object<Bvh>(bvh)),
          materials_(materials),
          radiance_(context.pixels<glm::vec4>(radiance)) {
        if (extended) extended_ = context.pixels<glm::vec4>(*extended);
        if (behind_panes) {
            behind_panes_ = context.object<SurfaceLookup>(*behind_panes);
            panes_.emplace(*bvh_, *behind_panes_, materials_);
        }
        for (const auto& light : context.inputs().world->lights)
            if (is_punctual(light)) lights_.push_back(light);
    }

    static int tiles_across(int pixels) { return (pixels + tile - 1) / tile; }

    void run(graph::Slice slice) const {
        parallel_for(context_.inputs().threads, slice.begin, slice.end, [&](std::int64_t i) {
            if (context_.cancel().is_cancelled()) return;
            const int across = tiles_across(view_.width);
            const int left = static_cast<int>(i % across) * tile, top = static_cast<int>(i / across) * tile;
            std::vector<Receiver> receivers;
            for (int y = top; y < std::min(top + tile, view_.height); y += block)
                for (int x = left; x < std::min(left + tile, view_.width); x += block)
                    fill_block(x, y, receivers);
        });
        context_.cancel().check();
    }

  private:
    /// Pixels along a side of what shares a packet of rays, and of an item of work.
    static constexpr int block = 4, tile = 16;
    /// Mirrors have a highlight as wide: a little above the square root of mirror_alpha.
    static constexpr float min_roughness = 0.03163f;
    static_assert(min_roughness * min_roughness > mirror_alpha);

    /// A pixel that light may fall on.
    struct Receiver {
        std::size_t pixel;
        glm::vec3 position, normal, geometric_normal, origin, wo;
        Bsdf bsdf;
    };

    void fill_block(int left, int top, std::vector<Receiver>& receivers) const {
        receivers.clear();
        for (int y = top; y < std::min(top + block, view_.height); ++y)
            for (int x = left; x < std::min(left + block, view_.width); ++x)
                begin(static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) +
                          static_cast<std::size_t>(x),
                      receivers);
        for (const auto& light : lights_) add(light, receivers);
    }

    void begin(std::size_t pixel, std::vector<Receiver>& receivers) const {
        radiance_[pixel] = glm::vec4(0);
        if (surfaces_.is_background(pixel)) return;
        auto surface = surfaces_.at(pixel);
        if (surface.is_unlit) {  // is its colour  [glTF2 KHR_materials_unlit]
            radiance_[pixel] = glm::vec4(surface.base_colour, 0);
            return;
        }
        if (!extended_.empty()) radiance_[pixel] = glm::vec4(glm::vec3(extended_[pixel]), 0);
        surface.transmission = 0;
        surface.roughness = std::max(surface.roughness, min_roughness);
        const auto wo = is_peeled_ ? surface.geometric_normal_ws : viewer_.seen_from(surface.position_ws);
        const auto& material = context_.inputs().scene->materials[static_cast<std::size_t>(surface.material)];
        receivers.push_back({pixel, surface.position_ws, surface.shading_normal_ws,
                             surface.geometric_normal_ws,
                             offset_origin(surface.position_ws, surface.geometric_normal_ws), wo,
                             Bsdf(surface, material, materials_)});
    }

    void add(const scene::Light& light, const std::vector<Receiver>& receivers) const {
        Bvh::Packet16 rays;
        std::ranges::fill(rays.active, 0);
        std::array<std::size_t, block * block> pixels;
        std::array<glm::vec3, block * block> radiances;
        std::size_t count = 0;
        for (const auto& r : receivers) {
            const auto arrival = punctual_arrival(light, r.position);
            if (!arrival || arrival->irradiance == glm::vec3(0)) continue;
            const auto l = arrival->direction_ws;
            if (glm::dot(r.normal, l) <= 0 || glm::dot(r.geometric_normal, l) <= 0) continue;
            pixels[count] = r.pixel;
            radiances[count] = r.bsdf.evaluate(r.wo, l) * arrival->irradiance;
            rays.ox[count] = r.origin.x, rays.oy[count] = r.origin.y, rays.oz[count] = r.origin.z;
            rays.dx[count] = l.x, rays.dy[count] = l.y, rays.dz[count] = l.z;
            rays.near[count] = 0, rays.far[count] = arrival->distance * shadow_ray_end;
            rays.active[count++] = -1;
        }
        if (count == 0) return;
        const auto occluded = bvh_->occluded16(rays, true);
        for (std::size_t k = 0; k < count; ++k) {
            const bool is_lit = (occluded >> k & 1) == 0;
            if (is_lit || panes_)
                radiance_[pixels[k]] += glm::vec4(is_lit ? radiances[k] : radiances[k] * passed(rays, k), 0);
        }
    }

    /// Fraction of a light behind something that comes through panes.
    glm::vec3 passed(const Bvh::Packet16& rays, std::size_t k) const {
        const float far = rays.far[k];
        const auto sight =
            panes_->look({rays.ox[k], rays.oy[k], rays.oz[k]}, {rays.dx[k], rays.dy[k], rays.dz[k]}, far);
        return sight.end.is_hit() ? glm::vec3(0) : sight.passed(far);
    }

    const graph::PassContext& context_;
    bool is_peeled_;
    const scene::View& view_;
    Viewer viewer_;
    GBufferSurfaces surfaces_;
    std::shared_ptr<Bvh> bvh_;
    std::shared_ptr<SurfaceLookup> behind_panes_;
    std::optional<Panes> panes_;  ///< where there are any
    Transport::Materials materials_;
    std::span<const glm::vec4> extended_;
    std::span<glm::vec4> radiance_;
    std::vector<scene::Light> lights_;
};

/// What rays meet, where there may be panes.
std::optional<graph::ObjectRef> surfaces_behind_panes(graph::GraphBuilder& builder,
                                                      Transport::Materials materials) {
    if (!Panes::any_in(builder.inputs().scene->materials, materials)) return {};
    const std::string key = "direct.panes";
    if (const auto found = graph::declared_object(builder, key)) return found;
    const auto textures = host_textures(builder);
    const auto result = builder.object({.text = {.key = key,
                                                 .label = "Surfaces for shadow rays",
                                                 .doc = "What shadow rays query of panes of clear glass."},
                                        .fingerprint = builder.inputs().geometry_fingerprint});
    builder.pass("surfaces for shadow rays", graph::Queue::cpu)
        .reads(textures)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const auto made =
                std::make_shared<SurfaceLookup>(*context.inputs().scene, *context.inputs().world, false,
                                                context.object<std::vector<HostTexture>>(textures));
            context.store(result, made, made->bytes());
        });
    return result;
}

}  // namespace

void direct_light_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                          Transport::Materials materials, std::optional<graph::ImageRef> extended,
                          graph::ImageRef radiance, int layer) {
    const auto rays = bvh(builder);
    const auto behind_panes = surfaces_behind_panes(builder, materials);
    const auto& view = builder.inputs().view;
    auto pass = builder.pass(pass_of_layer("direct light", layer), graph::Queue::cpu);
    pass.reads(rays).writes(radiance);
    if (layer == 1) pass.has_two_bodies();
    if (behind_panes) pass.reads(*behind_panes);
    if (extended) pass.reads(*extended);
    GBufferSurfaces::declare_reads(pass, gbuffer);
    pass.execute_sliced(std::int64_t{1} * DirectLightOnHost::tiles_across(view.width) *
                            DirectLightOnHost::tiles_across(view.height),
                        [=](graph::PassContext& context, graph::Slice slice) {
                            DirectLightOnHost(context, gbuffer, rays, behind_panes, materials, extended,
                                              radiance, layer > 1)
                                .run(slice);
                        });
}

graph::ImageRef peeled_direct_light(graph::GraphBuilder& builder, const PeeledLayer& layer,
                                    const ExtendedLightOptions& options) {
    const auto extended = peeled_extended_light(builder, layer, options);
    const auto radiance = builder.image(
        {.text = of_layer(graph::text_of(direct_output()), layer.number), .format = gl::Format::rgba32f});
    direct_light_on_host(builder, layer.surface, options.materials, extended, radiance, layer.number);
    return radiance;
}

}  // namespace ir::passes
