#pragma once

#include "projects/json.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// The JSON Schema of project.json, made from the tables of fields and the methods' parameters. Keys that it
/// does not know are allowed, as they are kept.
Json project_schema(const Registry& registry);

}  // namespace ir::projects
