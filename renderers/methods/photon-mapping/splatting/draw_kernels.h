#pragma once

#include <map>

#include "renderers/methods/photon-mapping/splatting/stored.h"
#include "renderers/methods/photon-mapping/splatting/surfaces.h"

namespace ir::methods::photon_mapping {

/// What the kernels of all photons are drawn from.
struct Kernels {
    StoredPhotons photons;
    graph::ImageRef tiles;
    SplatSurfaces surfaces;
    graph::BufferRef vertices, corners;  ///< of the icosahedron
    Parameters parameters;
};

/// Declares "splat.icosahedron.vertices" and "…corners".
Kernels declare_kernels(graph::GraphBuilder& builder, const StoredPhotons& photons, graph::ImageRef tiles,
                        const SplatSurfaces& surfaces, const Parameters& parameters);

/// The defines of inside.glsl.
std::map<std::string, std::string> kernel_defines(const Kernels& kernels);

/// Declares a pass that adds a value for every kernel that covers a texel.
struct KernelPass {
    std::string name, command_key;  ///< of the pass; of the buffer with the draw's command
    std::vector<graph::ImageRef> targets;
    std::map<std::string, std::string> defines = {};
    bool depth_test = true;  ///< only faster: the shader tests again
};
void draw_kernels(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass);

}  // namespace ir::methods::photon_mapping
