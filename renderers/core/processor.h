#pragma once

#include <optional>
#include <string>

namespace ir {

/// Which of their two bodies passes run that have two: GLSL on the OpenGL device, or C++ on the host's
/// threads and vector units. Both give the same picture within a tolerance that the method's page states.
enum class Processor { gl, host };

/// "gl" or "host".
std::string to_string(Processor processor);
/// None for "auto" and for an empty text. Throws UsageError.
std::optional<Processor> parse_processor(const std::string& text);

}  // namespace ir
