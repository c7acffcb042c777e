#pragma once

#include "renderers/core/method.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/hbao/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::hbao {

/// "hbao.explain.horizons" (values on the sphere), "hbao.explain.lines" and "hbao.explain.samples" of the
/// pixel that a person points at; empty while nobody does, and where the pixel shows no surface.
std::vector<OutputDescription> explanation_outputs();
SelectorDescription direction_selector();

/// Declares them and the pass "explain".
void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters);

}  // namespace ir::methods::hbao
