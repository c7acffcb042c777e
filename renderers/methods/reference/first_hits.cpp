#include "renderers/methods/reference/passes.h"

#include <limits>

#include "renderers/core/half_float.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::reference {
namespace {

struct Images {
    graph::ImageRef position, normal, albedo;
};

/// One row of pixels.
class Row {
  public:
    Row(const graph::PassContext& context, const Images& images, graph::ObjectRef bvh,
        graph::ObjectRef surfaces)
        : width_(static_cast<std::size_t>(context.inputs().view.width)),
          eye_ws_(context.inputs().view.eye_ws),
          rays_(passes::pixel_rays(context.inputs().view)),
          bvh_(context.object<passes::Bvh>(bvh)),
          surfaces_(context.object<passes::SurfaceLookup>(surfaces)),
          positions_(context.pixels<glm::vec4>(images.position)),
          normals_(context.pixels<std::uint64_t>(images.normal)),
          albedos_(context.pixels<std::uint64_t>(images.albedo)) {}

    void fill(std::size_t y) const {
        for (std::size_t x = 0; x < width_; ++x) {
            const auto at = glm::vec2(x, y) + 0.5f;
            const auto direction =
                glm::normalize(rays_.direction + at.x * rays_.direction_dx + at.y * rays_.direction_dy);
            const auto origin = rays_.origin + at.x * rays_.origin_dx + at.y * rays_.origin_dy;
            const auto hit = bvh_->closest_hit(origin, direction, 0, std::numeric_limits<float>::infinity());
            if (hit.is_hit()) set(y * width_ + x, surfaces_->at(hit, direction));
        }
    }

  private:
    void set(std::size_t pixel, const passes::Surface& s) const {
        positions_[pixel] = glm::vec4(s.position_ws, glm::distance(s.position_ws, eye_ws_));
        normals_[pixel] = pack_halves(glm::vec4(s.shading_normal_ws, 0));
        albedos_[pixel] = pack_halves(glm::vec4(s.base_colour, s.transmission));
    }

    std::size_t width_;
    glm::vec3 eye_ws_;
    passes::PixelRays rays_;
    std::shared_ptr<passes::Bvh> bvh_;
    std::shared_ptr<passes::SurfaceLookup> surfaces_;
    std::span<glm::vec4> positions_;
    std::span<std::uint64_t> normals_, albedos_;
};

}  // namespace

graph::ImageRef first_hits(graph::GraphBuilder& builder, graph::ObjectRef bvh, graph::ObjectRef surfaces) {
    Images images;
    images.position = builder.output("gbuffer.position", {.format = gl::Format::rgba32f});
    images.normal = builder.output("gbuffer.normal", {.format = gl::Format::rgba16f});
    images.albedo = builder.output("gbuffer.albedo", {.format = gl::Format::rgba16f});
    builder.pass("first hits", graph::Queue::cpu)
        .reads(bvh, surfaces)
        .writes(images.position, images.normal, images.albedo)
        .execute_sliced(builder.inputs().view.height, [=](graph::PassContext& context, graph::Slice slice) {
            const Row row(context, images, bvh, surfaces);
            for (auto y = slice.begin; y < slice.end; ++y) row.fill(static_cast<std::size_t>(y));
        });
    const auto valid = builder.output("valid", {.format = gl::Format::r8});
    builder.pass("valid", graph::Queue::cpu).writes(valid).execute([=](graph::PassContext& context) {
        const auto pixels = context.pixels<std::uint8_t>(valid);
        std::fill(pixels.begin(), pixels.end(), std::uint8_t{255});
    });
    return valid;
}

}  // namespace ir::methods::reference
