#pragma once

#include <string>
#include <vector>

#include "projects/store.h"

namespace ir::cli {

/// `project --results`: the kept results, one line each.
int list_results(const projects::LoadedProject& loaded, bool json);

/// `project --changes A [B]`: what changed from A to B; without B, to what the experiment of A would give
/// now.
int print_changes(const projects::LoadedProject& loaded, const std::vector<std::string>& versions, bool json);

}  // namespace ir::cli
