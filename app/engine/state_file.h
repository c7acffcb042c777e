#pragma once

#include <filesystem>

#include "renderers/graph/graph.h"
#include "renderers/image/exr.h"

namespace ir::engine {

/// A history on disk, bit by bit, as an EXR file that other programs can look at. A link is replaced,
/// not followed. Throws Error.
void write_state(const std::filesystem::path& file, const graph::History& history,
                 const ImageAttributes& attributes);
/// Throws InputError with one line.
graph::History read_state(const std::filesystem::path& file, ImageAttributes* attributes = nullptr);

}  // namespace ir::engine
