/// Words of an element of "ldm.points" (renderers/passes/ldm/points.cpp): position 3, normal 3, facing, depth in
/// metres, layer, map.
// C++: ir::passes::ldm::*
const uint POINT_WORDS = 10u, POINT_NORMAL = 3u, POINT_FACING = 6u, POINT_DEPTH = 7u, POINT_LAYER = 8u,
           POINT_MAP = 9u;
