// Light over mirrors and through glass, traced from lights without extent, which no camera finds: against
// closed forms, and against paths from the camera that meet a light with an extent. Means are over
// independent seeds; |t| < 5.2 is α = 1e-5 with 31 degrees of freedom.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/methods/reference/light_tracer.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "tests/image/methods/machine.h"
#include "tests/image/methods/reference_lab.h"

namespace ir::methods::reference::light_tracing {
namespace {

using Paths = Transport::Paths;
constexpr auto model = Transport::Materials::metalness_blend;
constexpr double critical_t = 5.2, pi = glm::pi<double>();
constexpr int seeds = 32;
constexpr float flux = 40, intensity = flux / (4 * glm::pi<float>());

scene::View view_from(glm::vec3 eye, glm::vec3 target, int size, bool orthographic = false) {
    scene::Camera camera;
    camera.eye = eye, camera.target = target, camera.up = {0, 0, -1};
    camera.fov_y = glm::radians(30.0f);
    camera.orthographic = orthographic;
    camera.height = 1;
    return scene::make_view(camera, size, size, {glm::vec3(-4), glm::vec3(4)});
}

scene::Material mirror() {
    scene::Material m;
    m.metallic = 1, m.roughness = 0;
    return m;
}

scene::Light bulb(glm::vec3 position) {
    scene::Light light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

/// Means over the picture of what light brings to it after one scattering and after two (red); for each seed.
struct Traced {
    std::vector<Estimate> once, twice;
};
Traced traced(const Lab& lab, const Transport& transport, const scene::View& view, int paths) {
    const auto world = lab.world(transport.materials);
    const auto shared = lab.shared(view, transport.materials);
    const LightTracer tracer(world, PathRules(transport), shared);
    Traced result;
    for (int seed = 0; seed < seeds; ++seed) {
        std::vector<Splat> splats;
        LightTracer::Counts counts;
        for (int path = 0; path < paths; ++path)
            tracer.trace(PathSampler(mixed(seed), static_cast<std::uint32_t>(path)), splats, counts);
        double sums[] = {0, 0};
        for (const auto& splat : splats)
            if (splat.scatterings <= 2) sums[splat.scatterings - 1] += splat.light.r;
        const double count = paths * static_cast<double>(tracer.film().pixels());
        result.once.push_back({sums[0] / count, 0});
        result.twice.push_back({sums[1] / count, 0});
    }
    return result;
}

TEST(LightTracingFilm, IsTheInverseOfThePixelsRays) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const bool orthographic : {false, true}) {
        const auto view = view_from({1, 2, 3}, {0.2f, 0, -0.4f}, 16, orthographic);
        const auto rays = passes::pixel_rays(view);
        const Film film(view);
        for (int i = 0; i < 200; ++i) {
            const glm::vec2 at(16 * unit(random), 16 * unit(random));
            const float depth = 0.1f + 5 * unit(random);
            const auto direction = rays.direction + at.x * rays.direction_dx + at.y * rays.direction_dy;
            const auto origin = rays.origin + at.x * rays.origin_dx + at.y * rays.origin_dy;
            const auto seen = film.see(origin + depth * direction);
            ASSERT_TRUE(seen);
            EXPECT_EQ(seen->pixel, static_cast<std::uint32_t>(at.y) * 16 + static_cast<std::uint32_t>(at.x));
            EXPECT_LT(glm::length(seen->to_eye_ws + glm::normalize(direction)), 1e-4f);
            EXPECT_NEAR(seen->distance, depth * glm::length(direction), 1e-4f);
            // The pixel's part of a plane across the ray at that depth, by its corners.
            const auto corner_x = depth * rays.direction_dx + rays.origin_dx,
                       corner_y = depth * rays.direction_dy + rays.origin_dy;
            const auto area = std::abs(glm::dot(glm::cross(corner_x, corner_y), seen->to_eye_ws));
            EXPECT_NEAR(seen->importance * area, 1, 1e-3f);
            EXPECT_FALSE(film.see(origin - depth * direction)) << "behind the eye";
        }
    }
}

/// A mirror wall x = 1 beside a floor y = 0: the light at height 1 has an image behind the wall.
class MirrorImage : public testing::Test {
  protected:
    MirrorImage() {
        lab.quad(lab.material(glm::vec3(0.7f)), {-9, 0, 9}, {18, 0, 0}, {0, 0, -18});
        lab.quad(lab.material(mirror()), {1, 0, -9}, {0, 0, 18}, {0, 18, 0});
        lab.light(bulb({0, 1, 0}));
        lab.build();
    }
    /// Mean over the picture, of light from behind the wall.
    static double expected(const scene::View& view, double image_x = 2) {
        constexpr int steps = 64;
        const auto rays = passes::pixel_rays(view);
        double sum = 0;
        for (int i = 0; i < steps * steps; ++i) {
            const float x = (static_cast<float>(i % steps) + 0.5f) / steps * static_cast<float>(view.width),
                        y = (static_cast<float>(i / steps) + 0.5f) / steps * static_cast<float>(view.height);
            const glm::dvec3 origin(rays.origin + x * rays.origin_dx + y * rays.origin_dy);
            const glm::dvec3 direction(rays.direction + x * rays.direction_dx + y * rays.direction_dy);
            const auto p = origin - origin.y / direction.y * direction;
            const double squared = (image_x - p.x) * (image_x - p.x) + 1 + p.z * p.z;
            sum += 0.7 / pi * intensity / (squared * std::sqrt(squared));
        }
        return sum / (steps * steps);
    }
    Lab lab;
};

TEST_F(MirrorImage, LightsTheFloorAsASecondLamp) {
    for (const bool orthographic : {false, true}) {
        const auto view = view_from({0.1f, 2, 0.3f}, {0.1f, 0, 0.2f}, 4, orthographic);
        const auto found = traced(lab, transport(Paths::direct, 1, 1, model), view, 20000).once;
        EXPECT_LT(std::abs(t_of(found, expected(view))), critical_t)
            << spread(found).mean << " " << expected(view);
        // Mutant: the image somewhere else.
        EXPECT_GT(std::abs(t_of(found, expected(view, 2.3))), critical_t);
    }
}

TEST_F(MirrorImage, IsNotFoundFromTheCameraAsWell) {
    const auto world = lab.world(model);
    Wavefront wavefront(world, PathRules(transport(Paths::direct, 1, 1, model)));
    const auto from_above = [](const PathSampler&, passes::Surface&) {
        return ray({0, 0.5f, 0.5f}, {0, -1, 0});
    };
    const double lamp = 0.7 / pi * intensity / std::pow(1.25, 1.5);
    EXPECT_NEAR(trace_pixel(wavefront, from_above, 0, 64).sums[0] / 8, lamp, 1e-3 * lamp);
}

TEST_F(MirrorImage, MaximumDistanceCountsFromTheMirror) {
    const auto view = view_from({0, 2, 0}, {0, 0, 0.01f}, 1, true);
    auto near = transport(Paths::direct, 1, 1, model);
    near.max_distance = 0.4f;  // no pixel is as near to the wall
    EXPECT_EQ(spread(traced(lab, near, view, 2000).once).mean, 0);
    near.max_distance = 4;
    EXPECT_GT(spread(traced(lab, near, view, 2000).once).mean, 0);
}

/// Light that a ball of clear glass holds at its centre comes out whole: what radiance gains by being
/// squeezed into the glass is no power.
TEST(LightTracing, AGlassBallKeepsThePowerOfItsLight) {
    Lab lab;
    scene::Material glass;
    glass.metallic = 0, glass.roughness = 0, glass.transmission = 1, glass.thickness = 1;
    lab.sphere(lab.material(glm::vec3(0.6f)), -2, 4);
    lab.sphere(lab.material(glass), 0.5f, 3);
    lab.light(bulb({0, 0, 0}));
    lab.build();
    const auto view = view_from({0.8f, 0.9f, 0}, {2, 2.2f, 0.1f}, 2);
    const auto found = traced(lab, transport(Paths::full, 1, 1, model), view, 20000);
    const double expected = 0.6 / pi * intensity / 4;
    // Flat triangles are up to 1 % nearer than the sphere.
    EXPECT_NEAR(spread(found.once).mean, expected, 0.02 * expected);
    // In a closed furnace each scattering leaves ρ of the power: the second one has 0.6 of the first.
    EXPECT_NEAR(spread(found.twice).mean, 0.6 * expected, 0.03 * expected);
}

/// A wall that is a mirror about normals which lean 15° against it, and a floor with leaning normals: what a
/// bulb sends over them is what paths from the camera find of a luminous ball of the same intensity.
TEST(LightTracing, AgreesWithPathsFromTheCameraUnderShadingNormals) {
    constexpr float radius = 0.2f;
    const auto leaning = [](float degrees, glm::vec3 n, glm::vec3 to) {
        return glm::normalize(std::cos(glm::radians(degrees)) * n + std::sin(glm::radians(degrees)) * to);
    };
    const auto build = [&](Lab& lab, bool is_mirror, bool is_ball) {
        const int floor = lab.material(glm::vec3(0.7f));
        const int wall = is_mirror ? lab.material(mirror()) : lab.material(glm::vec3(0));
        lab.quad(floor, {-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, leaning(10, {0, 1, 0}, {1, 0, 0}));
        lab.quad(wall, {1, 0, -9}, {0, 0, 18}, {0, 18, 0}, leaning(15, {-1, 0, 0}, {0, -1, 0}));
        // A convex body of area S and radiance L has the mean intensity L S / 4.
        const float area = Lab::sphere_area(radius, 2);
        if (is_ball)
            lab.sphere(lab.material(glm::vec3(0), glm::vec3(4 * intensity / area)), radius, 2, {0, 1, 0});
        if (!is_ball) lab.light(bulb({0, 1, 0}));
        lab.build();
    };
    Lab with_bulb, with_ball, without_mirror;
    build(with_bulb, true, false), build(with_ball, true, true), build(without_mirror, false, true);
    // One square metre of the floor.
    const auto view = view_from({0, 0.7f, 0}, {0, 0, 0}, 1, true);
    const Starter from_above = [](const PathSampler& sampler, passes::Surface&) {
        const auto u = sampler.pair(in_pixel) - 0.5f;
        return ray({u.x, 0.7f, u.y}, {0, -1, 0});
    };
    const auto direct = transport(Paths::direct, 1, 1, model);
    const auto all = spread(estimates(with_ball, direct, from_above, seeds, 16384)),
               lamp = spread(estimates(without_mirror, direct, from_above, seeds, 16384)),
               light = spread(traced(with_bulb, direct, view, 8192).once);
    const double expected = all.mean - lamp.mean;
    const double error = std::sqrt((all.variance + lamp.variance + light.variance) / seeds);
    EXPECT_LT(error, 0.03 * expected) << "precise enough to tell";
    EXPECT_NEAR(light.mean, expected, 4.5 * error);
}

}  // namespace
}  // namespace ir::methods::reference::light_tracing

