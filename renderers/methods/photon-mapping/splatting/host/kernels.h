#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {

/// Texels of a picture, ends excluded.
struct TexelBox {
    std::int32_t first_x = 0, end_x = 0, first_y = 0, end_y = 0;
    bool is_empty() const { return first_x >= end_x || first_y >= end_y; }
};

/// Planes of floats, texel by texel; rows are padded so that vectors may be read beyond their ends.
struct TexelPlanes {
    static constexpr int padding = 16;
    static constexpr float nowhere = 1e18f;
    int width = 0, height = 0, stride = 0;
    std::vector<float> position[3];  ///< world space, m; `nowhere` where there is no surface
    std::vector<float> normal[3];    ///< geometric; where kernels test it
    std::vector<float> sums[6];      ///< as HostKernel::added

    void resize(int w, int h, bool has_normals);
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x);
    }
};

/// A photon's kernel on the host, as struct Kernel of photon_kernel.glsl.
struct HostKernel {
    glm::vec3 centre_ws;
    glm::vec3 row_u, row_t, row_n;  ///< unit axes over their half-axes: into kernel space
    glm::vec3 to_light_ws;
    float added[6];  ///< to what it covers: irradiance, W/m², and that times the direction
};

/// Makes kernels of photons; what photon_kernel.glsl does on the device.
class KernelMaker {
  public:
    /// `photons_by_tile`: the texels of "splat.tiles", of which there are `columns` a row.
    /// With `probed` it looks where kernels hang over edges.
    KernelMaker(const KernelRules& rules, std::span<const std::uint32_t> photons_by_tile, int columns,
                const TexelPlanes* probed);
    /// Nothing of photons that light no texel. `box` is where its texels lie.
    std::optional<HostKernel> make(const Photon& photon, TexelBox& box) const;

  private:
    float radius(const Photon& photon, glm::vec3 n) const;
    float photons_of_tile(glm::vec3 position_ws) const;
    bool faces_viewer(glm::vec3 position_ws, glm::vec3 normal_ws) const;
    bool finds_surface(const HostKernel& kernel, glm::vec3 n, glm::vec3 place_ws, float half_thickness,
                       float longest) const;
    float covered_part(const HostKernel& kernel, const glm::mat3& half_axes, glm::vec3 n) const;
    /// Where an ellipsoid with these half-axes is seen.
    TexelBox box_of(glm::vec3 centre_ws, const glm::mat3& half_axes) const;

    KernelRules r_;
    std::span<const std::uint32_t> tiles_;
    int columns_, rows_;
    const TexelPlanes* probed_;
    glm::vec4 texel_x_, texel_y_, texel_w_;  ///< rows of the matrix to homogeneous texels
};

}  // namespace ir::methods::photon_mapping
