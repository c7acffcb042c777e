#include "renderers/core/output.h"

#include <array>

#include "renderers/core/mapped_kind.h"

namespace ir {

std::string to_string(OutputKind kind) {
    static constexpr std::array names{"image",    "pyramid", "stack",         "point-set",
                                      "line-set", "glyphs",  "sphere-values", "table"};
    return names.at(static_cast<std::size_t>(kind));
}

std::string to_string(Semantic semantic) {
    static constexpr std::array names{"generic",     "radiance", "irradiance", "accessibility", "albedo",
                                      "normal",      "position", "depth",      "distance",      "velocity",
                                      "probability", "count",    "id",         "mask"};
    return names.at(static_cast<std::size_t>(semantic));
}

std::vector<OutputDescription> joined(std::initializer_list<std::vector<OutputDescription>> parts) {
    std::vector<OutputDescription> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

OutputDescription accessibility_output(const std::string& more) {
    return {.key = "accessibility",
            .label = "Accessibility",
            .semantic = Semantic::accessibility,
            .doc = "Cosine-weighted openness of the hemisphere, 1 = open" + more};
}

std::string full_doc(const OutputDescription& output) {
    std::string text = output.doc;
    for (const auto& categories : output.categories) text += " " + category_doc(categories);
    if (output.when_empty.empty()) return text;
    const std::string begin =
        output.explains ? " Empty while no pixel is picked, and where " : " Empty where ";
    return text + begin + output.when_empty + ".";
}

MappedKind mapped_kind(Semantic semantic) {
    switch (semantic) {
        case Semantic::depth:
        case Semantic::distance:
            return MappedKind::depths;
        case Semantic::probability:
            return MappedKind::probabilities;
        case Semantic::count:
        case Semantic::id:
            return MappedKind::counts;
        default:
            return MappedKind::numbers;
    }
}

std::string default_colour_map(MappedKind kind) {
    static constexpr std::array names{"grey", "viridis", "viridis", "turbo", "magma", "coolwarm"};
    return names.at(static_cast<std::size_t>(kind));
}

std::string default_colour_map(Semantic semantic) {
    return default_colour_map(mapped_kind(semantic));
}

}  // namespace ir
