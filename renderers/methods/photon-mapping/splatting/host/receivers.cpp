#include "renderers/methods/photon-mapping/splatting/host/receivers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderers/core/parallel_for.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/passes/gbuffer/gbuffer_surfaces.h"
#include "renderers/passes/reflection/reflection.h"
#include "renderers/passes/scattering/microfacets.h"
#include "shaders/methods/photon-mapping/splatting/added.glsl.h"
#include "shaders/passes/reflection/receiver.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

/// As in shading_normal.glsl.
float directional_factor(float max_stretch, glm::vec3 direction, glm::vec3 shading_n, glm::vec3 geometric_n) {
    const float mapped = glm::dot(direction, shading_n), plain = glm::dot(direction, geometric_n);
    const float inverse = plain * max_stretch > 1 ? 1 / plain : max_stretch;
    return std::max(1 + (mapped - plain) * inverse, 0.0f);
}

/// inside_ellipsoid of kernel.glsl.
bool covers(const HostKernel& k, const TexelPlanes& planes, std::size_t at) {
    const auto d =
        glm::vec3(planes.position[0][at], planes.position[1][at], planes.position[2][at]) - k.centre_ws;
    const glm::vec3 point_ks(glm::dot(d, k.row_u), glm::dot(d, k.row_t), glm::dot(d, k.row_n));
    return glm::dot(point_ks, point_ks) <= 1;
}

}  // namespace

TexelReceivers::TexelReceivers(const graph::PassContext& p, const Kernels& kernels)
    : facing_test_(kernels.parameters.facing_test),
      directional_(kernels.parameters.receivers.directional),
      is_layered_(kernels.parameters.transport.materials == Transport::Materials::gltf),
      max_stretch_(kernels.parameters.max_stretch) {
    const auto& inputs = p.inputs();
    const auto rules = kernel_rules(inputs, kernels.parameters, kernels.photons.power_unit);
    const auto& view = rules.view;
    const auto size = texels_of(inputs.view, view.divisor);
    const float least_alpha = std::max(least_photon_alpha * rules.shrinking, passes::mirror_alpha);
    const passes::GBufferSurfaces surfaces(p, kernels.surfaces.gbuffer);
    const auto& materials = inputs.scene->materials;
    width_ = size.x;
    receivers_.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    parallel_for(inputs.threads, 0, size.y, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < size.x; ++x) {
            const auto pixel = view.divisor * glm::ivec2(x, y) + view.pixel_of_texel;
            if (pixel.x >= inputs.view.width || pixel.y >= inputs.view.height) continue;
            const auto i = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(inputs.view.width) +
                           static_cast<std::size_t>(pixel.x);
            if (surfaces.is_background(i)) continue;
            const auto s = surfaces.at(i);
            const auto v =
                view.perspective ? glm::normalize(view.eye_ws - s.position_ws) : -view.view_axis_ws;
            const float ior = materials[static_cast<std::size_t>(s.material)].ior;
            receivers_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x)] = receiver_at(s, ior, v, least_alpha);
        }
    });
}

void TexelReceivers::declare_reads(graph::PassBuilder& pass, const Kernels& kernels) {
    passes::GBufferSurfaces::declare_reads(pass, kernels.surfaces.gbuffer);
}

TexelReceiver TexelReceivers::receiver_at(const passes::Surface& s, float ior, glm::vec3 v,
                                          float least_alpha) const {
    TexelReceiver r{};
    r.n = s.shading_normal_ws, r.geometric_n = s.geometric_normal_ws, r.v = v;
    r.f0 = is_layered_ ? passes::layered_f0(ior, s.base_colour, s.metallic) : s.base_colour;
    r.n_dot_v = std::max(glm::dot(r.n, v), passes::min_view_cosine);
    r.alpha = std::max(s.roughness * s.roughness, least_alpha);
    r.part = (1 - s.transmission * (1 - s.metallic)) * (is_layered_ ? 1 : s.metallic);
    const auto albedo =
        passes::directional_albedo(r.f0, s.roughness, std::clamp(glm::dot(r.n, v), 0.05f, 1.0f));
    r.scale = glm::max(r.part * albedo, glm::vec3(passes::least_highlight_scale));
    return r;
}

TexelReceivers::Added TexelReceivers::added_by(const HostKernel& kernel, const TexelReceiver& r) const {
    const auto& l = kernel.to_light_ws;
    glm::vec3 irradiance(kernel.added[0], kernel.added[1], kernel.added[2]);
    if (directional_) irradiance *= directional_factor(max_stretch_, l, r.n, r.geometric_n);
    const auto h = passes::half_vector(r.n, l, r.v);
    const auto fresnel = passes::schlick_fresnel(r.f0, std::clamp(glm::dot(r.v, h), 0.0f, 1.0f));
    Added added{is_layered_ ? irradiance * (1.0f - fresnel) : irradiance, glm::vec3(0)};
    const float n_dot_l = glm::dot(r.n, l);
    if (!(n_dot_l > 0)) return added;
    const float masking = is_layered_ ? passes::smith_visibility(n_dot_l, r.n_dot_v, r.alpha)
                                      : passes::smith_masking_over_2_cosine(n_dot_l, r.alpha) *
                                            passes::smith_masking_over_2_cosine(r.n_dot_v, r.alpha);
    const float microfacets =
        passes::ggx_distribution(std::clamp(glm::dot(r.n, h), 0.0f, 1.0f), r.alpha) * masking;
    added.reflected = r.part * microfacets * fresnel / r.scale * irradiance;
    return added;
}

void TexelReceivers::add_to_rows(TexelPlanes& planes, const KernelRound& round, int first_row,
                                 int end_row) const {
    for (std::size_t i = 0; i < round.boxes.size(); ++i) {
        const auto& box = round.boxes[i];
        const auto& kernel = round.made[i];
        for (int y = std::max(box.first_y, first_row); y < std::min(box.end_y, end_row); ++y)
            for (int x = box.first_x; x < box.end_x; ++x) {
                const auto at = planes.place(x, y);
                if (!covers(kernel, planes, at)) continue;
                const auto& r = receivers_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                           static_cast<std::size_t>(x)];
                if (facing_test_ && !(glm::dot(r.geometric_n, kernel.to_light_ws) > 0)) continue;
                const auto added = added_by(kernel, r);
                for (int c = 0; c < 3; ++c) {
                    planes.sums[c][at] += added.irradiance[c];
                    planes.sums[c + 3][at] += added.reflected[c];
                }
            }
    }
}

}  // namespace ir::methods::photon_mapping
