#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>

#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/photons/photon_list.h"
#include "shaders/methods/photon-mapping/splatting/explain.comp.h"

namespace ir::methods::photon_mapping {

/// The photons that are there to be read.
struct StoredPhotons : passes::PhotonList {
    float power_unit = 1;
};

/// Declares the pass "count photons".
StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons);

/// What kernels are tested against, at the splatting resolution.
struct SplatSurfaces {
    graph::ImageRef depth;    ///< "splat.depth": along the view axis, m, of each texel's pixel
    graph::ImageRef stencil;  ///< "splat.stencil": for the depth test
    passes::GBuffer gbuffer;
    passes::SceneBuffers scene;
    int divisor = 1;
};

/// Declares the pass "surfaces to splat on".
SplatSurfaces splat_surfaces(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                             const passes::GBuffer& gbuffer, int divisor);

/// A regular icosahedron with its vertices on the unit sphere; corners run anticlockwise seen from outside.
struct Icosahedron {
    std::array<glm::vec3, 12> vertices;
    std::array<std::uint32_t, 60> corners;
};
Icosahedron icosahedron();

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

/// The defines of photon_kernel.glsl and inside.glsl.
std::map<std::string, std::string> kernel_defines(const Kernels& kernels);

/// What added.glsl needs where each photon is reflected by itself: defines, accesses and constants. With the
/// accesses come those of inside.glsl to normals.
void define_reflection(gl::ProgramSource& source, const Kernels& kernels);
void reads_receivers(graph::PassBuilder& pass, const Kernels& kernels);
void set_reflection(const gl::Program& program, const Kernels& kernels);

/// Declares a pass that adds a value for every kernel that covers a texel.
struct KernelPass {
    std::string name, command_key;  ///< of the pass; of the buffer with the draw's command
    std::vector<graph::ImageRef> targets;
    std::map<std::string, std::string> defines = {};
    bool depth_test = true;  ///< only faster: the shader tests again
    bool has_two_bodies = false;
};
void draw_kernels(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass);

/// Declares the same sums by a gather: photons are listed by the tiles that their kernels reach, and texels
/// sum those of their tile, in the order of the photons. Half floats are rounded once for each 49,152 of
/// them. With Receiver::full photons are reflected by the surfaces of texels.  [Smal19 §6.3, §7.4]
void gather_kernels(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass);

/// Declares the same pass on the host's threads, for ellipsoids: irradiance and direction are those of the
/// device but for rounding. Half floats are rounded once, from sums in single precision.
void splat_on_host(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass);

/// Declares "splat.tiles" and the pass that counts the photons of each tile.
graph::ImageRef count_tiles(graph::GraphBuilder& builder, const StoredPhotons& photons,
                            const Parameters& parameters);

/// Declares "photons.overlay": the photons over the picture.  [Smal19 fig. 8.1a]
void draw_overlay(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const StoredPhotons& photons);

/// Declares "splat.explain.photons" and "splat.explain.sum": the photons whose kernels cover the picked
/// pixel, gathered from the whole photon buffer, and their sum against what was splatted.
void explain_pixel(graph::GraphBuilder& builder, const Kernels& kernels, Splat& splat);
/// Those photons, in a pass that reads both.
std::span<const FoundPhoton> found_photons(const graph::PassContext& context, const Splat& splat);

/// Declares "splat.kernels": the kernels of all photons.
void show_kernels(graph::GraphBuilder& builder, const Kernels& kernels);

}  // namespace ir::methods::photon_mapping
