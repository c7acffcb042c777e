#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/core/report.h"

namespace ir {

/// What people see of a member: "position_ws" and "distance_m" are the position and the distance, and
/// "sample_" is sample, which is a word of GLSL.
std::string plain_name(std::string_view member);

namespace detail {

template <class T>
struct FieldOf;
template <>
struct FieldOf<float> {
    static constexpr FieldType type = FieldType::f32;
    static constexpr int count = 1;
};
template <>
struct FieldOf<std::uint32_t> {
    static constexpr FieldType type = FieldType::u32;
    static constexpr int count = 1;
};
template <>
struct FieldOf<std::int32_t> {
    static constexpr FieldType type = FieldType::i32;
    static constexpr int count = 1;
};
template <glm::length_t N, class T, glm::qualifier Q>
struct FieldOf<glm::vec<N, T, Q>> {
    static constexpr FieldType type = FieldOf<T>::type;
    static constexpr int count = N;
};
template <glm::length_t C, glm::length_t R, class T, glm::qualifier Q>
struct FieldOf<glm::mat<C, R, T, Q>> {
    static constexpr FieldType type = FieldOf<T>::type;
    static constexpr int count = C * R;
};
template <class T, std::size_t N>
struct FieldOf<std::array<T, N>> {
    static constexpr FieldType type = FieldOf<T>::type;
    static constexpr int count = static_cast<int>(N) * FieldOf<T>::count;
};

}  // namespace detail

/// The fields of a buffer whose elements are records of the type T: scalars of four bytes, vectors and arrays
/// of them, and records in turn ("slot.offset"). The record in GLSL is compared with them where a program
/// reads the buffer.
template <HasFields T>
std::vector<Field> record_fields() {
    std::vector<Field> result;
    for_each_field(T{}, [&]<class Member>(std::string_view name, const Member&) {
        if constexpr (HasFields<Member>) {
            for (const auto& field : record_fields<Member>())
                result.push_back({plain_name(name) + "." + field.name, field.type, field.count});
        } else {
            result.push_back(
                {plain_name(name), detail::FieldOf<Member>::type, detail::FieldOf<Member>::count});
        }
    });
    return result;
}

}  // namespace ir
