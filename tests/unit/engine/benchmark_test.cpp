// Benchmarks on real, tiny pictures: what rows and columns hold, what fails alone, what is told.
#include "app/engine/benchmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/engine/benchmark_thread.h"
#include "app/engine/interaction_benchmark.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

using Column = graph::BenchmarkColumn;

Machine& benchmark_machine() {
    static Machine instance{
        {.backend = {}, .device = {}, .processor = Processor::gl}};  // one that uploads the scene
    return instance;
}

BenchmarkOptions quick() {
    BenchmarkOptions options;
    options.repeats = 2;
    return options;
}

/// The two normals of the smallest method, which differ where normals are smooth, one that fails, and a peer
/// that takes 2 ms.
NamedBenchmark sample_benchmark() {
    NamedBenchmark named;
    named.method = "view-normals";
    auto& benchmark = named.benchmark;
    benchmark.name = "sample";
    benchmark.scene = "builtin:cornell";
    benchmark.width = 20;
    benchmark.height = 16;
    benchmark.variants = {{"vectors", {{"as_colour", false}}},
                          {"broken", {{"source", std::string("nonsense")}}},
                          {"colours", {{"as_colour", true}}}};
    benchmark.total_of = {"view normals"};
    benchmark.peers = {
        {"clock", [](const graph::Graph& graph, const graph::FrameInputs&, const CancelToken&) {
             EXPECT_TRUE(graph.read_image("gbuffer.position"));
             return std::map<std::string, double>{{"build", 1.5}, {"trace", 0.5}};
         }}};
    using Norm = Column::Difference::Norm;
    benchmark.columns = {
        {.label = "Total", .unit = "ms", .source = Column::PassTime{}},
        {.label = "Upload", .unit = "ms", .source = Column::PassTime{{"upload *"}}},
        {.label = "Nothing", .unit = "ms", .source = Column::PassTime{{"no such pass"}}},
        {.label = "Batches", .source = Column::Counter{"batches", 3}},
        {.label = "Ratio", .source = Column::CounterRatio{"batches", "growth"}},
        {.label = "Position", .unit = "B", .source = Column::ResourceBytes{{"gbuffer.position"}}},
        {.label = "Memory", .unit = "B", .source = Column::MemoryBytes{}},
        {.label = "Largest", .source = Column::LargestValue{"valid"}},
        {.label = "RMS", .source = Column::Difference{Norm::rms}},
        {.label = "Max", .source = Column::Difference{Norm::largest}},
        {.label = "To first", .source = Column::TimeRatio{}},
        {.label = "To clock", .source = Column::TimeRatio{"clock"}},
    };
    return named;
}

std::optional<double> cell(const BenchmarkReport& report, std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < report.columns.size(); ++i)
        if (report.columns[i].label == column) return report.rows.at(row).cells.at(i);
    ADD_FAILURE() << column;
    return {};
}

TEST(Benchmark, ColumnsShowWhatTheyDeclare) {
    const auto report = run_benchmark(benchmark_machine(), sample_benchmark(), quick());
    ASSERT_EQ(report.rows.size(), 4u);
    const auto& first = report.rows[0];
    EXPECT_EQ(first.label, "vectors");
    EXPECT_EQ(cell(report, 0, "Total"), first.warm_ms);
    EXPECT_GT(first.warm_ms, 0);
    double upload = 0;
    for (const auto& pass : first.passes)
        if (pass.name.starts_with("upload ")) upload += pass.ms;
    EXPECT_DOUBLE_EQ(cell(report, 0, "Upload").value(), upload);
    EXPECT_GT(upload, 0);
    EXPECT_FALSE(cell(report, 0, "Nothing"));
    EXPECT_EQ(cell(report, 0, "Batches"), 3);
    EXPECT_FALSE(cell(report, 0, "Ratio")) << "nothing grew: there is no quotient";
    EXPECT_GE(cell(report, 0, "Position").value(), 20 * 16 * 12);
    EXPECT_EQ(cell(report, 0, "Memory"), double(first.memory_bytes));
    EXPECT_EQ(cell(report, 0, "Largest"), 1);
    EXPECT_EQ(cell(report, 0, "To first"), 1);
    EXPECT_DOUBLE_EQ(cell(report, 2, "To first").value(), report.rows[2].warm_ms / first.warm_ms);
}

