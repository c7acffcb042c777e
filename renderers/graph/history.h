#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "renderers/gl/device.h"

namespace ir::graph {

/// Contents of the resources that passes read as "previous", bit by bit.
struct History {
    struct Entry {
        std::string key;
        bool is_image = true;
        gl::ImageShape shape;                           ///< images; level 0 with all layers
        std::uint64_t element_bytes = 0, elements = 0;  ///< buffers
        std::vector<std::byte> bytes = {};
    };
    std::vector<Entry> entries;
};

}  // namespace ir::graph
