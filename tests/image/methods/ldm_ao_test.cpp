// Ambient occlusion from layered depth maps against closed forms, and against itself with other storages,
// builders, batches and buffer sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "ldm_ao_fixture.h"
#include "renderers/passes/lights/environment_light.h"

namespace ir::ldm_ao_test {
namespace {

/// On either processor.
class LdmAoOnBoth : public LdmAo, public testing::WithParamInterface<Processor> {
  protected:
    LdmAoOnBoth() { processor = GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Processors, LdmAoOnBoth, testing::Values(Processor::gl, Processor::host),
                         [](const auto& info) { return to_string(info.param); });

TEST_P(LdmAoOnBoth, OfAnOpenPlaneIsExactlyOne) {
    load("builtin:plane");
    for (const int directions : {1, 2, 16, 128})
        for (const double reach : {0.0, 0.5})
            for (const char* name : {"top", "above"}) {
                const auto image =
                    render(camera(name), 32, 32, with(ao_maps(directions, 100), "max_distance", reach));
                for (const float value : image.pixels) ASSERT_EQ(value, 1) << directions << name;
            }
}

/// Brighter above and on one side.
scene::Environment uneven_sky() {
    Image map(32, 16, 3);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c)
                map.at(x, y, c) = float(c + 1) * (float(16 - y) + (x < 8 ? 10.0f : 0.0f)) / 16;
    return {glm::vec3(0), std::make_shared<const Image>(std::move(map))};
}

TEST_P(LdmAoOnBoth, AConstantSkyIsAmbientLight) {
    load("builtin:atrium?detail=0.1");
    const auto& view = world_.cameras.front();
    world_.lights.clear();  // shadow maps take most of the time
    environment().constant = glm::vec3(0.7f);
    for (const double reach : {0.0, 1.5})
        for (const char* falloff : {"hard", "smooth"}) {
            auto settings =
                with(with(ao_maps(33, 100), "max_distance", reach), "falloff", std::string(falloff));
            settings["ambient"] = 0.7;
            const auto ambient = render(view, 61, 43, settings, {}, 0, "lit");
            settings["ambient_source"] = std::string("environment");
            const auto sky = render(view, 61, 43, settings, {}, 0, "lit");
            EXPECT_GT(mean(ambient), 0.05);
            // On the host tiles and single points round depths by up to 1/128 of a quantum differently, and
            // a surface's own entries end within a few quanta of it: about one in 2,000 queries differs.
            std::size_t different = 0;
            for (std::size_t i = 0; i < sky.pixels.size(); ++i)
                different += std::abs(sky.pixels[i] - ambient.pixels[i]) > 1e-4f;
            EXPECT_LE(different, reach > 0 ? sky.pixels.size() / 50 : 0) << reach << falloff;
            EXPECT_LT(max_different(sky, ambient), 0.7f * 2 / 33) << reach << falloff;
        }
}

TEST_F(LdmAo, BothProcessorsSeeTheSameSky) {
    load("builtin:atrium?detail=0.1");
    environment() = uneven_sky();
    const auto& view = world_.cameras.front();
    auto settings = with(ao_maps(17, 270), "ambient_source", std::string("environment"));
    std::vector<Image> skies;
    for (const auto on : {Processor::gl, Processor::host, Processor::host}) {
        processor = on;
        threads = skies.size() == 1 ? 1 : 3;
        skies.push_back(render(view, 41, 29, settings, {}, 0, "ldm.sky"));
    }
    EXPECT_EQ(skies[1].pixels, skies[2].pixels);
    double difference = 0;
    for (std::size_t i = 0; i < skies[0].pixels.size(); ++i)
        difference += std::abs(double(skies[0].pixels[i]) - skies[1].pixels[i]);
    EXPECT_LT(difference / double(skies[0].pixels.size()) / mean(skies[0]), 0.002);
}

// E/π of an open plane is the integral of L cosθ over the sky above it, over π.
TEST_P(LdmAoOnBoth, AnOpenPlaneHasTheSkysLightHoweverTheRegionsAreTurned) {
    load("builtin:plane");
    environment() = uneven_sky();
    const passes::EnvironmentLight sky(environment());
    double expected = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double cosine = std::sqrt((i + 0.5) / n), turn = 2 * std::numbers::pi * (j + 0.5) / n,
                         sine = std::sqrt(1 - cosine * cosine);
            expected +=
                sky.radiance(glm::vec3(sine * std::cos(turn), cosine, sine * std::sin(turn))).r / (n * n);
        }
    auto settings = with(ao_maps(128, 50), "ambient_source", std::string("environment"));
    settings["progressive"] = true;
    for (int frame = 0; frame < 4; ++frame) {
        graph().reset_history();
        const auto image = render(camera("top"), 16, 16, settings, {}, frame, "ldm.sky");
        EXPECT_NEAR(image.at(8, 8, 0) / expected, 1, 0.01) << frame;
    }
}

TEST_F(LdmAo, UnderASecondPlaneTwoTexelsAboveIsNearZero) {
    load("builtin:plane?size=2&cover=0.028");  // texels of at most 2.83 m / 200
    const std::pair<const char*, const char*> ways[] = {
        {"arrays", "compute"}, {"arrays", "raster"}, {"linked-lists", "compute"}};
    for (const auto& [storage, builder] : ways) {
        auto settings = with(ao_maps(48, 200), "storage", std::string(storage));
        settings = with(settings, "builder", std::string(builder));
        const auto image = render(camera("under"), 24, 24, settings);
        EXPECT_LT(*std::max_element(image.pixels.begin(), image.pixels.end()), 0.05f) << storage << builder;
    }
}

/// Accessibility at distance d from an endless wall at right angles, with t = d / d_max < 1.
double corner_accessibility(double t) {
    return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
}

TEST_P(LdmAoOnBoth, NearACornerMatchesTheClosedForm) {
    EXPECT_NEAR(corner_accessibility(0.25), 0.657, 5e-4);
    EXPECT_NEAR(corner_accessibility(0.5), 0.804, 5e-4);
    EXPECT_NEAR(corner_accessibility(0.75), 0.928, 5e-4);
    // A wall of 2.2 m; t is right in the middle of rows 7, 15 and 23 of 31, from the far end.
    const auto rms = [&](Settings settings, int orientations) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> angle(0, 360);
        settings = with(settings, "max_distance", 1.0);
        double sum = 0;
        for (int i = 0; i < orientations; ++i) {
            const auto turn = [&](const char* key) { return key + std::to_string(angle(random)); };
            load("builtin:corner?size=2.2&" + turn("yaw=") + "&" + turn("pitch=") + "&" + turn("roll="));
            // The part of the wall within 1 m of the floor's edge.
            auto near = camera("wall");
            const auto down = glm::normalize(-near.up);
            near.eye += 0.6f * down;
            near.target += 0.6f * down;
            near.height = 1;
            const auto image = render(near, 2, 2 * 16, settings);
            for (const double t : {0.25, 0.5, 0.75}) {
                const int below =
                    static_cast<int>((1 - t) * 32);  // t lies between this row and the one before
                double found = 0;
                for (int x = 0; x < 2; ++x) found += 0.25 * (image.at(x, below - 1) + image.at(x, below));
                sum += std::pow(found - corner_accessibility(t), 2) / (3.0 * orientations);
            }
        }
        return std::sqrt(sum);
    };
    const double coarse = rms(ao_maps(128, 110), 8), fine = rms(ao_maps(512, 110), 4);
    std::printf("RMS error of 128 directions %.4f, of 512 %.4f\n", coarse, fine);
    EXPECT_LE(coarse, 0.02);
    EXPECT_LE(fine, 0.006);
}

