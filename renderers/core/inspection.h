#pragma once

#include <map>
#include <string>

namespace ir {

/// A list of things that a method can show one by one, such as its layered depth maps.
struct SelectorDescription {
    std::string
        key;  ///< "map"; elements of outputs that stand for an item have an integer field of this name
    std::string label;
    std::string doc = {};
    std::string count;  ///< key of the integer parameter that says how many there are, or the number itself
};

/// What a person points at. Passes may write outputs that explain it; what the method computes never depends
/// on it.
struct Inspection {
    static constexpr int all = -1;
    int x = -1, y = -1;                 ///< a pixel of the view; negative: none
    std::map<std::string, int> chosen;  ///< by selector: an item from 0 on, or `all`; absent: 0

    bool has_pixel() const { return x >= 0 && y >= 0; }
    int item(const std::string& selector) const {
        const auto found = chosen.find(selector);
        return found == chosen.end() ? 0 : found->second;
    }
    bool operator==(const Inspection&) const = default;
};

}  // namespace ir
