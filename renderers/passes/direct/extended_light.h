#pragma once

#include <optional>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/passes/direct/panes.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

struct ExtendedLightOptions {
    LightParameters parameters;
    Transport::Materials materials = Transport::Materials::gltf;
    bool environment = true;
    bool mirrors = true;  ///< whether mirrors show the sources that they reflect
};

/// How many sources with an extent light the scene.
struct ExtendedSources {
    std::size_t flat_lights = 0;  ///< rectangles and disks
    std::size_t emissive_triangles = 0;
    bool environment = false;
    bool any() const { return flat_lights > 0 || emissive_triangles > 0 || environment; }
};
ExtendedSources extended_sources(const graph::FrameInputs& inputs, const ExtendedLightOptions& options);

/// Whether light samples are taken on the device: it was chosen, and the environment's map is no wider than
/// images of all devices may be.
bool samples_on_device(const graph::FrameInputs& inputs, const ExtendedLightOptions& options);

/// What rays ask of them, with either model of materials. It does not need scene and world once it is made.
struct ExtendedEmitters {
    ExtendedEmitters(const graph::FrameInputs& inputs, const LightSampler::Options& options,
                     SurfaceLookup::Textures textures)
        : surfaces(*inputs.scene, *inputs.world, false, std::move(textures),
                   Panes::any_in(inputs.scene->materials, Transport::Materials::gltf)),
          lights(surfaces, options) {}
    SurfaceLookup surfaces;
    LightSampler lights;
};
/// Declares the object "direct.sources" (without an environment "direct.sources.placed"), an
/// ExtendedEmitters, with the pass "light sources" (cpu); kept while the world stays. Who asks again in a
/// frame gets the same.
graph::ObjectRef extended_emitters(graph::GraphBuilder& builder, const ExtendedLightOptions& options);

/// For methods with direct light; each is 0 where there is no such source.
std::vector<OutputDescription> extended_light_outputs();

/// Declares "direct.extended", rgba32f: light of rectangles, disks, emissive meshes and the environment that
/// surfaces reflect towards the eye, W/(m² sr), by samples, with a body for either processor; their mean
/// over the frames in which nothing moved; and the filter. None where no such source shines, or where there
/// are no samples, which a note says: then the outputs are 0.
std::optional<graph::ImageRef> extended_light(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                              const GBuffer& gbuffer, const ExtendedLightOptions& options);

}  // namespace ir::passes
