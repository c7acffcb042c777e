#pragma once

#include <string>
#include <vector>

#include "renderers/graph/builder.h"

namespace ir::graph {

/// Which passes and resources of a declared frame are needed for what is wanted.
struct Plan {
    std::vector<bool> pass_live;  ///< by pass
    std::vector<bool> image_live, buffer_live, object_live;
    std::vector<bool> image_history, buffer_history;  ///< read as "previous" by a live pass
};

/// Checks the declaration (every read resource is written by an earlier pass; history is read only of what is
/// written) and culls what nobody needs; resources of the keys `unwanted` are not wanted though a pattern
/// matches them. Throws std::logic_error that names pass and resource.
Plan make_plan(const GraphBuilder& builder, const std::vector<std::string>& wanted,
               const std::vector<std::string>& unwanted = {});

/// The size of an image of this frame.
gl::ImageShape resolve(const ImageDesc& desc, const scene::View& view);

}  // namespace ir::graph
