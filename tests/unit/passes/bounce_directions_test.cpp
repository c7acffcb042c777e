// The direction buffer: directions follow the densities that are stored with them.
#include <algorithm>
#include <functional>
#include <set>

#include "renderers/graph/pass_context.h"

#include "tests/unit/passes/bounce_fixture.h"

namespace ir::test {
namespace {

using bounce::Distribution;
using bounce::Spread;

using std::numbers::pi;
constexpr int rings = 10, sectors = 16;

using Density = std::function<double(glm::vec3)>;  // 1/sr, of a world-space direction

/// Counts of directions by cosine to n and azimuth; the last bin holds those that do not exist.
std::vector<double> histogram(const std::vector<glm::vec4>& directions, const glm::mat3& frame) {
    std::vector<double> counts(rings * sectors + 1);
    for (const auto& d : directions) {
        if (d.w == 0) {
            ++counts.back();
            continue;
        }
        const auto local = glm::vec3(d) * frame;
        const double azimuth = std::atan2(local.y, local.x) / (2 * pi) + 0.5;
        const int ring = std::clamp(static_cast<int>(local.z * rings), 0, rings - 1);
        const int sector = std::clamp(static_cast<int>(azimuth * sectors), 0, sectors - 1);
        ++counts[static_cast<std::size_t>(ring * sectors + sector)];
    }
    return counts;
}

/// Probabilities of the same bins, by midpoints.
std::vector<double> probabilities(const Density& density, const glm::mat3& frame) {
    constexpr int steps = 24;
    std::vector<double> result(rings * sectors + 1);
    double whole = 0;
    for (int i = 0; i < rings * steps; ++i)
        for (int j = 0; j < sectors * steps; ++j) {
            const double z = (i + 0.5) / (rings * steps), r = std::sqrt(1 - z * z);
            const double phi = 2 * pi * ((j + 0.5) / (sectors * steps) - 0.5);
            const auto l = frame * glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
            const double part = density(l) * 2 * pi / (rings * steps) / (sectors * steps);
            result[static_cast<std::size_t>(i / steps * sectors + j / steps)] += part;
            whole += part;
        }
    result.back() = std::max(0.0, 1 - whole);
    return result;
}

/// χ² over its limit at alpha = 1e-4; bins in which fewer than eight are expected are put together.
double chi_square_over_limit(const std::vector<double>& counts, const std::vector<double>& expected) {
    double n = 0, sum = 0, rare_count = 0, rare_expected = 0;
    for (const double count : counts) n += count;
    int bins = 0;
    const auto add = [&](double count, double e) {
        sum += (count - e) * (count - e) / e;
        ++bins;
    };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (n * expected[i] >= 8) {
            add(counts[i], n * expected[i]);
        } else {
            rare_count += counts[i];
            rare_expected += n * expected[i];
        }
    }
    if (rare_expected >= 8) add(rare_count, rare_expected);
    return sum / chi_square_limit(bins - 1);
}

/// Of ambient occlusion.
bounce::Samples declare_samples(graph::GraphBuilder& builder, const bounce::Directions& directions) {
    bounce::Batches all(directions.samples);
    const auto distance = bounce::declare_distance(builder, all);
    return {distance, bounce::declare_incoming(builder, all, bounce::Effects::ambient_occlusion)};
}

class DirectionsTest : public BounceTest {
  protected:
    void expect_density(const std::vector<glm::vec4>& directions, const Density& density) {
        int wrong = 0;
        for (const auto& d : directions) {
            if (d.w == 0) continue;
            ASSERT_NEAR(glm::length(glm::vec3(d)), 1, 1e-5);
            const double expected = density(glm::vec3(d));
            wrong += std::abs(d.w - expected) > 2e-3 * expected + 1e-5 ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0) << "stored densities";
    }
};

/// n = 64² · 16 directions, 160 bins, alpha = 1e-4; the other distribution is the mutant.
TEST_F(DirectionsTest, AmbientOcclusionFollowsItsDistribution) {
    const Wall wall;
    const auto frame = scene::frame_around(wall.normal);
    const Density uniform = [](glm::vec3) { return 0.5 / pi; };
    const Density cosine = [&](glm::vec3 l) { return glm::dot(wall.normal, l) / pi; };
    for (const auto spread : {Spread::stratified, Spread::independent})
        for (const auto distribution : {Distribution::uniform, Distribution::cosine}) {
            bounce::DirectionOptions options;
            options.parameters = {.samples = 16, .spread = spread, .distribution = distribution};
            choose_directions(wall.shot(64, 64), options, 7);
            const auto directions = all_directions(16);
            const bool is_uniform = distribution == Distribution::uniform;
            const auto& own = is_uniform ? uniform : cosine;
            const auto& mutant = is_uniform ? cosine : uniform;
            const auto counts = histogram(directions, frame);
            EXPECT_EQ(counts.back(), 0) << "every pixel has all samples";
            EXPECT_LT(chi_square_over_limit(counts, probabilities(own, frame)), 1);
            EXPECT_GT(chi_square_over_limit(counts, probabilities(mutant, frame)), 1) << "the mutant passes";
            expect_density(directions, own);
        }
}

/// n = 64² · 16, at most 161 bins, alpha = 1e-4, for each of six materials. Mutants: a tenth less rough, and
/// the cosine alone.
TEST_F(DirectionsTest, LightFollowsBrdfTimesCosine) {
    for (const auto model : {Transport::Materials::gltf, Transport::Materials::metalness_blend})
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
            Wall wall;
            wall.material().base_colour = {0.75f, 0.5f, 0.25f, 1};
            wall.material().metallic = metallic;
            wall.material().roughness = 0.5f;
            const auto frame = scene::frame_around(wall.normal);
            const Density pdf = [&](glm::vec3 l) { return wall.bsdf(model).pdf(wall.towards_eye, l); };
            bounce::DirectionOptions options{.light = true, .materials = model};
            options.parameters = {.samples = 16, .spread = Spread::independent};
            choose_directions(wall.shot(64, 64), options, 3);
            const auto directions = all_directions(16);
            const auto counts = histogram(directions, frame);
            EXPECT_LT(chi_square_over_limit(counts, probabilities(pdf, frame)), 1) << metallic;
            expect_density(directions, pdf);
            if (metallic < 0.75f) continue;
            const Density cosine = [&](glm::vec3 l) { return glm::dot(wall.normal, l) / pi; };
            wall.material().roughness = 0.45f;
            EXPECT_GT(chi_square_over_limit(counts, probabilities(pdf, frame)), 1) << "the mutant passes";
            EXPECT_GT(chi_square_over_limit(counts, probabilities(cosine, frame)), 1) << "the mutant passes";
        }
}

