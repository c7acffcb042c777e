// Light from infinity: directions by χ² (α = 1e-4), irradiance against closed forms.
#include "renderers/passes/lights/equirectangular.h"
#include "tests/unit/passes/light_fixture.h"

namespace ir::test {
namespace {

constexpr glm::vec3 up{0, 1, 0};

/// Dim everywhere but for a bright spot and a black band; rows are few so that sin θ varies much.
std::shared_ptr<Image> uneven_map() {
    auto map = std::make_shared<Image>(16, 8, 3, 0.5f);
    for (int c = 0; c < 3; ++c) {
        map->at(11, 1, c) = 20;
        for (int x = 0; x < 16; ++x)
            for (int y = 4; y < 7; ++y) map->at(x, y, c) = 0;
    }
    return map;
}

/// Cells of equal solid angle: x around, y by the cosine.
glm::vec2 cell_of(glm::vec3 direction) {
    return {passes::equirectangular_uv(direction).x, 0.5f - 0.5f * direction.y};
}
glm::vec3 direction_of(glm::vec2 cell) {
    return passes::equirectangular_direction(cell.x, 1.0 - 2.0 * cell.y);
}

CellTest cells_of(const passes::LightSampler& sampler, glm::vec3 normal, int n) {
    CellTest cells;
    cells.n = n;
    Uniform uniform(11);
    for (int i = 0; i < n; ++i) {
        const float choice = uniform.number();
        const auto s = sampler.sample({1, 2, 3}, normal, choice, uniform.pair());
        if (s) cells.count(cell_of(s->direction_ws));
    }
    return cells;
}

TEST(EnvironmentSampler, DirectionsFollowTheMapsDensity) {
    // n = 100,000; steps of half a degree, as the density jumps at the texels' borders.
    LightScene world;
    world.scene().environment.map = uneven_map();
    const auto& sampler = world.sampler();
    const auto density = [&](glm::vec2 p) {
        return 4 * pi * sampler.pdf_of_environment(up, direction_of(p));
    };
    // Samples of the dark parts of texels are not given out.
    const auto bright_density = [&](glm::vec2 p) {
        return sampler.environment(direction_of(p)) == glm::vec3(0) ? 0 : density(p);
    };
    auto cells = cells_of(sampler, up, 100000);
    cells.expect(bright_density, 50);
    cells.expect_fit("map");
    CellTest all;
    all.expect(density, 50);
    EXPECT_NEAR(all.integral(), 1, 2e-3);
    // Mutant: texels weighted by their light without sin θ.
    auto mutant = cells_of(sampler, up, 100000);
    const auto without = [&](glm::vec2 p) {
        const auto direction = direction_of(p);
        return bright_density(p) / std::sqrt(std::max(1 - direction.y * direction.y, 1e-6f));
    };
    mutant.expect(without, 50);
    const double scale = cells.integral() / mutant.integral();
    for (auto& e : mutant.expected) e *= scale;
    mutant.expect_misfit("without sin θ");
}

TEST(EnvironmentSampler, ConstantFollowsTheCosineOrTheSphere) {
    // n = 100,000 each. A zero normal means that there is no plane.
    LightScene world;
    world.scene().environment.constant = glm::vec3(0.5f);
    const auto& sampler = world.sampler();
    for (const glm::vec3 normal : {glm::normalize(glm::vec3(1, 2, -1)), up, -up, glm::vec3(0)}) {
        auto cells = cells_of(sampler, normal, 100000);
        cells.expect(
            [&](glm::vec2 p) { return 4 * pi * sampler.pdf_of_environment(normal, direction_of(p)); });
        cells.expect_fit("constant");
        EXPECT_NEAR(cells.integral(), 1, 2e-3);
        // Mutant: uniform on the hemisphere; without a plane, the cosine.
        auto mutant = cells_of(sampler, normal, 100000);
        mutant.expect([&](glm::vec2 p) {
            const float cosine = glm::dot(direction_of(p), normal == glm::vec3(0) ? up : normal);
            return normal == glm::vec3(0) ? 4 * std::max(cosine, 0.0f) : 2.0 * (cosine > 0);
        });
        mutant.expect_misfit("constant");
    }
}

TEST(EnvironmentSampler, ConstantSendsPiTimesItsRadiance) {
    LightScene world;
    world.scene().environment.constant = glm::vec3(0.5f);
    const auto e = irradiance(world.sampler(), {0, 0, 0}, glm::normalize(glm::vec3(1, 2, 3)), 1000);
    expect_mean(e, pi / 2);
    EXPECT_LT(e.error, 1e-5) << "sampled by the cosine, there is no noise";
}

TEST(EnvironmentSampler, MapSendsWhatItsIntegralSays) {
    // n = 200,000 against quadrature of the bilinear look-up.
    LightScene world;
    world.scene().environment.map = uneven_map();
    const auto& sampler = world.sampler();
    const auto normal = glm::normalize(glm::vec3(1, 1, 0.5f));
    double expected = 0;
    constexpr int side = 1000;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto direction = direction_of((glm::vec2(x, y) + 0.5f) / static_cast<float>(side));
            expected += sampler.environment(direction).x * std::max(glm::dot(direction, normal), 0.0f);
        }
    expected *= 4 * pi / (side * side);
    expect_mean(irradiance(sampler, {0, 0, 0}, normal, 200000), expected);
}

TEST(EnvironmentSampler, MapsLieAsTheyAreDescribed) {
    // Row 0 is +Y, column 0 is -X; somebody inside who turns to the right sees columns in order.
    const auto near = [](glm::vec2 a, glm::vec2 b) { return glm::length(a - b) < 1e-6f; };
    using passes::equirectangular_uv;
    EXPECT_NEAR(equirectangular_uv({0, 1, 0}).y, 0, 1e-6);
    EXPECT_NEAR(equirectangular_uv({0, -1, 0}).y, 1, 1e-6);
    EXPECT_TRUE(near(equirectangular_uv({0, 0, -1}), {0.25f, 0.5f}));
    EXPECT_TRUE(near(equirectangular_uv({1, 0, 0}), {0.5f, 0.5f}));
    EXPECT_TRUE(near(equirectangular_uv({0, 0, 1}), {0.75f, 0.5f}));
    EXPECT_LT(std::abs(equirectangular_uv(glm::normalize(glm::vec3(-1, 0, -1e-4f))).x), 1e-4f);
    for (const glm::vec2 uv : {glm::vec2(0.1f, 0.2f), glm::vec2(0.9f, 0.7f), glm::vec2(0.5f, 0.001f)})
        EXPECT_TRUE(
            near(equirectangular_uv(passes::equirectangular_direction(uv.x, std::cos(pi * uv.y))), uv));
    auto map = std::make_shared<Image>(4, 2, 3, 0.0f);
    map->at(1, 0, 0) = 1;
    LightScene world;
    world.scene().environment.map = map;
    const auto& sampler = world.sampler();
    const auto centre = passes::equirectangular_direction(1.5f / 4, std::cos(pi / 4));
    EXPECT_NEAR(sampler.environment(centre).x, 1, 1e-5);
    EXPECT_NEAR(sampler.environment({0, 0, -1}).x, 0.25, 1e-5) << "bilinear halfway to three texels";
}

TEST(EnvironmentSampler, DensityIsPositiveWhereverTheMapShines) {
    LightScene world;
    auto map = std::make_shared<Image>(16, 8, 3, 0.0f);
    map->at(0, 3, 1) = 100;
    map->at(5, 0, 2) = 1e-3f;  // spreads over the pole
    map->at(9, 7, 0) = -1;
    map->at(10, 7, 0) = NAN;
    map->at(11, 7, 0) = INFINITY;
    world.scene().environment.map = map;
    const auto& sampler = world.sampler();
    Uniform uniform(2);
    int bright = 0;
    for (int i = 0; i < 100000; ++i) {
        const auto u = uniform.pair();
        const auto direction = direction_of({u.x, u.y * u.y});
        const auto radiance = sampler.environment(direction);
        ASSERT_TRUE(radiance.x == 0 && radiance.y >= 0 && std::isfinite(radiance.y + radiance.z));
        if (radiance == glm::vec3(0)) continue;
        ++bright;
        ASSERT_GT(sampler.pdf_of_environment(up, direction), 0);
    }
    EXPECT_GT(bright, 1000);
}

}  // namespace
}  // namespace ir::test
