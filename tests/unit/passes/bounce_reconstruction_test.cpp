// From samples to pixels: estimators against closed forms, and what neighbours may give.
#include <algorithm>
#include <random>

#include "tests/unit/passes/bounce_fixture.h"

namespace ir::test {
namespace {

using bounce::Distribution;
using bounce::Estimator;
using bounce::Spread;

class ReconstructionTest : public BounceTest {
  protected:
    /// n values, alpha = 1e-4; of sums of few bounded values: the deviation's error is at most that of normal
    /// ones.
    static void expect_moments(const Moments& found, double mean, double deviation) {
        const double n = static_cast<double>(found.n);
        EXPECT_NEAR(found.mean, mean, two_sided * deviation / std::sqrt(n) + 1e-5);
        EXPECT_NEAR(found.deviation, deviation, two_sided * deviation / std::sqrt(2 * n) + 1e-4);
    }
};

TEST_F(ReconstructionTest, TheRatioOfAnOpenPlaneIsOne) {
    for (const auto& shot : {Shot("builtin:plane", "above", 48, 48), Wall().shot(48, 48)})
        for (const auto distribution : {Distribution::uniform, Distribution::cosine})
            for (const int radius : {0, 3}) {
                auto r = BounceRun::with(4, Spread::independent, radius);
                r.options.parameters.distribution = distribution;
                reconstruct(shot, r);
                for (const float value : result()) ASSERT_NEAR(value, 1, 2e-6);
            }
}

/// n = 64². 2 cosθ of a uniform hemisphere is uniform in [0, 2]: of variance 1/3 each, together 1/12. Of four
/// strata with one shift it is 3/4 + ξ/2. Each is the other's mutant: they are a factor of two apart.
TEST_F(ReconstructionTest, ThePublishedEstimateOfAnOpenPlaneIsNoisy) {
    const auto shot = Wall().shot(64, 64);
    auto r = BounceRun::with(4, Spread::independent, 0);
    r.reconstruction.estimator = Estimator::published;
    r.options.parameters.distribution = Distribution::uniform;
    reconstruct(shot, r);
    const Moments independent(result());
    expect_moments(independent, 1, std::sqrt(1.0 / 12));
    EXPECT_NEAR(independent.deviation, 0.29, 0.02);

    r.options.parameters.spread = Spread::stratified;
    reconstruct(shot, r);
    expect_moments(Moments(result()), 1, 0.5 / std::sqrt(12.0));

    r.options.parameters.distribution = Distribution::cosine;
    reconstruct(shot, r);
    expect_moments(Moments(result()), 1, 0);
}

/// All is closed beyond a plane through the surface point: (1 − cos β) / 2 is open, β between the normals.
/// The mutant takes the density of the other distribution.
TEST_F(ReconstructionTest, OfAHalfOpenHemisphereTheProjectedPartIsLeft) {
    const Wall wall;
    const auto frame = scene::frame_around(wall.normal);
    for (const float beta : {0.6f, std::numbers::pi_v<float> / 2}) {
        const auto closed = frame * glm::vec3(std::sin(beta), 0, std::cos(beta));
        auto r = BounceRun::with(4, Spread::independent, 0);
        r.meeting = [=](glm::ivec2, int, glm::vec4 direction) {
            return Met{glm::dot(glm::vec3(direction), closed) > 0 ? 0.5f : -1.0f};
        };
        const double expected = (1 - std::cos(double{beta})) / 2;
        for (const auto distribution : {Distribution::uniform, Distribution::cosine}) {
            r.options.parameters.distribution = distribution;
            r.reconstruction.estimator = Estimator::published;
            r.reconstruction.blur.blur = false;
            reconstruct(wall.shot(64, 64), r);
            const Moments found(result());
            EXPECT_NEAR(found.mean, expected, two_sided * found.standard_error());

            double mutant = 0;
            const auto directions = all_directions(4);
            for (const auto& d : directions)
                if (glm::dot(glm::vec3(d), closed) <= 0)
                    mutant +=
                        distribution == Distribution::uniform ? 1 : 2 * glm::dot(glm::vec3(d), wall.normal);
            mutant /= static_cast<double>(directions.size());
            if (beta < 1) {  // at right angles it is right by symmetry
                EXPECT_GT(std::abs(mutant - expected), two_sided * found.standard_error())
                    << "the mutant passes";
            }

            // The ratio's bias falls with the number of samples, here 4 · 7².
            r.reconstruction.estimator = Estimator::ratio;
            r.reconstruction.blur = {.blur = true, .radius = 3};
            reconstruct(wall.shot(64, 64), r);
            EXPECT_NEAR(Moments(result()).mean, expected, 0.01);
        }
    }
}

TEST_F(ReconstructionTest, LambertInAFurnaceIsItsAlbedoInEverySample) {
    Wall wall;
    wall.material().base_colour = {0.75f, 0.5f, 0, 1};
    auto r = BounceRun::with(4, Spread::stratified, 3);
    r.options.light = true;
    r.options.materials = Transport::Materials::lambert;
    r.meeting = [](glm::ivec2, int, glm::vec4) { return Met{1, glm::vec3(1)}; };
    reconstruct(wall.shot(32, 32), r);
    for (const auto& [channel, albedo] : {std::pair{0, 0.75}, {1, 0.5}, {2, 0.0}})
        for (const float value : result(channel)) ASSERT_NEAR(value, albedo, 1e-5);
}

/// The directional albedo, the mean of channels, by midpoints over the hemisphere.
glm::dvec3 directional_albedo(const Wall& wall, Transport::Materials model, float min_roughness) {
    constexpr int steps = 400;
    const auto bsdf = wall.bsdf(model, min_roughness);
    const auto frame = scene::frame_around(wall.normal);
    glm::dvec3 sum(0);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const double theta = (i + 0.5) * std::numbers::pi / 2 / steps, phi = j * std::numbers::pi / steps;
            const auto l = frame * glm::vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                             std::cos(theta));
            sum += glm::dvec3(bsdf.evaluate(wall.towards_eye, l)) * std::sin(theta);
        }
    return sum * (std::numbers::pi / 2 / steps) * (std::numbers::pi / steps);
}

