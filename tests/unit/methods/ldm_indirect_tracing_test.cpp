#include <numbers>

#include "tests/unit/methods/ldm_indirect_tracing_fixture.h"

namespace ir::test {
namespace {

/// ∫ dω over a rectangle at distance 1 by the corners' arc tangents.
double rectangle_solid_angle(glm::dvec2 low, glm::dvec2 high) {
    const auto corner = [](double x, double y) { return std::atan2(x * y, std::sqrt(1 + x * x + y * y)); };
    return corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) + corner(low.x, low.y);
}

TEST_F(IndirectTracingTest, PixelsOfACubeCoverTheSphere) {
    auto settings = quick();
    settings["directions"] = std::int64_t{2};
    settings["emission"] = std::int64_t{64};
    const Shot shot(box({lamp({0.3f, 1.2f, -0.4f})}), camera({0, 1.5f, 1.9f}, {0, 1.5f, 0}), 16, 16);
    trace(shot, settings);
    const auto all = primaries();
    ASSERT_EQ(all.size(), 6u * 64 * 64);
    double sum = 0, worst = 0, emitted = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto x = static_cast<double>(i % 64), y = static_cast<double>(i / 64 % 64);
        const glm::dvec2 low(x / 32 - 1, y / 32 - 1);
        const double exact = rectangle_solid_angle(low, low + 1.0 / 32);
        worst = std::max(worst, std::abs(all[i].solid_angle / exact - 1));
        sum += all[i].solid_angle;
        emitted += all[i].emitted.r;
    }
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-4);
    EXPECT_LT(worst, 1e-5);
    EXPECT_NEAR(emitted, 3 * 4 * std::numbers::pi, 1e-3);
}

TEST_F(IndirectTracingTest, SpotsAndSunsEmitTheirFlux) {
    auto settings = quick();
    settings["directions"] = std::int64_t{2};
    settings["emission"] = std::int64_t{64};
    const float outer = 30;
    const Shot lit_by_spot(box({spot({0, 2.5f, 0}, {0.2f, -1, 0}, outer)}),
                           camera({0, 1.5f, 1.9f}, {0, 1, 0}), 16, 16);
    trace(lit_by_spot, settings);
    // ∫ ((c − o)/(1 − o))² 2π dc from the outer cone's cosine o to 1
    const double expected = 3 * 2 * std::numbers::pi * (1 - std::cos(glm::radians(double(outer)))) / 3;
    EXPECT_NEAR(flux(energy()[li::row_emitted]).r / expected, 1, 1e-3);

    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 2);
    const Shot lit_by_sun(with(small.scene(), {sun({0, -1, 0})}, glm::vec3(0.5f)),
                          camera({0, 2, 3}, {0, 0, 0}), 16, 16);
    trace(lit_by_sun, settings);
    const auto rows = energy();
    // irradiance × area: what arrives, and is absorbed or reflected
    const double arrived = flux(rows[li::row_emitted]).r - flux(rows[li::row_nothing]).r;
    EXPECT_NEAR(arrived / (2 * 16), 1, 0.04);  // whole texels
}

/// Of photon i's ray, moved by a part of a pixel, where it meets the plane.
struct MovedRay {
    glm::dvec3 origin, direction;
};
MovedRay moved_ray(const passes::ShadowViewData& view, double column, double row, int side) {
    const glm::dvec2 ndc((column + 0.5) / side * 2 - 1, 1 - (row + 0.5) / side * 2);
    const auto lateral = ndc.x * glm::dvec3(view.right_ws) + ndc.y * glm::dvec3(view.up_ws);
    const glm::dvec3 origin(view.origin_ws), forward(view.forward_ws);
    return view.perspective != 0 ? MovedRay{origin, glm::normalize(forward + lateral)}
                                 : MovedRay{origin + lateral, forward};
}
glm::dvec3 on_plane(const MovedRay& ray, glm::dvec3 point, glm::dvec3 normal) {
    return ray.origin +
           glm::dot(normal, point - ray.origin) / glm::dot(normal, ray.direction) * ray.direction;
}
double relative_error(glm::dvec3 found, glm::dvec3 expected) {
    return glm::length(found - expected) / std::max(glm::length(expected), 1e-9);
}
/// α v ᾱ by a quaternion, where `from` and `to` are not opposite.
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 from, glm::dvec3 to) {
    const auto axis = glm::cross(from, to);
    const double w = 1 + glm::dot(from, to), size = std::sqrt(w * w + glm::dot(axis, axis));
    const glm::dvec3 q = axis / size;
    return v + 2.0 * glm::cross(q, glm::cross(q, v) + w / size * v);
}

class DifferentialsTest : public IndirectTracingTest {
  protected:
    /// Half of the change of `place` from pixel to pixel, by central differences of a hundredth.
    template <class Place>
    static glm::dvec3 half_change(Place place, bool along_u) {
        const double step = 0.01;
        const auto at = [&](double by) { return along_u ? place(by, 0.0) : place(0.0, by); };
        return (at(step) - at(-step)) / (4 * step);
    }
};

