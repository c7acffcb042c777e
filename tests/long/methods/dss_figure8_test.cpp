// The rows of [Nalbach15 fig. 8] with one set of defaults, against references of the same transport: a method
// of the picture alone, deep screen space without visibility, and with it. Printed as a table for
// docs/accuracy.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/image/metrics.h"

namespace ir {
namespace {

constexpr int width = 96, height = 64;

struct Row {
    std::string name, scene, camera, paths, competitor;
    std::int64_t reference_samples;
    bool visibility_helps;
};

/// Light has no maximum distance. The sky is off for all, as when the table was made.
Settings transport(const Row& row) {
    if (row.paths == "ao") return {{"paths", row.paths}, {"max_distance", 1.0}};
    return {{"paths", row.paths}, {"max_distance", 0.0}, {"environment_light", false}};
}

struct Shot {
    Image image;
    double splat_ms = 0, frame_ms = 0;
};

class DssFigure8 : public testing::Test {
  protected:
    Shot render(const Row& row, const std::string& method, const Settings& more = {},
                std::uint64_t seed = 1) {
        engine::Experiment e;
        e.scene = row.scene;
        e.camera_name = row.camera;
        e.method = method;
        e.settings = transport(row);
        for (const auto& [key, value] : more) e.settings[key] = value;
        e.width = width, e.height = height;
        e.seed = seed;
        engine::Execution execution(machine_, e);
        const auto report = execution.run_frame({});
        Shot result;
        result.image = main_result(execution);
        for (const auto& pass : report.passes) {
            const double ms = pass.queue == "gl" ? pass.gpu_ms : pass.cpu_ms;
            result.frame_ms += ms;
            if (pass.name == "splat" || pass.name.rfind("add surfels", 0) == 0) result.splat_ms += ms;
        }
        return result;
    }

    Shot reference(const Row& row, std::uint64_t seed) {
        Settings more{{"samples", row.reference_samples}};
        if (row.paths != "ao") more["max_bounces"] = std::int64_t{1};
        return render(row, "reference", more, seed);
    }

    std::map<std::string, double> errors(const Row& row, const Image& image, const Image& truth) {
        auto values = compute_metrics(image, truth, {"rmse", flip(row)}).values;
        values["clipped"] = compute_metrics(clipped(image), clipped(truth), {"rmse"}).values.at("rmse");
        return values;
    }
    /// As a screen shows it: a few pixels thousands of times as bright as white no longer decide.
    static Image clipped(Image image) {
        for (float& value : image.pixels) value = std::min(value, 1.0f);
        return image;
    }
    static double mean(const Image& image) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += image.at(x, y, 0);
        return sum / (image.width * image.height);
    }
    static std::string flip(const Row& row) { return row.paths == "ao" ? "flip" : "hdr-flip"; }

    void print(const Row& row, const char* what, const std::map<std::string, double>& errors,
               const Shot& run) const {
        std::printf("| %s | %s | %.4f | %.4f | %.4f | %.2f | %.2f |\n", row.name.c_str(), what,
                    errors.at("rmse"), errors.at("clipped"), errors.at(flip(row)), run.splat_ms / 1000,
                    run.frame_ms / 1000);
        std::fflush(stdout);
    }

    engine::Machine machine_;
};

const std::vector<Row> rows{
    {"Graveyard, AO", "builtin:graveyard", "graves", "ao", "hbao", 512, true},
    {"Still life, indirect", "builtin:still-life", "table", "indirect", "ssdo", 512, true},
    {"Still life, full", "builtin:still-life", "table", "full", "ssdo", 512, true},
    {"Dominoes, indirect", "builtin:dominoes", "row", "indirect", "ssdo", 512, true},
    {"Dominoes, full", "builtin:dominoes", "row", "full", "ssdo", 512, true}};

TEST_F(DssFigure8, OneSetOfDefaultsForAllRows) {
    std::printf(
        "| row | method | RMSE | RMSE clipped to 1 | ꟻLIP | splats, s | frame, s "
        "|\n|---|---|---|---|---|---|---|\n");
    for (const auto& row : rows) {
        const auto truth = reference(row, 1), other = reference(row, 2);
        const auto noise = errors(row, other.image, truth.image);
        print(row, "reference, another seed", noise, other);
        const auto competitor = render(row, row.competitor),
                   additive =
                       render(row, "deep-screen-space", {{"visibility", false}, {"glossy_senders", false}}),
                   visible = render(row, "deep-screen-space");
        const auto of_additive = errors(row, additive.image, truth.image),
                   of_visible = errors(row, visible.image, truth.image);
        print(row, row.competitor.c_str(), errors(row, competitor.image, truth.image), competitor);
        print(row, "without visibility", of_additive, additive);
        print(row, "with visibility", of_visible, visible);
        EXPECT_EQ(of_visible.at("clipped") < of_additive.at("clipped"), row.visibility_helps) << row.name;
        EXPECT_LT(noise.at("clipped"), of_visible.at("clipped"))
            << row.name << ": the reference is too noisy";
    }
}

/// What each deviation from the defaults gains, one at a time.
TEST_F(DssFigure8, Causes) {
    const std::vector<std::pair<std::string, Settings>> causes{
        {"defaults", {}},
        {"samples = 16", {{"samples", std::int64_t{16}}}},
        {"surfel_radius = 0.75", {{"surfel_radius", 0.75}}},
        {"coverage = 3", {{"coverage", 3.0}}},
        {"trade_off = 0.005", {{"trade_off", 0.005}}},
        {"glossy_senders = false", {{"glossy_senders", false}}}};
    for (const std::size_t i : {0u, 1u, 3u}) {
        const auto& row = rows[i];
        const auto truth = reference(row, 1);
        std::map<std::string, double> share;  // of the reference's mean
        for (const auto& [what, settings] : causes) {
            const auto shot = render(row, "deep-screen-space", settings);
            print(row, what.c_str(), errors(row, shot.image, truth.image), shot);
            share[what] = mean(shot.image) / mean(truth.image);
            std::printf("mean %.4f, of the reference %.4f\n", mean(shot.image), mean(truth.image));
        }
        if (row.paths == "ao") {
            EXPECT_LT(share.at("coverage = 3"), share.at("defaults") - 0.1) << "larger discs occlude more";
            EXPECT_NEAR(share.at("samples = 16"), share.at("defaults"), 0.03) << "samples only add noise";
            EXPECT_EQ(share.at("glossy_senders = false"), share.at("defaults")) << "nothing is sent";
        } else {
            EXPECT_LT(share.at("glossy_senders = false"), share.at("defaults")) << row.name;
            EXPECT_GT(share.at("coverage = 3"), share.at("defaults")) << "fewer rays pass between discs";
        }
    }
}

}  // namespace
}  // namespace ir
