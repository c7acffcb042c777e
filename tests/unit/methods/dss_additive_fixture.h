#pragma once

#include "renderers/methods/deep-screen-space/splatting/additive.h"
#include "tests/unit/methods/dss_fixture.h"

namespace ir::test {

/// Form factor from a point, its surface facing up, to a horizontal rectangle above it that spans [x0, x1] ×
/// [z0, z1] relative to the point at height h: corner by corner. [Howell10]
inline double rectangle_form_factor(double x0, double x1, double z0, double z1, double h) {
    const auto corner = [&](double x, double z) {
        const double a = x / h, b = z / h, p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
        return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * 3.14159265358979);
    };
    return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

/// What a run differs in.
struct AdditiveRun {
    std::vector<Disc> surfels;
    dss::Parameters parameters = plain();
    std::uint64_t seed = 0;

    /// One level, no blur, all surfels reach 100 m.
    static dss::Parameters plain() {
        auto p = published();
        p.visibility = false;
        p.levels = 1;
        p.transport.max_distance = 100;
        p.influence = dss::Influence::constant;
        p.reconstruction.blur.blur = false;
        return p;
    }
};

class AdditiveTest : public DeepScreenSpaceTest {
  protected:
    FrameReport splat(const Shot& shot, const AdditiveRun& run) {
        auto inputs = shot.inputs();
        inputs.seed = run.seed;
        return PassTest::run(inputs, [=](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto hierarchy = dss::shuffle(builder, gbuffer, run.parameters);
            dss::splat_additive(builder, scene, gbuffer,
                                passes::shadow_maps(builder, scene, 256, Transport::Materials::lambert),
                                hierarchy, upload(builder, run.surfels), run.parameters,
                                {"result", "Result"});
        });
    }

    /// A floor of 8 m around the origin, facing up, from straight above.
    static Shot floor(int size = 32, bool orthographic = true) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 4);
        return {small.scene(), dss_camera({0, 3, 0}, {0, 0, 0}, orthographic, 2), size, size};
    }

    /// Form factor of the square of half side `half` at this height over the origin at a pixel.
    double expected_at(int x, int y, double half, double height) const {
        const auto at = rgb(read("gbuffer.position"), x, y);
        return rectangle_form_factor(-half - at.x, half - at.x, -half - at.z, half - at.z, height);
    }
};

/// A square above the floor's origin, facing it, as n × n discs.
inline std::vector<Disc> square_above(float height, float half, int n, glm::vec3 radiance = glm::vec3(1)) {
    return discs_of_square({0, height, 0}, {1, 0, 0}, {0, 0, 1}, half, n, radiance);
}

}  // namespace ir::test
