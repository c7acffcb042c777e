#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/splatting/additive.h"
#include "renderers/methods/deep-screen-space/surfels/steps.h"
#include "renderers/passes/sampling/pcg.h"
#include "tests/unit/methods/dss_published.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace dss = methods::deep_screen_space;
using passes::pcg4d;

/// A surfel and what it sends, as two buffers hold them.
struct Disc : dss::Surfel {
    glm::vec3 radiance_front, radiance_back;
};

/// A disc that sends `radiance` to both sides.
inline Disc disc(glm::vec3 centre, glm::vec3 normal, float radius, std::uint32_t identity = 0,
                 glm::vec3 radiance = glm::vec3(1)) {
    Disc surfel{};
    surfel.centre_ws = centre;
    surfel.normal_ws = glm::normalize(normal);
    surfel.radius = radius;
    surfel.identity = pcg4d({identity, 1, 2, 3}).x;
    surfel.radiance_front = surfel.radiance_back = radiance;
    return surfel;
}

/// A square of half side `half` as n × n discs, each in the middle of its cell and of the cell's area.
inline std::vector<Disc> discs_of_square(glm::vec3 centre, glm::vec3 u, glm::vec3 v, float half, int n,
                                         glm::vec3 radiance = glm::vec3(1)) {
    std::vector<Disc> surfels;
    const float cell = 2 * half / static_cast<float>(n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto at = centre + ((static_cast<float>(x) + 0.5f) * cell - half) * u +
                            ((static_cast<float>(y) + 0.5f) * cell - half) * v;
            surfels.push_back(disc(at, glm::cross(u, v), cell / std::sqrt(3.14159265f),
                                   static_cast<std::uint32_t>(surfels.size()), radiance));
        }
    return surfels;
}

class DeepScreenSpaceTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override {
        return joined({dss::hierarchy_outputs(), dss::splat_outputs(), dss::additive_outputs()});
    }
    /// Declares surfels with these contents. `capacity`: 0: as many as there are; `uncounted` is added to the
    /// counter: surfels that found no place.
    static dss::Surfels upload(graph::GraphBuilder& builder, const std::vector<Disc>& discs,
                               std::uint64_t capacity = 0, std::uint32_t uncounted = 0) {
        graph::BufferDesc desc;
        desc.text = {.key = "surfels", .label = "Surfels"};
        desc.kind = OutputKind::glyphs;
        desc.fields = record_fields<dss::Surfel>();
        desc.elements = capacity ? capacity : std::max<std::size_t>(1, discs.size());
        const auto elements = desc.elements;
        const dss::Growing records{builder.buffer(std::move(desc)),
                                   builder.counter({.key = "surfels.count", .label = "Surfels"})};
        const auto lights = builder.buffer({.text = {.key = "surfels.lights", .label = "Light of surfels"},
                                            .fields = record_fields<dss::SurfelLight>(),
                                            .elements = elements});
        builder.pass("upload surfels")
            .writes(records.buffer, lights)
            .counts("Counter", records.count)
            .execute([=](graph::PassContext& p) {
                const auto there = std::min<std::size_t>(discs.size(), p.capacity(records.buffer));
                std::vector<dss::Surfel> geometry(discs.begin(),
                                                  discs.begin() + static_cast<std::ptrdiff_t>(there));
                std::vector<dss::SurfelLight> light;
                for (const auto& d : std::span(discs).first(there))
                    light.push_back({{d.radiance_front.x, d.radiance_front.y, d.radiance_front.z},
                                     {d.radiance_back.x, d.radiance_back.y, d.radiance_back.z}});
                p.upload(records.buffer, std::as_bytes(std::span(geometry)));
                p.upload(lights, std::as_bytes(std::span(light)));
                const auto count = static_cast<std::uint32_t>(discs.size()) + uncounted;
                add_to_counter(p, count);
            });
        auto surfels = dss::count_stored(builder, records, {});
        surfels.lights = lights;
        return surfels;
    }
};

inline scene::Camera dss_camera(glm::vec3 eye, glm::vec3 target, bool orthographic = false,
                                float height = 4) {
    return looking_at(eye, target, orthographic, height, {0, 0, -1});
}

}  // namespace ir::test
