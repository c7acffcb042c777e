#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderers/graph/builder.h"

namespace ir::graph {
namespace detail {

template <class Ref, class Desc>
std::optional<Ref> declared_among(const std::vector<Desc>& all, const std::string& key) {
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].text.key == key) return Ref{static_cast<int>(i)};
    return {};
}

}  // namespace detail

// What an earlier declaration of this frame made under the key.
inline std::optional<ObjectRef> declared_object(const GraphBuilder& builder, const std::string& key) {
    return detail::declared_among<ObjectRef>(builder.objects(), key);
}
inline std::optional<BufferRef> declared_buffer(const GraphBuilder& builder, const std::string& key) {
    return detail::declared_among<BufferRef>(builder.buffers(), key);
}
inline std::optional<ImageRef> declared_image(const GraphBuilder& builder, const std::string& key) {
    return detail::declared_among<ImageRef>(builder.images(), key);
}

}  // namespace ir::graph
