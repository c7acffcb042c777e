#pragma once

#include "renderers/core/output.h"
#include "renderers/methods/ambient-occlusion-volumes/volumes.h"
#include "renderers/passes/bounce/samples.h"

namespace ir::methods::ambient_occlusion_volumes {

struct Bounced {
    graph::ImageRef distance;  ///< bounce::Samples
    graph::ImageRef winner;    ///< "volumes.winner" r32ui stack: 1 + triangle, 0 none
};

/// Declares the pass "bounced z": for each sample the nearest triangle along its direction. [Nalbach15 §3.2]
Bounced find_nearest(graph::GraphBuilder& builder, const Volumes& volumes,
                     const passes::bounce::Directions& directions);

std::vector<OutputDescription> bounced_outputs();

}  // namespace ir::methods::ambient_occlusion_volumes
