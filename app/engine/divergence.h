#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/engine/execution.h"

namespace ir::engine {

/// What counts as the same number on two machines.
struct SameWithin {
    double relative = 2e-3;  ///< two steps of a half float, which processors round in their own ways
    double absolute = 2e-5;  ///< more than a step of 16 bits that stand for 0 to 1
    double share = 1e-3;     ///< of a buffer's values that may differ by more: edges that rays meet or miss
};

/// How a buffer differs between two machines.
struct BufferDivergence {
    std::string key;   ///< of the resource, with its level or layer
    std::string pass;  ///< that writes it first
    std::size_t values = 0, differing = 0;
    double largest = 0;   ///< difference
    std::string problem;  ///< one line: why nothing is compared, or what is to be known of it
    bool diverges = false;
    /// There is nothing to say of it; an empty one of both is the same, too.
    bool is_same() const { return largest == 0 && problem.empty(); }
};

/// An experiment on two machines.
struct Divergence {
    std::string a, b;  ///< backend, device and processor
    /// In the order in which the passes of A write them; what only one machine makes has a problem.
    std::vector<BufferDivergence> buffers;
    /// Of the first that diverges, else of the main result: the largest difference of each pixel over its
    /// channels. Empty where that is a list, or both have other sizes.
    Image where = {};
    std::string where_key = {};
    /// Null: none diverges.
    const BufferDivergence* first() const;
};

/// Runs all frames on one machine after the other, with all buffers, and compares them. `begun` is told
/// which machine begins. Throws as run_frames(), and Error where a machine cannot be made.
Divergence find_divergence(const Experiment& experiment, const MachineOptions& a, const MachineOptions& b,
                           const graph::FrameOptions& options, const SameWithin& same = {},
                           const std::function<void(const std::string& name)>& begun = {});

/// The machine that a name means (projects/analyses.h), with all else of `options`. Throws UsageError.
MachineOptions machine_called(const std::string& name, MachineOptions options);

/// One buffer; channels are values of equal weight. The elements of a list may stand in any order, which
/// atomics decide on a device: then each channel is compared by itself, and a problem says so.
BufferDivergence compare_buffers(const ImageLayer& a, const ImageLayer& b, bool is_list,
                                 const SameWithin& same);

}  // namespace ir::engine
