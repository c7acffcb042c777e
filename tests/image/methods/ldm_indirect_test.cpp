// The whole pipeline: light arrives as the reference says, whatever buffers start with, in how many batches
// maps are built, and how footprints are added up; and every watt and every pixel is accounted for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "app/engine/pictures.h"
#include "tests/image/methods/every_method.h"
#include "tests/image/methods/flat_pixels.h"

namespace ir::test {
namespace {

/// What both methods compute here: one bounce between diffuse surfaces.
const Settings diffuse_bounce{
    {"paths", std::string("indirect")}, {"materials", std::string("lambert")}, {"normal_maps", false}};

Settings indirect_maps(int directions, int resolution, int emission) {
    return {{"directions", std::int64_t{directions}},
            {"resolution", std::int64_t{resolution}},
            {"emission", std::int64_t{emission}}};
}

/// A picture of 48 x 48 pixels; where its light is all that counts, of 32 x 32.
struct Setting {
    engine::Experiment experiment;
    graph::FrameOptions options = {};
    Inspection inspection = {};
    int frames = 1;
};

/// The Cornell box with one spot of `intensity` W/sr under its ceiling in place of its lamp.
Setting cornell(const std::string& method, const Settings& more, float intensity = 1) {
    Setting s;
    s.experiment.scene = "builtin:cornell?emission=0";
    s.experiment.camera_name = "front";
    s.experiment.method = method;
    s.experiment.settings = with(diffuse_bounce, more);
    scene::Light spot;
    spot.type = scene::LightType::spot;
    spot.position = {0, 0.53f, -0.28f};
    spot.direction = {0, -1, 0};
    spot.intensity = intensity;
    spot.inner_angle = 0.8f, spot.outer_angle = 0.96f;
    s.experiment.lights = {spot};
    s.experiment.replace_lights = true;
    s.experiment.environment = scene::Environment{glm::vec3(0), nullptr};
    s.experiment.width = s.experiment.height = 48;
    return s;
}

/// The atrium, with textures and alpha masks, and a point light over its court.
Setting atrium(const Settings& more) {
    auto s = cornell("ldm-indirect", more);
    s.experiment.scene = "builtin:atrium?detail=0.05";
    s.experiment.camera_name = "nave";
    scene::Light point;
    point.position = {0, 4, 0};
    point.intensity = 300;
    point.range = 14;
    s.experiment.lights = {point};
    return s;
}

struct Rendered {
    Image image;
    FrameReport report;
    std::vector<std::byte> photons, sum, energy;
    Image normal, position;
};

Rendered render(Setting setting) {
    engine::Execution execution(machine(), setting.experiment);
    execution.inspect(setting.inspection);
    for (int frame = 1; frame < setting.frames; ++frame) execution.run_frame({});
    setting.options.wanted = {"radiance", "indirect.photons", "indirect.energy", "gbuffer.*"};
    if (setting.inspection.x >= 0) setting.options.wanted.push_back("indirect.explain.sum");
    Rendered picture;
    picture.report = execution.run_frame(setting.options);
    picture.image = main_result(execution);
    picture.normal = execution.graph().read_image("gbuffer.geometric_normal").value();
    picture.position = execution.graph().read_image("gbuffer.position").value();
    const auto bytes = [&](const char* key) {
        auto found = execution.graph().read_buffer(key);
        const auto device = execution.graph().device_buffer(key);
        if (!found || !device) return std::vector<std::byte>{};
        found->resize(std::min<std::size_t>(found->size(), device->elements * graph::stride(device->desc)));
        return std::move(*found);
    };
    picture.photons = bytes("indirect.photons");
    picture.energy = bytes("indirect.energy");
    picture.sum = bytes("indirect.explain.sum");
    return picture;
}

double mean(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (int(i) % image.channels < 3) sum += image.pixels[i];
    return sum / (3.0 * image.width * image.height);
}

/// Root mean square difference over the mean of the reference.
double relative_rmse(const Image& image, const Image& reference) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) sum += std::pow(double(image.at(x, y, c)) - reference.at(x, y, c), 2);
    return std::sqrt(sum / (3.0 * image.width * image.height)) / mean(reference);
}

