#pragma once

#include <cmath>
#include <numbers>

#include "renderers/passes/bounce/reconstruction.h"
#include "renderers/passes/scattering/bsdf.h"
#include "renderers/scene/frame.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace bounce = passes::bounce;

/// Standard normal beyond which lies 1e-4 on both sides together, and on one side.
inline constexpr double two_sided = 3.891, one_sided = 3.719;

/// χ² that is exceeded with probability 1e-4.  [Wilson31]
inline double chi_square_limit(int degrees) {
    const double part = 2.0 / (9 * degrees);
    return degrees * std::pow(1 - part + one_sided * std::sqrt(part), 3);
}

/// One large square of one material that fills an orthographic picture, so that all pixels see the same
/// surface under the same angle.
struct Wall {
    SmallWorld small;
    scene::Scene scene;
    glm::vec3 normal;
    glm::vec3 towards_eye;  ///< unit

    explicit Wall(glm::vec3 n = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f)),
                  glm::vec3 eye = glm::normalize(glm::vec3(-0.2f, 0.9f, 0.7f)))
        : normal(n), towards_eye(eye) {
        small.square({0, 0, 0}, n, 50);
        scene = small.scene();
    }
    scene::Material& material() { return scene.materials[SmallWorld::opaque]; }
    Shot shot(int width, int height) const {
        scene::Camera camera;
        camera.eye = 5.0f * towards_eye;
        camera.target = {0, 0, 0};
        camera.up = {0, 0, 1};
        camera.orthographic = true;
        camera.height = 1;
        return {scene, camera, width, height};
    }
    /// The scattering of the whole wall as light transport on the host knows it; the least roughness applied.
    passes::Bsdf bsdf(Transport::Materials model, float least_roughness = 0) const {
        const auto& m = scene.materials[SmallWorld::opaque];
        passes::Surface surface;
        surface.geometric_normal_ws = surface.shading_normal_ws = normal;
        surface.base_colour = glm::vec3(m.base_colour);
        surface.metallic = m.metallic;
        surface.roughness = std::max(m.roughness, least_roughness);
        return {surface, m, model};
    }
};

class BounceTest : public PassTest {
  protected:
    /// Only G-buffer and directions.
    void choose_directions(const Shot& shot, const bounce::DirectionOptions& options, std::uint64_t seed = 0,
                           int frame = 0) {
        auto inputs = shot.inputs();
        inputs.seed = seed;
        inputs.frame = frame;
        run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            bounce::directions(builder, scene, passes::gbuffer(builder, scene), options);
        });
    }
    std::vector<glm::vec4> all_directions(int samples) const {
        std::vector<glm::vec4> result;
        for (int layer = 0; layer < samples; ++layer) {
            const auto image = read("bounce.directions", layer);
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x)
                    result.emplace_back(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2),
                                        image.at(x, y, 3));
        }
        return result;
    }
};

}  // namespace ir::test