TEST_P(LdmAoOnBoth, DoesNotLeakThroughWallsOfTwoTexels) {
    // Everything inside a chamber is closed. Through thinner walls the leaked fraction is only reported.
    load("builtin:crevice");
    geometry = "crevice";
    for (const auto* name : {"wall-4", "wall-2", "wall-1", "wall-half"})
        for (const double reach : {0.0, 100.0}) {  // with a limit nodes have slopes
            const double leaked =
                mean(render(camera(name), 40, 40, with(ao_maps(128, 200), "max_distance", reach)));
            std::printf("leaked through %s: %g\n", name, leaked);
            if (name == std::string("wall-4") || name == std::string("wall-2")) {
                EXPECT_EQ(leaked, 0) << name;
            }
        }
}

TEST_P(LdmAoOnBoth, LeaksWhereRaysMayDipFarBelowTheSurface) {
    load("builtin:crevice");
    const auto settings = with(ao_maps(128, 200), "max_dip", 64.0);
    EXPECT_GT(mean(render(camera("wall-2"), 40, 40, settings)), 0);
}

TEST_F(LdmAo, BuildersGiveSimilarPictures) {
    load("builtin:atrium?detail=0.1");
    for (const char* nodes : {"plain", "sloped"}) {
        const auto settings = with(with(ao_maps(16, 64), "max_distance", 2.0), "nodes", std::string(nodes));
        const auto compute = render(world_.cameras.front(), 48, 36, settings);
        const auto raster =
            render(world_.cameras.front(), 48, 36, with(settings, "builder", std::string("raster")));
        EXPECT_GT(mean(compute), 0.02);
        double difference = 0;
        for (std::size_t i = 0; i < compute.pixels.size(); ++i)
            difference += std::abs(compute.pixels[i] - raster.pixels[i]) / raster.pixels.size();
        EXPECT_LE(difference, 1e-3) << nodes;
    }
}

