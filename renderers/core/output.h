#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "renderers/core/category.h"
#include "renderers/core/condition.h"

namespace ir {

/// What an output is made of; each kind has one viewer.
enum class OutputKind { image, pyramid, stack, point_set, line_set, glyphs, sphere_values, table };

/// What the numbers mean; chooses colour map, tooltip unit and metric.
enum class Semantic {
    generic,
    radiance,
    irradiance,
    accessibility,
    albedo,
    normal,
    position,
    depth,
    distance,
    velocity,
    probability,
    count,
    id,
    mask
};

std::string to_string(OutputKind kind);
std::string to_string(Semantic semantic);

/// What a method shows of itself. The first that is active under the settings is the main result.
struct OutputDescription {
    std::string key;  ///< equals the key of the graph resource that holds it
    std::string label;
    OutputKind kind = OutputKind::image;
    Semantic semantic = Semantic::generic;
    std::string unit = {};
    std::string colour_map = {};  ///< empty: the semantic's own
    std::string doc = {};
    /// Fields whose numbers are names: they have colours of their own and no colour map.
    std::vector<Categories> categories = {};
    /// Of a set: where it has no elements although everything succeeded; of one that explains, although a
    /// pixel is picked, often no_surface. The rest of a sentence that says "Empty where".
    std::string when_empty = {};
    /// Depends on the inspection: computed only when asked for, and again when a person points elsewhere.
    bool explains = false;
    /// Under other settings the method has no such output.
    Condition active_when = {};
};

/// For OutputDescription::when_empty.
inline constexpr const char* no_surface = "the pixel shows no surface";

/// All of them, in order.
std::vector<OutputDescription> joined(std::initializer_list<std::vector<OutputDescription>> parts);

/// The main result of methods of ambient occlusion; `more` ends the sentence that says what it is.
OutputDescription accessibility_output(const std::string& more = ".");

/// `doc`, what the numbers of its categories mean, and when it is empty.
std::string full_doc(const OutputDescription& output);

/// The colour map that a semantic is shown with when nobody chose another ("viridis", "grey", …).
std::string default_colour_map(Semantic semantic);

}  // namespace ir
