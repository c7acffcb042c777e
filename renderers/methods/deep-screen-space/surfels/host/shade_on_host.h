#pragma once

#include <optional>

#include "renderers/methods/deep-screen-space/surfels/steps.h"

namespace ir::methods::deep_screen_space {

/// Declares the pass "shade surfels" on the host's threads: what shade.comp writes into `lights`.
/// `irradiance`: by sources with an extent (sample_sources()).
void shade_on_host(graph::GraphBuilder& builder, const passes::ShadowMaps& shadow, const Surfels& surfels,
                   const std::optional<graph::BufferRef>& irradiance, const Growing& lights,
                   const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
