#pragma once

#include <string>

#include "renderers/core/method.h"

namespace ir {

/// The whole description as one JSON object.
std::string describe_json(const MethodDescription& method);

/// The method's page of the manual, as Markdown.
std::string describe_markdown(const MethodDescription& method);

}  // namespace ir
