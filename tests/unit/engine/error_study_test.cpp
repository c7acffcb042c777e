// Studies on real pictures: what is measured, refused, read and cancelled.
#include "app/engine/error_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "app/engine/from_project.h"
#include "app/engine/keep_result.h"
#include "app/engine/pictures.h"
#include "app/engine/study_plan.h"
#include "app/engine/study_reference.h"
#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "renderers/image/metrics.h"
#include "tests/processor_time.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir::engine {
namespace {

projects::Experiment experiment(const std::string& id, const std::string& method, const Settings& values) {
    projects::Experiment result;
    result.id = result.name = id;
    result.scene = "box";
    result.method = method;
    result.method_version = registry().at(method).version;
    result.values = completed(registry().at(method).parameters, values);
    result.size = {24, 18};
    return result;
}

/// All that is computed here: ambient occlusion without a limit.
Settings openness(Settings values) {
    values.insert({{"paths", std::string("ao")}, {"max_distance", 0.0}});
    return values;
}

/// Few paths per pixel and layered depth maps, against many paths per pixel with another seed.
projects::Project project() {
    projects::Project result;
    result.scenes = {{"box", "Box", {{"builtin:cornell@1", "", {}}}}};
    result.experiments = {
        experiment("noisy", "reference", openness({{"samples", std::int64_t{2}}})),
        experiment("maps", "ldm-ao",
                   openness({{"directions", std::int64_t{16}}, {"resolution", std::int64_t{32}}})),
        experiment("truth", "reference", openness({{"samples", std::int64_t{256}}}))};
    result.experiments[0].frames = 16;
    result.experiments[2].seed = 7;
    projects::ErrorPlot plot;
    plot.id = plot.name = "plot";
    plot.reference = "truth";
    plot.experiments = {"noisy"};
    result.plots = {plot};
    return result;
}

Machine& machine() {
    MachineOptions options;
#ifdef __SANITIZE_THREAD__
    options.threads = 1;
#endif
    static Machine instance(options);
    return instance;
}

class ErrorStudyTest : public testing::Test {
  protected:
    ErrorStudy run(const StudyCallbacks& callbacks = {}) {
        return run_error_study(machine(), project_, plot(), folder_.path, callbacks);
    }
    projects::ErrorPlot& plot() { return project_.plots[0]; }
    std::string refusal() {
        try {
            run();
        } catch (const UsageError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "accepted";
    }

    test::TemporaryFolder folder_;
    projects::Project project_ = project();
};

TEST_F(ErrorStudyTest, ErrorFallsWithFramesWhileTimeGrows) {
    std::vector<int> told;
    double last = -1;
    StudyCallbacks callbacks;
    callbacks.point = [&](const ErrorPoint& point) { told.push_back(point.frames); };
    callbacks.progress = [&](const std::string&, double fraction) {
        EXPECT_GE(fraction, last - 1e-9);
        EXPECT_LE(fraction, 1);
        last = fraction;
    };
    const auto study = run(callbacks);
    ASSERT_EQ(study.points.size(), 5u);  // 1, 2, 4, 8, 16
    EXPECT_EQ(told, (std::vector<int>{1, 2, 4, 8, 16}));
    EXPECT_GT(last, 0.5);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto& point = study.points[i];
        EXPECT_EQ(point.problem, "");
        EXPECT_EQ(point.frames, 1 << i);
        EXPECT_EQ(point.value, 1 << i);
        EXPECT_GT(point.pixels, 300u);
        EXPECT_GT(point.memory_bytes, 0u);
        for (const char* metric : {"rmse", "mae", "psnr"}) EXPECT_TRUE(point.errors.count(metric)) << metric;
        if (i > 0) {
            EXPECT_GT(point.ms, study.points[i - 1].ms);
        }
    }
    // 16 times the samples: a quarter of the noise, a fifth with stratification. The reference's is far less.
    const double first = study.points[0].errors.at("rmse"), end = study.points[4].errors.at("rmse");
    EXPECT_LT(end, first / 2.5);
    EXPECT_GT(study.reference_noise, 0);
    EXPECT_LT(study.reference_noise, end);
    EXPECT_EQ(std::count(study.metrics.begin(), study.metrics.end(), "rmse"), 1);
    EXPECT_FALSE(study.device.empty());
    // Time grows and error falls: unless two pictures tie, all are on the front.
    EXPECT_TRUE(study.points[0].on_front);
    EXPECT_TRUE(study.points[4].on_front);
}

TEST_F(ErrorStudyTest, APointIsThePictureThatTheCommandLineRenders) {
    plot().values = {4};
    const auto study = run();
    auto same = project_.experiments[0];
    same.frames = 4;
    const auto render = [&](const projects::Experiment& each) {
        Execution execution(machine(), from_project(project_, each, folder_.path));
        while (!execution.is_done()) execution.run_frame({});
        return std::pair(main_result(execution), execution.graph().read_image("valid").value());
    };
    const auto [image, valid] = render(same);
    const auto [truth, truth_valid] = render(project_.experiments[2]);
    MetricOptions masks;
    masks.valid_image = &valid;
    masks.valid_reference = &truth_valid;
    const auto measured = compute_metrics(image, truth, {"rmse"}, masks);
    ASSERT_EQ(study.points.size(), 1u);
    EXPECT_NEAR(study.points[0].errors.at("rmse"), measured.values.at("rmse"), 1e-6);
}

TEST_F(ErrorStudyTest, ValuesOfAParameterAreOnePictureEach) {
    plot().experiments = {"maps"};
    plot().over = "directions";
    plot().values = {4, 64, 0, "many"};
    const auto study = run();
    ASSERT_EQ(study.points.size(), 4u);
    EXPECT_EQ(study.points[0].problem, "");
    EXPECT_EQ(study.points[1].problem, "");
    EXPECT_LT(study.points[1].errors.at("rmse"), study.points[0].errors.at("rmse"));
    for (std::size_t i : {2u, 3u}) {
        EXPECT_NE(study.points[i].problem.find("directions"), std::string::npos) << study.points[i].problem;
        EXPECT_FALSE(study.points[i].on_front);
    }
}

TEST_F(ErrorStudyTest, SeedsGiveOtherPicturesOfTheSameQuality) {
    plot().over = "seed";
    plot().values = {1, 2, 1};
    project_.experiments[0].frames = 1;
    const auto study = run();
    ASSERT_EQ(study.points.size(), 3u);
    const auto rmse = [&](int i) { return study.points[std::size_t(i)].errors.at("rmse"); };
    EXPECT_NE(rmse(0), rmse(1));
    EXPECT_EQ(rmse(0), rmse(2));
    EXPECT_LT(std::abs(rmse(0) - rmse(1)), 0.5 * rmse(0));
}

TEST_F(ErrorStudyTest, OtherTransportsSizesAndCamerasAreRefusedByName) {
    plot().experiments = {"noisy", "maps", "truth", "gone"};
    project_.experiments[0].values["max_distance"] = 1.0;
    project_.experiments[0].frames = 1;
    project_.experiments[1].size = {18, 24};
    const auto study = run();
    ASSERT_EQ(study.points.size(), 4u);
    EXPECT_NE(study.points[0].problem.find("max_distance"), std::string::npos) << study.points[0].problem;
    EXPECT_NE(study.points[1].problem.find("size"), std::string::npos) << study.points[1].problem;
    EXPECT_EQ(study.points[2].problem, "is the reference itself");
    EXPECT_EQ(study.points[3].problem, "there is no experiment 'gone'");
    EXPECT_TRUE(study.metrics.empty());
}

TEST_F(ErrorStudyTest, WhereNothingMovesFramesOfAnyNumberShareAReference) {
    project_.experiments[1].frames = 3;  // two thirtieths of a second after the reference
    plot().experiments = {"maps"};
    plot().values = {1, 3};
    const auto study = run();
    ASSERT_EQ(study.points.size(), 2u);
    for (const auto& point : study.points) EXPECT_EQ(point.problem, "");
    for (const auto& note : study.notes) EXPECT_EQ(note.find("moves"), std::string::npos) << note;
}

TEST_F(ErrorStudyTest, WhereTheSceneMovesAReferenceOfAnotherMomentIsRefused) {
    project_.scenes[0].parts[0].source = "builtin:corridor";
    project_.experiments[1].frames = 3;
    plot().experiments = {"maps"};
    plot().values = {1, 3};
    const auto study = run();
    ASSERT_EQ(study.points.size(), 2u);
    for (const auto& point : study.points)
        EXPECT_NE(point.problem.find("time"), std::string::npos) << point.problem;
}

TEST_F(ErrorStudyTest, WhatCannotBeMeasuredAtAllIsRefused) {
    const auto with = [&](auto change) {
        project_ = project();
        change(plot());
        return refusal();
    };
    EXPECT_NE(with([](auto& p) { p.experiments.clear(); }).find("no experiments"), std::string::npos);
    EXPECT_NE(with([](auto& p) { p.reference = "nobody"; }).find("'nobody'"), std::string::npos);
    EXPECT_NE(with([](auto& p) { p.reference.clear(); }).find("no reference"), std::string::npos);
    EXPECT_NE(with([](auto& p) { p.metric = "beauty"; }).find("known are rmse"), std::string::npos);
    const auto unknown = with([](auto& p) { p.over = "smaples"; });
    EXPECT_NE(unknown.find("frames, seed, "), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("samples"), std::string::npos) << unknown;
    EXPECT_NE(with([](auto& p) { p.over = "samples"; }).find("no values"), std::string::npos);
}

TEST_F(ErrorStudyTest, AKeptReferenceIsReadAndNotRendered) {
    project_.experiments[2].values["samples"] = std::int64_t{64};
    plot().values = {1};
    const auto rendered = run();
    Execution execution(machine(), from_project(project_, project_.experiments[2], folder_.path));
    graph::FrameOptions options;
    options.wanted = {execution.method().variance};
    FrameReport report;
    while (!execution.is_done()) report = execution.run_frame(options);
    keep_result(project_, project_.experiments[2], folder_.path, execution, report);
    const auto read = run();
    ASSERT_FALSE(read.notes.empty());
    EXPECT_NE(read.notes[0].find("kept result"), std::string::npos) << read.notes[0];
    EXPECT_EQ(read.points[0].errors, rendered.points[0].errors);
    EXPECT_NEAR(read.reference_noise, rendered.reference_noise, 1e-6);
    // More samples than are kept: it goes on from there, and the picture is that of all at once.
    project_.experiments[2].values["samples"] = std::int64_t{256};
    const auto continued = run();
    ASSERT_FALSE(continued.notes.empty());
    EXPECT_NE(continued.notes[0].find("64 samples"), std::string::npos) << continued.notes[0];
    const test::TemporaryFolder empty;
    const auto fresh = run_error_study(machine(), project_, plot(), empty.path, {});
    EXPECT_EQ(continued.points[0].errors, fresh.points[0].errors);
}

TEST_F(ErrorStudyTest, AForeignImageMayBeTheReference) {
    const Image grey(24, 18, 1, 0.5f);
    write_exr(folder_.path / "grey.exr", {{"", {"Y"}, grey}}, {});
    projects::ForeignImage image;
    image.id = image.name = "grey";
    image.source = "grey.exr";
    project_.images = {image};
    plot().reference = "grey";
    plot().values = {1};
    auto study = run();
    EXPECT_EQ(study.points[0].problem, "");
    EXPECT_EQ(study.reference_noise, 0);
    ASSERT_FALSE(study.notes.empty());
    project_.experiments[0].size = {12, 9};
    study = run();
    EXPECT_NE(study.points[0].problem.find("sizes differ"), std::string::npos) << study.points[0].problem;
}

TEST_F(ErrorStudyTest, CancellingEndsWithinATenthOfASecond) {
    project_.experiments[2].values["samples"] = std::int64_t{1'000'000};
    CancelToken token;
    double requested = 0;
    int calls = 0;
    StudyCallbacks callbacks;
    callbacks.cancel = &token;
    callbacks.progress = [&](const std::string&, double) {
        if (++calls != 3) return;
        requested = processor_seconds();
        token.cancel();
    };
    EXPECT_THROW(run(callbacks), Cancelled);
#ifndef __SANITIZE_THREAD__
    EXPECT_LT(processor_seconds() - requested, 0.1 * std::max(1u, std::thread::hardware_concurrency()));
#endif
}

TEST_F(ErrorStudyTest, RepeatsGiveOneTimeEach) {
    plot().values = {1, 2};
    StudyCallbacks callbacks;
    callbacks.repeats = 3;
    int told = 0;
    callbacks.point = [&](const ErrorPoint& point) {
        ++told;
        EXPECT_GT(point.ms, 0);
    };
    const auto study = run(callbacks);
    EXPECT_EQ(told, 2);
    ASSERT_EQ(study.points.size(), 2u);
    EXPECT_GT(study.points[1].ms, study.points[0].ms);
}

TEST(StudyReference, NoiseIsTheRootOfTheMeanVarianceOfValidPixels) {
    Image variance(2, 2, 4, 9), valid(2, 2, 1, 1);
    variance.at(0, 0, 3) = 1e9f;  // a fourth channel is no colour
    variance.at(1, 1, 0) = 1e9f;
    valid.at(1, 1) = 0;
    EXPECT_DOUBLE_EQ(noise_of(variance, valid), 3);
    EXPECT_EQ(noise_of({}, {}), 0);
    variance.at(0, 1, 0) = std::nanf("");
    EXPECT_DOUBLE_EQ(noise_of(variance, valid), 3);
}

}  // namespace
}  // namespace ir::engine
