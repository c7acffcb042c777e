#include "renderers/methods/photon-mapping/emission/from_rsm.h"

namespace ir::methods::photon_mapping {

Condition from_rsm() {
    return {"first_hit", {std::string("rsm")}};
}

}  // namespace ir::methods::photon_mapping
