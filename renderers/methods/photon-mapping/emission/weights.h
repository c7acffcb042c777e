#pragma once

#include "renderers/methods/photon-mapping/stages.h"

namespace ir::methods::photon_mapping {

/// Of what only weights from visibility have.
inline Condition when_weighted() {
    return {"weights", {std::string("printed"), std::string("visible")}};
}

/// Declares what texels of maps of this size learn.
TexelWeights declare_weights(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, int resolution,
                             int layers);

/// The pass "weighted emission probability": the map that photons follow, by the weights that the frame
/// before left.  [Smal19 §5.4.2]
graph::ImageRef weigh(graph::GraphBuilder& builder, graph::ImageRef probability, const TexelWeights& weights,
                      const Parameters& parameters);

std::vector<OutputDescription> weight_outputs();

}  // namespace ir::methods::photon_mapping
