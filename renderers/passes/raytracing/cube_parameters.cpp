#include "renderers/passes/raytracing/cube_parameters.h"

namespace ir::passes {

ParameterTable<CubeOptions> cube_parameters(int since_version) {
    const Condition with_cube{"tracer", {std::string("cube")}};
    ParameterTable<CubeOptions> table;
    table
        .add(&CubeOptions::resolution,
             {.key = "cube_resolution",
              .label = "Resolution of the cube",
              .doc = "Texels along the longest side of the scene's bounds, in each of the three maps.",
              .unit = "texels",
              .hard = {1, 8192},
              .soft = {64, 2048},
              .active_when = with_cube,
              .since_version = since_version})
        .add(&CubeOptions::maps,
             {.key = "cube_maps",
              .label = "Maps of the cube",
              .doc = "Which maps a ray marches through.",
              .citation = "Aalund15 §2.2",
              .choices = {{"all", "All three",
                           "Each surface stands in the map that sees it best, and the nearest hit counts."},
                          {"closest", "The closest one",
                           "As published: the map whose direction is closest to the ray's has all surfaces. "
                           "Those that it sees edge-on are gaps."}},
              .active_when = with_cube,
              .since_version = since_version})
        .add(&CubeOptions::tolerance, {.key = "cube_tolerance",
                                       .label = "Depth tolerance of the cube",
                                       .doc = "How far a ray may pass a node and still hit it.",
                                       .unit = "texels",
                                       .citation = "Aalund15 §2.2",
                                       .hard = {0, 64},
                                       .soft = {0, 4},
                                       .active_when = with_cube,
                                       .since_version = since_version});
    return table;
}

}  // namespace ir::passes
