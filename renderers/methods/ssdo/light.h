#pragma once

#include "renderers/core/method.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/ssdo/parameters.h"
#include "renderers/passes/direct/direct_light.h"

namespace ir::methods::ssdo {

/// Declares passes that blur `raw`, W/(m² sr), without its materials' reflectance, into the output `key`.
graph::ImageRef blurred(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef raw,
                        const std::string& key, const Parameters& parameters);

struct Lit {
    graph::ImageRef seen;     ///< "ssdo.direct" rgba32f
    graph::ImageRef senders;  ///< "ssdo.senders" rgba32f: without unlit surfaces
};

/// Declares the pass "add environment light". `sky`: environment light; null: there is none.
Lit add_sky(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const passes::DirectLight& direct,
            const graph::ImageRef* sky);

std::vector<OutputDescription> light_outputs();

}  // namespace ir::methods::ssdo