TEST(Benchmark, DifferencesAreToTheFirstVariant) {
    auto named = sample_benchmark();
    named.benchmark.variants = {{"a", {}}, {"same", {}}, {"colours", {{"as_colour", true}}}};
    const auto report = run_benchmark(benchmark_machine(), named, quick());
    EXPECT_FALSE(cell(report, 0, "RMS")) << "it would be compared with itself";
    EXPECT_EQ(cell(report, 1, "RMS"), 0);
    EXPECT_EQ(cell(report, 1, "Max"), 0);
    // A normal n as a colour is (n + 1) / 2: components differ by (1 - n) / 2, which is 1 where n = -1.
    const double rms = cell(report, 2, "RMS").value(), largest = cell(report, 2, "Max").value();
    EXPECT_NEAR(largest, 1, 0.02) << "some wall's normal points along an axis";
    EXPECT_GT(rms, 0.2);
    EXPECT_LT(rms, largest);
}

TEST(Benchmark, AVariantMayHaveALargerPicture) {
    auto named = sample_benchmark();
    named.benchmark.variants = {{"whole", {}}, {.label = "double", .settings = {}, .scale = 2}};
    const auto report = run_benchmark(benchmark_machine(), named, quick());
    EXPECT_DOUBLE_EQ(cell(report, 1, "Position").value(), 4 * cell(report, 0, "Position").value());
    EXPECT_TRUE(report.rows[1].problem.empty()) << report.rows[1].problem;
    EXPECT_FALSE(cell(report, 1, "RMS")) << "pictures of two sizes have no difference";
}

TEST(Benchmark, WhatFailsIsARowAndTheOthersRun) {
    const auto report = run_benchmark(benchmark_machine(), sample_benchmark(), quick());
    EXPECT_NE(report.rows[1].problem.find("nonsense"), std::string::npos) << report.rows[1].problem;
    EXPECT_EQ(report.rows[1].problem.find('\n'), std::string::npos);
    EXPECT_FALSE(cell(report, 1, "Total"));
    EXPECT_TRUE(report.rows[2].problem.empty());
    const auto text = benchmark_text(report);
    EXPECT_NE(text.find(report.rows[1].problem), std::string::npos) << text;
    EXPECT_EQ(first_measured(report), &report.rows[0]);
}

TEST(Benchmark, PeersRunThoughTheLastVariantFailed) {
    auto named = sample_benchmark();
    std::swap(named.benchmark.variants[1], named.benchmark.variants[2]);
    named.benchmark.peers.push_back(
        {"mute", [](const auto&, const auto&, const auto&) -> std::map<std::string, double> {
             throw Error("no tongue");
         }});
    const auto report = run_benchmark(benchmark_machine(), named, quick());
    ASSERT_EQ(report.rows.size(), 5u);
    EXPECT_EQ(report.rows[4].problem, "no tongue");
    const auto& peer = report.rows[3];
    EXPECT_TRUE(peer.is_peer);
    EXPECT_EQ(peer.warm_ms, 2);
    EXPECT_EQ(cell(report, 3, "Total"), 2);
    EXPECT_EQ(peer.parts.at("build"), 1.5);
    EXPECT_DOUBLE_EQ(cell(report, 0, "To clock").value(), report.rows[0].warm_ms / 2);
}

TEST(Benchmark, ABudgetThatDoesNotSufficeIsTheRowsMessage) {
    BenchmarkCallbacks callbacks;
    callbacks.memory_budget = 1000;
    const auto report = run_benchmark(benchmark_machine(), sample_benchmark(), quick(), callbacks);
    ASSERT_EQ(report.rows.size(), 3u) << "no peer without a frame";
    EXPECT_NE(report.rows[0].problem.find("memory budget"), std::string::npos);
    EXPECT_EQ(first_measured(report), nullptr);
}

TEST(Benchmark, ChosenVariantsRunInTheBenchmarksOrder) {
    auto options = quick();
    options.variants = {"colours"};
    const auto report = run_benchmark(benchmark_machine(), sample_benchmark(), options);
    ASSERT_EQ(report.rows.size(), 2u);
    EXPECT_EQ(report.rows[0].label, "colours");
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_NE(report.notes[0].find("'colours'"), std::string::npos) << "it is the first now";
    options.variants = {"green"};
    try {
        run_benchmark(benchmark_machine(), sample_benchmark(), options);
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("vectors, broken, colours"), std::string::npos)
            << error.what();
    }
}

