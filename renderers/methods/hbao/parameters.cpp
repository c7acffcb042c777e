#include "renderers/methods/hbao/parameters.h"

#include "renderers/passes/direct/lit.h"

namespace ir::methods::hbao {
namespace {

void add_march(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::directions,
            {.key = "directions",
             .label = "Directions",
             .doc = "Directions in the picture, all around, that are marched from each pixel. 8 to 16 is the "
                    "sensible setting. The baseline of Aalund 2015 marched 512 with up to 128 steps, with "
                    "neither turning nor blur: the benchmark's variant “authors' baseline”.",
             .citation = "Bavoil08",
             .hard = {1, 1024},
             .soft = {4, 64},
             .coarse = std::int64_t{8}})
        .add(&Parameters::steps,
             {.key = "steps",
              .label = "Steps",
              .doc = "Samples along each direction, evenly spread from the pixel to where the radius or the "
                     "picture ends; no more than there are pixels. 8 to 16 is the sensible setting, 128 that "
                     "of Aalund 2015's baseline.",
              .citation = "Bavoil08",
              .hard = {1, 1024},
              .soft = {4, 64},
              .coarse = std::int64_t{6}});
}

void add_shape(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::weighting,
             {.key = "weighting",
              .label = "Weighting",
              .doc = "What the openness of a direction counts.",
              .citation = "Bavoil08",
              .choices = {{"cosine", "Cosine",
                           "By the cosine with the shading normal, integrated exactly between horizon and "
                           "view: the quantity that all methods of ambient occlusion compute."},
                          {"published", "Published",
                           "By solid angle: sin h − sin t of the elevations of horizon and tangent, counted "
                           "from the tangent plus the angle bias. Another quantity; shading normals do not "
                           "count."}}})
        .add(
            &Parameters::turning,
            {.key = "turning",
             .label = "Turning",
             .doc = "How directions are turned and first steps shifted from pixel to pixel, so that what few "
                    "directions miss becomes a pattern that the blur takes away. The same in every frame.",
             .citation = "Bavoil08",
             .choices = {{"none", "None", "All pixels march alike: banding in place of noise."},
                         {"pattern", "4×4 pattern", "Sixteen turns and shifts that repeat."},
                         {"hash", "Hash", "Another turn and shift for each pixel."}}})
        .add(&Parameters::angle_bias,
             {.key = "angle_bias",
              .label = "Angle bias",
              .doc = "Samples that are not seen by so much above the plane of the pixel's triangle do not "
                     "occlude: otherwise curved surfaces of flat triangles shade themselves.",
              .unit = "degrees",
              .citation = "Bavoil08",
              .hard = {0, 89},
              .soft = {0, 45}});
}

}  // namespace

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    add_march(table);
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"ao"}, .keys = {"max_distance", "falloff", "normal_maps"}}));
    add_shape(table);
    table.include(&Parameters::blur, passes::blur_parameters());
    table.add(&Parameters::ambient, passes::ambient_parameter());
    table.include(&Parameters::light, passes::light_parameters());
    return table;
}

}  // namespace ir::methods::hbao