float max_different(const Image& a, const Image& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    float most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
    return most;
}

/// The picture alone, after so many frames.
Image after(const Setting& setting, int frames) {
    engine::Execution execution(machine(), setting.experiment);
    for (int frame = 0; frame < frames; ++frame) execution.run_frame({});
    return main_result(execution);
}

/// Mean of the picture.
double light_of(Setting setting) {
    setting.experiment.width = setting.experiment.height = 32;
    return mean(after(setting, 1));
}

/// The box by the reference.
const Rendered& truth_of_box() {
    static const auto truth = render(cornell("reference", {{"samples", std::int64_t{1024}}}));
    return truth;
}

// The method has no random numbers. Measured: flat pixels have 1.002 of their light; the picture has 0.98, as
// footprints hang over edges, and 0.95 if hidden photons are rejected; its RMSE is 0.20 of its mean at most,
// 0.06 of that the reference's noise. The mutant, a tenth more light, is rejected.
TEST(LdmIndirectPicture, IsAsBrightAsTheReferenceSays) {
    const auto& truth = truth_of_box();
    const auto flat = flat_pixels(truth.normal, truth.position, 3, 0.008f);
    ASSERT_GT(flat.size(), 300u);
    const auto light = [&](const Image& image) {
        double found = 0, expected = 0;
        for (const auto& p : flat)
            for (int c = 0; c < 3; ++c) {
                found += image.at(p.x, p.y, c);
                expected += truth.image.at(p.x, p.y, c);
            }
        return found / expected;
    };
    const auto picture = render(cornell("ldm-indirect", indirect_maps(96, 100, 48))).image;
    EXPECT_NEAR(light(picture), 1, 0.02);
    EXPECT_NEAR(mean(picture) / mean(truth.image), 0.983, 0.015);
    EXPECT_LT(relative_rmse(picture, truth.image), 0.22);
    const auto brighter = render(cornell("ldm-indirect", indirect_maps(96, 100, 48), 1.1f)).image;
    EXPECT_GT(std::abs(light(brighter) - 1), 0.02);
    EXPECT_GT(relative_rmse(brighter, truth.image), 0.22);
}

// Directions turn, photons move and footprints shrink, so what few directions leave as blur and bands goes
// away, and so does what footprints lose. Measured: RMSE 0.22 of the mean after 32 frames.
TEST(LdmIndirectPicture, ProgressiveFramesConvergeToTheReference) {
    const auto& truth = truth_of_box().image;
    const auto frames = [&](int count, const Settings& more) {
        return after(
            cornell("ldm-indirect", with(with(indirect_maps(16, 100, 16), more), {{"progressive", true}})),
            count);
    };
    const auto first = frames(1, {}), last = frames(32, {}), as_wide = frames(32, {{"radius_decay", 1.0}});
    EXPECT_LT(relative_rmse(last, truth), 0.6 * relative_rmse(first, truth));
    EXPECT_LT(mean(as_wide), mean(last)) << "footprints shrink";
    EXPECT_NEAR(mean(last) / mean(truth), 0.99, 0.02);
    const auto alone = after(cornell("ldm-indirect", indirect_maps(16, 100, 16)), 2);
    EXPECT_EQ(alone.pixels, after(cornell("ldm-indirect", indirect_maps(16, 100, 16)), 1).pixels);
}

// What each further bounce adds. Footprints of photons that are everywhere lose more than those of a spot's:
// 0.99 of the first, two seeds have 0.94 and 0.96 of the second, 0.92 and 0.98 of the third; four times the
// photons 0.99 and 0.98.
TEST(LdmIndirectPicture, FurtherBouncesAddWhatTheReferenceSays) {
    double before = 0, before_truth = 0;
    for (const std::int64_t bounces : {1, 2, 3}) {
        const Settings many{{"max_bounces", bounces}};
        const double truth = light_of(cornell("reference", with(many, {{"samples", std::int64_t{512}}}))),
                     light = light_of(cornell("ldm-indirect", with(many, indirect_maps(64, 100, 96))));
        EXPECT_GT(truth, 1.1 * before_truth);
        EXPECT_NEAR((light - before) / (truth - before_truth), 0.97, 0.08) << bounces;
        before = light, before_truth = truth;
    }
}

