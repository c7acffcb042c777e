#pragma once

#include <vector>

#include "projects/document.h"
#include "projects/object_reader.h"
#include "renderers/core/method.h"
#include "renderers/core/report.h"

namespace ir::projects {

/// An experiment of a file that had this schema, with its values checked and completed against its method's
/// description; those of an unknown method are kept as they are.
Experiment read_experiment(ObjectReader& reader, const Registry& registry, int schema_in_file,
                           std::vector<Message>& messages);

/// A plain boolean, number or text; nothing for what no parameter can hold.
std::optional<Value> to_value(const Json& json);

/// Id and name are taken already. Throws InputError with the place.
void read_motion(ObjectReader& reader, Motion& motion);

}  // namespace ir::projects
