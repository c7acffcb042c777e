#include "renderers/methods/ldm-indirect/parameters.h"

namespace ir::methods::ldm_indirect {

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.include(&Parameters::maps, passes::ldm::map_parameters());
    table.include(&Parameters::transport,
                  transport_parameters({.paths = {"direct", "indirect", "full"},
                                        .keys = {"materials", "normal_maps", "environment_light"}}));
    add_tracing_parameters(table);
    add_splatting_parameters(table);
    table.include(&Parameters::receivers, passes::receiver_parameters(4));
    table.include(&Parameters::light, passes::light_parameters());
    table.include(&Parameters::maps, passes::ldm::self_hit_parameters());
    return table;
}

}  // namespace ir::methods::ldm_indirect