namespace ir::engine {
namespace {

/// The Cornell box with a mirror for a wall, lit by a spot, or by the panel as well.
Experiment mirror_room(std::int64_t samples, const std::string& scene = "builtin:cornell?emission=0") {
    Experiment e;
    scene::Part box{scene};
    box.materials["red"].metallic = 1;
    box.materials["red"].roughness = 0;
    e.parts = {box};
    e.scene = scene::composition_name(e.parts);
    e.method = "reference";
    e.settings = {{"samples", samples}, {"max_bounces", std::int64_t{2}}, {"paths", "full"}};
    e.width = 33, e.height = 24;
    return e;
}

std::map<std::string, std::vector<float>> pictures(const Experiment& e, int frames, Machine& on) {
    Execution execution(on, e);
    graph::FrameOptions options;
    options.wanted = {"*"};
    for (int i = 0; i < frames; ++i) execution.run_frame(options);
    std::map<std::string, std::vector<float>> result;
    for (const char* key : {"radiance", "direct", "indirect", "reference.variance", "reference.light_sums"})
        result[key] = execution.graph().read_image(key).value().pixels;
    return result;
}

void expect_same_bits(const std::string& scene) {
    const auto once = pictures(mirror_room(12, scene), 1, machine());
    EXPECT_GT(
        *std::max_element(once.at("reference.light_sums").begin(), once.at("reference.light_sums").end()), 0);
    MachineOptions options;
    options.threads = 1;
    Machine alone(options);
    EXPECT_EQ(pictures(mirror_room(12, scene), 1, alone), once);
    EXPECT_EQ(pictures(mirror_room(3, scene), 4, machine()), once);
    // 5 samples, kept, and 7 more in another session.
    Execution first(machine(), mirror_room(5, scene));
    first.run_frame({});
    Execution second(alone, mirror_room(12, scene));
    second.restore(*first.state());
    graph::FrameOptions all;
    all.wanted = {"*"};
    second.run_frame(all);
    EXPECT_EQ(second.graph().read_image("radiance")->pixels, once.at("radiance"));
    EXPECT_EQ(second.graph().read_image("reference.variance")->pixels, once.at("reference.variance"));
}

TEST(LightTracing, IsTheSameForAnyThreadsFramesAndSessions) {
    expect_same_bits("builtin:cornell?emission=0");
    expect_same_bits("builtin:cornell");
}

/// Light of a picture beyond what shadow maps show, on what is no mirror.
double beyond_direct_light(const Experiment& e, const std::vector<float>& direct, int frames) {
    Execution execution(machine(), e);
    graph::FrameOptions options;
    options.wanted = {"radiance", "valid", "gbuffer.material"};
    for (int i = 0; i < frames; ++i) execution.run_frame(options);
    const auto picture = main_result(execution), valid = execution.graph().read_image("valid").value(),
               material = execution.graph().read_image("gbuffer.material").value();
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (valid.at(x, y) > 0 && material.at(x, y, 0) < 0.5f)
                sum += picture.at(x, y, 0) - direct[4 * (std::size_t(y) * picture.width + x)];
    return sum;
}

/// Photon mapping keeps what a mirror throws onto a surface, as the thesis does: a third of this room's light
/// beyond direct light.  [Smal19 §8.7]
TEST(LightTracing, PhotonMappingHasTheSameLightByMirrors) {
    auto photons = mirror_room(1);
    photons.method = "photon-mapping";
    photons.settings = {{"paths", "full"},
                        {"materials", "metalness-blend"},
                        {"photons", std::int64_t{200000}},
                        {"normal_axis", 1.0}};
    photons.width = 64, photons.height = 48;
    auto truth = photons;
    truth.method = "reference";
    truth.settings = {{"paths", "full"}, {"materials", "metalness-blend"}, {"samples", std::int64_t{256}}};
    Execution lit(machine(), photons);
    graph::FrameOptions options;
    options.wanted = {"direct.radiance"};
    lit.run_frame(options);
    const auto direct = lit.graph().read_image("direct.radiance").value().pixels;
    const double expected = beyond_direct_light(truth, direct, 1);
    EXPECT_NEAR(beyond_direct_light(photons, direct, 4) / expected, 1, 0.08);
    // Without the light that mirrors throw, it would be far less.
    truth.settings["paths"] = "indirect";
    EXPECT_LT(beyond_direct_light(truth, std::vector<float>(direct.size()), 1), 0.85 * expected);
}

}  // namespace
}  // namespace ir::engine
