#pragma once

#include <string>

#include "renderers/plot/pipeline.h"

namespace ir {

/// The pipeline with its title and a legend, as a file of its own, on white. Each pass and buffer has a title
/// that says what is known of it. Throws as place_pipeline().
std::string pipeline_svg(const Pipeline& pipeline);

}  // namespace ir
