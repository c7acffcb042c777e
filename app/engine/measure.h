#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "app/engine/study_reference.h"
#include "projects/object_reader.h"

namespace ir::engine {

/// How far a picture is from its reference.
struct Measured {
    std::map<std::string, double> errors;  ///< by metric: all that apply
    std::size_t pixels = 0, skipped = 0;
};

/// What the last frame of an execution left, whose context is current, against the reference. Throws
/// UsageError where no metric applies, and Cancelled.
Measured measure(const Execution& execution, const StudyReference& reference, const CancelToken* cancel);

/// Members "errors", by metric, and "reasons" of those that are not finite.
void put_errors(projects::Json& json, const std::map<std::string, double>& errors, std::size_t pixels);
/// Back; absent: none. Throws InputError.
std::map<std::string, double> read_errors(projects::ObjectReader& reader);

}  // namespace ir::engine
