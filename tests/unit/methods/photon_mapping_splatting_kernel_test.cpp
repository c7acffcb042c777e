// The shape of kernels against closed forms, by what explains a pixel; the counts of tiles.
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/passes/scene/progressive.h"
#include "tests/unit/methods/photon_mapping_splatting_fixture.h"

namespace ir::test {
namespace {

constexpr int kernel_size = 64;
class SplattingKernel : public SplatTest {
  protected:
    /// Height of the eye, and what it sees of the plane z = 0.
    static constexpr float distance = 5;
    static double width(float height) { return 2 * height * std::tan(0.785398 / 2); }

    Shot shot_{wide_square(), camera_at({0, 0, distance}, {0, 0, 0}), kernel_size, kernel_size};
    const float radius_ = shot_.world.bounds.radius();

    /// The kernel over the picture's middle, where the photon lies.
    ExplainedPhoton kernel(const pm::Parameters& parameters, const SomePhoton& photon, int copies = 1) {
        SplatRun run{std::vector<SomePhoton>(static_cast<std::size_t>(copies), photon), parameters};
        run.inspection = {kernel_size / 2, kernel_size / 2, {}};
        splat(shot_, run);
        const auto photons = explained_photons();
        EXPECT_EQ(photons.size(), static_cast<std::size_t>(copies));
        return photons.empty() ? ExplainedPhoton{} : photons[0];
    }

