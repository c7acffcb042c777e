#include "projects/edit_kinds.h"
#include "projects/edits.h"

namespace ir::projects::edits {

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
