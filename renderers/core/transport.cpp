#include "renderers/core/transport.h"

#include <algorithm>

namespace ir {
namespace {

ParameterTable<Transport> whole_group() {
    ParameterTable<Transport> table;
    table
        .add(&Transport::paths,
             {.key = "paths",
              .label = "Paths",
              .doc = "What is computed: ambient occlusion, direct light (one scattering), indirect light "
                     "(min_bounces + 1 to max_bounces + 1 scatterings), or everything.",
              .choices = {{"ao", "Ambient occlusion", "Cosine-weighted openness of the hemisphere."},
                          {"direct", "Direct light", "Paths with one scattering."},
                          {"indirect", "Indirect light",
                           "Paths with min_bounces + 1 to max_bounces + 1 scatterings."},
                          {"full", "Full", "Everything, with emission seen directly and the background."}}})
        .add(&Transport::min_bounces,
             {.key = "min_bounces",
              .label = "Fewest bounces",
              .doc = "Indirect light: fewest bounces between the light and the visible surface.",
              .hard = {1, 64},
              .soft = {1, 8},
              .active_when = {"paths", {std::string("indirect"), std::string("full")}}})
        .add(&Transport::max_bounces,
             {.key = "max_bounces",
              .label = "Most bounces",
              .doc = "Indirect light: most bounces between the light and the visible surface.",
              .hard = {1, 64},
              .soft = {1, 8},
              .active_when = {"paths", {std::string("indirect"), std::string("full")}}})
        .add(&Transport::max_distance,
             {.key = "max_distance",
              .label = "Maximum distance",
              .doc = "Surfaces farther away than this do not occlude; 0 means that there is no limit.",
              .unit = "m",
              .citation = "Aalund15 §5.1",
              .hard = {0, 1e9},
              .soft = {0, 20}})
        .add(&Transport::falloff, {.key = "falloff",
                                   .label = "Fall-off",
                                   .doc = "How visibility V grows with the distance d of the first hit, up "
                                          "to the maximum distance d_max.",
                                   .citation = "Aalund15 §3.3",
                                   .choices = {{"hard", "Hard", "V = 0 below d_max."},
                                               {"smooth", "Smooth", "V = (d/d_max)² below d_max."}}})
        .add(&Transport::materials,
             {.key = "materials",
              .label = "Materials",
              .doc = "The reflectance model that all surfaces use.",
              .choices = {{"gltf", "glTF", "Metallic-roughness as glTF 2.0 defines it."},
                          {"metalness-blend", "Metalness blend",
                           "Lambert and Cook–Torrance mixed by metalness."},
                          {"lambert", "Lambert", "Diffuse only."}}})
        .add(&Transport::normal_maps,
             {.key = "normal_maps",
              .label = "Normal maps",
              .doc = "Take cosines with the normal-mapped shading normal instead of the "
                     "interpolated one."})
        .add(&Transport::environment_light, {.key = "environment_light",
                                             .label = "Environment light",
                                             .doc = "Whether the environment emits light."});
    return table;
}

}  // namespace

ParameterTable<Transport> transport_parameters(const TransportSupport& support) {
    auto keys = support.keys;
    keys.push_back("paths");
    return whole_group().only(keys, "paths", support.paths);
}

const std::vector<ParameterDescription>& transport_group() {
    static const auto descriptions = whole_group().descriptions();
    return descriptions;
}

bool is_transport_key(const std::string& key) {
    return find(transport_group(), key) != nullptr;
}

}  // namespace ir
