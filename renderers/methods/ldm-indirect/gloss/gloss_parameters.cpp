#include "renderers/methods/ldm-indirect/gloss/gloss_parameters.h"

#include "renderers/core/transport.h"

namespace ir::methods::ldm_indirect {
namespace {

const Condition with_gloss{"gloss", {std::string("mirror"), std::string("lobe")}};
const Condition by_maps{"gloss_tracer", {std::string("maps")}};
constexpr int since = 6;  ///< version of the method

}  // namespace

ParameterTable<GlossParameters> gloss_parameters() {
    ParameterTable<GlossParameters> table;
    table
        .add(&GlossParameters::kind,
             {.key = "gloss",
              .label = "Gloss",
              .doc =
                  "In which directions glossy interfaces that are seen look for what they reflect. What "
                  "they meet there is lit by its direct light, and with more bounces by paths that go on. It "
                  "takes the place of `receiver`. Lambert surfaces have no interface.",
              .citation = "Aalund15 §6",
              .choices = {{"none", "None", "Interfaces reflect what `receiver` says."},
                          {"mirror", "Mirror direction",
                           "Sharp, however rough the surface is, and as bright as the whole lobe."},
                          {"lobe", "Lobe",
                           "Directions drawn from the lobe of the material: a region of the maps' "
                           "directions counts as much as the lobe lies in it."}},
              .active_when = only_indirect,
              .since_version = since,
              .value_in_older_projects = std::string("none")})
        .add(
            &GlossParameters::tracer,
            {.key = "gloss_tracer",
             .label = "Tracer of gloss",
             .doc =
                 "What finds what interfaces look at. Exact rays have a body for either processor; the others "
                 "are on the host.",
             .citation = "Aalund15 §6",
             .choices = {{"maps", "Maps", "The map whose region has the direction, along its own."},
                         {"cube", "Layered depth cube",
                          "Rays march through three maps along the axes, at 512 texels, or through those of "
                          "`tracer`. [Lischinski98]"},
                         {"rays", "Exact rays",
                          "By Embree, or by the device's hierarchy: right, and faster than the others."}},
             .exact = {"rays"},
             .active_when = with_gloss,
             .since_version = since})
        .add(&GlossParameters::landing,
             {.key = "gloss_landing",
              .label = "Landing of gloss",
              .doc = "Where a map's direction is not the one that was wished, what is seen there.",
              .citation = "Aalund15 §6",
              .choices = {{"direction", "Map's direction",
                           "What lies along it, as published: mirrors are mosaics, a piece for each region."},
                          {"plane", "Plane of the hit",
                           "Where the wished direction meets the plane of what was hit, if the surface is "
                           "there."}},
              .active_when = by_maps,
              .since_version = since})
        .add(&GlossParameters::near,
             {.key = "gloss_near",
              .label = "Exact gloss nearby",
              .doc = "Exact rays see what lies nearer than so many texels, which maps do not resolve.",
              .unit = "texels",
              .hard = {0, 1e6},
              .soft = {0, 16},
              .active_when = by_maps,
              .since_version = since})
        .add(&GlossParameters::samples, {.key = "gloss_samples",
                                         .label = "Samples of gloss",
                                         .doc = "Directions for each pixel and frame.",
                                         .hard = {1, 4096},
                                         .soft = {1, 64},
                                         .active_when = with_gloss,
                                         .coarse = std::int64_t{1},
                                         .since_version = since})
        .add(
            &GlossParameters::highlight_rays,
            {.key = "gloss_highlight_rays",
             .label = "Rays of a highlight in gloss",
             .doc =
                 "How many of a pixel's directions meet a highlight of what they see at least. Smaller ones are "
                 "widened as far as these directions are apart, with the same light: the more samples and "
                 "frames, the less. 0: highlights stay as they are; of one that few directions meet each "
                 "makes a bright dot.",
             .citation = "Kaplanyan13",
             .hard = {0, 1000},
             .soft = {0, 16},
             .active_when = with_gloss,
             .since_version = 7,
             .value_in_older_projects = 0.0});
    return table;
}

std::vector<OutputDescription> gloss_outputs() {
    return {{.key = "gloss.radiance",
             .label = "Gloss",
             .semantic = Semantic::radiance,
             .unit = "W/(m² sr)",
             .doc = "What interfaces reflect of the scene, but for direct light: that of lights is in the "
                    "direct light. 0 of Lambert surfaces. A: frames in the mean.",
             .active_when = with_gloss},
            {.key = "gloss.error",
             .label = "Angle to the map's direction",
             .unit = "degrees",
             .doc = "Between the direction that a pixel's interface looks along and that of the map that "
                    "is asked; the mean of the frame's samples. 0 with the other tracers.",
             .active_when = with_gloss},
            {.key = "gloss.distance",
             .label = "Distance of what is reflected",
             .semantic = Semantic::depth,
             .unit = "m",
             .doc = "To what the first sample meets. 0: nothing.",
             .active_when = with_gloss}};
}

}  // namespace ir::methods::ldm_indirect
