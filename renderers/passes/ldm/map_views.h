#pragma once

#include "renderers/core/method.h"
#include "renderers/passes/ldm/points.h"

namespace ir::passes::ldm {

/// The selector that chooses a map.
inline constexpr const char* map_selector = "map";
SelectorDescription map_selector_description();

/// Of a field `side`: along which of the two directions of a map.
inline const Category against_map{-1, "against the map's direction", tints::orange};
inline const Category along_map{1, "along the map's direction", tints::sky};

/// Descriptions of "ldm.layers", "ldm.points", "ldm.xray" and "ldm.directions".
std::vector<OutputDescription> map_outputs();

/// The maps that an inspection chooses: one, the last one in place of those beyond, or all.
MapRange chosen_maps(const Inspection& inspection, const Maps& maps);

/// Fields of "ldm.directions", and words of an element. Regions of a set of directions that was turned have
/// no bounds of colatitude and longitude, so these fields are missing then.
std::vector<graph::Field> region_fields(const Maps& maps);

/// Declares "ldm.directions": two elements per map, v and -v, and the pass "directions".
graph::BufferRef show_directions(graph::GraphBuilder& builder, MapsPointer maps);

graph::ImageRef declare_layers(graph::GraphBuilder& builder, const Maps& maps);
/// Pass "layers" of the maps shown that are in the batch, if any.
void show_layers(graph::GraphBuilder& builder, MapsPointer maps, int batch, MapRange shown,
                 graph::ImageRef layers);

}  // namespace ir::passes::ldm
