#pragma once

#include <string>

#include "renderers/methods/deep-screen-space/parameters.h"

/// What the contents of buffers depend on. Empty where the scene has no fingerprint.
namespace ir::methods::deep_screen_space {

/// Surfels without their light: the scene's geometry, the view (they are of equal size in the picture), the
/// parameters of surfels and the seed. Lights do not count. `reach` as of make_surfels.
std::string surfel_fingerprint(const graph::FrameInputs& inputs, float reach, const Parameters& parameters);

/// Which surfel each sample met: as `surfels` says, and all parameters but those of light and of what comes
/// later. Empty where that is.
std::string splat_fingerprint(const graph::FrameInputs& inputs, const std::string& surfels,
                              const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
