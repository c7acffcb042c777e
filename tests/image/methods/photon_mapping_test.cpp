// The whole pipeline: light arrives as the reference says, and neither small buffers nor slices change a bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "app/engine/pictures.h"
#include "tests/device_fixture.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

/// What both methods compute here: one bounce between diffuse surfaces.
const Settings photon_bounce{{"paths", std::string("indirect")},
                             {"max_bounces", std::int64_t{1}},
                             {"materials", std::string("lambert")},
                             {"normal_maps", false}};

struct Picture {
    Image image;
    std::map<std::string, std::vector<std::byte>> buffers;
    FrameReport report;
};

/// A corner of the still life's room, 96 x 64 pixels, lit by its spot and its point light.
/// With `intensity` a point light of so many W/sr instead.
Picture still_life(const std::string& method, const Settings& more, Inspection inspection = {},
                   float intensity = 0) {
    engine::Experiment experiment;
    experiment.scene = "builtin:still-life?detail=0.3";
    experiment.method = method;
    experiment.settings = photon_bounce;
    for (const auto& [key, value] : more) experiment.settings[key] = value;
    if (intensity > 0) {
        scene::Light light;
        light.position = {-1.1f, 1.9f, 0.6f};
        light.intensity = intensity;
        experiment.lights = {light};
        experiment.replace_lights = true;
    }
    experiment.width = 96;
    experiment.height = 64;
    experiment.seed = 3;
    engine::Execution execution(machine(), experiment);
    execution.inspect(std::move(inspection));
    graph::FrameOptions options;
    options.wanted = {"radiance", "photons.records", "splat.explain.*"};
    Picture picture;
    picture.report = execution.run_frame(options);
    picture.image = main_result(execution);
    for (const auto* key : {"photons.records", "splat.explain.sum"})
        if (auto bytes = execution.graph().read_buffer(key)) picture.buffers[key] = std::move(*bytes);
    return picture;
}

double mean_of(const Image& image, int x0, int y0, int width, int height) {
    double sum = 0;
    for (int y = y0; y < y0 + height; ++y)
        for (int x = x0; x < x0 + width; ++x) sum += image.at(x, y, 1);
    return sum / (width * height);
}

const Settings unfiltered{{"filter_passes", std::int64_t{0}},
                          {"temporal", false},
                          {"sum_precision", std::string("single-float")},
                          {"tracer", std::string("embree")}};

// A flat wall, whose kernels are neither cut by edges nor bent: n = 400 pixels. Seeds were measured to spread
// its mean by 0.8 % with 1.6 million photons, so by 1.6 % with 400,000; 6.5 % is 3.9 times that (alpha =
// 1e-4).
TEST(PhotonMappingPicture, WallsGetTheLightThatTheReferenceSays) {
    const auto truth = still_life("reference", {{"samples", std::int64_t{256}}}).image;
    const auto expected = mean_of(truth, 0, 0, 20, 20);
    for (const char* first_hit : {"rsm", "traced"}) {
        const auto picture =
            still_life("photon-mapping", with(unfiltered, {{"photons", std::int64_t{400000}},
                                                           {"first_hit", std::string(first_hit)}}))
                .image;
        EXPECT_NEAR(mean_of(picture, 0, 0, 20, 20) / expected, 1, 0.065) << first_hit;
    }
    // the printed scaling of power takes 0.617 of a cone's light
    const auto printed =
        still_life("photon-mapping", with(unfiltered, {{"photons", std::int64_t{400000}},
                                                       {"power_scaling", std::string("printed")}}))
            .image;
    EXPECT_GT(std::abs(mean_of(printed, 0, 0, 20, 20) / expected - 1), 0.065);
}

// The same photons, found by marching through three layered depth maps: what falls through their texels is
// lost.
TEST(PhotonMappingPicture, ALayeredDepthCubeFindsAlmostTheSamePhotons) {
    const Settings few{
        {"photons", std::int64_t{50000}}, {"filter_passes", std::int64_t{0}}, {"temporal", false}};
    const auto exact = still_life("photon-mapping", with(few, {{"tracer", std::string("embree")}}));
    std::map<std::string, double> errors;
    for (const std::string maps : {"all", "closest"}) {
        const auto marched =
            still_life("photon-mapping", with(few, {{"tracer", std::string("cube")}, {"cube_maps", maps}}));
        if (maps == "all") {
            EXPECT_NEAR(
                marched.report.counters.at("photons.count") / exact.report.counters.at("photons.count"), 1,
                0.03);
            EXPECT_NEAR(mean_of(marched.image, 0, 0, 96, 64) / mean_of(exact.image, 0, 0, 96, 64), 1, 0.05);
        }
        for (std::size_t i = 0; i < exact.image.pixels.size(); ++i)
            errors[maps] += std::abs(double{marched.image.pixels[i]} - double{exact.image.pixels[i]});
    }
    EXPECT_GT(errors["all"], 0);
    EXPECT_LT(errors["all"], 0.5 * errors["closest"]);
}

TEST(PhotonMappingPicture, BuffersThatStartAThousandTimesTooSmallGiveTheSamePicture) {
    const auto large = still_life("photon-mapping", {{"photons", std::int64_t{50000}}});
    const auto small = still_life("photon-mapping", {{"photons", std::int64_t{50000}}, {"reserve", 0.001}});
    EXPECT_EQ(large.image.pixels, small.image.pixels);
    EXPECT_EQ(small.report.counters.at("photons.count"), large.report.counters.at("photons.count"));
    EXPECT_GT(small.report.counters.at("growth"), 0);
}

