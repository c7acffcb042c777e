#include "renderers/methods/photon-mapping/parameters.h"

namespace ir::methods::photon_mapping {
namespace {

const std::string bound_of_radius =
    "Bound of the radius that comes from the density, as a fraction of the radius of the scene's bounds. Not "
    "printed; the default is ";

void add_targets(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::splatting,
             {.key = "splatting",
              .label = "Splatting",
              .doc = "How kernels are added up. The picture is the same but for rounding. With the receivers "
                     "“full” the device gathers by tiles in any case.",
              .citation = "Smal19 §6.2, §6.3",
              .choices = {{"drawn", "Drawn",
                           "Kernels are drawn as solids around them, and blending adds; on the host, threads "
                           "add them to rows of texels."},
                          {"tiles", "Tiles",
                           "Compute shaders list the photons of each tile of 16 × 16 texels in order, and "
                           "texels add up their tile's. On the device alone."}},
              .effect = Effect::cost,
              .on_change = OnChange::reallocate,
              .since_version = 5})
        .add(
            &Parameters::splat_resolution,
            {.key = "splat_resolution",
             .label = "Splatting resolution",
             .doc =
                 "Resolution at which kernels are added up. A texel is for one pixel's surface; the other pixels "
                 "take from the texels around them that are on theirs.",
             .citation = "Smal19 §6.2.1",
             .choices = {{"full", "Full", "A texel for each pixel."},
                         {"half", "Half", "A texel for one of 2 × 2 pixels."},
                         {"quarter", "Quarter", "A texel for one of 4 × 4 pixels."}},
             .on_change = OnChange::reallocate})
        .add(&Parameters::inside_test,
             {.key = "inside_test",
              .label = "Inside test",
              .doc = "Which surfaces a kernel lights.",
              .citation = "Smal19 §6.2",
              .choices =
                  {{"ellipsoid", "Ellipsoid", "Those within the tri-axial ellipsoid."},
                   {"linear-depth", "Linear depth",
                    "Those near the kernel's plane along the view axis, seen through its ellipse. Draws 2 "
                    "triangles a photon in place of 20, but loses surfaces that bend away."}}})
        .add(&Parameters::sum_precision,
             {.key = "sum_precision",
              .label = "Precision",
              .doc = "Of the sums of irradiance and direction. Half floats differ from single ones by 0.2 % "
                     "(root mean square) where 10 kernels meet; drivers that cut off instead of rounding, as "
                     "software rasterisers do, lose 0.2 % there and 1.3 % where 50 meet. They end at 65,504 "
                     "W/m², the sum over all channels: what goes beyond is cut off and counted.",
              .citation = "Smal19 §6.2",
              .choices = {{"half-float", "Half float", "16 bits a number, as published: 12 bytes a texel."},
                          {"single-float", "Single float", "32 bits a number: 24 bytes a texel."}},
              .on_change = OnChange::reallocate});
}

void add_size(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::tile_size,
             {.key = "tile_size",
              .label = "Tile size",
              .doc = "Side of the tiles whose photons are counted to estimate their density.",
              .unit = "texels",
              .citation = "Smal19 §6.1.1",
              .hard = {1, 1024},
              .soft = {4, 64},
              .on_change = OnChange::reallocate})
        .add(&Parameters::kernel_scale,
             {.key = "kernel_scale",
              .label = "Photons in a kernel",
              .doc =
                  "How many photons a kernel should hold by the density of its tile, n_tile; radii grow with "
                  "its root. More is smoother and slower, with more bias.",
              .citation = "Smal19 eq. 6.2",
              .hard = {1e-3, 1e4},
              .soft = {0.25, 16}})
        .add(&Parameters::min_radius, {.key = "min_radius",
                                       .label = "Minimum radius",
                                       .doc = bound_of_radius + "1/500.",
                                       .citation = "Smal19 eq. 6.2",
                                       .hard = {0, 1},
                                       .soft = {0, 0.1}})
        .add(&Parameters::max_radius, {.key = "max_radius",
                                       .label = "Maximum radius",
                                       .doc = bound_of_radius + "1/20.",
                                       .citation = "Smal19 eq. 6.2",
                                       .hard = {0, 10},
                                       .soft = {0.002, 0.2}})
        .add(&Parameters::min_radius_texels,
             {.key = "min_radius_texels",
              .label = "Minimum radius, texels",
              .doc = "Kernels are no smaller than this many texels of the splatting resolution, where a "
                     "texel faces the viewer. √½ lets each be seen by a texel; 0, as published, lets "
                     "small kernels fall between texels or flash on one.",
              .unit = "texels",
              .hard = {0, 100},
              .soft = {0, 4}});
}

void add_shape(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::min_ray_length_scale,
             {.key = "min_ray_length_scale",
              .label = "Minimum scale of short rays",
              .doc = "Lower bound of the factor l / l_max by which photons at the end of short rays have "
                     "smaller kernels.",
              .citation = "Smal19 app. C",
              .hard = {1e-3, 1},
              .soft = {0.02, 1}})
        .add(&Parameters::ray_length_scale,
             {.key = "ray_length_scale",
              .label = "Length of full scale",
              .doc =
                  "l_max: kernels at the end of rays of this length and longer have their full size; as part "
                  "of the radius of the scene's bounds.",
              .citation = "Smal19 eq. 6.1",
              .hard = {1e-4, 100},
              .soft = {0.02, 2}})
        .add(&Parameters::normal_axis,
             {.key = "normal_axis",
              .label = "Thickness",
              .doc = "s_n: thickness of the kernel along the normal, against its radius. Thin kernels do not "
                     "light surfaces behind a corner, but leave holes where a surface bends.",
              .citation = "Smal19 §6.1.2",
              .hard = {1e-3, 10},
              .soft = {0.05, 1}})
        .add(&Parameters::max_stretch,
             {.key = "max_stretch",
              .label = "Maximum stretch",
              .doc = "s_max: how far kernels of light at grazing incidence are stretched along it at most.",
              .citation = "Smal19 eq. 6.3",
              .hard = {1, 100},
              .soft = {1, 10}})
        .add(&Parameters::facing_test,
             {.key = "facing_test",
              .label = "Test of normals",
              .doc = "A kernel lights only surfaces that face where its photon came from: light does not go "
                     "around edges to what turns away from it.",
              .since_version = 3})
        .add(&Parameters::edge_probes,
             {.key = "edge_probes",
              .label = "Probes at edges",
              .doc =
                  "Divides a photon's power by the area that its kernel can light, estimated by eight looks "
                  "at the picture's depths, instead of by all of its area: what hangs over edges is not "
                  "lost. At least three of them count, so that no photon on a thin thing becomes a bright "
                  "dot.",
              .since_version = 5,
              .value_in_older_projects = Value{false}});
}

}  // namespace

void add_splatting_parameters(ParameterTable<Parameters>& table) {
    add_targets(table);
    add_size(table);
    add_shape(table);
}

}  // namespace ir::methods::photon_mapping
