#pragma once

#include "renderers/core/constants.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/direct/light_estimate.h"
#include "renderers/passes/scattering/keep_interface.h"
#include "renderers/passes/scene/hit_surfaces.h"
#include "renderers/passes/shadow/shadow_maps.h"

namespace ir::methods::deep_screen_space {
/// Constants of shaders/methods/deep-screen-space/surfels/sent.glsl.
struct SenderConstants {
    int light_count;
    bool normal_maps;
    float light_offset;
    IR_FIELDS(light_count, normal_maps, light_offset)
};
inline SenderConstants sender_constants(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return {static_cast<int>(inputs.world->lights.size()), parameters.transport.normal_maps,
            parameters.light_offset};
}

/// What passes with that file read.
struct SenderInputs {
    passes::HitSurfaces surfaces;
    graph::BufferRef lights;
    passes::ShadowMaps shadow;

    void read_by(graph::PassBuilder& pass) const {
        surfaces.read_by(pass);
        shadow.read_by(pass);
        pass.reads(lights);
    }
};
inline SenderInputs sender_inputs(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                  const passes::ShadowMaps& shadow) {
    return {passes::hit_surfaces(builder, scene), scene.lights, shadow};
}

inline passes::ExtendedLightOptions source_options(const Parameters& parameters) {
    return passes::extended_light_options(parameters.light, parameters.transport);
}

/// Whether sources with an extent light senders.
inline bool has_sources(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return parameters.sender_samples > 0 &&
           passes::extended_sources(inputs, source_options(parameters)).any();
}

/// Whether light of these sources is sampled where rays meet senders, too.
inline bool winners_are_sampled(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return (sends_highlights(parameters) || parameters.level0 == Level0::triangles) &&
           has_sources(inputs, parameters);
}

/// The object of these sources, a passes::ExtendedEmitters.
inline graph::ObjectRef sources_of(graph::GraphBuilder& builder, const Parameters& parameters) {
    return passes::extended_emitters(builder, source_options(parameters));
}

/// Estimates what sources with an extent send to a surface, as light on a white Lambertian one times π.
/// Without normal maps: senders stand for more than their folds.
class SourceIrradiance {
  public:
    SourceIrradiance(const passes::Bvh& bvh, const passes::ExtendedEmitters& sources,
                     const Parameters& parameters)
        : estimate_(bvh, sources.surfaces, sources.lights,
                    {.materials = Transport::Materials::lambert, .between = parameters.transport.materials}) {
    }

    /// On the side of `normal`, W/m², unbiased over keys.
    glm::vec3 irradiance(passes::Surface surface, const glm::vec3& normal, std::uint64_t key,
                         int samples) const {
        surface.base_colour = glm::vec3(1);
        surface.is_unlit = false;
        glm::vec3 sum(0);
        for (int i = 0; i < samples; ++i)
            sum += estimate_.sample(surface, normal, passes::PathSampler(key, static_cast<std::uint32_t>(i)));
        return pi / static_cast<float>(samples) * sum;
    }

  private:
    passes::LightEstimate estimate_;
};

/// Estimates what highlights of surfaces send of these sources: the light that their microfacets alone
/// reflect, as those of a metal with this reflectance.
class SourceHighlight {
  public:
    SourceHighlight(const passes::Bvh& bvh, const passes::ExtendedEmitters& sources,
                    const Parameters& parameters)
        : estimate_(bvh, sources.surfaces, sources.lights,
                    {.materials = parameters.transport.materials, .between = parameters.transport.materials}),
          model_(parameters.transport.materials) {}

    /// Towards the unit direction `to_ws`, W/(m² sr), by one sample, unbiased over samplers.
    glm::vec3 radiance(passes::Surface surface, float ior, const glm::vec3& to_ws,
                       const passes::PathSampler& sampler) const {
        const float part = passes::keep_interface(surface, ior, model_);
        if (part == 0) return glm::vec3(0);
        return part * estimate_.sample(surface, to_ws, sampler);
    }

  private:
    passes::LightEstimate estimate_;
    Transport::Materials model_;
};

}  // namespace ir::methods::deep_screen_space
