#pragma once

#include <memory>

#include "projects/document.h"
#include "renderers/core/method.h"
#include "widgets/document/project_model.h"

namespace ir::widgets {

/// What the tree shows of a project, worked out from the document alone.
std::unique_ptr<ProjectModel::Node> project_nodes(const projects::Project& project, const Registry& registry);

/// "3.5 W/sr at 0, 2, 0": a light in a few words.
QString light_text(const projects::LightSpec& light);
/// "Point light"
QString light_name(projects::LightSpec::Type type);
/// Last step of a source: "nave.gltf", "builtin:atrium@1".
QString source_name(const std::string& source);

}  // namespace ir::widgets
