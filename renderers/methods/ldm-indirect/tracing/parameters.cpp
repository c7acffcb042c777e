#include "renderers/methods/ldm-indirect/parameters.h"

#include "renderers/passes/raytracing/cube_parameters.h"

namespace ir::methods::ldm_indirect {

void add_tracing_parameters(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::emission,
             {.key = "emission",
              .label = "Photons of a light",
              .doc = "Pixels along a side of a light's image, of which point lights have six. Each pixel "
                     "is a photon, which is split into as many as there are directions.",
              .unit = "pixels",
              .citation = "Aalund15 §4.2",
              .hard = {1, 1024},
              .soft = {16, 256},
              .on_change = OnChange::reallocate,
              .coarse = std::int64_t{32}})
        .add(
            &Parameters::senders,
            {.key = "senders",
             .label = "Senders",
             .doc = "What the surfaces reflect that photons meet first, into all directions as Lambert's do.",
             .citation = "Aalund15 §3.4",
             .choices = {{"diffuse", "Diffuse", "The diffuse part; metals are black."},
                         {"whole", "Whole albedo",
                          "What the interface reflects, too, although it would go into narrower lobes."}},
             .active_when = passes::has_microfacets,
             .since_version = 4,
             .value_in_older_projects = std::string("diffuse")})
        .add(&Parameters::tracer,
             {.key = "tracer",
              .label = "Ray tracer",
              .doc = "What finds where photons land that leave a surface along the maps' directions. Beams "
                     "are clipped by the maps in any case.",
              .citation = "Aalund15 §2.2",
              .choices = {{"directions", "Maps of the directions",
                           "As published: each map answers for its direction. Further bounces take rays by "
                           "Embree, as nodes know no reflectance."},
                          {"cube", "Layered depth cube",
                           "On the processor: rays march through three layered depth maps along the axes, "
                           "whose nodes know their triangle. Further bounces do so, too. [Lischinski98]"},
                          {"compute", "Compute",
                           "Exact: a bounding volume hierarchy on the device; further bounces by Embree."},
                          {"embree", "Embree", "Exact, on the processor: the oracle."}},
              .exact = {"embree"},
              .on_change = OnChange::reallocate,
              .since_version = 6})
        .add(&Parameters::footprint,
             {.key = "footprint",
              .label = "Footprint",
              .doc = "The spread of a photon after its split.",
              .citation = "Aalund15 §3.4",
              .choices = {{"published", "Published",
                           "The differential of the light's pixel, turned into the new direction: narrower "
                           "than the region of directions that the photon stands for."},
                          {"widened", "Widened",
                           "Spread over the region of directions, too: their second moments add."}}})
        .add(
            &Parameters::landing,
            {.key = "landing",
             .label = "Landing",
             .doc = "Where photons land that a map's entry stops. The camera's view corrects it for what it "
                    "shows.",
             .citation = "Aalund15 §3.1",
             .choices = {{"centre", "Texel's centre",
                          "As deep as the entry, whose texel's centre lies beside the photon; of the surface "
                          "nothing is known."},
                         {"plane", "Plane",
                          "On the plane through the entry and its neighbours, which has a normal, too."}},
             .active_when = {"tracer", {std::string("directions")}},
             .since_version = 4,
             .value_in_older_projects = std::string("centre")})
        .add(&Parameters::clipping,
             {.key = "clipping",
              .label = "Clipping",
              .doc = "What a footprint lights.",
              .citation = "Aalund15 eq. 5",
              .choices = {{"none", "None",
                           "As published: whatever lies in an ellipsoid about the receiver's plane, also "
                           "behind a thin wall."},
                          {"maps", "By the maps",
                           "What a beam meets from the photon's first surface on, as far as pixels see back "
                           "along it by its map."}},
              .since_version = 5,
              .value_in_older_projects = std::string("none")})
        .add(&Parameters::overhang,
             {.key = "overhang",
              .label = "Overhang",
              .doc = "What becomes of light whose footprint reaches beyond its surface, or off its plane.",
              .citation = "Aalund15 §3.4",
              .choices = {{"lost", "Lost", "As published: pictures are darker along edges."},
                          {"returned", "Returned",
                           "The photon is as much brighter where its surface is. The map's entries say how "
                           "much of a footprint lies on it."}},
              .active_when = {"clipping", {std::string("none")}},
              .since_version = 4,
              .value_in_older_projects = std::string("lost")})
        .add(&Parameters::reject_hidden,
             {.key = "reject_hidden",
              .label = "Reject hidden photons",
              .doc =
                  "As published: stores no photons whose centre the view does not show. Pictures are darker "
                  "then along their borders and behind things by what footprints reach over from there. "
                  "Otherwise photons are stored if their footprint may reach the view. What is rejected is "
                  "counted.",
              .citation = "Aalund15 §4.2"})
        .add(&Parameters::visibility_tolerance,
             {.key = "visibility_tolerance",
              .label = "Visibility tolerance",
              .doc = "How far a photon may lie from the surface that its pixel shows and count as seen: of "
                     "the distance to the eye, along the surface's normal.",
              .hard = {0, 1},
              .soft = {0.0001, 0.05}})
        .add(&Parameters::reserve,
             {.key = "reserve",
              .label = "Memory reserved",
              .doc = "Part of the photons that memory is reserved for at first, for at most 4,194,304 of "
                     "them. It grows where more are stored.",
              .hard = {0, 1},
              .soft = {0.001, 1},
              .effect = Effect::cost,
              .on_change = OnChange::reallocate});
    table.include(&Parameters::cube, passes::cube_parameters(6));
}

}  // namespace ir::methods::ldm_indirect
