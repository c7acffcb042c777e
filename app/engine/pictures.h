#pragma once

#include "app/engine/execution.h"

namespace ir::engine {

// What the last frame of an execution left, as files have it.

/// Key of the resource that holds the main result.
std::string main_key(const Execution& execution);
/// Empty before the first frame.
Image main_result(const Execution& execution);
/// The same with three channels or one, for a PNG.
Image displayed_result(const Execution& execution);
/// Default layer with the main result, "valid", its variance, and each resource that matches a pattern:
/// images as they are (levels and layers as "key.level1", "key.layer3"), buffers as images with a channel per
/// field, at most 4096 wide.
std::vector<ImageLayer> layers(const Execution& execution, const std::vector<std::string>& patterns);
/// Throws UsageError for the first pattern that matches no resource; `option` is what gave it.
void require_matches(const std::string& option, const std::vector<std::string>& patterns,
                     const FrameReport& report);
/// How the names of all attributes begin.
inline const std::string attribute_prefix = "interreflect.";
/// Holds Experiment::recipe, by which the picture can be rendered again.
inline const std::string recipe_attribute = attribute_prefix + "recipe";
/// Parameters, seed, camera, scene hash, versions, recipe: for the EXR header.
ImageAttributes attributes(const Execution& execution);
/// The main result and the layers that match `dumps` with all attributes as .exr, or the main result as
/// .png, as screens show it. Throws Error.
void write_picture(const std::filesystem::path& file, const Execution& execution,
                   const std::vector<std::string>& dumps);

}  // namespace ir::engine