TEST_F(DirectionsTest, SmootherReceiversAreTakenForTheLeastRoughness) {
    Wall wall;
    wall.material().roughness = 0;
    bounce::DirectionOptions options{.light = true};
    options.parameters.min_roughness = 0.25f;
    choose_directions(wall.shot(16, 16), options);
    const auto bsdf = wall.bsdf(options.materials, 0.25f);
    expect_density(all_directions(4), [&](glm::vec3 l) { return bsdf.pdf(wall.towards_eye, l); });
    wall.material().roughness = 0.5f;
    choose_directions(wall.shot(16, 16), options);
    const auto rougher = wall.bsdf(options.materials);
    expect_density(all_directions(4), [&](glm::vec3 l) { return rougher.pdf(wall.towards_eye, l); });
}

/// Heights of 16 samples are a shifted grid, so each stratum of a sixteenth has one.
TEST_F(DirectionsTest, StrataHoldOneSampleEach) {
    const Wall wall;
    bounce::DirectionOptions options;
    options.parameters = {.samples = 16, .spread = Spread::stratified, .distribution = Distribution::uniform};
    choose_directions(wall.shot(8, 8), options);
    const auto directions = all_directions(16);
    for (std::size_t pixel = 0; pixel < 64; ++pixel) {
        std::vector<float> heights;
        for (std::size_t i = 0; i < 16; ++i)
            heights.push_back(glm::dot(glm::vec3(directions[i * 64 + pixel]), wall.normal));
        std::sort(heights.begin(), heights.end());
        for (std::size_t i = 1; i < 16; ++i)
            ASSERT_NEAR(heights[i] - heights[i - 1], 1.0 / 16, 1e-5) << pixel;
    }
}

TEST_F(DirectionsTest, SeedsDecide) {
    const auto shot = Wall().shot(16, 16);
    bounce::DirectionOptions options;
    const auto chosen = [&](std::uint64_t seed, int frame) {
        choose_directions(shot, options, seed, frame);
        return all_directions(options.parameters.samples);
    };
    for (const auto spread : {Spread::stratified, Spread::independent}) {
        options.parameters.spread = spread;
        options.vary = false;
        const auto first = chosen(1, 0);
        EXPECT_EQ(first, chosen(1, 0));
        EXPECT_EQ(first, chosen(1, 5)) << "frames count only where asked for";
        EXPECT_NE(first, chosen(2, 0));
        EXPECT_NE(first, chosen(1ull << 32, 0)) << "all of the seed counts";
        options.vary = true;
        const auto begun = chosen(1, 0), later = chosen(1, 5);
        std::size_t same = 0;
        for (std::size_t i = 0; i < begun.size(); ++i) same += begun[i] == later[i] ? 1 : 0;
        EXPECT_EQ(same, 0u);
    }
}

