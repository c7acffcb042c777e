#include "renderers/methods/photon-mapping/splatting/stages.h"

namespace ir::methods::photon_mapping {

StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons) {
    const StoredPhotons result{passes::photon_list(builder, photons.records), photons.power_unit};
    builder.pass("count photons")
        .reads(photons.records)
        .writes("Stored", result.stored)
        .counts("Count", photons.count)
        .execute([=](const graph::PassContext& p) { passes::count_stored(p, result); });
    return result;
}

}  // namespace ir::methods::photon_mapping
