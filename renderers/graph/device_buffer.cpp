#include <algorithm>

#include "renderers/graph/cache.h"

namespace ir::graph {

std::optional<DeviceBuffer> Graph::device_buffer(const std::string& key) const {
    const auto desc = cache_->buffer_descs.find(key);
    auto* physical = cache_->pool.find(key);
    if (desc == cache_->buffer_descs.end() || !physical || physical->is_image || !physical->has_contents())
        return std::nullopt;
    auto& copy = physical->now();
    // A cpu pass between two slices goes on writing on the host: what is brought to the device now counts as
    // current for this look only.
    const bool host_is_being_written = cache_->is_running && copy.on_host && !copy.on_device;
    DeviceBuffer result{cache_->pool.on_device(*physical, copy), desc->second, physical->capacity};
    if (host_is_being_written) copy.on_device = false;
    const auto used = cache_->elements_in_use.find(key);
    if (used != cache_->elements_in_use.end()) result.elements = std::min(result.elements, used->second);
    return result;
}

}  // namespace ir::graph