TEST_P(LdmAoOnBoth, NodesWithSlopesAreNearerToExactHits) {
    load("builtin:atrium?detail=0.3");
    const auto settings = with(ao_maps(32, 200), "max_distance", 0.2);
    const auto render_with = [&](const char* key, const char* value) {
        return render(camera("nave"), 80, 60, with(settings, key, std::string(value)));
    };
    const auto exact = render_with("exact", "all");
    struct Error {
        double rms = 0, mean = 0;
    };
    const auto error = [&](const char* nodes) {
        const auto found = render_with("nodes", nodes);
        const double count = double(exact.pixels.size());
        Error e;
        for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
            const double d = double{found.pixels[i]} - double{exact.pixels[i]};
            e.rms += d * d / count, e.mean += d / count;
        }
        e.rms = std::sqrt(e.rms);
        std::printf("%s nodes: RMS error %.4f, mean %+.4f\n", nodes, e.rms, e.mean);
        return e;
    };
    const auto plain = error("plain"), sloped = error("sloped");
    EXPECT_LT(sloped.rms, 0.92 * plain.rms);
    EXPECT_LT(std::abs(sloped.mean), 0.7 * std::abs(plain.mean));
}

TEST_F(LdmAo, StoragesGiveEqualPictures) {
    // Without a reach, any element of a sequence beyond the point may answer; with it, the nearest one does.
    for (const double reach : {0.0, 2.0}) {
        load(reach > 0 ? "builtin:atrium?detail=0.1" : "builtin:cornell");
        auto settings = with(with(ao_maps(8, 50), "max_distance", reach), "nodes", std::string("plain"));
        const auto expected = render(world_.cameras.front(), 48, 36, settings);
        EXPECT_GT(mean(expected), 0.02);
        settings = with(settings, "fixed_layers", std::int64_t(128));
        for (const auto& storage : find(method().description.parameters, "storage")->choices) {
            if (storage.key == "packed-arrays") continue;  // rounds depths
            SCOPED_TRACE(storage.key);
            const auto found = render(world_.cameras.front(), 48, 36, with(settings, "storage", storage.key));
            EXPECT_EQ(report.counters["ldm.dropped"], 0);
            EXPECT_EQ(found.pixels, expected.pixels);
        }
    }
}

