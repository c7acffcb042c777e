// Where light starts: what all rays carry together, and what they make of a surface that the same light is
// sampled for from the other side.
#include "renderers/passes/lights/emission_sampler.h"

#include "renderers/core/constants.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "tests/unit/passes/light_fixture.h"

namespace ir::test {
namespace {

using passes::EmissionSampler;
using passes::EmittedLight;
using scene::LightType;

/// A floor that receives, in the plane y = 0, side 2; it gives the scene its bounds.
constexpr double floor_area = 4;
void add_floor(LightScene& scene) {
    scene.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, 0);
}

std::vector<EmittedLight> rays_of(const EmissionSampler& sampler, int n) {
    std::vector<EmittedLight> rays;
    for (int i = 0; i < n; ++i) {
        const passes::PathSampler numbers(7, static_cast<std::uint32_t>(i));
        const auto choice = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
        if (const auto ray = sampler.sample(choice, numbers.pair(0), numbers.pair(1))) rays.push_back(*ray);
    }
    return rays;
}

struct Source {
    const char* name;
    std::function<void(LightScene&)> add;
    double power;  ///< W, red
};

std::vector<Source> sources() {
    const auto light = [](const scene::Light& l) { return [l](LightScene& scene) { scene.light(l); }; };
    auto spot = make_light(LightType::spot, {0.2f, 1.5f, 0}, {0.1f, -1, 0}, {}, 3);
    spot.inner_angle = 0.2f, spot.outer_angle = 0.7f;
    const double inner = std::cos(0.2), outer = std::cos(0.7);
    return {{"point", light(make_light(LightType::point, {0.1f, 1, 0.2f}, -up, {}, 2)), 8 * pi},
            {"spot", light(spot), 3 * 2 * pi * (1 - inner + (inner - outer) / 3)},
            {"rectangle", light(make_light(LightType::rectangle, {0, 1, 0}, -up, {0.6f, 0.4f}, 5)),
             pi * 5 * 0.24},
            {"disk", light(make_light(LightType::disk, {0, 1, 0}, {0.3f, -1, 0}, {0.6f, 0.4f}, 5)),
             pi * 5 * pi * 0.06},
            {"sun", light(make_light(LightType::directional, {}, {0.2f, -1, 0}, {}, 2)),
             2 * floor_area / std::sqrt(1.04)},
            {"mesh",
             [](LightScene& scene) {
                 scene.triangle({-0.3f, 1, 0}, {0.4f, 1.2f, 0}, {0, 1, 0.7f}, scene.emitter({4, 2, 1}));
             },
             2 * pi * 4 * 0.5 * glm::length(glm::cross(glm::dvec3(0.7, 0.2, 0), glm::dvec3(0.3, 0, 0.7)))},
            {"sky",
             [](LightScene& scene) {
                 scene.scene().environment.constant = {0.5f, 0.7f, 1};
             },
             pi * 0.5 * 2 * floor_area}};
}

/// The whole power leaves, in rays that differ by nothing else.
TEST(EmissionSampler, RaysCarryThePowerOfTheirSource) {
    for (const auto& [name, add, power] : sources()) {
        LightScene scene;
        add_floor(scene);
        add(scene);
        EmissionSampler::Options options;
        for (int i = 0; i < static_cast<int>(scene.scene().lights.size()); ++i) options.lights.push_back(i);
        const EmissionSampler sampler(scene.surfaces(), options);
        ASSERT_FALSE(sampler.empty()) << name;
        const int n = 1000;
        const auto rays = rays_of(sampler, n);
        ASSERT_EQ(rays.size(), static_cast<std::size_t>(n)) << name;
        for (const auto& ray : rays) {
            ASSERT_NEAR(ray.flux.r / power, 1, 3e-3)
                << name;  // light comes in a little beside the floor, too
            ASSERT_NEAR(glm::length(ray.direction_ws), 1, 1e-5) << name;
            ASSERT_GE(glm::dot(ray.normal_ws, ray.direction_ws), 0) << name;
        }
    }
}

/// No light of what is infinitely far misses a scene that fills its bounds, and all that travels in one
/// direction is as dense.
TEST(EmissionSampler, LightFromFarComesInThroughTheBounds) {
    Image map(8, 4, 1);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = static_cast<float>(i % 3);
    const auto even = scene::Environment{glm::vec3(1), nullptr},
               uneven = scene::map_environment(std::make_shared<Image>(std::move(map)));
    for (const auto& environment : {even, uneven, scene::Environment{}}) {
        LightScene scene;
        const glm::vec3 low(1, -2, 0), high(2, 1, 5);
        const auto corner = [&](int x, int y, int z) {
            return glm::vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
        };
        for (const int side : {0, 1}) {
            scene.quad(corner(side, 0, 0), corner(side, 1, 0), corner(side, 1, 1), corner(side, 0, 1), 0);
            scene.quad(corner(0, side, 0), corner(1, side, 0), corner(1, side, 1), corner(0, side, 1), 0);
            scene.quad(corner(0, 0, side), corner(1, 0, side), corner(1, 1, side), corner(0, 1, side), 0);
        }
        const auto travel = glm::normalize(glm::vec3(1, -2, 0.5f));
        scene.light(make_light(LightType::directional, {}, travel, {}, 1));
        scene.scene().environment = environment;
        const bool is_sky = environment.map || environment.constant != glm::vec3(0);
        const auto& surfaces = scene.surfaces();
        const EmissionSampler sampler(surfaces, {.lights = is_sky ? std::vector<int>{} : std::vector{0}});
        const passes::Bvh bvh(surfaces.scene(), surfaces.world());
        const auto rays = rays_of(sampler, 4000);
        ASSERT_GT(rays.size(), 3000u);
        int missed = 0;
        std::array<int, 3> faces{};
        for (const auto& ray : rays) {
            missed += !bvh.closest_hit(ray.origin_ws, ray.direction_ws, 0, infinity).is_hit();
            for (int i = 0; i < 3; ++i)
                faces.at(i) += std::min(std::abs(ray.origin_ws[i] - low[i]),
                                        std::abs(ray.origin_ws[i] - high[i])) < 1e-2f;
            const glm::vec3 areas(15, 5, 3);
            ASSERT_NEAR(1 / ray.area_pdf / glm::dot(areas, glm::abs(ray.direction_ws)), 1, 0.01);
        }
        EXPECT_LT(missed, 20) << "beside the edges";
        if (!is_sky) {
            const glm::vec3 shares = glm::vec3(15, 5, 3) * glm::abs(travel);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(faces.at(i) / 4000.0, shares[i] / (shares.x + shares.y + shares.z), 0.03) << i;
        }
    }
}

/// Irradiance of the floor by photons against that by samples of the lights, which is the reference's.
class Received : public testing::Test {
  protected:
    /// W that the floor gets, red: of n rays with the standard error.
    static Estimate by_photons(const passes::SurfaceLookup& surfaces, const EmissionSampler::Options& options,
                               int n) {
        const EmissionSampler sampler(surfaces, options);
        const passes::Bvh bvh(surfaces.scene(), surfaces.world());
        Uniform uniform(11);
        double sum = 0, squares = 0;
        for (int i = 0; i < n; ++i) {
            const float choice = uniform.number();
            const auto place = uniform.pair();
            const auto ray = sampler.sample(choice, place, uniform.pair());
            if (!ray) continue;
            const auto hit = bvh.closest_hit(ray->origin_ws, ray->direction_ws, 0, infinity);
            const auto at = ray->origin_ws + hit.distance * ray->direction_ws;
            if (!hit.is_hit() || std::abs(at.y) > 1e-4f || ray->direction_ws.y > 0) continue;
            sum += ray->flux.r;
            squares += static_cast<double>(ray->flux.r) * ray->flux.r;
        }
        const double mean = sum / n;
        return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n)};
    }
    static Estimate by_light_samples(const passes::SurfaceLookup& surfaces, int n) {
        const passes::LightSampler sampler(surfaces);
        const passes::Bvh bvh(surfaces.scene(), surfaces.world());
        Uniform uniform(5);
        double sum = 0, squares = 0;
        for (int i = 0; i < n; ++i) {
            const auto u = 2.0f * uniform.pair() - 1.0f;
            const glm::vec3 at(u.x, 1e-5f, u.y);
            const float choice = uniform.number();
            const auto s = sampler.sample(at, up, choice, uniform.pair());
            if (!s || bvh.occluded(at, s->direction_ws, 0, s->distance * 0.9999f)) continue;
            const double value = floor_area * s->radiance.r * std::max(s->direction_ws.y, 0.0f) / s->pdf;
            sum += value;
            squares += value * value;
        }
        const double mean = sum / n;
        return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n)};
    }
    static void expect_equal(LightScene& scene, const std::string& name) {
        EmissionSampler::Options options;
        for (int i = 0; i < static_cast<int>(scene.scene().lights.size()); ++i) options.lights.push_back(i);
        const auto& surfaces = scene.surfaces();
        const auto photons = by_photons(surfaces, options, 100'000);
        const auto samples = by_light_samples(surfaces, 100'000);
        const double error = std::hypot(photons.error, samples.error);
        ASSERT_GT(samples.mean, 0) << name;
        EXPECT_NEAR(photons.mean, samples.mean, 3.891 * error + 2e-4 * samples.mean) << name;
        EXPECT_LT(error, 0.03 * samples.mean) << name;
    }
};

TEST_F(Received, IsWhatLightSamplesSay) {
    for (const auto& [name, add, power] : sources()) {
        LightScene scene;
        add_floor(scene);
        add(scene);
        expect_equal(scene, name);
    }
}

TEST_F(Received, IsTheSumOfAllSources) {
    LightScene scene;
    add_floor(scene);
    for (const auto& [name, add, power] : sources()) add(scene);
    expect_equal(scene, "all");
}

/// A map with a small sun.
TEST_F(Received, FollowsAMap) {
    Image map(32, 16, 3);
    for (auto& value : map.pixels) value = 0.1f;
    for (std::size_t c = 0; c < 3; ++c) map.pixels[map.index(9, 4) + c] = 200;
    LightScene scene;
    add_floor(scene);
    scene.quad({-0.3f, 0.5f, 0.3f}, {0.3f, 0.5f, 0.3f}, {0.3f, 0.5f, -0.3f}, {-0.3f, 0.5f, -0.3f}, 0);
    scene.scene().environment = scene::map_environment(std::make_shared<Image>(std::move(map)));
    expect_equal(scene, "map");
}

/// The sky of a large scene does not take all rays from a lamp; what these carry is right all the same.
TEST(EmissionSampler, LampsKeepTheirShareUnderASky) {
    LightScene scene;
    scene.quad({-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, -100}, 0);
    scene.light(make_light(LightType::disk, {0, 1, 0}, -up, {0.1f, 0.1f}, 1));
    scene.scene().environment.constant = {1, 1, 1};
    const EmissionSampler sampler(scene.surfaces(), {.lights = {0}});
    EXPECT_GT(sampler.power(EmissionSampler::environment), 1e6 * sampler.power(0));
    EXPECT_NEAR(sampler.power(), sampler.power(EmissionSampler::environment) + sampler.power(0), 1);
    const auto rays = rays_of(sampler, 1000);
    double lamp = 0, sky = 0;
    int from_lamp = 0;
    for (const auto& ray : rays) {
        (ray.emitter == 0 ? lamp : sky) += ray.flux.r / 1000.0;
        from_lamp += ray.emitter == 0;
    }
    EXPECT_EQ(from_lamp, 250);
    EXPECT_NEAR(lamp / sampler.power(0), 1, 1e-3);
    EXPECT_NEAR(sky / sampler.power(EmissionSampler::environment), 1, 1e-3);
}

}  // namespace
}  // namespace ir::test