    /// Of a tile, faced.
    double tile_area(const pm::Parameters& parameters) const {
        const double side = width(distance) * parameters.tile_size / kernel_size;
        return side * side;
    }
    static pm::Parameters unbounded() {
        auto parameters = plain_kernels();
        parameters.min_radius = 0;
        parameters.max_radius = 10;
        parameters.min_radius_texels = 0;
        return parameters;
    }
    /// In the tile right below the middle; s_l is 1.
    static SomePhoton middle() { return {.position_ws = {0.01f, -0.01f, 0}, .power = {2, 1, 0.5f}}; }
};

TEST_F(SplattingKernel, RadiusFollowsTheTilesDensity) {
    for (const int count : {1, 4, 25}) {
        const auto k = kernel(unbounded(), middle(), count);
        const double r = std::sqrt(tile_area(unbounded()) / (std::numbers::pi * count));
        EXPECT_NEAR(k.radius, r, 1e-4 * r) << count;
        EXPECT_NEAR(glm::length(k.axis_u), r, 2e-3 * r);
        EXPECT_NEAR(glm::length(k.axis_v), r, 2e-3 * r);
        EXPECT_NEAR(glm::length(k.axis_w), unbounded().normal_axis * r, 1e-3 * r);
        EXPECT_NEAR(k.contribution.r, 2 / (std::numbers::pi * r * r), 2e-3 * 2 / (std::numbers::pi * r * r));
        const double without_the_4 = 0.5 * r, printed_n_tile = 1;
        EXPECT_GT(std::abs(k.radius - without_the_4 * printed_n_tile), 0.3 * r);
    }
}

/// What a tile shows of a slanted surface is larger than what it shows of one that faces the viewer.
TEST_F(SplattingKernel, SlantedSurfacesHaveKernelsForAsManyPhotons) {
    for (const bool parallel : {false, true})
        for (const float cosine : {0.7f, 0.3f, 0.04f}) {
            const float sine = std::sqrt(1 - cosine * cosine);
            shot_ =
                Shot(wide_square(), camera_at({0, -distance * sine, distance * cosine}, {0, 0, 0}, parallel),
                     kernel_size, kernel_size);
            auto parameters = unbounded();
            SomePhoton photon{.position_ws = {0, 0, 0}};
            const double seen = parallel ? 4 * 4 / (64.0 * 64) * 256 : tile_area(parameters);
            const double area = seen / std::max(cosine, 0.1f);
            const auto k = kernel(parameters, photon, 4);
            EXPECT_NEAR(k.radius, std::sqrt(area / (4 * std::numbers::pi)), 2e-3 * k.radius) << cosine;
            parameters.max_radius = 1e-4f;
            parameters.min_radius_texels = 6;  // so that the kernel covers the pixel's middle
            const double texel = std::sqrt(area) / parameters.tile_size;
            EXPECT_NEAR(kernel(parameters, photon).radius, 6 * texel, 1e-2 * texel) << cosine;
        }
}

TEST_F(SplattingKernel, RadiusGrowsWithTheRootOfThePhotonsAskedFor) {
    auto parameters = unbounded();
    const auto one = kernel(parameters, middle());
    parameters.kernel_scale = 9;
    const auto nine = kernel(parameters, middle());
    EXPECT_NEAR(nine.radius, 3 * one.radius, 1e-4 * nine.radius);
}

TEST_F(SplattingKernel, RadiusIsBounded) {
    auto parameters = unbounded();
    parameters.min_radius = 0.1f;
    EXPECT_NEAR(kernel(parameters, middle(), 100).radius, 0.1 * radius_, 1e-4 * radius_);
    parameters = unbounded();
    parameters.max_radius = 0.01f;
    EXPECT_NEAR(kernel(parameters, middle()).radius, 0.01 * radius_, 1e-5 * radius_);
    parameters.kernel_scale = 4;  // after the bounds
    EXPECT_NEAR(kernel(parameters, middle()).radius, 0.02 * radius_, 1e-5 * radius_);
    parameters.min_radius = 0.5f;  // contradicting bounds: the least counts
    EXPECT_NEAR(kernel(parameters, middle()).radius, radius_, 1e-4 * radius_);
}

TEST_F(SplattingKernel, ShortRaysHaveSmallKernelsDownToTheFloor) {
    const auto parameters = unbounded();
    const float l_max = parameters.ray_length_scale * radius_;
    const double full = kernel(parameters, middle()).radius;
    for (const auto& [part, expected] :
         {std::pair{2.0f, 1.0}, {0.5f, 0.5}, {0.1f, 0.1}, {0.01f, 0.1}, {0.0f, 0.1}}) {
        auto photon = middle();
        photon.position_ws = {0.02f, -0.02f, 0};
        auto enlarged = parameters;
        enlarged.kernel_scale = 100;  // so that the smallest still covers the pixel
        photon.ray_length = part * l_max;
        EXPECT_NEAR(kernel(enlarged, photon).radius, 10 * expected * full, 1e-3 * full) << part;
    }
}

TEST_F(SplattingKernel, KernelsAreNoSmallerThanTexels) {
    auto parameters = unbounded();
    parameters.max_radius = 1e-4f;
    parameters.min_radius_texels = 1.5f;
    EXPECT_NEAR(kernel(parameters, middle()).radius, 1.5 * width(distance) / kernel_size, 1e-5);
    parameters.splat_resolution = pm::SplatResolution::quarter;
    auto photon = middle();
    EXPECT_NEAR(kernel(parameters, photon).radius, 4 * 1.5 * width(distance) / kernel_size, 1e-4);
}

TEST(ProgressiveRadii, ShrinkAsTheProductOfTheirSteps) {
    for (const float decay : {0.3f, 2.0f / 3, 1.0f}) {
        double squared = 1;
        for (int frame = 0; frame < 200; ++frame) {
            const double shrinking = passes::progressive_shrinking(frame, decay);
            EXPECT_NEAR(shrinking * shrinking, squared, 1e-5 * squared) << frame;
            squared *= (frame + 1 + decay) / (frame + 2);
        }
        EXPECT_TRUE(decay < 1 || squared == 1);
    }
}

TEST_F(SplattingKernel, LightFromTheSideStretchesUpToALimit) {
    for (const float cosine : {1.0f, 0.8f, 0.5f, 0.1f, 0.0f}) {
        auto photon = middle();
        photon.direction =
            glm::vec3(0.6f * std::sqrt(1 - cosine * cosine), -0.8f * std::sqrt(1 - cosine * cosine), cosine);
        const auto k = kernel(unbounded(), photon);
        const double s_u = std::min(cosine > 0 ? 1.0 / cosine : 1e9, 3.0);
        EXPECT_NEAR(glm::length(k.axis_u) / k.radius, s_u, 0.01 * s_u) << cosine;
        EXPECT_NEAR(glm::length(k.axis_v) / k.radius, 1, 1e-3);
        EXPECT_NEAR(k.contribution.g * std::numbers::pi * s_u * k.radius * k.radius, 1, 0.01)
            << "E = Φ / (π ‖u‖ ‖t‖)";
        EXPECT_NEAR(glm::dot(k.axis_u, k.axis_v), 0, 1e-4);
        EXPECT_NEAR(glm::dot(k.axis_u, k.axis_w), 0, 1e-4);
        EXPECT_NEAR(std::abs(k.axis_u.z), 0, 2e-3 * k.radius);
        if (cosine < 0.9f) {
            EXPECT_NEAR(glm::dot(glm::normalize(k.axis_u), glm::vec3(0.6f, -0.8f, 0)), 1, 1e-3);
        }
    }
}

TEST_F(SplattingKernel, ParallelViewsHaveTilesOfOneSize) {
    for (const float z : {0.0f, 2.0f}) {
        shot_ = Shot(wide_square(), camera_at({0, 0, distance}, {0, 0, 0}, true), kernel_size, kernel_size);
        auto photon = middle();
        photon.position_ws.z = z;
        auto parameters = unbounded();
        parameters.normal_axis = 10;  // reaches down to the plane
        const double tile = 4.0 * parameters.tile_size / kernel_size;
        EXPECT_NEAR(kernel(parameters, photon).radius, tile / std::sqrt(std::numbers::pi), 1e-4) << z;
    }
}

/// The tile that a point is in, on the host; texels are about their pixels' middles.
glm::ivec2 tile_of(const Shot& shot, glm::vec3 position_ws, int divisor, int texels) {
    const auto clip = shot.view.clip_from_world() * glm::vec4(position_ws, 1);
    const glm::vec2 px((clip.x / clip.w * 0.5f + 0.5f) * float(shot.view.width),
                       (0.5f - clip.y / clip.w * 0.5f) * float(shot.view.height));
    const float from_middle = pm::pixel_of_texel(divisor) + 0.5f;
    return glm::ivec2(((px - from_middle) / float(divisor) + 0.5f) / float(texels));
}

TEST_F(SplattingKernel, TilesCountThePhotonsThatFaceTheViewer) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-3, 3);
    for (const int divisor : {1, 2, 4}) {
        shot_ = Shot(wide_square(), camera_at({1, 2, distance}, {0, 0, 0}), 72, 56);
        SplatRun run;
        run.parameters.splat_resolution = static_cast<pm::SplatResolution>(divisor / 2);
        run.parameters.tile_size = 5;
        std::map<std::pair<int, int>, int> expected;
        int inside = 0;
        for (int i = 0; i < 3000; ++i) {
            SomePhoton photon{.position_ws = {place(random), place(random), 0}};
            if (i % 5 == 0) photon.normal.z = -1;
            if (i % 7 == 0) photon.position_ws.z = 20;  // behind the camera
            run.photons.push_back(photon);
            if (i % 5 == 0 || i % 7 == 0) continue;
            const auto clip = pm::clip_from_world(shot_.view, divisor) * glm::vec4(photon.position_ws, 1);
            if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
            const auto tile = tile_of(shot_, photon.position_ws, divisor, 5);
            ++expected[{tile.x, tile.y}];
            ++inside;
        }
        splat(shot_, run);
        const auto tiles = read("splat.tiles");
        ASSERT_EQ(tiles.width, (72 + 5 * divisor - 1) / (5 * divisor));
        int sum = 0, different = 0;
        for (int y = 0; y < tiles.height; ++y)
            for (int x = 0; x < tiles.width; ++x) {
                sum += static_cast<int>(tiles.at(x, y));
                different += std::abs(static_cast<int>(tiles.at(x, y)) - expected[{x, y}]);
            }
        EXPECT_NEAR(sum, inside, 2);
        EXPECT_LE(different, 8) << "a photon on a border may be rounded to either side";
        EXPECT_GT(inside, 800);
    }
}

}  // namespace
}  // namespace ir::test
