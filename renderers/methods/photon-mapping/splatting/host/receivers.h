#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/methods/photon-mapping/splatting/host/add_kernels.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::photon_mapping {

/// What texels show, as receiver.glsl has it.
struct TexelReceiver {
    glm::vec3 n, geometric_n, v;
    glm::vec3 f0, scale;  ///< scale: what is reflected is divided by it
    float n_dot_v, alpha;
    float part;  ///< of the interface: what is opaque, and with the blended model metallic
};

/// Reflects photons by what texels show; what added.glsl does on the device.
class TexelReceivers {
  public:
    /// For a pass that declare_reads() was called for.
    TexelReceivers(const graph::PassContext& p, const Kernels& kernels);
    static void declare_reads(graph::PassBuilder& pass, const Kernels& kernels);

    /// As add_to_rows(), with the whole BRDF of each photon.
    void add_to_rows(TexelPlanes& planes, const KernelRound& round, int first_row, int end_row) const;

  private:
    struct Added {
        glm::vec3 irradiance, reflected;
    };
    Added added_by(const HostKernel& kernel, const TexelReceiver& r) const;
    TexelReceiver receiver_at(const passes::Surface& surface, float ior, glm::vec3 v,
                              float least_alpha) const;

    int width_;
    bool facing_test_, directional_, is_layered_;
    float max_stretch_;
    std::vector<TexelReceiver> receivers_;  ///< row by row
};

}  // namespace ir::methods::photon_mapping
