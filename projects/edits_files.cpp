#include "projects/edit_kinds.h"
#include "projects/edits.h"
#include "projects/validate.h"

namespace ir::projects::edits {
namespace {

/// One replacement for every item that differs; the lists hold the same ids in the same order.
template <class Item>
void replace_changed(std::vector<EditPtr>& steps, const Project& before, const Project& after,
                     const std::string& label) {
    const auto& old_items = list_of<Item>(before);
    const auto& new_items = list_of<Item>(after);
    for (std::size_t i = 0; i < old_items.size(); ++i) {
        if (old_items[i] == new_items[i]) continue;
        validate(new_items[i]);
        steps.push_back(replace(before, new_items[i], label, ""));
    }
}

}  // namespace

EditPtr relocate(const Project& project, const std::map<std::string, std::string>& new_sources) {
    Project after = project;
    const auto move = [&](std::string& source) {
        if (const auto found = new_sources.find(source); found != new_sources.end()) source = found->second;
    };
    for (auto& scene : after.scenes)
        for (auto& part : scene.parts) move(part.source);
    for (auto& set : after.lights)
        if (set.environment.kind == Environment::Kind::map) move(set.environment.source);
    for (auto& image : after.images) move(image.source);
    const std::string label = "Locate files";
    std::vector<EditPtr> steps;
    replace_changed<Scene>(steps, project, after, label);
    replace_changed<LightSet>(steps, project, after, label);
    replace_changed<ForeignImage>(steps, project, after, label);
    return group(label, std::move(steps));
}

}  // namespace ir::projects::edits