/// A room with the sources that it has, and those given.
Setting room(const std::string& scene, const std::string& method, const Settings& more = {}) {
    auto s = cornell(method, more);
    s.experiment.scene = scene;
    s.experiment.lights.clear();
    s.experiment.replace_lights = false;
    if (!scene.starts_with("builtin:cornell")) s.experiment.camera_name.clear();
    return s;
}
double light_over_reference(const std::function<Setting(const std::string&, const Settings&)>& of,
                            const Settings& more = indirect_maps(128, 200, 64)) {
    return light_of(of("ldm-indirect", more)) / light_of(of("reference", {{"samples", std::int64_t{128}}}));
}

// Every kind of source, at the defaults, indirect light over all pixels; less in the shared room, whose lamp
// hangs a texel below the ceiling: with maps of 400² there is all its light.
TEST(LdmIndirectPicture, LampsAndTheSkyLightAsTheReferenceSays) {
    const auto panel = light_over_reference(
        [](const auto& method, const auto& more) { return room("builtin:cornell", method, more); });
    EXPECT_NEAR(panel, 1, 0.05) << "emissive mesh";
    for (const auto type : {scene::LightType::rectangle, scene::LightType::disk}) {
        const auto lamp = light_over_reference([&](const auto& method, const auto& more) {
            auto s = cornell(method, more);
            auto& light = s.experiment.lights.front();
            light.type = type;
            light.position = {0, 0.5f, -0.28f};
            light.size = {0.3f, 0.2f};
            return s;
        });
        EXPECT_NEAR(lamp, 1, 0.05) << "lamp";
    }
    const auto sky = light_over_reference([](const auto& method, const auto& more) {
        auto s = cornell(method, more);
        s.experiment.lights.clear();
        s.experiment.environment = scene::Environment{glm::vec3(0.5f, 1, 2), nullptr};
        return s;
    });
    EXPECT_NEAR(sky, 0.95, 0.1) << "environment";
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) return;
    const auto file = std::string(folder) + "/rooms/cornell-box/cornell-box.glb";
    const auto shipped =
        light_over_reference([&](const auto& method, const auto& more) { return room(file, method, more); });
    EXPECT_NEAR(shipped, 0.95, 0.04) << "cornell-box as shipped";
}

// At the defaults, over all pixels. Edges of carved stone lose light, and so do hairs, which are thinner than
// texels and footprints. Measured: 0.91, 0.55, 0.98.
TEST(LdmIndirectPicture, HallsAndHairHaveTheirLight) {
    const auto light = [](const std::string& scene, bool is_sponza = false) {
        return light_over_reference([&](const auto& method, const auto& more) {
            auto s = room(scene, method, more);
            if (!is_sponza) return s;
            auto& spot = s.experiment.lights.emplace_back();
            spot.type = scene::LightType::spot;
            spot.position = {-4, 6, 0};
            spot.direction = {0, -1, 0};
            spot.intensity = 300;
            spot.outer_angle = 1;
            s.experiment.replace_lights = true;
            s.experiment.camera.emplace();
            s.experiment.camera->eye = {-10, 2, 0};
            s.experiment.camera->target = {0, 3, 0};
            return s;
        });
    };
    EXPECT_NEAR(light("builtin:atrium"), 0.92, 0.06);
    EXPECT_NEAR(light("builtin:hairball"), 0.55, 0.12);
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) return;
    EXPECT_NEAR(light(std::string(folder) + "/sponza.glb", true), 0.99, 0.05);
}

