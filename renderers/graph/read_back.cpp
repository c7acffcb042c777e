#include <algorithm>
#include <cstring>
#include <span>

#include "renderers/core/half_float.h"
#include "renderers/graph/frame.h"

namespace ir::graph {

namespace {

/// Numbers of type T from `raw`, each as `as_float` says.
template <class T, class AsFloat>
void convert(const std::byte* raw, std::span<float> to, AsFloat as_float) {
    for (std::size_t i = 0; i < to.size(); ++i) {
        T number;
        std::memcpy(&number, raw + i * sizeof number, sizeof number);
        to[i] = as_float(number);
    }
}

/// Components of texels, one after the other.
void to_floats(const std::byte* raw, const gl::FormatInfo& format, std::span<float> to) {
    switch (format.type) {
        case GL_UNSIGNED_BYTE:
            return convert<std::uint8_t>(raw, to, [](auto number) { return float(number) / 255.0f; });
        case GL_HALF_FLOAT:
            return convert<std::uint16_t>(raw, to, float_from_half);
        case GL_UNSIGNED_INT:
            return convert<std::uint32_t>(raw, to, [](auto number) { return float(number); });
        default:
            std::memcpy(to.data(), raw, to.size_bytes());
    }
}

}  // namespace

std::optional<Image> read_image(GraphCache& cache, const std::string& key, int level, int layer) {
    auto* physical = cache.pool.find(key);
    if (!physical || !physical->is_image) return std::nullopt;
    const auto& shape = physical->shape;
    if (level < 0 || level >= shape.levels || layer < 0 || layer >= std::max(1, shape.layers))
        return std::nullopt;
    auto& copy = physical->now();
    if (!copy.on_device && !copy.on_host) return std::nullopt;
    const auto& format = gl::info(shape.format);
    const int width = shape.level_width(level), height = shape.level_height(level);
    const auto bytes = static_cast<std::size_t>(width) * height * format.bytes;
    Image image(width, height, format.channels);
    if (copy.on_host && level == 0) {
        to_floats(copy.host.data() + layer * bytes, format, image.pixels);
    } else if (format.type == GL_FLOAT) {
        cache.device.read_image(cache.pool.on_device(*physical, copy), shape, level, layer,
                                std::as_writable_bytes(std::span(image.pixels)));
    } else {
        std::vector<std::byte> raw(bytes);
        cache.device.read_image(cache.pool.on_device(*physical, copy), shape, level, layer, raw);
        to_floats(raw.data(), format, image.pixels);
    }
    return image;
}

std::optional<Image> Graph::read_image(const std::string& key, int level, int layer) const {
    return graph::read_image(*cache_, key, level, layer);
}

std::optional<std::vector<float>> read_texel(GraphCache& cache, const std::string& key, int x, int y,
                                             int layer) {
    auto* physical = cache.pool.find(key);
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
        cache.device.read_texel(copy.name, shape, 0, layer, x, y, raw);
    }
    std::vector<float> values(static_cast<std::size_t>(format.channels));
    to_floats(raw.data(), format, values);
    return values;
}

std::optional<std::vector<float>> Graph::read_texel(const std::string& key, int x, int y, int layer) const {
    return graph::read_texel(*cache_, key, x, y, layer);
}

std::optional<std::vector<std::byte>> read_buffer(GraphCache& cache, const std::string& key,
                                                  std::uint64_t max_bytes) {
    auto* physical = cache.pool.find(key);
    if (!physical || physical->is_image || !physical->has_contents()) return std::nullopt;
    auto& copy = physical->now();
    std::vector<std::byte> bytes(std::min(physical->copy_bytes(), max_bytes));
    if (copy.on_host)
        std::copy_n(copy.host.begin(), bytes.size(), bytes.begin());
    else if (!bytes.empty())
        cache.device.read_buffer(copy.name, 0, bytes);
    return bytes;
}

std::optional<std::vector<std::byte>> Graph::read_buffer(const std::string& key,
                                                         std::uint64_t max_bytes) const {
    return graph::read_buffer(*cache_, key, max_bytes);
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
