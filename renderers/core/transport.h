#pragma once

#include <string>
#include <vector>

#include "renderers/core/parameter.h"

namespace ir {

/// What is being computed: the one group of parameters that all methods share. Equal keys mean the same
/// everywhere, so a reference matches a method by copying the group.
struct Transport {
    enum class Paths { ao, direct, indirect, full };
    enum class Falloff { hard, smooth };
    enum class Materials { gltf, metalness_blend, lambert };
    enum class Emitters { all, direct, none };

    Paths paths = Paths::ao;
    int min_bounces = 1;
    int max_bounces = 1;
    float max_distance = 0;  ///< metres; 0 = unlimited
    Falloff falloff = Falloff::hard;
    Materials materials = Materials::gltf;
    bool normal_maps = true;
    bool environment_light = true;
    Emitters emitters = Emitters::all;
};

/// The part of the group that a method supports.
struct TransportSupport {
    std::vector<std::string> paths;  ///< keys that `paths` may take: "ao", "direct", "indirect", "full"
    std::vector<std::string> keys;   ///< the other keys of the group that the method honours
    int emitters_since = 1;          ///< version of the method that introduced this key
};

/// Describes the supported part of the group. Defaults are the member initialisers above, or those that the
/// method's own struct gives its Transport member.
ParameterTable<Transport> transport_parameters(const TransportSupport& support);

/// The descriptions of the whole group, with the defaults above.
const std::vector<ParameterDescription>& transport_group();

/// Conditions of parameters and outputs, by what is being computed.
inline const Condition only_ao{"paths", {std::string("ao")}};
inline const Condition only_light{"paths",
                                  {std::string("direct"), std::string("indirect"), std::string("full")}};
inline const Condition only_indirect{"paths", {std::string("indirect"), std::string("full")}};
inline const Condition only_full{"paths", {std::string("full")}};

/// Whether `key` belongs to the transport group.
bool is_transport_key(const std::string& key);

/// What methods compute at their defaults, so that one can be put beside another as they are: those of
/// ambient occlusion what is near, as nothing is open in a closed room; those of light the whole picture. A
/// method's own struct begins with one of them.
inline constexpr Transport default_occlusion{.paths = Transport::Paths::ao, .max_distance = 1};
inline constexpr Transport default_light{.paths = Transport::Paths::full, .max_distance = 0};

/// What one method takes over from another.
struct CarriedTransport {
    Settings values;
    std::vector<std::string> lost;  ///< one line for each value that could not be taken over
};

/// The transport that a method with parameters `to` computes in place of one with parameters `from` (none
/// where it is unknown), of the keys in `values` that it has. A value at the default of `from` becomes the
/// default of `to`; any other is kept, or becomes that default where `to` does not allow it.
CarriedTransport carry_transport(const Settings& values, const std::vector<ParameterDescription>& from,
                                 const std::vector<ParameterDescription>& to);

}  // namespace ir
