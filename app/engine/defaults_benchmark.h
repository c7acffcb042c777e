#pragma once

#include <vector>

#include "app/engine/benchmarks.h"

namespace ir::engine {

inline constexpr const char* defaults_name = "defaults";
inline constexpr const char* defaults_doc =
    "Every method at its defaults beside the reference: time, error, and the reference's time to the same "
    "error";

/// Every method at its defaults beside the reference that matches its transport: one table for each
/// transport, which is its `doc`. The first row is the reference at its own number of samples. Errors are
/// from a long reference with another seed and 8 times the samples; flat pixels are those of flat_pixels().
/// Of all squared errors the variance that the long reference has left is taken off. The time of the
/// reference to the same RMSE comes from its own errors at growing numbers of samples, as ms_to_error() says.
/// Of rows whose warm runs took 10 s there are no more.
///
/// Of the options `variants` are ids of methods; without a scene it is builtin:atrium, without a size
/// 400 × 300. Methods whose result is of another kind than the reference's are left out. A method that fails
/// is a row with its message. Throws UsageError for methods that there are not, InputError for a scene that
/// cannot be loaded, Cancelled, and Error where the reference fails.
std::vector<BenchmarkReport> run_defaults_benchmark(Machine& machine, const BenchmarkOptions& options,
                                                    const BenchmarkCallbacks& callbacks = {});

}  // namespace ir::engine
