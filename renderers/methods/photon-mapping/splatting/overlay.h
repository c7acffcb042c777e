#pragma once

#include <string>

#include "renderers/core/category.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// Declares the output KEY: the scene in grey, and over it a colour wherever a mark's low four bits are not
/// 0, that of the eight named ones whose place is theirs, from 1.
void draw_marks(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef marks,
                const std::string& key, const Categories& colours);

}  // namespace ir::methods::photon_mapping