TEST_F(LdmAo, OutermostDepthsAnswerHitsAtAnyDistanceAlone) {
    load("builtin:atrium?detail=0.3");
    const auto settings = with(ao_maps(16, 100), "nodes", std::string("plain")),
               outermost = with(settings, "storage", std::string("outermost"));
    const auto expected = render(camera("nave"), 96, 72, settings);
    const auto found = render(camera("nave"), 96, 72, outermost);
    EXPECT_EQ(found.pixels, expected.pixels);
    EXPECT_EQ(report.counters["ldm.bytes"], 4 * 16 * 100 * 100);
    EXPECT_LE(report.counters["ldm.nodes"], 2 * 16 * 100 * 100);
    EXPECT_GT(report.counters["ldm.between"], report.counters["ldm.nodes"]);
    const auto says = [&](const char* words) {
        return std::any_of(report.messages.begin(), report.messages.end(), [&](const auto& message) {
            return message.text.find(words) != std::string::npos;
        });
    };
    EXPECT_FALSE(says("storage=outermost"));
    render(camera("nave"), 48, 36, outermost, {}, 0, "ldm.self_hits");
    EXPECT_TRUE(says("storage=outermost: views of self-hits"));
    const Settings needs_more[] = {with(outermost, "max_distance", 2.0),
                                   with(outermost, "self_hit", std::string("normal-offset")),
                                   with(outermost, "exact", std::string("near"))};
    for (const auto& more : needs_more) {
        const auto instead = render(camera("nave"), 48, 36, more);
        EXPECT_TRUE(says("arrays are used"));
        EXPECT_EQ(instead.pixels,
                  render(camera("nave"), 48, 36, with(more, "storage", std::string("arrays"))).pixels);
        EXPECT_FALSE(says("arrays are used"));
    }
}

TEST_F(LdmAo, PackedArraysRoundDepthsAndLittleElse) {
    const std::string packed = "packed-arrays";
    load("builtin:atrium?detail=0.3");
    const auto settings = with(ao_maps(16, 100), "max_distance", 2.0);
    const auto exact = render(world_.cameras.front(), 48, 36, settings);
    const auto rounded = render(world_.cameras.front(), 48, 36, with(settings, "storage", packed));
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
        const double difference = rounded.pixels[i] - exact.pixels[i];
        squares += difference * difference, sum += difference;
    }
    const double rms = std::sqrt(squares / double(exact.pixels.size()));
    std::printf("RMS difference of packed arrays %.4f, mean %.4f\n", rms, sum / double(exact.pixels.size()));
    EXPECT_GT(rms, 0);
    EXPECT_LT(rms, 0.015);
    EXPECT_NEAR(sum / double(exact.pixels.size()), 0, 0.003);

    load("builtin:plane");
    const auto open = render(world_.cameras.front(), 32, 24, with(ao_maps(32, 100), "storage", packed));
    for (const float value : open.pixels) ASSERT_EQ(value, 1);

    load("builtin:crevice");
    EXPECT_EQ(mean(render(camera("wall-2"), 32, 32, with(ao_maps(32, 200), "storage", packed))), 0);
}

TEST_F(LdmAo, FixedArraysThatAreTooShortLoseOccludersAndSaySo) {
    load("builtin:atrium");
    const auto settings = with(with(ao_maps(8, 50), "max_distance", 2.0), "nodes", std::string("plain"));
    const double exact = mean(render(world_.cameras.front(), 48, 36, settings));
    for (const char* storage : {"fixed-arrays", "fixed-arrays-presorted"}) {
        double previous = 2;
        for (const int layers : {2, 8}) {
            auto fixed = with(settings, "fixed_layers", std::int64_t(layers));
            const double open =
                mean(render(world_.cameras.front(), 48, 36, with(fixed, "storage", std::string(storage))));
            EXPECT_GT(report.counters["ldm.dropped"], 0);
            EXPECT_TRUE(std::any_of(report.messages.begin(), report.messages.end(), [](const Message& m) {
                return m.severity == Severity::warning && m.text.find("fixed_layers") != std::string::npos;
            }));
            EXPECT_GE(open, exact);
            EXPECT_LT(open, previous) << layers;
            previous = open;
        }
    }
}

