#pragma once

#include "renderers/core/category.h"

namespace ir::methods::ldm_indirect {

/// Of the field `side`: along which of the two directions of a map a photon came.
inline Categories side_categories() {
    return {"side",
            {{-1, "against the map's direction", tints::orange},
             {0, "from the light itself", tints::yellow},
             {1, "along the map's direction", tints::sky}}};
}

}  // namespace ir::methods::ldm_indirect
