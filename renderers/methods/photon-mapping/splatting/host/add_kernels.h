#pragma once

#include <vector>

#include "renderers/methods/photon-mapping/splatting/host/kernels.h"

namespace ir::methods::photon_mapping {

/// Planes of floats, texel by texel; rows are padded so that vectors may be read beyond their ends.
struct TexelPlanes {
    static constexpr int padding = 16;
    int width = 0, height = 0, stride = 0;
    std::vector<float> position[3];  ///< world space, m; far beyond every kernel where there is nothing
    std::vector<float> normal[3];    ///< geometric; where kernels test it
    std::vector<float> sums[6];      ///< as HostKernel::added

    void resize(int w, int h, bool has_normals);
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x);
    }
};

/// Kernels that are added at once.
struct KernelRound {
    static constexpr std::size_t kernels = 16384;
    std::vector<HostKernel> made;
    std::vector<TexelBox> boxes;  ///< empty: no kernel
};

/// Adds kernels of the round to rows of texels, in the order of the kernels.
void add_to_rows(TexelPlanes& planes, const KernelRound& round, int first_row, int end_row);

}  // namespace ir::methods::photon_mapping
