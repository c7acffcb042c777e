#include "renderers/scene/gltf/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderers/core/error.h"

namespace ir::scene::gltf {
namespace {

template <class T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);  // alignment is not promised
    return value;
}

std::uint32_t load_unsigned(const std::uint8_t* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return *bytes;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

/// [glTF 2.0, 3.11: f = max(c / 127, -1) and its like]
float load_float(const std::uint8_t* bytes, int type, bool normalised) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return load<float>(bytes);
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const auto c = static_cast<float>(load<std::int8_t>(bytes));
            return normalised ? std::max(c / 127.0f, -1.0f) : c;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return normalised ? *bytes / 255.0f : *bytes;
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const auto c = static_cast<float>(load<std::int16_t>(bytes));
            return normalised ? std::max(c / 32767.0f, -1.0f) : c;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
            const auto c = static_cast<float>(load<std::uint16_t>(bytes));
            return normalised ? c / 65535.0f : c;
        }
        default: {
            const auto c = static_cast<float>(load<std::uint32_t>(bytes));
            return normalised ? c / 4294967295.0f : c;
        }
    }
}

}  // namespace

Accessor::Accessor(const Document& document, int index, std::string place)
    : document_(document), place_(std::move(place)) {
    if (const auto& problem = document.accessor_problems[index]; !problem.empty())
        fail(element("accessors", index) + " " + problem);
    const auto& accessor = document.model.accessors[index];
    type_ = accessor.componentType;
    components_ = tinygltf::GetNumComponentsInType(accessor.type);
    normalised_ = accessor.normalized;
    count_ = accessor.count;
    stride_ = tinygltf::GetComponentSizeInBytes(type_) * components_;
    if (accessor.bufferView >= 0) {
        base_ = bytes_of(accessor.bufferView, accessor.byteOffset);
        const auto stride = document.model.bufferViews[accessor.bufferView].byteStride;
        if (stride > 0) stride_ = stride;
    }
    if (accessor.sparse.isSparse) read_sparse(accessor);
}

bool Accessor::is_float() const {
    return type_ == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

bool Accessor::is_unsigned() const {
    return type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT || type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

const std::uint8_t* Accessor::bytes_of(int view, std::size_t offset) const {
    const auto& fields = document_.model.bufferViews[view];
    const auto& buffer = document_.buffers[fields.buffer];
    return buffer.present ? buffer.bytes.data() + fields.byteOffset + offset : nullptr;
}

void Accessor::read_sparse(const tinygltf::Accessor& accessor) {
    const auto& sparse = accessor.sparse;
    const auto* indices = bytes_of(sparse.indices.bufferView, sparse.indices.byteOffset);
    const auto* values = bytes_of(sparse.values.bufferView, sparse.values.byteOffset);
    if (!indices || !values) return;
    const auto step = [&](int view, int tight) {
        const auto stride = document_.model.bufferViews[view].byteStride;
        return stride > 0 ? stride : static_cast<std::size_t>(tight);
    };
    const int index_bytes = tinygltf::GetComponentSizeInBytes(sparse.indices.componentType);
    const auto index_step = step(sparse.indices.bufferView, index_bytes);
    const auto value_step =
        step(sparse.values.bufferView, tinygltf::GetComponentSizeInBytes(type_) * components_);
    for (int i = 0; i < sparse.count; ++i) {
        const auto index = load_unsigned(indices + i * index_step, sparse.indices.componentType);
        if (index >= count_) fail("has a sparse index beyond its count; export the file again");
        sparse_.emplace_back(index, values + i * value_step);
    }
    std::sort(sparse_.begin(), sparse_.end());
}

const std::uint8_t* Accessor::bytes_at(std::size_t element) const {
    if (!sparse_.empty()) {
        const auto found =
            std::lower_bound(sparse_.begin(), sparse_.end(), element,
                             [](const auto& entry, std::size_t wanted) { return entry.first < wanted; });
        if (found != sparse_.end() && found->first == element) return found->second;
    }
    return base_ ? base_ + element * stride_ : nullptr;
}

std::uint32_t Accessor::whole(std::size_t element) const {
    const auto* bytes = bytes_at(element);
    return bytes ? load_unsigned(bytes, type_) : 0;
}

void Accessor::floats(std::size_t element, float* result) const {
    const auto* bytes = bytes_at(element);
    const int component_bytes = tinygltf::GetComponentSizeInBytes(type_);
    for (int i = 0; i < components_; ++i) {
        result[i] = bytes ? load_float(bytes + i * component_bytes, type_, normalised_) : 0.0f;
        if (!std::isfinite(result[i]))
            fail("element " + std::to_string(element) + " is not a finite number; export the file again");
    }
}

void Accessor::fail(const std::string& problem) const {
    throw InputError(document_.file, place_, problem);
}

}  // namespace ir::scene::gltf
