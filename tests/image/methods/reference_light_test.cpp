// Pictures of light by the reference as a method: rendered through graph and G-buffer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "tests/image/methods/machine.h"

namespace ir::engine {
namespace {

/// One context for all tests of this file.
Settings light(const std::string& paths, std::int64_t samples, Settings more = {}) {
    more["paths"] = paths;
    more["samples"] = samples;
    return more;
}

Experiment cornell(Settings settings, const std::string& scene = "builtin:cornell") {
    Experiment e;
    e.scene = scene;
    e.method = "reference";
    e.settings = std::move(settings);
    e.width = 33;  // tiles that are cut off
    e.height = 24;
    return e;
}

struct Picture {
    explicit Picture(const Experiment& e, int frames = 1, Machine& on = machine()) {
        Execution execution(on, e);
        graph::FrameOptions options;
        options.wanted = {"*"};
        for (int i = 0; i < frames; ++i) report = execution.run_frame(options);
        for (const auto& resource : report.resources)
            if (const auto image = execution.graph().read_image(resource.key)) images[resource.key] = *image;
        main = main_result(execution);
    }
    const Image& operator[](const std::string& key) const { return images.at(key); }
    bool notes(const std::string& word) const {
        return std::any_of(report.messages.begin(), report.messages.end(),
                           [&](const auto& m) { return m.text.find(word) != std::string::npos; });
    }
    FrameReport report;
    Image main;
    std::map<std::string, Image> images;
};

const std::vector<std::string> parts{"radiance", "direct", "indirect", "reference.variance"};

void expect_equal(const Picture& a, const Picture& b, const std::string& what) {
    for (const auto& key : parts) EXPECT_EQ(a[key].pixels, b[key].pixels) << key << ", " << what;
}

Picture with_threads(const Experiment& e, int threads, int frames = 1) {
    MachineOptions options;
    options.threads = threads;
    Machine own(options);
    return Picture(e, frames, own);
}

TEST(ReferenceLight, IsTheSameForAnyNumberOfThreads) {
    for (const char* primary : {"gbuffer", "rays"}) {
        const auto e = cornell(light("full", 24, {{"max_bounces", std::int64_t{4}}, {"primary", primary}}));
        const auto one = with_threads(e, 1), two = with_threads(e, 2);
        expect_equal(one, two, primary);
        expect_equal(two, with_threads(e, 2), primary);
    }
}

TEST(ReferenceLight, DependsOnTheSeed) {
    auto e = cornell(light("full", 8));
    const Picture first(e);
    e.seed = 1;
    EXPECT_NE(first["radiance"].pixels, Picture(e)["radiance"].pixels);
}

TEST(ReferenceLight, FramesAddUpHoweverTheyAreSplit) {
    for (const char* primary : {"gbuffer", "rays"}) {
        const Settings more{{"max_bounces", std::int64_t{4}}, {"primary", primary}};
        const Picture once(cornell(light("full", 16, more)));
        expect_equal(Picture(cornell(light("full", 1, more)), 16), once, "16 of 1");
        expect_equal(Picture(cornell(light("full", 4, more)), 4), once, "4 of 4");
        for (const float n : once["reference.samples"].pixels) ASSERT_EQ(n, 16);
    }
}

/// 5 samples, then 11 more by raising the parameter.
TEST(ReferenceLight, RaisingTheSamplesGoesOn) {
    for (const char* paths : {"full", "ao"}) {
        const auto all = cornell(light(paths, 16)), some = cornell(light(paths, 5));
        Execution execution(machine(), some);
        graph::FrameOptions options;
        options.wanted = {"*"};
        execution.run_frame(options);
        execution.update(all);
        const auto report = execution.run_frame(options);
        EXPECT_EQ(main_result(execution).pixels, Picture(all).main.pixels) << paths;
        EXPECT_LT(report.counters.at("rays"), Picture(all).report.counters.at("rays")) << paths;
    }
}

/// The lamp of the box emits and a spot shines under it: what is left out is exactly the lamp's.
TEST(ReferenceLight, EmittersAreLeftOutAsTheTransportSays) {
    const auto picture = [](const char* emitters, const std::string& options) {
        return Picture(cornell(light("full", 16, {{"max_bounces", std::int64_t{3}}, {"emitters", emitters}}),
                               "builtin:cornell" + options));
    };
    const auto all = picture("all", ""), once = picture("direct", ""), none = picture("none", "");
    const auto spot = picture("all", "?emission=0");
    EXPECT_EQ(none["direct"].pixels, spot["direct"].pixels);
    EXPECT_EQ(none["indirect"].pixels, spot["indirect"].pixels);
    EXPECT_EQ(once["direct"].pixels, all["direct"].pixels);
    EXPECT_EQ(once["indirect"].pixels, none["indirect"].pixels);
    EXPECT_NE(all["indirect"].pixels, none["indirect"].pixels);
    const float lamp = 17;
    EXPECT_GE(*std::max_element(none.main.pixels.begin(), none.main.pixels.end()), lamp) << "it is seen";
    const auto dark = picture("none", "?light=0");
    EXPECT_TRUE(dark.notes("emitters"));
    for (std::size_t i = 0; i < dark["direct"].pixels.size(); ++i)
        ASSERT_EQ(dark["direct"].pixels[i], i % 4 == 3 ? 1 : 0);  // alpha is 1
}

TEST(ReferenceLight, PartsAddUp) {
    const Picture full(cornell(light("full", 16, {{"max_bounces", std::int64_t{3}}})));
    const auto& emission = full["gbuffer.emission"];
    for (int y = 0; y < full.main.height; ++y)
        for (int x = 0; x < full.main.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float sum =
                    full["direct"].at(x, y, c) + full["indirect"].at(x, y, c) + emission.at(x, y, c);
                EXPECT_NEAR(full.main.at(x, y, c), sum, 1e-5f * (1 + sum)) << x << " " << y;
            }
    // The same paths, each alone: the same random numbers, added up in another order.
    const auto expect_near = [](const Image& a, const Image& b, const char* what) {
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            ASSERT_NEAR(a.pixels[i], b.pixels[i], 1e-5f * (1e-3f + b.pixels[i])) << what << " at " << i;
    };
    expect_near(Picture(cornell(light("direct", 16))).main, full["direct"], "direct");
    const Picture indirect(cornell(light("indirect", 16, {{"max_bounces", std::int64_t{3}}})));
    expect_near(indirect.main, full["indirect"], "indirect");
}

/// Pixels whose neighbours lie on the same plane and have the same colour.
std::vector<std::pair<int, int>> smooth_pixels(const Picture& p) {
    const auto& normal = p["gbuffer.geometric_normal"];
    const auto& albedo = p["gbuffer.albedo"];
    std::vector<std::pair<int, int>> result;
    for (int y = 1; y + 1 < normal.height; ++y)
        for (int x = 1; x + 1 < normal.width; ++x) {
            bool same = p["valid"].at(x, y) != 0 && p["gbuffer.emission"].at(x, y) == 0;
            for (int v = y - 1; v <= y + 1; ++v)
                for (int u = x - 1; u <= x + 1; ++u)
                    for (int c = 0; c < 3; ++c)
                        same = same && normal.at(u, v, c) == normal.at(x, y, c) &&
                               albedo.at(u, v, c) == albedo.at(x, y, c);
            if (same) result.push_back({x, y});
        }
    return result;
}

/// Mean difference over smooth pixels in standard errors. Indirect light of a matt scene hardly bends within
/// a pixel.
double z_of(const Picture& a, const Picture& b, double scale = 1) {
    double sum = 0, variance = 0;
    for (const auto& [x, y] : smooth_pixels(a))
        for (int c = 0; c < 3; ++c) {
            sum += a.main.at(x, y, c) - scale * b.main.at(x, y, c);
            variance += a["reference.variance"].at(x, y, c) + b["reference.variance"].at(x, y, c);
        }
    return sum / std::sqrt(variance);
}

TEST(ReferenceLight, GBufferAndRaysAgreeWhereItIsSmooth) {
    // n ≈ 1000 pixels with 128 samples; α = 1e-4 two-sided: |z| < 3.9. The colours of a pixel go together:
    // at most a factor √3.
    const auto picture = [](const char* primary) {
        auto e = cornell(
            light("indirect", 128,
                  {{"max_bounces", std::int64_t{3}}, {"materials", "lambert"}, {"primary", primary}}));
        e.width = 64, e.height = 48;
        return Picture(e);
    };
    const auto centre = picture("gbuffer"), rays = picture("rays");
    EXPECT_GT(smooth_pixels(centre).size(), 700u);
    EXPECT_LT(std::abs(z_of(centre, rays)), 3.9 * std::sqrt(3.0));
    // Mutant: one of them 5 % brighter.
    EXPECT_GT(std::abs(z_of(centre, rays, 1.05)), 3.9 * std::sqrt(3.0));
}

TEST(ReferenceLight, EqualsTheRasterisedDirectLightOfPunctualLights) {
    for (const char* scene : {"builtin:plane?cover=2", "builtin:corner"}) {
        auto e = cornell(light("direct", 8), scene);
        const Picture traced(e);
        e.method = "ldm-ao";
        e.settings = {};
        const Picture rasterised(e);
        const auto& expected = rasterised["direct.radiance"];
        int pixels = 0, differing = 0;
        for (int y = 0; y < expected.height; ++y)
            for (int x = 0; x < expected.width; ++x) {
                if (traced["valid"].at(x, y) == 0) continue;
                ++pixels;
                bool same = true;
                for (int c = 0; c < 3; ++c)
                    same = same && std::abs(traced.main.at(x, y, c) - expected.at(x, y, c)) <=
                                       2e-3f * expected.at(x, y, c) + 1e-6f;
                differing += !same;
            }
        EXPECT_GT(pixels, 150) << scene;
        EXPECT_LT(differing, 0.05 * pixels) << scene << ": more than the borders of shadows";
    }
}

TEST(ReferenceLight, BackgroundIsTheEnvironmentOfFullPathsOnly) {
    Experiment e = cornell(light("full", 4, {{"primary", "rays"}}), "builtin:plane");
    e.environment = scene::Environment{{0.25f, 0.5f, 1}, nullptr};
    e.camera_name = "above";
    const Picture full(e);
    EXPECT_EQ(full.main.at(0, 0, 1), 0.5f);
    EXPECT_EQ(full["valid"].at(0, 0), 1);
    e.settings["environment_light"] = false;
    EXPECT_EQ(Picture(e).main.at(0, 0, 1), 0);
    e.settings = light("direct", 4);
    const Picture direct(e);
    EXPECT_EQ(direct.main.at(0, 0, 1), 0);
    EXPECT_EQ(direct["valid"].at(0, 0), 0);
}

TEST(ReferenceLight, SaysWhatIsMissing) {
    auto dark = cornell(light("full", 1), "builtin:plane");
    dark.replace_lights = true;
    const Picture black(dark);
    EXPECT_TRUE(black.notes("nothing in the scene emits light"));
    for (std::size_t i = 0; i < black.main.pixels.size(); ++i)
        ASSERT_EQ(black.main.pixels[i], i % 4 == 3 ? 1 : 0);  // alpha is 1
    const Picture lit(cornell(light("full", 1)));
    EXPECT_FALSE(lit.notes("nothing in the scene emits"));
    EXPECT_FALSE(lit.notes("traced from the lights"));
}

TEST(Darkness, IsSaidByEveryMethodOfLight) {
    for (const char* method : {"deep-screen-space", "ldm-indirect", "photon-mapping", "ssdo"}) {
        auto dark = cornell({}, "builtin:plane");
        dark.method = method;
        dark.settings["paths"] = "full";
        dark.replace_lights = true;
        EXPECT_TRUE(Picture(dark).notes("nothing in the scene emits light")) << method;
        dark.lights = {scene::Light{}};
        dark.lights[0].position = {0, 2, 0};
        EXPECT_FALSE(Picture(dark).notes("nothing in the scene emits light")) << method;
    }
}

TEST(ReferenceLight, TellsSpeedAndError) {
    const Picture p(cornell(light("full", 32)));
    EXPECT_GT(p.report.counters.at("reference.trace_ms"), 0);
    EXPECT_EQ(p.report.counters.at("reference.samples_total"), 33.0 * 24 * 32);
    double variance = 0, count = 0;
    for (int y = 0; y < p.main.height; ++y)
        for (int x = 0; x < p.main.width; ++x)
            for (int c = 0; c < 3 && p["valid"].at(x, y) != 0; ++c)
                variance += p["reference.variance"].at(x, y, c), ++count;
    EXPECT_NEAR(p.report.counters.at("reference.error"), std::sqrt(variance / count), 1e-6);
    EXPECT_EQ(p.report.counters.at("reference.bad_samples"), 0);
}

/// The error that a picture tells of itself is the difference to a converged one.
TEST(ReferenceLight, EstimatesItsError) {
    const Settings matt{{"materials", "lambert"}};
    const Picture converged(cornell(light("full", 4096, matt)));
    auto e = cornell(light("full", 64, matt));
    e.seed = 5;
    const Picture p(e);
    double squares = 0, count = 0;
    for (std::size_t i = 0; i < p.main.pixels.size(); ++i)
        if (i % 4 != 3 && p["valid"].pixels[i / 4] != 0)
            squares += std::pow(p.main.pixels[i] - converged.main.pixels[i], 2), ++count;
    EXPECT_NEAR(p.report.counters.at("reference.error") / std::sqrt(squares / count), 1, 0.15);
}

TEST(ReferenceLight, GoesOnAfterACancelledFrame) {
    const auto e = cornell(light("full", 200));
    const Picture undisturbed(e, 2);
    Execution execution(machine(), e);
    execution.run_frame({});
    CancelToken cancel;
    graph::FrameOptions options;
    options.cancel = &cancel;
    options.progress = [&](const std::string& pass, double) {
        if (pass == "trace paths") cancel.cancel();
    };
    EXPECT_THROW(execution.run_frame(options), Cancelled);
    execution.run_frame({});
    EXPECT_EQ(main_result(execution).pixels, undisturbed.main.pixels);
}

}  // namespace
}  // namespace ir::engine