/// One sample for each of 8 × 8 pixels. Cosine² and azimuth of together 64 are evenly spaced, and wherever
/// they begin their mean is 1/2 within 1/128; of 64 at random it deviates by 0.036.
TEST_F(DirectionsTest, NeighboursShareTheHemisphere) {
    const Wall wall;
    const auto shot = wall.shot(8, 8);
    const auto frame = scene::frame_around(wall.normal);
    const auto largest_deviation = [&](const bounce::DirectionOptions& options) {
        double largest = 0;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            choose_directions(shot, options, seed);
            double height = 0, azimuth = 0;
            for (const auto& d : all_directions(1)) {
                const auto local = glm::vec3(d) * frame;
                height += local.z * local.z / 64;
                azimuth += (std::atan2(local.y, local.x) / (2 * pi) + 0.5) / 64;
            }
            largest = std::max({largest, std::abs(height - 0.5), std::abs(azimuth - 0.5)});
        }
        return largest;
    };
    bounce::DirectionOptions options{.parameters = {.samples = 1}};
    EXPECT_LT(largest_deviation(options), 1.0 / 128 + 1e-3);
    options.vary = true;
    EXPECT_GT(largest_deviation(options), 0.02) << "pixels whose frames are averaged draw by themselves";
    options.vary = false;
    options.parameters.spread = Spread::independent;
    EXPECT_GT(largest_deviation(options), 0.02);
}

TEST_F(DirectionsTest, BackgroundAndUnlitSurfacesHaveNone) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    scene.materials[SmallWorld::opaque].unlit = true;
    const Shot shot(scene, scene::Camera{}, 32, 32);
    bounce::DirectionOptions options;
    for (const bool light : {false, true}) {
        options.light = light;
        choose_directions(shot, options);
        const auto valid = read("valid");
        const auto image = read("bounce.directions");
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                const bool has = !light && valid.at(x, y) > 0;
                ASSERT_EQ(image.at(x, y, 3) > 0, has) << x << ' ' << y;
                ASSERT_EQ(rgb(image, x, y) != glm::vec3(0), has);
            }
    }
}

/// The reference samples the shading normal's hemisphere and takes for closed what lies below the triangle.
TEST_F(DirectionsTest, BelowTheTriangleAllIsClosed) {
    SmallWorld small;
    scene::Mesh mesh;
    const auto leaning = glm::normalize(glm::vec3(0, 1, 1));
    mesh.positions = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
    mesh.normals.assign(4, leaning);
    mesh.uv0.assign(4, {0, 0});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    small.add(std::move(mesh));
    const Shot shot(small.scene(), scene::Camera{}, 16, 16);
    run(shot, [&](graph::GraphBuilder& builder) {
        const auto scene = passes::upload_scene(builder);
        const auto gbuffer = passes::gbuffer(builder, scene);
        const auto directions = bounce::directions(builder, scene, gbuffer,
                                                   {.parameters = {.distribution = Distribution::uniform}});
        const auto samples = declare_samples(builder, directions);
        const auto distance = samples.distance;
        builder.pass("miss").writes(distance).execute([=](graph::PassContext& context) {
            const std::vector<float> nothing(16 * 16, -1);
            for (int layer = 0; layer < 4; ++layer)
                context.upload(distance, std::as_bytes(std::span(nothing)), 0, layer);
        });
        bounce::fill_visibility(builder, gbuffer, directions, samples, Transport{.max_distance = 1});
    });
    int below = 0;
    for (int layer = 0; layer < 4; ++layer) {
        const auto directions = read("bounce.directions", layer), incoming = read("bounce.incoming", layer);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                const auto d = rgb(directions, x, y);
                ASSERT_GE(glm::dot(d, leaning), -1e-3f);
                ASSERT_EQ(incoming.at(x, y), d.z > 0 ? 1 : 0);
                below += d.z > 0 ? 0 : 1;
            }
    }
    EXPECT_NEAR(below / 1024.0, 0.25, 0.06) << "a lune of 45 degrees";
}

TEST_F(DirectionsTest, VisibilityFollowsTheTransport) {
    const auto shot = Wall().shot(4, 1);
    const std::vector<float> met{-1, 0.25f, 0.5f, 2};
    const auto seen = [&](const Transport& transport) {
        run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            bounce::DirectionOptions options;
            options.parameters.samples = 1;
            const auto directions = bounce::directions(builder, scene, gbuffer, options);
            const auto samples = declare_samples(builder, directions);
            const auto distance = samples.distance;
            builder.pass("meet").writes(distance).execute([=](graph::PassContext& context) {
                context.upload(distance, std::as_bytes(std::span(met)));
            });
            bounce::fill_visibility(builder, gbuffer, directions, samples, transport);
        });
        const auto image = read("bounce.incoming");
        return std::vector<float>{image.at(0, 0), image.at(1, 0), image.at(2, 0), image.at(3, 0)};
    };
    using Falloff = Transport::Falloff;
    EXPECT_EQ(seen({.max_distance = 1, .falloff = Falloff::hard}), (std::vector<float>{1, 0, 0, 1}));
    EXPECT_EQ(seen({.max_distance = 1, .falloff = Falloff::smooth}),
              (std::vector<float>{1, 0.0625f, 0.25f, 1}));
    EXPECT_EQ(seen({.max_distance = 0, .falloff = Falloff::smooth}), (std::vector<float>{1, 0, 0, 0}));
}

}  // namespace
}  // namespace ir::test
