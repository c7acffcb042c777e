#pragma once

#include "renderers/methods/ldm-ao/passes.h"
#include "renderers/passes/ldm/points.h"

namespace ir::methods::ldm_ao {

/// Key of the selector that chooses a map.
inline constexpr const char* map_selector = "map";

/// The maps that an inspection chooses: one, the last one in place of those beyond, or all.
passes::ldm::MapRange chosen_maps(const Inspection& inspection, const passes::ldm::Maps& maps);

/// Fields of "ldm.directions", and words of an element. Regions of a set of directions that was turned have
/// no bounds of colatitude and longitude, so these fields are missing then.
std::vector<graph::Field> region_fields(const passes::ldm::Maps& maps);

/// Declares "ldm.directions": two elements per map, v and -v, and the pass "directions".
graph::BufferRef show_directions(graph::GraphBuilder& builder, MapsPointer maps);

graph::ImageRef declare_layers(graph::GraphBuilder& builder, const passes::ldm::Maps& maps);
/// Pass "layers" of the maps shown that are in the batch, if any.
void show_layers(graph::GraphBuilder& builder, MapsPointer maps, int batch, passes::ldm::MapRange shown,
                 graph::ImageRef layers);

}  // namespace ir::methods::ldm_ao
