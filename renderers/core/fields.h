#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

namespace ir {

/// In a struct of plain data: its members, all of them and in their order, for what knows them by name: the
/// uniforms of a program (gl/constants.h) and the records of a buffer (core/record.h).
///
///     struct Blur {
///         int radius;
///         float tolerance;
///         IR_FIELDS(radius, tolerance)
///     };
#define IR_FIELDS(...)                           \
    static constexpr const char* field_names() { \
        return #__VA_ARGS__;                     \
    }                                            \
    auto fields() const {                        \
        return std::tie(__VA_ARGS__);            \
    }

template <class T>
concept HasFields = requires(const T& value) {
    T::field_names();
    value.fields();
};

namespace detail {

/// sizeof a struct that has just these members in this order.
template <class... Members>
constexpr std::size_t size_with(const std::tuple<Members...>*) {
    std::size_t end = 0, alignment = 1;
    const auto align = [&](std::size_t to) { end = (end + to - 1) / to * to; };
    const auto add = [&](std::size_t size, std::size_t aligned_to) {
        align(aligned_to);
        end += size;
        alignment = std::max(alignment, aligned_to);
    };
    (add(sizeof(Members), alignof(Members)), ...);
    align(alignment);
    return end;
}

/// "a, b, c" → "a", leaving "b, c".
inline std::string_view take_name(std::string_view& names) {
    std::size_t end = 0;
    while (end < names.size() && names[end] != ',') ++end;
    const auto name = names.substr(0, end);
    while (end < names.size() && (names[end] == ',' || names[end] == ' ')) ++end;
    names.remove_prefix(end);
    return name;
}

}  // namespace detail

/// Calls `visit(name, member)` for each member.
template <HasFields T, class Visit>
void for_each_field(const T& value, Visit&& visit) {
    using Members = decltype(value.fields());
    static_assert(detail::size_with(static_cast<const Members*>(nullptr)) == sizeof(T),
                  "IR_FIELDS lists all members of its struct in their order");
    std::string_view names = T::field_names();
    std::apply([&](const auto&... members) { (visit(detail::take_name(names), members), ...); },
               value.fields());
}

/// Bytes from the begin of a struct to one of its members.
template <class T, class Member>
std::size_t offset_of(const T& value, const Member& member) {
    return static_cast<std::size_t>(reinterpret_cast<const char*>(&member) -
                                    reinterpret_cast<const char*>(&value));
}

}  // namespace ir
