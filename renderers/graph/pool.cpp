#include "renderers/graph/pool.h"

#include <algorithm>

namespace ir::graph {

std::uint64_t Physical::host_bytes() const {
    if (!is_image) return element_bytes * capacity;
    return static_cast<std::uint64_t>(shape.width) * shape.height * std::max(1, shape.layers) *
           gl::info(shape.format).bytes;
}

Pool::~Pool() {
    for (auto& [key, physical] : resources_) release(physical);
}

void Pool::release(Physical& physical) {
    for (auto& copy : physical.copies) release(physical, copy);
}

void Pool::release(const Physical& physical, std::shared_ptr<Copy>& copy) {
    if (copy.use_count() == 1 && copy->name)
        physical.is_image ? device_.destroy_image(copy->name) : device_.destroy_buffer(copy->name);
    copy = std::make_shared<Copy>();
}

Copy& Pool::own(Physical& physical) {
    auto& copy = physical.copies[physical.current];
    if (copy.use_count() > 1)
        release(physical, copy);
    else
        copy = std::make_shared<Copy>(std::move(*copy));  // whoever knows it by its old contents loses it
    return *copy;
}

void Pool::adopt(Physical& physical, std::shared_ptr<Copy> copy, const std::string& fingerprint) {
    auto& own = physical.copies[physical.current];
    release(physical, own);
    own = std::move(copy);
    physical.fingerprint = fingerprint;
}

Physical& Pool::image(const std::string& key, const std::string& label, const gl::ImageShape& shape,
                      bool history) {
    auto& physical = resources_[key];
    if (!physical.is_image || physical.shape != shape || physical.history != history) {
        release(physical);
        physical = {};
    }
    physical.is_image = true;
    physical.label = label;
    physical.shape = shape;
    physical.history = history;
    return physical;
}

Physical& Pool::buffer(const std::string& key, const std::string& label, std::uint64_t element_bytes,
                       std::uint64_t capacity, std::uint64_t estimate, bool history) {
    auto& physical = resources_[key];
    const bool same_elements = !physical.is_image && physical.element_bytes == element_bytes &&
                               physical.estimate == estimate && physical.history == history;
    if (same_elements && history && physical.capacity < capacity && physical.before().committed) {
        grow_with_history(physical, capacity);
    } else if (!same_elements || physical.capacity != capacity) {
        release(physical);
        physical = {};
    }
    physical.is_image = false;
    physical.label = label;
    physical.element_bytes = element_bytes;
    physical.capacity = capacity;
    physical.estimate = estimate;
    physical.history = history;
    return physical;
}

void Pool::grow_with_history(Physical& physical, std::uint64_t capacity) {
    auto committed = std::move(on_host(physical, physical.before()));
    committed.resize(physical.element_bytes * capacity);
    release(physical);
    physical.fingerprint.clear();
    auto& copy = physical.before();
    copy.host = std::move(committed);
    copy.on_host = copy.committed = true;
}

Physical* Pool::find(const std::string& key) {
    const auto found = resources_.find(key);
    return found == resources_.end() ? nullptr : &found->second;
}

const Physical* Pool::find(const std::string& key) const {
    const auto found = resources_.find(key);
    return found == resources_.end() ? nullptr : &found->second;
}

void Pool::free(const std::string& key) {
    const auto found = resources_.find(key);
    if (found == resources_.end()) return;
    release(found->second);
    resources_.erase(found);
}

void Pool::free_except(const std::vector<std::string>& keys) {
    for (auto it = resources_.begin(); it != resources_.end();) {
        if (std::find(keys.begin(), keys.end(), it->first) == keys.end()) {
            release(it->second);
            it = resources_.erase(it);
        } else {
            ++it;
        }
    }
}

gl::Name Pool::on_device(Physical& physical, Copy& copy) {
    if (!copy.name) {
        copy.name =
            physical.is_image
                ? device_.create_image(physical.shape, physical.label)
                : device_.create_buffer(std::max<std::uint64_t>(16, physical.copy_bytes()), physical.label);
        copy.on_device = false;
    }
    if (copy.on_host && !copy.on_device) {
        if (physical.is_image) {
            const auto layer_bytes = physical.host_bytes() / std::max(1, physical.shape.layers);
            for (int layer = 0; layer < std::max(1, physical.shape.layers); ++layer)
                device_.write_image(copy.name, physical.shape, 0, layer,
                                    std::span(copy.host).subspan(layer * layer_bytes, layer_bytes));
        } else {
            device_.write_buffer(copy.name, 0, copy.host);
        }
        copy.on_device = true;
    }
    return copy.name;
}

std::vector<std::byte> Pool::read(const Physical& physical, const Copy& copy) const {
    if (copy.on_host) return copy.host;
    std::vector<std::byte> bytes(physical.host_bytes());
    if (!copy.on_device) return bytes;
    if (!physical.is_image) {
        device_.read_buffer(copy.name, 0, bytes);
        return bytes;
    }
    const auto layer_bytes = physical.host_bytes() / std::max(1, physical.shape.layers);
    for (int layer = 0; layer < std::max(1, physical.shape.layers); ++layer)
        device_.read_image(copy.name, physical.shape, 0, layer,
                           std::span(bytes).subspan(layer * layer_bytes, layer_bytes));
    return bytes;
}

std::vector<std::string> Pool::keys() const {
    std::vector<std::string> keys;
    for (const auto& [key, physical] : resources_) keys.push_back(key);
    return keys;
}

std::vector<std::byte>& Pool::on_host(Physical& physical, Copy& copy) {
    if (copy.on_device && !copy.on_host) {
        copy.host = read(physical, copy);
        copy.on_host = true;
    }
    copy.host.resize(physical.host_bytes());
    return copy.host;
}

void Pool::zero(Physical& physical, Copy& copy, bool device) {
    if (!device) {
        copy.host.assign(physical.host_bytes(), std::byte{0});
    } else {
        copy.on_host = copy.on_device = false;
        on_device(physical, copy);
        if (physical.is_image)
            device_.clear_image(copy.name, physical.shape);
        else
            device_.clear_buffer(copy.name, 0, physical.copy_bytes());
        copy.host = {};
    }
    copy.on_device = device;
    copy.on_host = !device;
}

void Pool::begin_frame() {
    for (auto& [key, physical] : resources_) {
        // The committed copy is read as "previous"; the frame writes the other one.
        if (physical.history && physical.now().committed) physical.current = 1 - physical.current;
    }
}

void Pool::begin_attempt() {
    for (auto& [key, physical] : resources_) physical.produced = false;
}

void Pool::abandon() {
    for (auto& [key, physical] : resources_)
        if (physical.history && physical.before().committed) physical.current = 1 - physical.current;
}

void Pool::commit() {
    for (auto& [key, physical] : resources_) {
        physical.had_previous = physical.history && physical.produced && physical.before().committed;
        if (!physical.history || !physical.produced) continue;
        physical.now().committed = true;
        physical.before().committed = false;
    }
}

void Pool::show_previous() {
    for (auto& [key, physical] : resources_)
        if (physical.had_previous) physical.before().committed = true;
}

void Pool::hide_previous() {
    for (auto& [key, physical] : resources_)
        if (physical.had_previous) physical.before().committed = false;
}

void Pool::forget_history() {
    for (auto& [key, physical] : resources_)
        for (auto& copy : physical.copies) copy->committed = false;
}

std::uint64_t Pool::bytes(const Physical& physical) const {
    std::uint64_t sum = 0;
    for (const auto& copy : physical.copies)
        sum += (copy->name ? physical.copy_bytes() : 0) + copy->host.size();
    return sum;
}

std::uint64_t Pool::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& [key, physical] : resources_) sum += bytes(physical);
    return sum;
}

}  // namespace ir::graph
