#include "renderers/methods/ssdo/passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/equirectangular.h"

namespace ir::methods::ssdo {
namespace {

/// Mean over the solid angle of the texel (x, y), from points evenly spread in azimuth and height: as many as
/// the map has texels there.
glm::vec4 mean_radiance(const passes::EnvironmentLight& light, int x, int y, glm::ivec2 points) {
    constexpr double pi = std::numbers::pi;
    const double top = std::cos(pi * y / environment_height),
                 bottom = std::cos(pi * (y + 1) / environment_height);
    glm::dvec3 sum(0);
    for (int j = 0; j < points.y; ++j)
        for (int i = 0; i < points.x; ++i) {
            const double u = (x + (i + 0.5) / points.x) / environment_width;
            const double cosine = top + (bottom - top) * (j + 0.5) / points.y;
            sum +=
                glm::dvec3(light.radiance(passes::equirectangular_direction(static_cast<float>(u), cosine)));
        }
    return {glm::vec3(sum / static_cast<double>(points.x * points.y)), 1};
}

std::vector<glm::vec4> texels(const scene::Environment& environment, bool lit) {
    std::vector<glm::vec4> made(environment_width * environment_height, glm::vec4(0, 0, 0, 1));
    if (!lit) return made;
    const passes::EnvironmentLight light(environment);
    glm::ivec2 points(1);
    if (environment.map)
        points = {std::max(1, (environment.map->width + environment_width - 1) / environment_width),
                  std::max(1, (environment.map->height + environment_height - 1) / environment_height)};
    for (int y = 0; y < environment_height; ++y)
        for (int x = 0; x < environment_width; ++x)
            made[static_cast<std::size_t>(y * environment_width + x)] = mean_radiance(light, x, y, points);
    return made;
}

}  // namespace

graph::ImageRef environment(graph::GraphBuilder& builder, bool lit) {
    graph::ImageDesc desc;
    desc.text = {"ssdo.environment",
                 "Environment",
                 "What open directions see: means over solid angles, equirectangular.",
                 Semantic::radiance,
                 "W/(m² sr)",
                 {}};
    desc.format = gl::Format::rgba32f;
    desc.extent = graph::Extent::fixed(environment_width, environment_height);
    const auto& inputs = builder.inputs();
    if (!inputs.world_fingerprint.empty()) desc.fingerprint = inputs.world_fingerprint + (lit ? "" : " off");
    const auto image = builder.image(std::move(desc));
    builder.pass("environment").writes(image).execute([image, lit](graph::PassContext& context) {
        const auto made = texels(context.inputs().scene->environment, lit);
        context.upload(image, std::as_bytes(std::span(made)));
    });
    return image;
}

}  // namespace ir::methods::ssdo