/// n = 64² pixels of 4 samples each, alpha = 1e-4. The mutant divides by the directions that there are,
/// without those that were lost into the surface.
TEST_F(ReconstructionTest, GlossySurfacesInAFurnaceReflectTheirDirectionalAlbedo) {
    for (const auto model : {Transport::Materials::gltf, Transport::Materials::metalness_blend})
        for (const auto& [metallic, roughness] : {std::pair{0.0f, 0.5f}, {1.0f, 0.75f}, {0.5f, 0.0f}}) {
            Wall wall(glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f)),
                      glm::normalize(glm::vec3(-0.9f, 0.2f, 0.5f)));
            wall.material().base_colour = {0.75f, 0.5f, 0.03125f, 1};
            wall.material().metallic = metallic;
            wall.material().roughness = roughness;
            auto r = BounceRun::with(4, Spread::independent, 0);
            r.options.light = true;
            r.options.materials = model;
            r.options.parameters.min_roughness = 0.25f;
            r.meeting = [](glm::ivec2, int, glm::vec4) { return Met{1, glm::vec3(1)}; };
            reconstruct(wall.shot(64, 64), r);
            const auto albedo = directional_albedo(wall, model, 0.25f);
            double lost = 0;
            for (const auto& d : all_directions(4)) lost += d.w == 0 ? 1.0 / (4 * 64 * 64) : 0;
            for (int c = 0; c < 3; ++c) {
                const Moments found(result(c));
                const double tolerance = two_sided * found.standard_error() + 1e-3 * albedo[c];
                EXPECT_NEAR(found.mean, albedo[c], tolerance) << metallic << ' ' << c;
                if (roughness == 0.75f && c == 0) {
                    EXPECT_GT(std::abs(found.mean / (1 - lost) - albedo[c]), tolerance)
                        << "the mutant passes";
                }
            }
        }
}

/// A wall whose checks are white and nearly black, as a wide blur sees it.
struct Checks {
    Wall wall;
    Checks() {
        scene::Texture texture;
        texture.width = texture.height = 2;
        texture.rgba = {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255};
        texture.sampler = {.mag = scene::Filter::nearest, .min = scene::Filter::nearest, .mipmaps = false};
        wall.scene.textures[0] = texture;
        wall.scene.meshes[0].uv0 = {{0, 0}, {400, 0}, {400, 400}, {0, 400}};
        wall.material().base_colour_texture.texture = 0;
        wall.material().metallic = 0;
    }
};

TEST_F(ReconstructionTest, TexturesStayUnderAWideBlur) {
    const Checks checks;
    auto r = BounceRun::with(4, Spread::stratified, 6);
    r.options.light = true;
    r.options.materials = Transport::Materials::lambert;
    r.meeting = [](glm::ivec2, int, glm::vec4) { return Met{1, glm::vec3(1)}; };
    reconstruct(checks.wall.shot(64, 64), r);
    const auto image = read("result"), albedo = read("gbuffer.albedo");
    const Moments seen(result());
    EXPECT_GT(seen.deviation, 0.3) << "there is a texture";
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) ASSERT_NEAR(image.at(x, y), albedo.at(x, y), 1e-5) << x << ' ' << y;
}

