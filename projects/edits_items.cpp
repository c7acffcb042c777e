#include "projects/edit_kinds.h"
#include "projects/edits.h"
#include "projects/text.h"
#include "projects/validate.h"

namespace ir::projects::edits {
namespace {

template <class Item>
EditPtr change(const Project& project, const Item& item) {
    validate(item);
    const std::string word = ListOf<Item>::word;
    return replace(project, item, "Change " + word + " '" + printable(item.name, 40) + "'",
                   word + ":" + item.id);
}

}  // namespace

EditPtr change_camera(const Project& project, const Camera& camera) {
    return change(project, camera);
}

EditPtr change_lights(const Project& project, const LightSet& lights) {
    return change(project, lights);
}

EditPtr change_motion(const Project& project, const Motion& motion) {
    return change(project, motion);
}

EditPtr change_comparison(const Project& project, const Comparison& comparison) {
    return change(project, comparison);
}

EditPtr change_sweep(const Project& project, const Sweep& sweep) {
    return change(project, sweep);
}

EditPtr change_plot(const Project& project, const ErrorPlot& plot) {
    return change(project, plot);
}

EditPtr change_image(const Project& project, const ForeignImage& image) {
    return change(project, image);
}

EditPtr change_scene(const Project& project, const Scene& scene) {
    return change(project, scene);
}

EditPtr set_project_name(const Project& project, const std::string& name) {
    return std::make_unique<SetText>("Rename project", "", &Project::name, project.name, name);
}

EditPtr set_notes(const Project& project, const std::string& notes) {
    return std::make_unique<SetText>("Change notes", "notes", &Project::notes, project.notes, notes);
}

EditPtr group(std::string label, std::vector<EditPtr> edits) {
    return std::make_unique<Group>(std::move(label), std::move(edits));
}

}  // namespace ir::projects::edits
