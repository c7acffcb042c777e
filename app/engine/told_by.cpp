#include "app/engine/told_by.h"

#include "app/engine/pictures.h"

namespace ir::engine {

std::map<std::string, projects::Json> told_by(const ImageAttributes& attributes, const std::string& file) {
    std::map<std::string, projects::Json> told;
    for (const auto& [key, value] : attributes) {
        if (!key.starts_with(attribute_prefix)) continue;
        if (key != recipe_attribute) {
            told[key.substr(attribute_prefix.size())] = value;
            continue;
        }
        const auto recipe = projects::parse_json(value, file);
        // The other lists repeat what attributes tell one by one.
        for (const char* list : {"scenes", "lights", "motion"})
            if (const auto found = recipe.find(list); found != recipe.end()) {
                const auto leaves = found->flatten();
                for (const auto& [place, leaf] : leaves.items()) told[list + place] = leaf;
            }
    }
    return told;
}

}  // namespace ir::engine
