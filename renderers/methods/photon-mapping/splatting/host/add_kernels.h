#pragma once

#include <vector>

#include "renderers/methods/photon-mapping/splatting/host/kernels.h"

namespace ir::methods::photon_mapping {

/// Kernels that are added at once.
struct KernelRound {
    static constexpr std::size_t kernels = 16384;
    std::vector<HostKernel> made;
    std::vector<TexelBox> boxes;  ///< empty: no kernel
};

/// Adds kernels of the round to rows of texels, in the order of the kernels.
void add_to_rows(TexelPlanes& planes, const KernelRound& round, int first_row, int end_row);

}  // namespace ir::methods::photon_mapping