TEST(PhotonMappingPicture, SumsBeyondHalfFloatsAreCutOffAndCounted) {
    const Settings few{{"photons", std::int64_t{2000}}};
    const auto half = still_life("photon-mapping", few, {}, 1e7f);
    for (const float value : half.image.pixels) ASSERT_TRUE(std::isfinite(value));
    EXPECT_GT(half.report.counters.at("splat.overflow"), 0);
    const auto single =
        still_life("photon-mapping", with(few, {{"sum_precision", std::string("single-float")}}), {}, 1e7f);
    EXPECT_EQ(single.report.counters.at("splat.overflow"), 0);
}

TEST(PhotonMappingPicture, ThePickedPixelIsTheSumOfItsPhotons) {
    const auto picture =
        still_life("photon-mapping",
                   with(unfiltered, {{"photons", std::int64_t{50000}}, {"kernel_scale", 4.0}}), {48, 10, {}});
    const auto& bytes = picture.buffers.at("splat.explain.sum");
    struct {
        std::uint32_t x, y, photons;
        float gathered[3], pixel[3], difference[3];
    } sum;
    ASSERT_GE(bytes.size(), sizeof(sum));
    std::memcpy(&sum, bytes.data(), sizeof(sum));
    EXPECT_GT(sum.photons, 0u);
    EXPECT_GT(sum.gathered[0], 0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum.gathered[i], sum.pixel[i], 1e-5f * sum.pixel[i]) << i;
}

/// Indirect light of Lambert surfaces, of a view of the Cornell box.
Image cornell(const std::string& method, const Settings& more, int size, int frames = 1,
              std::optional<Processor> processor = {}) {
    engine::Experiment experiment;
    experiment.scene = "builtin:cornell";
    experiment.method = method;
    experiment.settings = photon_bounce;
    for (const auto& [key, value] : more) experiment.settings[key] = value;
    experiment.width = experiment.height = size;
    experiment.seed = 3;
    machine().set_processor(processor);
    engine::Execution execution(machine(), experiment);
    graph::FrameOptions options;
    options.wanted = {"radiance"};
    for (int i = 0; i < frames; ++i) {
        const auto report = execution.run_frame(options);
        if (processor) {
            EXPECT_EQ(ran_on_host(report, "splat"), *processor == Processor::host);
        }
    }
    machine().set_processor({});
    return main_result(execution);
}

double mean_of(const Image& image) {
    return mean_of(image, 0, 0, image.width, image.height);
}

/// The same photons, so that only what texels stand for differs.
TEST(PhotonMappingPicture, LowResolutionsHaveTheLightOfTheFullOne) {
    const auto light = [](const char* resolution) {
        return mean_of(cornell("photon-mapping", {{"splat_resolution", std::string(resolution)}}, 128));
    };
    const double full = light("full");
    EXPECT_NEAR(light("half") / full, 1, 0.01);
    EXPECT_NEAR(light("quarter") / full, 1, 0.03);
}

/// Rays, kernels and filters of the host against those of the device: edges and rounding differ.
TEST(PhotonMappingPicture, TheHostsPictureIsTheDevices) {
    const auto device = cornell("photon-mapping", {}, 96, 2, Processor::gl);
    const auto host = cornell("photon-mapping", {}, 96, 2, Processor::host);
    double squared = 0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) squared += std::pow(device.at(x, y, 1) - host.at(x, y, 1), 2);
    const double mean = mean_of(device);
    EXPECT_NEAR(mean_of(host) / mean, 1, 0.01);
    EXPECT_LT(std::sqrt(squared) / 96, 0.05 * mean);
}

/// Root mean square error over the mean, of all pixels that see a surface.
double relative_error(const Image& image, const Image& truth) {
    double squared = 0, sum = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            squared += std::pow(image.at(x, y, 1) - truth.at(x, y, 1), 2);
            sum += truth.at(x, y, 1);
        }
    const auto pixels = static_cast<double>(truth.width) * truth.height;
    return std::sqrt(squared / pixels) / (sum / pixels);
}

/// The variance of a mean of K frames goes with K^-α, and the blur of large surfaces with K^(α-1): with α =
/// 2/3 both errors go with K^-1/3. In bands along edges, whose width goes with the radius, the error goes
/// with K^-1/12.
TEST(PhotonMappingPicture, ProgressiveRadiiConverge) {
    const Settings progressive{{"accumulation", std::string("progressive")},
                               {"filter_passes", std::int64_t{0}},
                               {"photons", std::int64_t{20000}},
                               {"kernel_scale", 4.0}};
    const auto truth = cornell("reference", {{"samples", std::int64_t{1024}}}, 32);
    const double few = relative_error(cornell("photon-mapping", progressive, 32, 4), truth);
    const double many = relative_error(cornell("photon-mapping", progressive, 32, 64), truth);
    const double slope = std::log(many / few) / std::log(64.0 / 4);
    RecordProperty("slope", std::to_string(slope));
    EXPECT_LT(slope, -0.2) << few << " after 4 frames, " << many << " after 64";
    EXPECT_GT(slope, -0.4) << few << " after 4 frames, " << many << " after 64";
}

}  // namespace
}  // namespace ir::test
