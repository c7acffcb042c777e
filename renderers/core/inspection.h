#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "renderers/core/value.h"

namespace ir {

/// A list of things that a method can show one by one, such as its layered depth maps.
struct SelectorDescription {
    std::string
        key;  ///< "map"; elements of outputs that stand for an item have an integer field of this name
    std::string label;
    std::string doc = {};
    std::string parameter = {};  ///< an integer that says how many there are
    std::int64_t count = 0;      ///< how many there are, where no parameter says
};

/// How many items there are under these settings; 1 where they do not say.
inline std::int64_t count_of(const SelectorDescription& selector, const Settings& settings) {
    if (selector.parameter.empty()) return selector.count;
    const auto found = settings.find(selector.parameter);
    const auto* count = found == settings.end() ? nullptr : std::get_if<std::int64_t>(&found->second);
    return count ? *count : 1;
}

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
