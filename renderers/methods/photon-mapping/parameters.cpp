#include "renderers/methods/photon-mapping/parameters.h"

namespace ir::methods::photon_mapping {

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    add_emission_parameters(table);
    add_tracing_parameters(table);
    add_splatting_parameters(table);
    add_filtering_parameters(table);
    return table;
}

int texels(Resolution resolution) {
    return 64 << static_cast<int>(resolution);
}

}  // namespace ir::methods::photon_mapping
