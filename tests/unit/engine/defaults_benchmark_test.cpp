// Every method beside the reference, on tiny pictures: which tables there are, what their cells say.
#include "app/engine/defaults_benchmark.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"

namespace ir::engine {
namespace {

Machine& defaults_machine() {
    static Machine instance;
    return instance;
}

BenchmarkOptions tiny(const std::vector<std::string>& methods) {
    BenchmarkOptions options;
    options.place.scene = "builtin:cornell";
    options.size = glm::ivec2(32, 24);
    options.variants = methods;
    options.repeats = 1;
    return options;
}

double judged(const BenchmarkReport& report, std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < report.columns.size(); ++i)
        if (report.columns[i].label == column) return report.rows.at(row).cells.at(i).value_or(NAN);
    ADD_FAILURE() << column;
    return NAN;
}

TEST(DefaultsBenchmark, MethodsOfOneTransportShareATable) {
    const auto reports = run_defaults_benchmark(defaults_machine(), tiny({"ssdo", "hbao", "ldm-ao"}));
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[0].doc, "paths=ao max_distance=1");
    EXPECT_EQ(reports[1].doc, "paths=full max_distance=1");
    ASSERT_EQ(reports[0].rows.size(), 3u);
    EXPECT_EQ(reports[0].rows[1].label, "hbao");
    EXPECT_EQ(reports[0].rows[2].label, "ldm-ao");
    ASSERT_EQ(reports[1].rows.size(), 2u);
    EXPECT_EQ(reports[1].rows[1].label, "ssdo");
    EXPECT_EQ(reports[1].columns[5].label, "HDR-ꟻLIP");
    for (const auto& report : reports) {
        EXPECT_EQ(report.scene, "builtin:cornell");
        EXPECT_EQ(report.width, 32);
        for (std::size_t row = 0; row < report.rows.size(); ++row)
            for (const auto& column : report.columns)
                EXPECT_GT(judged(report, row, column.label), 0) << report.rows[row].label << column.label;
    }
}

TEST(DefaultsBenchmark, TheReferenceIsAsGoodAsItself) {
    const auto report = run_defaults_benchmark(defaults_machine(), tiny({"hbao"})).at(0);
    const double time = judged(report, 0, "Time");
    EXPECT_TRUE(report.notes.at(0).starts_with("errors are from 512 samples")) << report.notes.at(0);
    EXPECT_NEAR(judged(report, 0, "Mean"), 1, 0.02);
    EXPECT_NEAR(judged(report, 0, "Reference"), time, 0.01 * time);
    EXPECT_NEAR(judged(report, 0, "Reference flat / time"), 1, 0.01);
    EXPECT_LT(judged(report, 0, "Reference flat"), 1.01 * time);
    // A screen-space method is far from it: fewer samples are as good, and what is flat is better.
    EXPECT_LT(judged(report, 1, "Reference"), time);
    EXPECT_GT(judged(report, 1, "RMSE"), 1.5 * judged(report, 0, "RMSE"));
    EXPECT_LT(judged(report, 1, "RMSE flat"), judged(report, 1, "RMSE"));
    EXPECT_NEAR(judged(report, 1, "Reference flat / time") * judged(report, 1, "Time"),
                judged(report, 1, "Reference flat"), 1e-6);
}

TEST(DefaultsBenchmark, TellsHowFarItIs) {
    BenchmarkCallbacks callbacks;
    std::vector<std::string> labels;
    double last = 0;
    callbacks.progress = [&](const BenchmarkProgress& progress) {
        if (labels.empty() || labels.back() != progress.label) labels.push_back(progress.label);
        EXPECT_EQ(progress.rows, 3u);
        EXPECT_EQ(progress.row + 1, labels.size());
        last = progress.fraction;
        EXPECT_LE(last, 1);
    };
    run_defaults_benchmark(defaults_machine(), tiny({"hbao"}), callbacks);
    EXPECT_EQ(labels, (std::vector<std::string>{"long reference", "reference", "hbao"}));
    EXPECT_GT(last, 0.7);
    CancelToken cancel;
    callbacks.cancel = &cancel;
    callbacks.progress = [&](const BenchmarkProgress& progress) {
        if (progress.label == "hbao") cancel.cancel();
    };
    EXPECT_THROW(run_defaults_benchmark(defaults_machine(), tiny({"hbao"}), callbacks), Cancelled);
}

TEST(DefaultsBenchmark, RefusesWhatCannotBeJudged) {
    EXPECT_THROW(run_defaults_benchmark(defaults_machine(), tiny({"nonsense"})), UsageError);
    EXPECT_THROW(run_defaults_benchmark(defaults_machine(), tiny({"reference"})), UsageError);
    EXPECT_THROW(run_defaults_benchmark(defaults_machine(), tiny({"view-normals"})), UsageError);
}

}  // namespace
}  // namespace ir::engine
