// The table of a benchmark as text, CSV and JSON.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/engine/benchmark_report.h"

namespace ir::engine {
namespace {

using Column = graph::BenchmarkColumn;

BenchmarkRow row(const std::string& label, std::vector<std::optional<double>> cells) {
    BenchmarkRow result;
    result.label = label;
    result.cells = std::move(cells);
    return result;
}

BenchmarkReport sample_report() {
    BenchmarkReport report;
    report.name = "sample";
    report.device = "abacus";
    report.columns = {{.label = "Build", .unit = "ms", .source = Column::PassTime{}},
                      {.label = "Bytes", .unit = "B", .source = Column::MemoryBytes{}},
                      {.label = "Nodes", .source = Column::Counter{"nodes"}, .best = Column::Best::highest},
                      {.label = "Scene", .source = Column::Counter{"scene"}, .best = Column::Best::none}};
    report.rows = {row("arrays", {12.25, 805.5e6, 39'211'034.0, 1.5}),
                   row("ä, \"lists\"", {1234.5, 17e6, 3.0, 2.5}), row("bad", {{}, {}, {}, {}})};
    report.rows[2].problem = "too large";
    return report;
}

TEST(BenchmarkTable, ColumnsHaveOneUnitAndAsManyDecimalsAsTheSmallestNeeds) {
    const auto report = sample_report();
    const auto build = shown_column(report, 0), bytes = shown_column(report, 1);
    EXPECT_EQ(build.heading, "Build [ms]");
    EXPECT_EQ(build.cells, (std::vector<std::string>{"12.25", "1,234.50", ""}));
    EXPECT_EQ(bytes.heading, "Bytes [MB]");
    EXPECT_EQ(bytes.cells, (std::vector<std::string>{"805.50", "17.00", ""}));
    EXPECT_EQ(shown_column(report, 2).cells[0], "39,211,034");
}

TEST(BenchmarkTable, NumbersFarApartAreRoundedEachByItself) {
    auto report = sample_report();
    report.rows[0].cells[0] = 1e-7;
    report.rows[1].cells[0] = 0.25;
    EXPECT_EQ(shown_column(report, 0).cells, (std::vector<std::string>{"1e-07", "0.25", ""}));
    report.rows[0].cells[0] = NAN;
    report.rows[1].cells[0] = -INFINITY;
    EXPECT_EQ(shown_column(report, 0).cells, (std::vector<std::string>{"nan", "-inf", ""}));
    report.rows[0].cells[0] = 0;
    report.rows[1].cells[0] = -1234567;
    EXPECT_EQ(shown_column(report, 0).cells, (std::vector<std::string>{"0", "-1,234,567", ""}));
}

TEST(BenchmarkTable, TheBestIsMarkedWhereThereIsAWorse) {
    auto report = sample_report();
    EXPECT_EQ(shown_column(report, 0).is_best, (std::vector<bool>{true, false, false}));
    EXPECT_EQ(shown_column(report, 1).is_best, (std::vector<bool>{false, true, false}));
    EXPECT_EQ(shown_column(report, 2).is_best, (std::vector<bool>{true, false, false})) << "more is better";
    EXPECT_EQ(shown_column(report, 3).is_best, (std::vector<bool>{false, false, false}));
    report.rows[1].cells[0] = 12.25;
    EXPECT_EQ(shown_column(report, 0).is_best, (std::vector<bool>{false, false, false}));
}

TEST(BenchmarkTable, LinesAreAligned) {
    auto report = sample_report();
    report.rows[2].problem.clear();
    report.rows[2].cells = {1.0, 1e6, 1.0, 1.0};
    const auto table = benchmark_table(report);
    EXPECT_EQ(table,
              "Variant     Build [ms]   Bytes [MB]        Nodes   Scene\n"
              "arrays           12.25      805.500   39,211,034*  1.500\n"
              "ä, \"lists\"    1,234.50       17.000            3   2.500\n"
              "bad               1.00*       1.000*           1   1.000\n")
        << table;
}

TEST(BenchmarkTable, CsvQuotesAndKeepsTheColumnsUnits) {
    EXPECT_EQ(benchmark_csv(sample_report()),
              "variant,Build [ms],Bytes [B],Nodes,Scene,problem\r\n"
              "arrays,12.25,805500000,39211034,1.5,\r\n"
              "\"ä, \"\"lists\"\"\",1234.5,17000000,3,2.5,\r\n"
              "bad,,,,,too large\r\n");
}

TEST(BenchmarkTable, JsonHasNumbersAndTable) {
    auto report = sample_report();
    report.rows[0].cells[0] = INFINITY;
    const auto json = nlohmann::json::parse(benchmark_json(report));
    EXPECT_EQ(json["device"], "abacus");
    EXPECT_EQ(json["columns"][0]["label"], "Build");
    EXPECT_EQ(json["columns"][1]["unit"], "B");
    EXPECT_TRUE(json["table"][0]["cells"][0].is_null());
    EXPECT_EQ(json["table"][0]["reasons"]["Build"], "infinite");
    EXPECT_FALSE(json["table"][2].contains("reasons")) << "it has no number there";
    EXPECT_EQ(json["table"][1]["cells"][1], 17e6);
    EXPECT_TRUE(json["table"][2]["cells"][0].is_null());
    EXPECT_EQ(json["results"]["variants"][2]["problem"], "too large");
    EXPECT_EQ(json["results"]["variants"].size(), 3u);
}

}  // namespace
}  // namespace ir::engine
