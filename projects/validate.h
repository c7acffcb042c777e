#pragma once

#include "projects/document.h"

namespace ir::projects {

/// Throw UsageError (one line) for an item that could be written but not be read again, or that makes no
/// sense. References to other items are not looked at.
void validate(const Scene& scene);
void validate(const Camera& camera);
void validate(const LightSet& lights);
void validate(const Motion& motion);
void validate(const ForeignImage& image);
void validate(const Experiment& experiment);
void validate(const Comparison& comparison);
void validate(const Sweep& sweep);
void validate(const ErrorPlot& plot);
void validate(const Analysis& analysis);

}  // namespace ir::projects
