#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "renderers/scene/gltf/document.h"

namespace ir::scene::gltf {

/// Elements of one accessor, whatever its storage: tight, interleaved, sparse or all zeros.
class Accessor {
  public:
    /// `place` names the user in errors. Throws InputError where the accessor's type is unknown.
    Accessor(const Document& document, int index, std::string place);

    std::size_t count() const { return count_; }
    int components() const { return components_; }
    /// False where all elements are zero for want of a buffer [glTF 2.0, 3.6.2].
    bool has_data() const { return base_ || !sparse_.empty(); }
    bool is_float() const;
    bool is_unsigned() const;
    /// Unsigned integer accessors only.
    std::uint32_t whole(std::size_t element) const;
    /// All components; normalised integers in [0,1] or [-1,1], other integers as they are. Throws InputError
    /// for a NaN or an infinity.
    void floats(std::size_t element, float* result) const;
    /// Integers count as normalised from here on, whatever the file says (vertex colours).
    void set_normalised() { normalised_ = true; }

    [[noreturn]] void fail(const std::string& problem) const;

  private:
    /// Null where the buffer has no data.
    const std::uint8_t* bytes_of(int view, std::size_t offset) const;
    const std::uint8_t* bytes_at(std::size_t element) const;
    void read_sparse(const tinygltf::Accessor& accessor);

    const Document& document_;
    std::string place_;
    const std::uint8_t* base_ = nullptr;
    std::size_t count_ = 0, stride_ = 0;
    int components_ = 1, type_ = 0;
    bool normalised_ = false;
    std::vector<std::pair<std::uint32_t, const std::uint8_t*>> sparse_;  ///< ascending
};

/// The elements that `chosen` names, or all where it is null. Vector must have the accessor's components, or
/// be a vec4 that gets w = 1 from three.
template <class Vector>
std::vector<Vector> read_vectors(const Accessor& accessor, const std::vector<std::uint32_t>* chosen) {
    std::vector<Vector> result(chosen ? chosen->size() : accessor.count(), Vector(1));
    for (std::size_t i = 0; i < result.size(); ++i) accessor.floats(chosen ? (*chosen)[i] : i, &result[i].x);
    return result;
}

}  // namespace ir::scene::gltf
