#pragma once

#include "projects/document.h"
#include "projects/object_reader.h"

namespace ir::projects {

/// Id and name are taken already. Throws InputError with the place.
void read_motion(ObjectReader& reader, Motion& motion);

}  // namespace ir::projects
