#pragma once

#include <compare>
#include <string>

namespace ir::engine {

/// An image resource, or a level or layer of it.
struct Part {
    static constexpr int all = -1;  ///< side by side, as image/atlas.h arranges them
    std::string key;                ///< empty: the main result
    int level = 0, layer = 0;
    std::string after = {};  ///< as it was when this pass had run; empty: at the end of the frame
    auto operator<=>(const Part&) const = default;
};

/// How files and documents call one level and layer: "key.level1", "key.layer3". The layer is named where
/// there are several.
std::string layer_name(const Part& part, bool has_layers);
/// The part that is called so.
Part part_called(const std::string& name);

}  // namespace ir::engine
