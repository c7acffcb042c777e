#pragma once

#include <optional>
#include <string>

#include "renderers/graph/builder.h"

namespace ir::graph {

/// The object that an earlier declaration of this frame made under the key.
inline std::optional<ObjectRef> declared_object(const GraphBuilder& builder, const std::string& key) {
    const auto& objects = builder.objects();
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (objects[i].text.key == key) return ObjectRef{static_cast<int>(i)};
    return {};
}

}  // namespace ir::graph
