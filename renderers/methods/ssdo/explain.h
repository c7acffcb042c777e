#pragma once

#include "renderers/methods/ssdo/gather.h"

namespace ir::methods::ssdo {

/// "ssdo.explain.samples" and "ssdo.explain.lines" of the pixel that a person points at; empty while nobody
/// does, and where the pixel shows no surface.
std::vector<OutputDescription> explanation_outputs();
SelectorDescription sample_selector();

/// Declares them and the pass "explain".
void explain(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders);

}  // namespace ir::methods::ssdo