// What an open plane reflects of a constant sky is ρ L; in a room maps and samples find the same light.
TEST(LdmIndirectPicture, MapsAndSamplesFindTheSameSky) {
    const auto under = [](const std::string& scene, const glm::vec3& sky, const Settings& more) {
        auto s = room(scene, "ldm-indirect", with(indirect_maps(64, 100, 16), more));
        s.experiment.camera_name = scene == "builtin:plane" ? "top" : "front";
        s.experiment.settings["paths"] = std::string("direct");
        s.experiment.replace_lights = true;
        s.experiment.environment = scene::Environment{sky, nullptr};
        return render(s).image;
    };
    const Settings maps{{"environment_by", std::string("maps")}};
    const auto single = under("builtin:plane", glm::vec3(1), maps),
               twice = under("builtin:plane", glm::vec3(2), maps);
    EXPECT_GT(single.at(24, 24, 0), 0.1f);
    EXPECT_EQ(twice.at(24, 24, 0), 2 * single.at(24, 24, 0));
    const auto plane = under("builtin:plane", glm::vec3(1), {{"light_samples", std::int64_t{256}}});
    EXPECT_NEAR(single.at(24, 24, 0) / plane.at(24, 24, 0), 1, 1e-3);
    const auto by_maps = under("builtin:cornell?emission=0", {0.5f, 1, 2}, maps),
               by_samples =
                   under("builtin:cornell?emission=0", {0.5f, 1, 2}, {{"light_samples", std::int64_t{64}}});
    EXPECT_NEAR(mean(by_maps) / mean(by_samples), 1, 0.03);
}

TEST(LdmIndirectPicture, BuffersThatStartAThousandTimesTooSmallGiveTheSamePicture) {
    auto large = cornell("ldm-indirect", with(indirect_maps(48, 64, 32), {{"reserve", 1.0}}));
    auto small = cornell("ldm-indirect", with(indirect_maps(48, 64, 32), {{"reserve", 0.001}}));
    small.options.initial_capacity = 0.001;
    const auto expected = render(large), grown = render(small);
    EXPECT_EQ(expected.report.counters.at("growth"), 0);
    EXPECT_GT(grown.report.counters.at("growth"), 0);
    EXPECT_GT(expected.photons.size(), 64u * 1000);
    EXPECT_EQ(grown.photons, expected.photons);
    EXPECT_EQ(grown.image.pixels, expected.image.pixels);
}

TEST(LdmIndirectPicture, BatchesOfMapsChangeNothingButRounding) {
    // On the device: the host streams its maps, which are arrays.
    auto setting =
        cornell("ldm-indirect", with(indirect_maps(64, 160, 16), {{"storage", std::string("linked-lists")}}));
    const auto whole = render(setting);
    setting.options.memory_budget = whole.report.peak_memory_bytes * 6 / 10;
    const auto divided = render(setting);
    ASSERT_GT(divided.report.counters.at("batches"), 1);
    EXPECT_EQ(divided.report.counters.at("indirect.count"), whole.report.counters.at("indirect.count"));
    EXPECT_LT(max_different(divided.image, whole.image), 1e-5);
    EXPECT_GT(mean(whole.image), 0.03);
}

TEST(LdmIndirectPicture, AllWaysOfSplattingAgree) {
    const auto quads = render(atrium(indirect_maps(32, 64, 24))).image;
    ASSERT_GT(mean(quads), 0.01);
    for (const char* way : {"tiles", "image-atomics"}) {
        const auto other =
            render(atrium(with(indirect_maps(32, 64, 24), {{"splatting", std::string(way)}}))).image;
        EXPECT_LT(max_different(other, quads),
                  2e-5 * *std::max_element(quads.pixels.begin(), quads.pixels.end()))
            << way;
    }
}

