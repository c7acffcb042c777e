#pragma once

#include <cstddef>
#include <vector>

namespace ir {

/// A part of work that is divided: the `index`-th of `count`, counted from 1.
struct Shard {
    int index = 1, count = 1;
    bool operator==(const Shard&) const = default;
};

/// Every count-th item, beginning with the index-th, so that shards are equally hard.
template <class Item>
std::vector<Item> part_of(const std::vector<Item>& items, const Shard& shard) {
    std::vector<Item> part;
    for (auto i = static_cast<std::size_t>(shard.index - 1); i < items.size();
         i += static_cast<std::size_t>(shard.count))
        part.push_back(items[i]);
    return part;
}

}  // namespace ir
