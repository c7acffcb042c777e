#pragma once

#include <string>

#include "renderers/core/error.h"

namespace ir::cli {

/// One line on standard error, whatever line breaks the paths in it hold.
void complain(const std::string& line);

/// Of what fails and keeps nothing else from being done.
int status_of(const Error& error);

}  // namespace ir::cli
