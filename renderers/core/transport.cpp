#include "renderers/core/transport.h"

#include <algorithm>

#include "renderers/core/error.h"

namespace ir {

namespace {

void add_paths(ParameterTable<Transport>& table) {
    table.add(
        &Transport::paths,
        {.key = "paths",
         .label = "Paths",
         .doc = "What is computed, by how often light is scattered on its way to the camera. Mirrors and "
                "glass do not count as scatterings.",
         .choices = {
             {"ao", "Ambient occlusion", "Cosine-weighted openness of the hemisphere; background 1."},
             {"direct", "Direct light",
              "One scattering, from all light sources: lights, emitters and environment; and the "
              "base colour of unlit surfaces. Background 0."},
             {"indirect", "Indirect light", "min_bounces + 1 to max_bounces + 1 scatterings. Background 0."},
             {"full", "Full",
              "Emission and background as they are seen, direct light, and indirect light."}}});
}

void add_bounces(ParameterTable<Transport>& table) {
    table
        .add(&Transport::min_bounces,
             {.key = "min_bounces",
              .label = "Minimum bounces",
              .doc = "Indirect light: fewest surfaces that scatter light before the visible one does.",
              .hard = {1, 64},
              .soft = {1, 8},
              .active_when = only_indirect})
        .add(&Transport::max_bounces,
             {.key = "max_bounces",
              .label = "Maximum bounces",
              .doc = "Indirect light: most surfaces that scatter light before the visible one does.",
              .hard = {1, 64},
              .soft = {1, 8},
              .active_when = only_indirect});
}

void add_distances(ParameterTable<Transport>& table) {
    table
        .add(&Transport::max_distance,
             {.key = "max_distance",
              .label = "Maximum distance",
              .doc = "Ambient occlusion: surfaces farther away than this do not occlude. Light: what a "
                     "surface scatters does not reach surfaces farther away than this; light sources and the "
                     "environment are seen at any distance. 0 means that there is no limit.",
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
                                               {"smooth", "Smooth", "V = (d/d_max)² below d_max."}},
                                   .active_when = only_ao});
}

void add_surfaces(ParameterTable<Transport>& table) {
    table
        .add(&Transport::materials,
             {.key = "materials",
              .label = "Materials",
              .doc = "The reflectance model that all surfaces use.",
              .choices = {{"gltf", "glTF",
                           "Metallic-roughness as glTF 2.0 defines it; smooth surfaces are mirrors, "
                           "transmissive ones glass."},
                          {"metalness-blend", "Metalness blend",
                           "Lambert and Cook–Torrance mixed by metalness."},
                          {"lambert", "Lambert", "Diffuse and opaque."}},
              .active_when = only_light})
        .add(&Transport::normal_maps,
             {.key = "normal_maps",
              .label = "Normal maps",
              .doc = "Take cosines with the normal-mapped shading normal instead of the interpolated one."});
}

void add_sources(ParameterTable<Transport>& table, int emitters_since) {
    table
        .add(&Transport::environment_light, {.key = "environment_light",
                                             .label = "Environment light",
                                             .doc = "Whether the environment emits light and is seen behind "
                                                    "everything.",
                                             .active_when = only_light})
        .add(&Transport::emitters,
             {.key = "emitters",
              .label = "Emitters",
              .doc = "What light sources with an extent do. Emissive surfaces are seen in any case where "
                     "the paths are full.",
              .choices = {{"all", "All light",
                           "Rectangles, disks, emissive surfaces and the environment light directly, and "
                           "what they light lights others."},
                          {"direct", "Direct light only",
                           "They light directly, and what surfaces scatter of that is left out."},
                          {"none", "None",
                           "Rectangles, disks and emissive surfaces light nothing, and rectangles and disks "
                           "are not seen. The environment is as environment_light says."}},
              .active_when = only_light,
              .since_version = emitters_since,
              .value_in_older_projects = Value{std::string("all")}});
}

/// In the order in which people see them.
ParameterTable<Transport> whole_group(int emitters_since = 1) {
    ParameterTable<Transport> table;
    add_paths(table);
    add_bounces(table);
    add_distances(table);
    add_surfaces(table);
    add_sources(table, emitters_since);
    return table;
}

}  // namespace

ParameterTable<Transport> transport_parameters(const TransportSupport& support) {
    auto keys = support.keys;
    keys.push_back("paths");
    return whole_group(support.emitters_since).only(keys, "paths", support.paths);
}

const std::vector<ParameterDescription>& transport_group() {
    static const auto descriptions = whole_group().descriptions();
    return descriptions;
}

bool is_transport_key(const std::string& key) {
    return find(transport_group(), key) != nullptr;
}

CarriedTransport carry_transport(const Settings& values, const std::vector<ParameterDescription>& from,
                                 const std::vector<ParameterDescription>& to) {
    CarriedTransport carried;
    for (const auto& [key, value] : values) {
        const auto *before = find(from, key), *after = find(to, key);
        if (!is_transport_key(key)) continue;
        const bool is_default = before && value == before->default_value;
        if (!after) {
            if (before && !is_default && is_active(*before, values))
                carried.lost.push_back("parameter '" + key + "': '" + to_string(value) +
                                       "' is lost, as the method has no such parameter");
            continue;
        }
        carried.values[key] = after->default_value;
        if (is_default) continue;
        try {
            carried.values[key] = after->checked(value);
        } catch (const UsageError& error) {
            carried.lost.push_back(std::string(error.what()) + "; its default '" +
                                   to_string(after->default_value) + "' is taken");
        }
    }
    return carried;
}

}  // namespace ir
