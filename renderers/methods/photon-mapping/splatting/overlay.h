#pragma once

#include <string>

#include "renderers/core/category.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// Declares the output KEY: the scene in grey under marks. The low four bits of a mark are 0 for none, else 1
/// + the place of its colour among the first eight.
void draw_marks(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef marks,
                const std::string& key, const Categories& colours);

}  // namespace ir::methods::photon_mapping
