// Directions and densities of rectangles, disks and triangles. Each χ² test states n; α = 1e-4.
#include "renderers/passes/raytracing/bvh.h"
#include "tests/unit/passes/light_fixture.h"

namespace ir::test {
namespace {

using passes::LightSampler;
using scene::LightType;

/// A flat light with points numbered by the unit square, equal areas for equal areas.
struct Shape {
    std::function<glm::vec3(glm::vec2)> point;
    std::function<glm::vec2(glm::vec3)> number;
    double area = 0;
    glm::vec3 normal{0};
};

/// A rectangle in the plane y = 2 with sides along x and z.
Shape rectangle_shape(glm::vec2 size) {
    return {[=](glm::vec2 p) { return glm::vec3((p.x - 0.5f) * size.x, 2, (p.y - 0.5f) * size.y); },
            [=](glm::vec3 w) { return glm::vec2(w.x / size.x + 0.5f, w.z / size.y + 0.5f); }, size.x * size.y,
            -up};
}

Shape disk_shape(glm::vec2 size) {
    return {[=](glm::vec2 p) {
                const double angle = 2 * pi * p.y;
                return glm::vec3(0.5 * size.x * std::sqrt(p.x) * std::cos(angle), 2,
                                 0.5 * size.y * std::sqrt(p.x) * std::sin(angle));
            },
            [=](glm::vec3 w) {
                const glm::dvec2 unit(2 * w.x / size.x, 2 * w.z / size.y);
                const double turn = std::atan2(unit.y, unit.x) / (2 * pi);
                return glm::vec2(glm::dot(unit, unit), turn - std::floor(turn));
            },
            pi / 4 * size.x * size.y, -up};
}

Shape triangle_shape(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::mat3 edges(b - a, c - a, glm::cross(b - a, c - a));
    return {[=](glm::vec2 p) {
                const float root = std::sqrt(p.x);
                return a + root * (1 - p.y) * (b - a) + root * p.y * (c - a);
            },
            [=](glm::vec3 w) {
                const auto weights = glm::inverse(edges) * (w - a);
                const float sum = weights.x + weights.y;
                return glm::clamp(glm::vec2(sum * sum, weights.y / sum), 0.0f, 1.0f);
            },
            0.5 * glm::length(edges[2]), glm::normalize(edges[2])};
}

using Density = std::function<float(glm::vec3 direction_ws, const glm::vec3& at)>;

CellTest cells_of(const LightSampler& sampler, const Shape& shape, glm::vec3 from, const Density& density,
                  int n) {
    CellTest cells;
    cells.n = n;
    Uniform uniform(7);
    for (int i = 0; i < n; ++i) {
        const float choice = uniform.number();
        const auto s = sampler.sample(from, up, choice, uniform.pair());
        if (s) cells.count(shape.number(from + s->distance * s->direction_ws));
    }
    cells.expect([&](glm::vec2 p) {
        const auto at = shape.point(p);
        const glm::dvec3 offset = glm::dvec3(at) - glm::dvec3(from);
        const double distance = glm::length(offset);
        const double cosine = std::abs(glm::dot(offset, glm::dvec3(shape.normal))) / distance;
        return density(glm::vec3(offset / distance), at) * cosine / (distance * distance) * shape.area;
    });
    return cells;
}

Density density_of_light(const LightSampler& sampler, glm::vec3 from) {
    return [&sampler, from](glm::vec3 direction_ws, const glm::vec3& at) {
        passes::LightHit hit;
        hit.light = 0;
        hit.distance = glm::length(at - from);
        return sampler.pdf_of_light(from, up, direction_ws, hit);
    };
}

class FlatLights : public testing::TestWithParam<glm::vec3> {};

TEST_P(FlatLights, DirectionsFollowTheDensity) {
    const glm::vec2 size(3, 1);
    for (const auto type : {LightType::rectangle, LightType::disk}) {
        LightScene world;
        world.light(make_light(type, {0, 2, 0}, -up, size));
        const auto& sampler = world.sampler();
        const bool is_disk = type == LightType::disk;
        const auto cells = cells_of(sampler, is_disk ? disk_shape(size) : rectangle_shape(size), GetParam(),
                                    density_of_light(sampler, GetParam()), 50000);
        cells.expect_fit(is_disk ? "disk" : "rectangle");
        EXPECT_NEAR(cells.integral(), 1, 2e-3) << is_disk;
    }
}

TEST_P(FlatLights, DensityWithoutTheCosineIsRejected) {
    const glm::vec2 size(3, 1);
    LightScene world;
    world.light(make_light(LightType::disk, {0, 2, 0}, -up, size));
    const auto& sampler = world.sampler();
    const auto shape = disk_shape(size);
    // Mutant: distance² / area.
    const Density mutant = [&](glm::vec3, const glm::vec3& at) {
        const auto offset = at - GetParam();
        return static_cast<float>(glm::dot(offset, offset) / shape.area);
    };
    cells_of(sampler, shape, GetParam(), mutant, 50000).expect_misfit("disk without cosine");
}

TEST_P(FlatLights, TriangleDirectionsFollowTheDensity) {
    const glm::vec3 a(-1, 2, -1), b(1.5f, 2.5f, -0.5f), c(0, 1.5f, 1);
    LightScene world;
    world.triangle(a, b, c, world.emitter(glm::vec3(2)));
    const auto& sampler = world.sampler();
    const auto shape = triangle_shape(a, b, c);
    const Density density = [&](glm::vec3, const glm::vec3& at) {
        const auto weights = glm::inverse(glm::mat3(b - a, c - a, shape.normal)) * (at - a);
        passes::Hit hit;
        hit.u = weights.x, hit.v = weights.y;
        hit.distance = glm::length(at - GetParam());
        return sampler.pdf_of_triangle(GetParam(), up, hit);
    };
    const auto cells = cells_of(sampler, shape, GetParam(), density, 50000);
    cells.expect_fit("triangle");
    EXPECT_NEAR(cells.integral(), 1, 2e-3);
    // Mutant: the distance counts linearly.
    const Density mutant = [&](glm::vec3 direction_ws, const glm::vec3& at) {
        return density(direction_ws, at) / glm::length(at - GetParam());
    };
    cells_of(sampler, shape, GetParam(), mutant, 50000).expect_misfit("distance³");
}

// Near one corner, far away, and at a grazing angle.
INSTANTIATE_TEST_SUITE_P(Places, FlatLights,
                         testing::Values(glm::vec3(1.2f, 1.2f, 0.3f), glm::vec3(2, -9, 4),
                                         glm::vec3(-3, 1.6f, 0.5f)));

/// A scene with one of everything that has an extent, and a point light.
void fill_mixed(LightScene& world) {
    world.light(make_light(LightType::rectangle, {0, 3, 0}, {0.3f, -1, 0}, {2, 1}, 3));
    world.light(make_light(LightType::point, {2, 1, 1}, -up, {1, 1}, 2));
    world.light(make_light(LightType::disk, {-2, 2, 0}, {1, -0.5f, 0.2f}, {1, 1}, 4));
    const int glow = world.emitter({1, 2, 3});
    world.quad({1, 0.5f, -1}, {2, 0.5f, -1}, {2, 1.5f, -2}, {1, 1.5f, -2}, glow);
    world.triangle({-1, 1, 2}, {-1, 2, 2}, {0, 1, 2.5f}, world.emitter({5, 0, 0}));
    world.quad({-4, -1, 4}, {4, -1, 4}, {4, -1, -4}, {-4, -1, -4}, 0);
    world.scene().environment.constant = glm::vec3(0.2f);
}

/// Density for what a ray in the sample's direction meets at the sample's distance.
float density_again(const LightSampler& sampler, const passes::Bvh& bvh, glm::vec3 from, glm::vec3 normal,
                    const passes::LightSample& s) {
    if (std::isinf(s.distance)) return sampler.pdf_of_environment(normal, s.direction_ws);
    float pdf = 0;
    sampler.visit_lights(from, s.direction_ws, 1e30f, [&](const passes::LightHit& hit) {
        if (std::abs(hit.distance - s.distance) > 1e-4f * s.distance) return;
        EXPECT_EQ(hit.radiance, s.radiance);
        pdf = sampler.pdf_of_light(from, normal, s.direction_ws, hit);
    });
    const auto hit = bvh.closest_hit(from, s.direction_ws, 0.999f * s.distance, 1.001f * s.distance);
    if (pdf == 0 && hit.is_hit()) pdf = sampler.pdf_of_triangle(from, normal, hit);
    return pdf;
}

TEST(LightSamplerTest, DensityOfASampleIsTheDensityOfItsDirection) {
    LightScene world;
    fill_mixed(world);
    const auto& sampler = world.sampler();
    const passes::Bvh bvh(world.scene(), world.world(), 1);
    Uniform uniform(3);
    int compared = 0, missed = 0, apart = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 from(4 * uniform.number() - 2, 2 * uniform.number() - 0.9f, 2 * uniform.number() - 1);
        const auto normal = i % 3 == 0 ? glm::vec3(0) : up;
        const float choice = uniform.number();
        const auto s = sampler.sample(from, normal, choice, uniform.pair());
        if (!s || s->is_delta) continue;
        ASSERT_NEAR(glm::length(s->direction_ws), 1, 1e-5f);
        const float again = density_again(sampler, bvh, from, normal, *s);
        ++compared;
        if (again == 0) {
            ++missed;  // within rounding of an edge
            continue;
        }
        apart += std::abs(again / s->pdf - 1) > 1e-4f;  // rounding of directions seen edge-on
        ASSERT_TRUE(std::abs(again / s->pdf - 1) < 0.01f) << "sample " << i;
    }
    EXPECT_GT(compared, 10000);
    EXPECT_LE(missed, compared / 5000);
    EXPECT_LE(apart, compared / 1000);
}

TEST(LightSamplerTest, ProbabilitiesOfAllThatIsSampledAddUpToOne) {
    // The density of all that a direction meets, integrated over the sphere: n = 200,000 uniform directions.
    LightScene world;
    fill_mixed(world);
    world.scene().lights.erase(world.scene().lights.begin() + 1);  // the point light has no density
    const auto& sampler = world.sampler();
    const passes::Bvh bvh(world.scene(), world.world(), 1);
    const glm::vec3 from(0.3f, 0.2f, -0.1f);
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    double sum = 0, squares = 0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
        const auto direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        double density = sampler.pdf_of_environment(glm::vec3(0), direction);
        sampler.visit_lights(from, direction, 1e30f, [&](const passes::LightHit& hit) {
            density += sampler.pdf_of_light(from, glm::vec3(0), direction, hit);
        });
        for (float near = 0;;) {  // all triangles along the ray: the density does not know of shadows
            const auto hit = bvh.closest_hit(from, direction, near, 1e30f);
            if (!hit.is_hit()) break;
            density += sampler.pdf_of_triangle(from, glm::vec3(0), hit);
            near = hit.distance * 1.00001f;
        }
        density *= 4 * pi;
        sum += density;
        squares += density * density;
    }
    const double mean = sum / n;
    expect_mean({mean, std::sqrt((squares / n - mean * mean) / n)}, 1, "all densities");
}

}  // namespace
}  // namespace ir::test
