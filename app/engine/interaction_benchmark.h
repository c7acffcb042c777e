#pragma once

#include "app/engine/benchmarks.h"

namespace ir::engine {

inline constexpr const char* interaction_name = "interaction";
inline constexpr const char* interaction_doc =
    "What a hand feels with each method: time to the first pictures, and pictures a second while the camera "
    "turns";

/// Every method at its defaults on a render thread of its own, as the window uses it: times from the first
/// request, once the scene is loaded, to the preview, to the first coarse and to the full picture; then a
/// hand that turns the camera for some seconds, a new place every 16 ms, and the pictures that follow it.
///
/// Of the options `variants` are ids of methods; without a scene it is builtin:atrium, without a size
/// 800 × 600. A method that fails is a row with its message. Throws UsageError for methods that there are
/// not, InputError for a scene that cannot be loaded, Cancelled, and Error without a device.
BenchmarkReport run_interaction_benchmark(const MachineOptions& machine, const BenchmarkOptions& options,
                                          const BenchmarkCallbacks& callbacks = {});

}  // namespace ir::engine
