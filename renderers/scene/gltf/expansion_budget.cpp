#include "renderers/scene/gltf/expansion_budget.h"

#include "renderers/core/error.h"

namespace ir::scene::gltf {

void ExpansionBudget::spend(std::size_t bytes, const std::string& place) {
    if (bytes > left_)
        throw InputError(file_, place, "the file expands to far more geometry than it holds; split it");
    left_ -= bytes;
}

}  // namespace ir::scene::gltf
