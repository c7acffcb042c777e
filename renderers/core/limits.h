#pragma once

namespace ir {

/// Pixels on a side that a document may ask for; devices may offer less.
inline constexpr int max_image_side = 65536;

}  // namespace ir
