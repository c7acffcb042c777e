#pragma once

#include "renderers/core/constants.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/direct/light_estimate.h"

namespace ir::methods::deep_screen_space {

inline passes::ExtendedLightOptions source_options(const Parameters& parameters) {
    return passes::extended_light_options(parameters.light, parameters.transport);
}

/// Whether sources with an extent light senders.
inline bool has_sources(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return parameters.sender_samples > 0 &&
           passes::extended_sources(inputs, source_options(parameters)).any();
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

}  // namespace ir::methods::deep_screen_space
