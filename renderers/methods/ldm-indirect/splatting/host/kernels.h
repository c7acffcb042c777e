#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/methods/ldm-indirect/host_math.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {

/// A footprint's kernel on the host, as struct Kernel of splatting/kernel.glsl. [Aalund15 eqs. 4-7]
struct HostKernel {
    glm::vec3 centre_ws, row_p, row_q, row_n;  ///< rows of M
    glm::vec3 peak;                            ///< added at the centre, 3 E_p, W/m²
    glm::vec3 to_source_ws;
    glm::vec3 directed;    ///< to_source times R + G + B of the peak
    float per_cosine = 0;  ///< as Kernel::per_cosine
    float distance = 0;    ///< of a beam, m; 0: it is an ellipsoid
    std::uint32_t map = 0;
    bool counts = false;  ///< else there is nothing to splat
};

/// How many footprints are not drawn as they are, as measure.comp counts them.
struct MendedFootprints {
    std::uint32_t axes_short = 0, axes_long = 0, degenerate = 0, broken = 0;
    MendedFootprints& operator+=(const MendedFootprints& other);
};

/// A footprint's ellipse: unit axes and normal, and how far it reaches along them, m.
struct HostEllipse {
    glm::vec3 p, q, n;
    float longer, shorter, height;
};

/// What splatting/ellipse.glsl does on the device. Axes come from half-angle formulas instead of arc
/// tangents.
class EllipseMaker {
  public:
    explicit EllipseMaker(const Ellipses& constants) : c_(constants) {}
    HostEllipse make(const Photon& photon, MendedFootprints& mended) const {
        return make(photon, unpacked_direction(photon.normal), mended);
    }
    /// In the plane with this normal.
    HostEllipse make(const Photon& photon, const glm::vec3& normal, MendedFootprints& mended) const;

  private:
    float pixel_at(glm::vec3 position_ws) const;
    Ellipses c_;
};

/// Makes kernels of photons; what splatting/footprint.glsl does on the device.
class KernelMaker {
  public:
    KernelMaker(const Footprints& constants, std::vector<glm::vec4> arrivals)
        : c_(constants), ellipses_(constants.ellipses), arrivals_(std::move(arrivals)) {}
    HostKernel make(const Photon& photon, MendedFootprints& mended) const;

  private:
    glm::vec3 to_source(const Photon& photon) const;
    Footprints c_;
    EllipseMaker ellipses_;
    std::vector<glm::vec4> arrivals_;
};

}  // namespace ir::methods::ldm_indirect
