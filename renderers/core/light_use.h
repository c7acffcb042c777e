#pragma once

#include <bitset>
#include <string>
#include <vector>

#include "renderers/core/light_kind.h"
#include "renderers/core/method.h"

namespace ir {

/// Which light is in a method's picture: each part of each kind of source.
class LightUse {
  public:
    bool has(LightPart part, LightKind kind) const { return bits_[index(part, kind)]; }
    void set(LightPart part, LightKind kind, bool value) { bits_[index(part, kind)] = value; }
    /// In how many kinds of sources the two differ.
    std::size_t differing_kinds(const LightUse& other) const;

  private:
    static std::size_t index(LightPart part, LightKind kind) {
        return static_cast<std::size_t>(part) * light_kinds + static_cast<std::size_t>(kind);
    }
    std::bitset<light_parts * light_kinds> bits_;
};

/// What the transport of these complete settings asks for, less what the description says to be missing.
/// Nothing for ambient occlusion and for methods without paths.
LightUse light_use(const MethodDescription& method, const Settings& settings);

/// The output of methods of ambient occlusion that has direct light.
inline constexpr const char* lit_output_key = "lit";
/// Which light is in it under these complete settings, less what the description says to be missing.
LightUse light_use_of_lit(const MethodDescription& method, const Settings& settings);

/// Complete settings of the reference with the choice of sources that differs from `wanted` in the fewest
/// kinds; of equally good ones the first, so that what does not count has its default.
Settings with_light_use(const MethodDescription& reference, Settings settings, const LightUse& wanted);

/// The sources with what is in the picture of each.
std::vector<UsedLight> used_lights(const std::vector<LightSource>& sources, const LightUse& use);

/// In which sources two pictures differ, in the parts that the transport of both has, one line each:
/// "the environment gives direct light in B alone". Sources are told apart by kind and name; one that is
/// only in one of the lists is no difference in the use of light.
std::vector<std::string> light_differences(const std::vector<UsedLight>& a, const std::vector<UsedLight>& b,
                                           const std::vector<LightPart>& parts, const std::string& name_a,
                                           const std::string& name_b);

/// The parts that a value of "paths" is made of; none for ambient occlusion and unknown ones.
std::vector<LightPart> light_parts_of(const std::string& paths);

/// Of two complete settings: the parts that the paths of both have.
std::vector<LightPart> parts_in_both(const Settings& a, const Settings& b);

/// Whether a parameter only chooses between sources of light: what light_use() tells more exactly.
inline bool chooses_sources(const std::string& key) {
    return key == "emitters" || key == "environment_light";
}

/// As JSON: [{"source": …, "kind": …, "parts": […]}]. What is not of this form is nothing.
std::string to_json(const std::vector<UsedLight>& lights);
std::vector<UsedLight> used_lights_from_json(const std::string& text);

}  // namespace ir
