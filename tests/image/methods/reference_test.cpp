// The reference as a method: rendered through graph and G-buffer.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/methods/all_methods.h"
#include "tests/image/methods/machine.h"

namespace ir::engine {
namespace {

/// One context for all tests of this file.
graph::FrameOptions keeping(const std::string& pattern) {
    graph::FrameOptions options;
    options.wanted = {pattern};
    return options;
}

/// Of ambient occlusion, unlimited unless the settings say otherwise.
Experiment experiment(const std::string& scene, const std::string& camera, Settings settings = {}) {
    settings.insert({"paths", std::string("ao")});
    Experiment e;
    e.scene = scene;
    e.camera_name = camera;
    e.method = "reference";
    e.settings = std::move(settings);
    e.width = 64;
    e.height = 48;
    return e;
}

/// A rendered experiment: some images by resource key, and the last frame's report.
struct Rendered {
    explicit Rendered(const Experiment& e, int frames = 1, Machine& on = machine()) {
        Execution execution(on, e);
        for (int i = 0; i < frames; ++i) report = execution.run_frame(keeping("*"));
        for (const char* key :
             {"accessibility", "reference.variance", "reference.samples", "valid", "gbuffer.position"}) {
            images[key] = execution.graph().read_image(key).value();
        }
    }
    const Image& operator[](const std::string& key) const { return images.at(key); }
    FrameReport report;
    std::map<std::string, Image> images;
};

/// With a context of its own, which is gone when the images are compared.
Rendered render_with_threads(const Experiment& e, int frames, int threads) {
    MachineOptions options;
    options.threads = threads;
    Machine own(options);
    return Rendered(e, frames, own);
}

std::size_t valid_pixels(const Rendered& r) {
    std::size_t count = 0;
    for (const float v : r["valid"].pixels) count += v != 0;
    return count;
}

TEST(Reference, PlaneIsExactlyOpen) {
    for (const char* scene : {"builtin:plane", "builtin:plane?size=1000"}) {
        const Rendered r(experiment(scene, "above"));
        EXPECT_GT(valid_pixels(r), 500u);
        EXPECT_GT(r.report.counters.at("rays"), 500 * 64);
        for (const float v : r["accessibility"].pixels) ASSERT_EQ(v, 1);
        for (const float v : r["reference.variance"].pixels) ASSERT_EQ(v, 0);
    }
}

TEST(Reference, PlaneIsExactlyOpenWithSmoothFallOff) {
    const Rendered r(experiment("builtin:plane", "above", {{"max_distance", 1.0}, {"falloff", "smooth"}}));
    for (const float v : r["accessibility"].pixels) ASSERT_EQ(v, 1);
}

TEST(Reference, FurnaceIsExactlyClosed) {
    const auto scene = scene::load_scene("builtin:furnace");
    const Rendered r(experiment("builtin:furnace", scene.cameras.front().name));
    EXPECT_EQ(valid_pixels(r), 64u * 48u);
    for (const float v : r["accessibility"].pixels) ASSERT_EQ(v, 0);
}

/// Sum over pixels of (found - expected), in standard errors, and of its square. The wall of the corner
/// within r of the floor, away from the borders: AO(d) = 1 - (acos t - t √(1 - t²)) / π, t = d/r.
struct CornerTest {
    double z = 0;     ///< normal, as the sum of many pixels
    double chi2 = 0;  ///< per pixel: F(1, 7) has the mean 7/5
    int pixels = 0;
};
CornerTest test_corner(const Rendered& r, double radius, const Image& accessibility) {
    const auto variance = r["reference.variance"], position = r["gbuffer.position"];
    double sum = 0, sum_variance = 0;
    CornerTest result;
    for (int y = 0; y < accessibility.height; ++y) {
        for (int x = 0; x < accessibility.width; ++x) {
            const double d = position.at(x, y, 1), t = d / radius;
            if (r["valid"].at(x, y) == 0 || t > 0.9 || std::abs(position.at(x, y, 2)) > 0.5 - radius)
                continue;
            const double expected = 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / glm::pi<double>();
            const double difference = accessibility.at(x, y) - expected;
            sum += difference;
            sum_variance += variance.at(x, y);
            if (variance.at(x, y) > 0) result.chi2 += difference * difference / variance.at(x, y);
            ++result.pixels;
        }
    }
    result.z = sum / std::sqrt(sum_variance);
    result.chi2 /= result.pixels;
    return result;
}

Experiment corner_experiment() {
    auto e =
        experiment("builtin:corner?size=1", "wall", {{"max_distance", 0.2}, {"samples", std::int64_t{64}}});
    e.width = e.height = 64;
    return e;
}

TEST(Reference, CornerFollowsTheClosedForm) {
    // n ≈ 500 pixels with 64 samples; α = 1e-4 two-sided: |z| < 3.9.
    const Rendered r(corner_experiment());
    const auto result = test_corner(r, 0.2, r["accessibility"]);
    EXPECT_GT(result.pixels, 300);
    EXPECT_LT(std::abs(result.z), 3.9);
    EXPECT_LT(result.chi2, 2.2);  // 1.4 expected, its own deviation about 0.2
}

TEST(Reference, CornerTestRejectsAnotherRadius) {
    auto mutant = corner_experiment();
    mutant.settings["max_distance"] = 0.21;
    const Rendered r(mutant);
    EXPECT_GT(std::abs(test_corner(r, 0.2, r["accessibility"]).z), 3.9);
}

TEST(Reference, TurnedCornerGivesTheSame) {
    // Rotated about the origin: positions are no longer exact in any coordinate.
    auto turned = corner_experiment();
    turned.scene = "builtin:corner?size=1&yaw=33&pitch=21&roll=-47";
    const Rendered a(corner_experiment()), b(turned);
    const auto first = a["accessibility"], second = b["accessibility"];
    double difference = 0;
    for (std::size_t i = 0; i < first.pixels.size(); ++i) difference += first.pixels[i] - second.pixels[i];
    EXPECT_LT(std::abs(difference / static_cast<double>(first.pixels.size())), 0.002);
}

TEST(Reference, IsTheSameForAnyNumberOfThreads) {
    const auto e = experiment("builtin:cornell", scene::load_scene("builtin:cornell").cameras.front().name);
    const auto one = render_with_threads(e, 2, 1), two = render_with_threads(e, 2, 2);
    const auto again = render_with_threads(e, 2, 2);
    for (const char* key : {"accessibility", "reference.variance"}) {
        EXPECT_EQ(one[key].pixels, two[key].pixels) << key;
        EXPECT_EQ(two[key].pixels, again[key].pixels) << key;
    }
}

TEST(Reference, DependsOnTheSeed) {
    auto e = experiment("builtin:cornell", scene::load_scene("builtin:cornell").cameras.front().name);
    const Rendered first(e);
    e.seed = 1;
    const Rendered second(e);
    EXPECT_NE(first["accessibility"].pixels, second["accessibility"].pixels);
}

Settings with_samples(std::int64_t samples) {
    return {{"paths", std::string("ao")}, {"samples", samples}, {"max_distance", 0.5}};
}

TEST(Reference, FramesAddUp) {
    const auto camera = scene::load_scene("builtin:cornell").cameras.front().name;
    const Rendered once(experiment("builtin:cornell", camera, with_samples(60)));
    const Rendered thrice(experiment("builtin:cornell", camera, with_samples(20)), 3);
    EXPECT_EQ(thrice["accessibility"].pixels, once["accessibility"].pixels);
    EXPECT_EQ(thrice["reference.variance"].pixels, once["reference.variance"].pixels);
    for (const float n : thrice["reference.samples"].pixels) ASSERT_EQ(n, 60);
}

TEST(Reference, TracesManySamplesInPortions) {
    const auto camera = scene::load_scene("builtin:cornell").cameras.front().name;
    auto e = experiment("builtin:cornell", camera, with_samples(600));
    e.width = 33;  // tiles that are cut off
    e.height = 17;
    auto parts = e;
    parts.settings["samples"] = std::int64_t{100};
    const Rendered once(e), six(parts, 6);
    EXPECT_EQ(once["accessibility"].pixels, six["accessibility"].pixels);
    for (const float n : once["reference.samples"].pixels) ASSERT_EQ(n, 600);
    EXPECT_LE(once.report.counters.at("rays"), 600.0 * 33 * 17);
}

TEST(Reference, GoesOnAfterACancelledFrame) {
    const auto camera = scene::load_scene("builtin:cornell").cameras.front().name;
    const auto e = experiment("builtin:cornell", camera, with_samples(400));
    const Rendered undisturbed(e, 2);
    Execution execution(machine(), e);
    execution.run_frame({});
    CancelToken cancel;
    graph::FrameOptions options;
    options.cancel = &cancel;
    bool traced = false;
    options.progress = [&](const std::string& pass, double) {  // called after each slice
        if (pass == "trace visibility") traced = true, cancel.cancel();
    };
    EXPECT_THROW(execution.run_frame(options), Cancelled);
    EXPECT_TRUE(traced);
    EXPECT_EQ(execution.committed_frames(), 1);
    execution.run_frame(keeping("*"));
    EXPECT_EQ(main_result(execution).pixels, undisturbed["accessibility"].pixels);
}

/// Runs frames of the reference with views of one's own.
class Frames {
  public:
    explicit Frames(const std::string& scene)
        : scene_(scene::load_scene(scene)),
          world_(scene::flatten(scene_, 0, 0)),
          graph_(machine().device(), &machine().context(), &machine().programs()) {
        machine().context().make_current();
        for (const auto* candidate : methods::all_methods()) {
            if (candidate->description.id == "reference") method_ = candidate;
        }
    }
    /// Samples per pixel after a frame seen from `eye`.
    float run(glm::vec3 eye) {
        auto camera = scene_.cameras.front();
        camera.eye = eye;
        graph::FrameInputs inputs;
        inputs.scene = &scene_;
        inputs.world = &world_;
        inputs.world_fingerprint = inputs.geometry_fingerprint = "cornell";
        inputs.view = scene::make_view(camera, 32, 24, world_.bounds);
        inputs.previous_view = frame_ ? view_ : inputs.view;
        inputs.frame = frame_++;
        view_ = inputs.view;
        auto settings = completed(method_->description.parameters, with_samples(16));
        graph_.run(*method_, settings, inputs, keeping("reference.samples"));
        return graph_.read_image("reference.samples")->pixels[0];
    }

  private:
    scene::Scene scene_;
    scene::World world_;
    graph::Graph graph_;
    const graph::Method* method_ = nullptr;
    scene::View view_;
    int frame_ = 0;
};

TEST(Reference, StartsAnewWhenTheViewMoves) {
    Frames frames("builtin:cornell");
    const auto eye = scene::load_scene("builtin:cornell").cameras.front().eye;
    EXPECT_EQ(frames.run(eye), 16);
    EXPECT_EQ(frames.run(eye), 32);
    EXPECT_EQ(frames.run(eye + glm::vec3(0.1f, 0, 0)), 16);
    EXPECT_EQ(frames.run(eye + glm::vec3(0.1f, 0, 0)), 32);
}

TEST(Reference, EmptyPixelsAreOpenAndInvalid) {
    auto e = experiment("builtin:cornell", "");
    scene::Camera away;
    away.eye = {0, 0, 1000};
    away.target = {0, 0, 2000};
    e.camera = away;
    const Rendered r(e);
    EXPECT_EQ(valid_pixels(r), 0u);
    EXPECT_EQ(r.report.counters.at("rays"), 0);
    for (const float v : r["accessibility"].pixels) ASSERT_EQ(v, 1);
}

}  // namespace
}  // namespace ir::engine