TEST_F(DifferentialsTest, EqualTracedNeighbouringRays) {
    auto settings = quick();
    settings["footprint"] = std::string("published");
    for (const auto& light :
         {lamp({0.3f, 1.2f, -0.4f}), spot({0, 2.5f, 0}, {0.2f, -1, 0}, 50), sun({0.3f, -1, 0.2f})}) {
        const bool is_sun = light.type == scene::LightType::directional;
        const Shot shot(is_sun ? planes({light}) : box({light}), camera({0, 1.0f, 1.9f}, {0, 0.8f, 0}), 64,
                        64);
        // The sun lights the ceiling's outside; seen from there nothing arrives, so its photons end at x1.
        trace(shot, settings);
        const auto views = passes::shadow_views(shot.world, 16);
        const auto all = primaries();
        const auto rays_of = [&](std::size_t source) {
            return [&views, source](double u, double v) {
                return moved_ray(views.at(source / 256), double(source % 16) + u,
                                 double(source / 16 % 16) + v, 16);
            };
        };
        double worst = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].fate != 1) continue;
            const auto ray = rays_of(i);
            const auto place = [&](double u, double v) {
                return on_plane(ray(u, v), all[i].position_ws, all[i].normal_ws);
            };
            worst = std::max(worst, relative_error(all[i].axis_u, half_change(place, true)));
            worst = std::max(worst, relative_error(all[i].axis_v, half_change(place, false)));
        }
        EXPECT_LT(worst, 1e-3);
        if (is_sun) continue;

        const auto map_frames = frames();
        double worst_child = 0, wrong_child = 0;
        std::size_t tested = 0;
        const auto stored = photons();
        for (std::size_t k = 0; k < stored.size(); k += 7) {
            const auto& photon = stored[k];
            const auto& primary = all.at(photon.source);
            const auto d1 = glm::dvec3(primary.direction_ws), d2 = direction_of(photon, map_frames);
            const auto n2 = normal_of(photon);
            if (glm::dot(d1, d2) < -0.99 || std::abs(glm::dot(d2, n2)) < 0.05) continue;
            const auto ray = rays_of(photon.source);
            const auto end = [&](glm::dvec3 turned_from, double sign) {
                return [&, turned_from, sign](double u, double v) {
                    const auto at = ray(u, v);
                    const MovedRay second{on_plane(at, primary.position_ws, primary.normal_ws),
                                          turned(sign * at.direction, turned_from, d2)};
                    return on_plane(second, photon.centre_ws, n2);
                };
            };
            worst_child = std::max(worst_child, relative_error(photon.axis_u, half_change(end(d1, 1), true)));
            worst_child =
                std::max(worst_child, relative_error(photon.axis_v, half_change(end(d1, 1), false)));
            // from the direction to the light, as the printed α(ω_i, ω_o) may be read
            wrong_child =
                std::max(wrong_child, relative_error(photon.axis_u, half_change(end(-d1, -1), true)));
            ++tested;
        }
        EXPECT_GT(tested, 50u);
        EXPECT_LT(worst_child, 2e-3);
        EXPECT_GT(wrong_child, 0.1);
    }
}

// Half-axes h e_k, h² = 2/N, of a cone across d are seen after t m on a plane with normal n as
// a_k = t h (e_k − (e_k·n)/(d·n) d). Along q in the plane, w = q − (q·d)/(d·n) n is perpendicular to d, hence
// Σ(q·a_k)² = t² h² Σ(w·e_k)² = t² h² |w|² = t² (2/N) (1 + ((q·d)/(d·n))²).
TEST_F(IndirectTracingTest, WidenedFootprintsCoverTheRegion) {
    constexpr double directions = 32;
    auto settings = quick();
    const Shot shot(planes({spot({0, 0.5f, 0}, {0, 1, 0}, 20)}), camera({0, 1, 3.9f}, {0, 0, 0}), 64, 64);
    settings["footprint"] = std::string("widened");
    trace(shot, settings);
    const auto wide = photons();
    settings["footprint"] = std::string("published");
    trace(shot, settings);
    const auto published = photons();
    ASSERT_EQ(wide.size(), published.size());
    ASSERT_GT(wide.size(), 100u);
    const auto map_frames = frames();
    const auto all = primaries();
    double worst = 0, min_facing = 1, max_facing = 0;
    for (std::size_t i = 0; i < wide.size(); ++i) {
        const auto d = direction_of(wide[i], map_frames), n = normal_of(wide[i]);
        const double facing = std::abs(glm::dot(d, n)),
                     t = double(wide[i].path_length) - double(all.at(wide[i].source).path_length);
        for (const auto& across : {glm::dvec3(0.3, 0.5, 0.9), glm::dvec3(0.9, 0.1, -0.4)}) {
            const auto q = glm::normalize(glm::cross(n, across));
            const auto moment = [&](const li::Photon& p) {
                return std::pow(glm::dot(q, glm::dvec3(p.axis_u)), 2) +
                       std::pow(glm::dot(q, glm::dvec3(p.axis_v)), 2);
            };
            const double added = 2 / directions * t * t * (1 + std::pow(glm::dot(q, d) / facing, 2));
            worst = std::max(worst, std::abs((moment(wide[i]) - moment(published[i])) / added - 1));
        }
        EXPECT_NEAR(glm::dot(glm::dvec3(wide[i].axis_u), n), 0, 1e-3);
        min_facing = std::min(min_facing, facing);
        max_facing = std::max(max_facing, facing);
    }
    EXPECT_LT(worst, 0.01);
    EXPECT_LT(min_facing, 0.65);
    EXPECT_GT(max_facing, 0.8);
}

}  // namespace
}  // namespace ir::test