// Nothing is stored then. Lists are the device's, as the host would trace the others.
TEST(LdmIndirectPicture, PhotonsMayBeSplattedWhileTheyAreTraced) {
    const auto by = [](const char* way, const Settings& more) {
        return with(more, {{"splatting", std::string(way)}, {"storage", std::string("linked-lists")}});
    };
    const auto largest = [](const Image& image) {
        return *std::max_element(image.pixels.begin(), image.pixels.end());
    };
    const auto leaves = with(indirect_maps(32, 64, 12), {{"splat_size", 4.0}});
    const auto stored = render(atrium(by("image-atomics", leaves))).image;
    EXPECT_LT(max_different(render(atrium(by("one-pass", leaves))).image, stored), 2e-5 * largest(stored));
    EXPECT_GT(mean(stored), 0.01);
    for (const auto& more :
         {Settings{{"progressive", true}},
          Settings{{"clipping", std::string("none")}, {"overhang", std::string("returned")}}}) {
        const auto box = with(indirect_maps(40, 160, 12), more);
        const auto expected = render(cornell("ldm-indirect", by("image-atomics", box))).image;
        auto setting = cornell("ldm-indirect", by("one-pass", box));
        const auto whole = render(setting);
        EXPECT_LT(max_different(whole.image, expected), 2e-5 * largest(expected));
        setting.options.memory_budget = whole.report.peak_memory_bytes * 7 / 10;
        const auto divided = render(setting);
        EXPECT_GT(divided.report.counters.at("batches"), 1);
        EXPECT_LT(max_different(divided.image, expected), 2e-5 * largest(expected));
        EXPECT_GT(mean(whole.image), 0.03);
    }
    // What needs stored photons has them, and is told.
    const Settings exact{{"tracer", std::string("embree")}};
    const auto noted =
        render(cornell("ldm-indirect", by("one-pass", with(indirect_maps(24, 60, 12), exact))));
    EXPECT_TRUE(std::ranges::any_of(noted.report.messages, [](const auto& message) {
        return message.text.find("another tracer") != std::string::npos;
    }));
    EXPECT_GT(mean(noted.image), 0.03);
}

TEST(LdmIndirectPicture, ThePickedPixelIsTheSumOfItsPhotons) {
    struct Sum {
        std::uint32_t x, y, photons;
        float gathered[3], direct[3], pixel[3], difference[3];
    };
    for (const glm::ivec2 pixel : {glm::ivec2(24, 40), glm::ivec2(8, 20), glm::ivec2(24, 20)}) {
        auto setting = atrium(indirect_maps(32, 64, 24));
        setting.inspection.x = pixel.x, setting.inspection.y = pixel.y;
        setting.experiment.settings["progressive"] = pixel.x == 8;
        setting.frames = pixel.x == 8 ? 3 : 1;
        const auto bytes = render(setting).sum;
        ASSERT_EQ(bytes.size(), sizeof(Sum));
        Sum sum;
        std::memcpy(&sum, bytes.data(), sizeof sum);
        EXPECT_GT(sum.photons, 0u) << pixel.x;
        EXPECT_GT(sum.gathered[1], 0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum.gathered[c], sum.pixel[c], 1e-5f * sum.pixel[c]) << pixel.x << " channel " << c;
    }
}

TEST(LdmIndirectPicture, EveryWattIsAccountedFor) {
    struct Row {
        std::uint32_t cause, leg, photons;
        float flux[3];
    };
    for (const bool reject : {true, false}) {
        auto setting =
            atrium(with(indirect_maps(32, 64, 24), {{"reject_hidden", reject}, {"progressive", !reject}}));
        setting.frames = reject ? 1 : 3;
        const auto bytes = render(setting).energy;
        ASSERT_GE(bytes.size(), 14 * sizeof(Row));
        std::vector<Row> rows(bytes.size() / sizeof(Row));
        std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(Row));
        for (int c = 0; c < 3; ++c) {
            double found = 0;
            for (std::size_t i = 1; i < 14; ++i) found += rows[i].flux[c];
            EXPECT_GT(rows[0].flux[c], 1000);  // 300 W/sr all round
            EXPECT_NEAR(found / rows[0].flux[c], 1, 1e-4) << c;
        }
        EXPECT_GT(rows[12].flux[1], 0);
        EXPECT_GT(rows[2].flux[1], 0) << "the range takes something";
        EXPECT_EQ(rows[reject ? 9 : 13].photons > 0, true);
        EXPECT_EQ(rows[reject ? 13 : 9].photons, 0u);
    }
}

}  // namespace
}  // namespace ir::test