TEST_F(LdmAo, GrownBuffersGiveTheSamePictureAlsoAtFrameThree) {
    load("builtin:cornell");
    const auto settings = with(with(ao_maps(16, 64), "progressive", true), "max_distance", 0.7);
    const auto third = [&](double capacity) {
        reset();
        graph::FrameOptions options;
        options.initial_capacity = capacity;
        Image image;
        for (int frame = 0; frame < 4; ++frame)
            image = render(world_.cameras.front(), 32, 32, settings, options, frame);
        return image;
    };
    EXPECT_EQ(third(0.001).pixels, third(4).pixels);
}

TEST_F(LdmAo, BatchesGiveTheSamePicture) {
    load("builtin:cornell");
    for (const char* storage : {"arrays", "linked-lists"}) {
        reset();
        const auto settings = with(ao_maps(64, 100), "storage", std::string(storage));
        const auto whole = render(world_.cameras.front(), 32, 32, settings);
        EXPECT_EQ(report.counters["batches"], 1);
        const double fragments = report.counters["ldm.fragments"];
        reset();
        graph::FrameOptions options;
        options.memory_budget = report.peak_memory_bytes * 7 / 10;
        const auto parts = render(world_.cameras.front(), 32, 32, settings, options);
        EXPECT_GT(report.counters["batches"], 1);
        EXPECT_LE(report.peak_memory_bytes, options.memory_budget);
        EXPECT_EQ(report.counters["ldm.fragments"], fragments);
        EXPECT_LE(max_different(whole, parts), 1e-6f);
    }
}

TEST_P(LdmAoOnBoth, ProgressiveFramesConverge) {
    load("builtin:corner?size=4&yaw=20&pitch=33");
    const auto error_after = [&](int frames) {
        reset();
        auto near = camera("wall");
        near.height = 2;
        auto settings = with(with(ao_maps(16, 100), "progressive", true), "max_distance", 1.0);
        const auto down = glm::normalize(-near.up);
        near.eye += 1.0f * down;
        near.target += 1.0f * down;
        Image image;
        for (int frame = 0; frame < frames; ++frame) image = render(near, 4, 32, settings, {}, frame);
        double sum = 0;
        for (int y = 17; y < 30; ++y) {
            const double t = 2 * (32 - y - 0.5) / 32;
            sum += std::pow(image.at(1, y) - corner_accessibility(t), 2);
        }
        return std::sqrt(sum / 13);
    };
    const double last = error_after(24);
    EXPECT_LT(last, 0.5 * error_after(1));
    EXPECT_LT(last, 0.02);
}

TEST_P(LdmAoOnBoth, ViewsShowWhatTheyPromise) {
    load("builtin:corner");
    const auto view = camera("view");
    const auto settings = ao_maps(32, 100);
    const auto found = render(view, 48, 48, settings, {}, 0, "ldm.self_hits");
    const auto missing = render(view, 48, 48, settings, {}, 0, "ldm.missing");
    const auto normal = render(view, 48, 48, settings, {}, 0, "accessibility");
    int own = 0;
    for (std::size_t i = 0; i < found.pixels.size(); ++i) {
        EXPECT_LE(found.pixels[i] + missing.pixels[i], 1.0001f);
        own += found.pixels[i] > 0.9f;
    }
    EXPECT_GT(own, 200);
    const auto layers = render(view, 8, 8, settings, {}, 0, "ldm.layers");
    EXPECT_EQ(layers.width, 100);
    // The first map looks along y: the floor's texels have one layer.
    EXPECT_NEAR(mean(layers), 1, 0.03);
    const auto lit = render(view, 48, 48, settings, {}, 0, "lit");
    const auto darker = render(view, 48, 48, with(settings, "ambient", 0.0), {}, 0, "lit");
    EXPECT_GT(mean(lit), mean(darker));
}

}  // namespace
}  // namespace ir::ldm_ao_test
