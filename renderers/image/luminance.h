#pragma once

#include <array>

namespace ir {

/// Of linear RGB with sRGB's primaries, rounded. [ITU-R BT.709-6 item 3.2]
inline constexpr std::array<double, 3> luminance_weights{0.2126, 0.7152, 0.0722};

/// Of three numbers; computed in their type.
template <class Number>
constexpr Number luminance(Number red, Number green, Number blue) {
    return static_cast<Number>(luminance_weights[0]) * red +
           static_cast<Number>(luminance_weights[1]) * green +
           static_cast<Number>(luminance_weights[2]) * blue;
}

}  // namespace ir