TEST(Benchmark, RunsAtTheGivenPlace) {
    auto options = quick();
    options.place.scene = "builtin:nowhere";
    EXPECT_THROW(run_benchmark(benchmark_machine(), sample_benchmark(), options), Error)
        << "a scene that is not there is not each variant's failure";
    options.place.scene = "builtin:plane";
    options.size = glm::ivec2(8, 6);
    const auto report = run_benchmark(benchmark_machine(), sample_benchmark(), options);
    EXPECT_EQ(report.scene, "builtin:plane");
    EXPECT_EQ(report.width, 8);
    EXPECT_TRUE(report.rows[0].problem.empty()) << report.rows[0].problem;
}

TEST(Benchmark, TellsOfProgressAndOfEachRow) {
    std::vector<double> fractions;
    std::vector<std::size_t> rows;
    BenchmarkCallbacks callbacks;
    callbacks.progress = [&](const BenchmarkProgress& progress) {
        EXPECT_LT(progress.row, progress.rows);
        EXPECT_LE(progress.repeat, progress.repeats);
        fractions.push_back(progress.fraction);
    };
    callbacks.report = [&](const BenchmarkReport& report) { rows.push_back(report.rows.size()); };
    run_benchmark(benchmark_machine(), sample_benchmark(), quick(), callbacks);
    EXPECT_EQ(rows, (std::vector<std::size_t>{1, 2, 3, 4}));
    EXPECT_GT(fractions.size(), 9u);
    EXPECT_LE(*std::max_element(fractions.begin(), fractions.end()), 1);
    EXPECT_GT(fractions.back(), 0.9);
}

TEST(Benchmark, CanBeCancelledBetweenRows) {
    CancelToken token;
    BenchmarkCallbacks callbacks;
    callbacks.cancel = &token;
    callbacks.report = [&](const BenchmarkReport&) { token.cancel(); };
    EXPECT_THROW(run_benchmark(benchmark_machine(), sample_benchmark(), quick(), callbacks), Cancelled);
}

TEST(Benchmark, EveryOneHasUniqueNamesAndLabels) {
    std::vector<std::string> names;
    for (const auto& [method, benchmark] : benchmarks()) {
        names.push_back(benchmark.name);
        std::vector<std::string> labels;
        for (const auto& variant : benchmark.variants) labels.push_back(variant.label);
        std::sort(labels.begin(), labels.end());
        EXPECT_EQ(std::adjacent_find(labels.begin(), labels.end()), labels.end()) << benchmark.name;
        EXPECT_FALSE(benchmark.variants.empty()) << benchmark.name;
        for (const auto& column : benchmark.columns) {
            EXPECT_FALSE(column.label.empty()) << benchmark.name;
            EXPECT_FALSE(column.doc.empty()) << benchmark.name << ": " << column.label;
        }
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(InteractionBenchmark, NamesTheDeviceAsOthersDo) {
    BenchmarkOptions options;
    options.size = {24, 16};
    options.variants = {"view-normals"};
    const auto report = run_interaction_benchmark(benchmark_machine().options(), options);
    const auto& device = benchmark_machine().context().info();
    EXPECT_EQ(report.device, device.renderer);
    EXPECT_EQ(report.software, device.software);
    ASSERT_EQ(report.rows.size(), 1u);
    EXPECT_EQ(report.rows[0].problem, "");
}

TEST(InteractionBenchmark, TellsHowFarItIsWithinARow) {
    BenchmarkOptions options;
    options.size = {24, 16};
    options.variants = {"view-normals", "view-normals"};
    BenchmarkCallbacks callbacks;
    std::set<std::string> whats;
    double last = 0;
    callbacks.progress = [&](const BenchmarkProgress& progress) {
        EXPECT_GE(progress.fraction, last) << progress.what;
        last = progress.fraction;
        whats.insert(progress.what);
    };
    run_interaction_benchmark(benchmark_machine().options(), options, callbacks);
    EXPECT_TRUE(whats.contains("dragging"));
    EXPECT_GT(last, 0.9);
    EXPECT_LE(last, 1.01);
}

}  // namespace
}  // namespace ir::engine
