#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderers/core/fields.h"

namespace ir::gl {

/// A member of a struct of constants: the value of the uniform of its name.
struct Constant {
    /// vec4s: an array of any length (std::span), or of `count`.
    enum class Type { int_, uint, float_, bool_, vec2, vec3, vec4, ivec2, mat4, vec4s };
    std::string name;
    Type type = Type::float_;
    std::size_t offset = 0;  ///< bytes
    int count = 1;
};

using ConstantLayout = std::vector<Constant>;

namespace detail {

template <class T>
struct ConstantOf;
template <Constant::Type type_, int count_ = 1>
struct ConstantTraits {
    static constexpr auto type = type_;
    static constexpr int count = count_;
};
template <>
struct ConstantOf<int> : ConstantTraits<Constant::Type::int_> {};
template <>
struct ConstantOf<unsigned> : ConstantTraits<Constant::Type::uint> {};
template <>
struct ConstantOf<float> : ConstantTraits<Constant::Type::float_> {};
template <>
struct ConstantOf<bool> : ConstantTraits<Constant::Type::bool_> {};
template <>
struct ConstantOf<glm::vec2> : ConstantTraits<Constant::Type::vec2> {};
template <>
struct ConstantOf<glm::vec3> : ConstantTraits<Constant::Type::vec3> {};
template <>
struct ConstantOf<glm::vec4> : ConstantTraits<Constant::Type::vec4> {};
template <>
struct ConstantOf<glm::ivec2> : ConstantTraits<Constant::Type::ivec2> {};
template <>
struct ConstantOf<glm::mat4> : ConstantTraits<Constant::Type::mat4> {};
template <std::size_t N>
struct ConstantOf<std::array<glm::vec4, N>> : ConstantTraits<Constant::Type::vec4, static_cast<int>(N)> {};
template <>
struct ConstantOf<std::span<const glm::vec4>> : ConstantTraits<Constant::Type::vec4s> {};

template <HasFields T>
void add_constants(ConstantLayout& layout, std::size_t begin) {
    const T value{};
    for_each_field(value, [&]<class Member>(std::string_view name, const Member& member) {
        const auto offset = begin + offset_of(value, member);
        if constexpr (HasFields<Member>)
            add_constants<Member>(layout, offset);
        else
            layout.push_back(
                {std::string(name), ConstantOf<Member>::type, offset, ConstantOf<Member>::count});
    });
}

}  // namespace detail

/// The uniforms that a struct with IR_FIELDS gives values to. A member that has fields itself stands for
/// these: the constants of an included file.
template <HasFields T>
const ConstantLayout& constants_of() {
    static const ConstantLayout layout = [] {
        ConstantLayout result;
        detail::add_constants<T>(result, 0);
        return result;
    }();
    return layout;
}

}  // namespace ir::gl
