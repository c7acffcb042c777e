#pragma once

#include <string>

#include "renderers/core/method.h"

namespace ir {

/// The whole description as one JSON object.
std::string describe_json(const MethodDescription& method);

/// The method's page of the manual, as Markdown.
std::string describe_markdown(const MethodDescription& method);

/// One parameter, output or selector of the method, as JSON and as Markdown. Throws UsageError that lists the
/// keys.
std::string describe_json(const MethodDescription& method, const std::string& key);
std::string describe_markdown(const MethodDescription& method, const std::string& key);

/// "`key` is a, b"; empty without a condition.
std::string condition_text(const Condition& condition);

}  // namespace ir
