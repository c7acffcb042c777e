#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "renderers/graph/cache.h"

namespace ir::graph {

namespace {

float component(const std::byte* from, const gl::FormatInfo& format) {
    switch (format.type) {
        case GL_UNSIGNED_BYTE:
            return static_cast<float>(std::to_integer<int>(*from)) / 255.0f;
        case GL_HALF_FLOAT: {
            std::uint16_t half;
            std::memcpy(&half, from, sizeof half);
            return glm::unpackHalf1x16(half);
        }
        case GL_UNSIGNED_INT: {
            std::uint32_t number;
            std::memcpy(&number, from, sizeof number);
            return static_cast<float>(number);
        }
        default: {
            float number;
            std::memcpy(&number, from, sizeof number);
            return number;
        }
    }
}

}  // namespace

std::optional<Image> Graph::read_image(const std::string& key, int level, int layer) const {
    auto* physical = cache_->pool.find(key);
    if (!physical || !physical->is_image) return std::nullopt;
    const auto& shape = physical->shape;
    if (level < 0 || level >= shape.levels || layer < 0 || layer >= std::max(1, shape.layers))
        return std::nullopt;
    auto& copy = physical->now();
    if (!copy.on_device && !copy.on_host) return std::nullopt;
    const auto& format = gl::info(shape.format);
    const int width = shape.level_width(level), height = shape.level_height(level);
    std::vector<std::byte> raw(static_cast<std::size_t>(width) * height * format.bytes);
    if (copy.on_host && level == 0)
        std::memcpy(raw.data(), copy.host.data() + layer * raw.size(), raw.size());
    else
        cache_->device.read_image(cache_->pool.on_device(*physical, copy), shape, level, layer, raw);
    Image image(width, height, format.channels);
    const auto step = static_cast<std::size_t>(format.bytes / format.channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = component(raw.data() + i * step, format);
    return image;
}

std::optional<std::vector<float>> Graph::read_texel(const std::string& key, int x, int y, int layer) const {
    auto* physical = cache_->pool.find(key);
    if (!physical || !physical->is_image || !physical->has_contents()) return std::nullopt;
    const auto& shape = physical->shape;
    if (x < 0 || x >= shape.width || y < 0 || y >= shape.height || layer < 0 ||
        layer >= std::max(1, shape.layers))
        return std::nullopt;
    const auto& format = gl::info(shape.format);
    const auto& copy = physical->now();
    std::vector<std::byte> raw(static_cast<std::size_t>(format.bytes));
    if (copy.on_host) {
        const auto texel = (static_cast<std::size_t>(layer) * shape.height + y) * shape.width + x;
        std::memcpy(raw.data(), copy.host.data() + texel * raw.size(), raw.size());
    } else {
        cache_->device.read_texel(copy.name, shape, 0, layer, x, y, raw);
    }
    std::vector<float> values(static_cast<std::size_t>(format.channels));
    for (std::size_t c = 0; c < values.size(); ++c)
        values[c] = component(raw.data() + c * raw.size() / values.size(), format);
    return values;
}

std::optional<std::vector<std::byte>> Graph::read_buffer(const std::string& key,
                                                         std::uint64_t max_bytes) const {
    auto* physical = cache_->pool.find(key);
    if (!physical || physical->is_image || !physical->has_contents()) return std::nullopt;
    auto& copy = physical->now();
    std::vector<std::byte> bytes(std::min(physical->copy_bytes(), max_bytes));
    if (copy.on_host)
        std::memcpy(bytes.data(), copy.host.data(), bytes.size());
    else if (!bytes.empty())
        cache_->device.read_buffer(copy.name, 0, bytes);
    return bytes;
}

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