/// Directions of neighbours of another colour are right on average, too. n = 64² pixels, which share samples:
/// all are within 5 %, and their mean within 1 %.
TEST_F(ReconstructionTest, GlossyTexturesStayUnderAWideBlur) {
    Checks checks;
    checks.wall.material().roughness = 0.5f;
    auto r = BounceRun::with(16, Spread::stratified, 6);
    r.options.light = true;
    r.meeting = [](glm::ivec2, int, glm::vec4) { return Met{1, glm::vec3(1)}; };
    reconstruct(checks.wall.shot(64, 64), r);
    const auto image = read("result"), albedo = read("gbuffer.albedo");
    for (const float colour : {0.0f, 1.0f}) {
        auto plain = checks.wall;
        plain.material().base_colour = glm::vec4(glm::vec3(colour), 1);
        const double expected = directional_albedo(plain, r.options.materials, 0).x;
        std::vector<float> found;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                if (albedo.at(x, y) == colour) found.push_back(image.at(x, y));
        ASSERT_GT(found.size(), 500u);
        for (const float value : found) ASSERT_NEAR(value, expected, 0.1 * expected);
        EXPECT_NEAR(Moments(found).mean, expected, 0.01 * expected);
    }
}

TEST_F(ReconstructionTest, BackgroundAndUnlitSurfacesAreEmpty) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    const auto all_met = [](glm::ivec2, int, glm::vec4) { return Met{0.5f, glm::vec3(1)}; };
    for (const bool light : {false, true})
        for (const bool unlit : {false, true}) {
            scene.materials[SmallWorld::opaque].unlit = unlit;
            auto r = BounceRun::with(2, Spread::stratified, 3);
            r.options.light = light;
            r.meeting = all_met;
            reconstruct({scene, scene::Camera{}, 32, 32}, r);
            const auto valid = read("valid"), image = read("result");
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const bool surface = valid.at(x, y) > 0;
                    if (light) {
                        ASSERT_EQ(image.at(x, y) > 0.1f, surface && !unlit) << image.at(x, y);
                    } else {
                        ASSERT_EQ(image.at(x, y), surface ? 0 : 1);
                    }
                }
        }
}

TEST_F(ReconstructionTest, ValuesThatAreNotFiniteCountForNothing) {
    auto r = BounceRun::with(2, Spread::stratified, 3);
    r.options.light = true;
    r.options.materials = Transport::Materials::lambert;
    r.meeting = [](glm::ivec2 pixel, int, glm::vec4) {
        const bool bad = pixel.x == 8 && pixel.y == 8;
        return Met{1, glm::vec3(bad ? std::numeric_limits<float>::quiet_NaN() : 1.0f)};
    };
    reconstruct(Wall().shot(16, 16), r);
    for (const float value : result()) ASSERT_NEAR(value, 1, 1e-5);
}

/// Two pieces of rough metal, one of which sees the eye's mirror image and one of which does not: the other
/// one's samples seldom go where a pixel reflects most. n = 64² pixels and 24 seeds, alpha = 1e-4.
TEST_F(ReconstructionTest, BalanceBoundsWhatANeighboursSampleGivesAndLeavesTheMean) {
    SmallWorld small;
    small.quad({-2, 0, -2}, {-2, 0, 2}, {0, 0, 2}, {0, 0, -2});
    small.quad({0, 0, -2}, {0, 0, 2}, {2, 0.7f, 2}, {2, 0.7f, -2});
    auto scene = small.scene();
    auto& material = scene.materials[SmallWorld::opaque];
    material.metallic = 1;
    material.roughness = 0.3f;
    scene::Camera camera;
    camera.eye = {0, 5, 0.01f};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1};
    camera.orthographic = true;
    camera.height = 0.2f;
    const Shot shot(scene, camera, 32, 32);
    auto r = BounceRun::with(2, Spread::independent, 3);
    r.options.light = true;
    r.options.parameters.min_roughness = 0.1f;
    r.reconstruction.blur.normal_power = 1;
    r.reconstruction.blur.plane_tolerance = 10;
    r.meeting = [](glm::ivec2, int, glm::vec4) { return Met{1, glm::vec3(1)}; };
    const auto run_with = [&](float balance) {
        r.reconstruction.balance = balance;
        std::vector<float> means, most;
        for (r.seed = 0; r.seed < 24; ++r.seed) {
            reconstruct(shot, r);
            const auto values = result();
            means.push_back(static_cast<float>(Moments(values).mean));
            most.push_back(*std::max_element(values.begin(), values.end()));
        }
        return std::pair{Moments(means), *std::max_element(most.begin(), most.end())};
    };
    const auto [own, own_most] = [&] {
        const auto blur = r.reconstruction.blur;
        r.reconstruction.blur.blur = false;
        const auto result = run_with(0);
        r.reconstruction.blur = blur;
        return result;
    }();
    const auto [published, published_most] = run_with(0);
    const auto [balanced, balanced_most] = run_with(0.25f);
    EXPECT_NEAR(balanced.mean, own.mean, two_sided * (balanced.standard_error() + own.standard_error()));
    EXPECT_LT(balanced_most, own_most / 0.25f);
    EXPECT_LT(balanced.deviation, published.deviation);
    EXPECT_GT(published_most, balanced_most);
}

