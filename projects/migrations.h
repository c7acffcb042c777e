#pragma once

#include <string>
#include <vector>

#include "projects/json.h"
#include "renderers/core/report.h"

namespace ir::projects {

/// One step from schema `from` to `from` + 1 on the JSON tree. It must cope with any tree: what it does not
/// recognise it leaves alone, for the reader to judge.
struct Migration {
    int from = 1;
    std::string summary;  ///< what changed, one line
    void (*apply)(Json& project) = nullptr;
};

const std::vector<Migration>& migrations();

/// Brings the tree to the newest schema, one step after the other, and says so. Throws InputError for a
/// missing, wrong or newer schema. Returns the schema that the file had.
int migrate(Json& project, const std::string& file, std::vector<Message>& messages);

}  // namespace ir::projects
