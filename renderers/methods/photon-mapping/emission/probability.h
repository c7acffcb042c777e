#pragma once

#include "renderers/methods/photon-mapping/emission/sources.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/rsm/rsm.h"

namespace ir::methods::photon_mapping {

/// Where photons should be emitted, and the same as a pyramid that points are warped by.
struct EmissionMaps {
    graph::ImageRef probability;  ///< r32f, a layer per layer of the RSM; not normalised:
                                  ///< "emission.probability", or with weights "emission.weighted"
    graph::ImageRef haar;  ///< "emission.haar" rgba32f of half the resolution with all levels: of each quad
                           ///< below the mean; left - right, upper - lower and diagonal details
    int resolution = 0, levels = 0, layers = 0;  ///< resolution = 2^levels
};

/// Declares the passes "emission probability", with weights "weighted emission probability", "Haar pyramid"
/// and "Haar pyramid, last levels".
EmissionMaps emission_maps(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                           const passes::Rsm& rsm, const std::optional<TexelWeights>& weights,
                           const Parameters& parameters);

/// The pyramid of any map whose sides are a power of two, at least 2 texels.  [Smal19 §5.3.1.2]
EmissionMaps haar_pyramid(graph::GraphBuilder& builder, graph::ImageRef map, int resolution, int layers,
                          const std::string& fingerprint);

/// Constants of rsm.glsl and hits.comp: index of survival.glsl for the transport's materials, whether paths
/// follow mirrors, and the photon planes.
struct SurfaceRules {
    int materials_model;
    bool follows_mirrors;
    float photon_near, photon_far;
    IR_FIELDS(materials_model, follows_mirrors, photon_near, photon_far)
};
SurfaceRules surface_rules(const scene::Scene& scene, const Parameters& parameters);

/// What programs that include rsm.glsl read.
void reads_map(graph::PassBuilder& pass, const passes::Rsm& rsm, const passes::SceneBuffers& scene);

std::vector<OutputDescription> probability_outputs();

}  // namespace ir::methods::photon_mapping