/// The left half of a wall is closed, the right half open. Pixels are 1/64 m apart.
TEST_F(ReconstructionTest, KernelsReachNoFartherThanWhatIsMet) {
    const auto shot = Wall().shot(64, 64);
    auto r = BounceRun::with(4, Spread::stratified, 8);
    const auto row = [&](float met_at, float by_distance) {
        r.meeting = [=](glm::ivec2 pixel, int, glm::vec4) { return Met{pixel.x < 32 ? met_at : -1.0f}; };
        r.reconstruction.kernel_by_distance = by_distance;
        reconstruct(shot, r);
        const auto image = read("result");
        std::vector<float> values;
        for (int x = 0; x < 64; ++x) values.push_back(image.at(x, 32));
        return values;
    };
    const auto wide = row(0.005f, 0), narrow = row(0.005f, 1), far = row(0.9f, 1);
    EXPECT_GT(wide[31], 0.3f);
    EXPECT_LT(wide[32], 0.7f);
    EXPECT_LT(narrow[31], 0.01f);
    EXPECT_GT(narrow[32], 0.9f);
    EXPECT_EQ(far, row(0.9f, 0));
}

/// Of many materials, over the edges of tiles; radiances are any that differ. The G-buffer has two bodies,
/// too: few pixels at edges are of another surface, and so are their neighbours' samples.
TEST_F(ReconstructionTest, HostAndDeviceGiveTheSame) {
    const Shot shot("builtin:dominoes", "row", 83, 21);
    // of sharp highlights a graphics card rounds more than llvmpipe
    const float tolerance = device().software() ? 1e-3f : 1e-2f;
    const auto compare = [&](BounceRun r) {
        std::vector<std::vector<float>> of_body;
        for (r.on = Processor::gl;; r.on = Processor::host) {
            reconstruct(shot, r);
            for (int c = 0; c < (r.options.light ? 3 : 1); ++c) of_body.push_back(result(c));
            if (r.on == Processor::host) break;
        }
        const auto channels = of_body.size() / 2;
        for (std::size_t c = 0; c < channels; ++c) {
            EXPECT_GT(Moments(of_body[c]).deviation, 0.01) << "there is something to compare";
            std::size_t different = 0;
            for (std::size_t i = 0; i < of_body[c].size(); ++i) {
                const float device = of_body[c][i], host = of_body[channels + c][i];
                different += !(std::abs(host - device) <= tolerance * (0.1f + std::abs(device)));
            }
            EXPECT_LE(different, of_body[c].size() / 25) << "channel " << c;
        }
    };
    for (const int radius : {0, 3}) {
        auto r = BounceRun::with(radius > 0 ? 6 : 3, Spread::stratified, radius);  // two groups, and one
        r.meeting = [](glm::ivec2 pixel, int sample, glm::vec4 direction) {
            const float hash = std::sin(13.0f * static_cast<float>(pixel.x + 7 * pixel.y + 3 * sample));
            return Met{hash * 2 * direction.y, glm::abs(glm::vec3(direction)) * (1.5f + hash)};
        };
        for (const auto estimator : {Estimator::ratio, Estimator::published}) {
            SCOPED_TRACE("accessibility, radius " + std::to_string(radius));
            r.reconstruction.estimator = estimator;
            compare(r);
        }
        r.reconstruction.kernel_by_distance = 0.005f;
        compare(r);
        r.reconstruction.kernel_by_distance = 0;
        r.options.light = true;
        for (const auto model : {Transport::Materials::gltf, Transport::Materials::metalness_blend,
                                 Transport::Materials::lambert})
            for (const float balance : {0.0f, 0.25f}) {
                SCOPED_TRACE("materials " + std::to_string(static_cast<int>(model)) + ", radius " +
                             std::to_string(radius) + ", balance " + std::to_string(balance));
                r.options.materials = model;
                r.reconstruction.balance = balance;
                compare(r);
            }
    }
}

}  // namespace
}  // namespace ir::test
