#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/engine/compared_sides.h"
#include "app/engine/execution.h"
#include "app/engine/live.h"
#include "renderers/image/exr.h"

namespace ir::python {

namespace py = pybind11;

/// What a rendering left, or a file holds: host memory alone, which arrays share.
struct Picture {
    std::vector<ImageLayer> layers;  ///< as the command line writes them; the main result has no name
    ImageAttributes attributes;
    std::map<std::string, engine::BufferContents> buffers = {};
    std::string main_key = {};    ///< under which the main result is found, too; empty: of a file
    std::string statistics = {};  ///< JSON; empty: of a file
    std::vector<std::string> messages = {};

    const ImageLayer* layer(const std::string& key) const;
    std::vector<std::string> keys() const;
    engine::Side side(const std::string& name) const;
};
using PicturePtr = std::shared_ptr<const Picture>;

/// What the last frame left of the main result and of all resources that match. The context is current.
PicturePtr picture_of(const engine::Execution& execution, const FrameReport& report,
                      const std::vector<std::string>& outputs);

}  // namespace ir::python
