#include "renderers/methods/photon-mapping/parameters.h"

#include "renderers/passes/raytracing/cube_parameters.h"

namespace ir::methods::photon_mapping {

void add_tracing_parameters(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::tracer,
            {.key = "tracer",
             .label = "Ray tracer",
             .doc =
                 "What finds the surfaces that photons hit. Compute and Embree know the same triangles and "
                 "alpha masks; where a ray meets an edge they may name different ones.",
             .citation = "Smal19 §4.3",
             .choices =
                 {{"auto", "Automatic", "Embree where passes with two bodies run on the host.", Effect::cost},
                  {"compute", "Compute", "A bounding volume hierarchy on the device.", Effect::cost},
                  {"embree", "Embree", "On the processor: the oracle.", Effect::cost},
                  {"cube", "Layered depth cube",
                   "On the processor: rays march through three layered depth maps along the axes, as coarse "
                   "as their texels. [Lischinski98]"}},
             .exact = {"embree"}})
        .add(&Parameters::roulette,
             {.key = "roulette",
              .label = "Russian roulette",
              .doc = "How photons are absorbed, with equal means and different noise.",
              .citation = "Smal19 §4.4.2",
              .choices =
                  {{"multichannel", "Multichannel",
                    "A photon survives with the largest part that a channel keeps; its colour changes."},
                   {"per-channel", "Per channel",
                    "Each channel survives by itself; photons become pure colours."}}})
        .add(&Parameters::microfacet_sampling,
             {.key = "microfacet_sampling",
              .label = "Microfacet sampling",
              .doc = "How glossy reflections choose their directions.",
              .citation = "Smal19 §4.4.1",
              .choices = {{"visible-normals", "Visible normals",
                           "Survival G2 F / G1, never above 1. [Heitz18]"},
                          {"ggx", "GGX",
                           "All normals of the distribution; weights above 1 are carried on as power."},
                          {"ggx-printed", "GGX, as printed",
                           "Wrong: all normals of the distribution with the survival that belongs to visible "
                           "ones. Glossy surfaces reflect too much or too little."}},
              .active_when = passes::has_microfacets})
        .add(&Parameters::culling,
             {.key = "culling",
              .label = "Culling",
              .doc =
                  "Does not store photons that can light no pixel: outside the camera's frustum, widened by "
                  "the largest kernel, or on surfaces that turn their back. They are counted.",
              .citation = "Smal19 §4.3",
              .effect = Effect::cost});
    table.include(&Parameters::cube, passes::cube_parameters(5));
}

}  // namespace ir::methods::photon_mapping
