// Analyses: their answers follow from pictures that can be rendered otherwise, and are kept.
#include "app/engine/analysis/analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/kept_analysis.h"
#include "app/engine/analysis/sensitivity.h"
#include "app/engine/part.h"
#include "projects/document_json.h"
#include "projects/results.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "renderers/core/resources_path.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;
using projects::Analysis, projects::Json;

class AnalysisTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "ir-analysis-XXXXXX").string();
        ASSERT_TRUE(::mkdtemp(name.data()));
        folder_ = name;
        add("a", "hbao", {{"directions", 4}, {"steps", 4}});
        add("b", "hbao", {{"directions", 8}, {"steps", 12}, {"angle_bias", 20.0}});
        add("maps", "ldm-ao", {{"directions", 16}, {"resolution", 20}});
        add("truth", "reference", {{"samples", 16}}, {{"paths", "ao"}});
    }
    void TearDown() override { fs::remove_all(folder_); }

    void add(const std::string& id, const std::string& method, const Json& values,
             Json transport = Json::object()) {
        transport["max_distance"] = 0.5;
        experiments_.push_back({{"id", id},
                                {"name", "The " + id},
                                {"scene", "box"},
                                {"method", method},
                                {"values", values},
                                {"transport", transport},
                                {"size", {16, 12}}});
        const Json json = {{"schema", 6},
                           {"name", "Small"},
                           {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
                           {"experiments", experiments_}};
        project = projects::read_project(json.dump(), "test.json", registry()).project;
    }
    static Machine& machine() {
        static Machine instance;
        return instance;
    }
    static Analysis ask(const std::string& kind, std::vector<std::string> experiments,
                        const std::string& reference = {}) {
        Analysis analysis;
        analysis.id = analysis.name = kind;
        analysis.kind = kind;
        analysis.experiments = std::move(experiments);
        analysis.reference = reference;
        return analysis;
    }
    AnalysisResult answer(const Analysis& analysis, const AnalysisCallbacks& told = {}) const {
        return run_analysis(machine(), project, analysis, folder_, told);
    }
    /// What the picture of an experiment is.
    Image picture(const std::string& id) const {
        const auto analysis = ask("sensitivity", {id});
        const AnalysisCallbacks told;
        AnalysisRun run(machine(), project, analysis, folder_, told);
        return run.picture(run.experiment(0), id);
    }
    static const AnalysisPicture& find(const AnalysisResult& result, const std::string& key) {
        for (const auto& each : result.pictures)
            if (each.key == key) return each;
        throw Error("no picture " + key);
    }
    /// A number of the table, by the point's id and the column.
    static double number(const AnalysisResult& result, const std::string& id, std::size_t column) {
        const auto* point = result.data.find(id);
        if (!point) throw Error("no point " + id);
        return point->cells.at(column).number.value();
    }
    static double sum_of_bars(const AnalysisResult& result) {
        double sum = 0;
        for (const auto& series : result.data.series)
            for (const auto& point : series.points) sum += point.x - point.value;
        return sum;
    }
    double rmse(const std::string& id) const {
        const auto result = answer(ask("disagreement", {id, id == "a" ? "b" : "a"}, "truth"));
        return number(result, "nearest:" + id, 2);
    }

    projects::Project project;
    fs::path folder_;

  private:
    Json experiments_ = Json::array();
};

TEST_F(AnalysisTest, WhoIsNearestIsNearest) {
    const auto result = answer(ask("disagreement", {"a", "b", "maps"}, "truth"));
    const auto truth = picture("truth");
    const std::vector<Image> pictures{picture("a"), picture("b"), picture("maps")};
    const auto& nearest = find(result, "nearest");
    ASSERT_EQ(nearest.categories.size(), 4u);
    EXPECT_EQ(nearest.categories[3].label, "The maps");
    std::vector<std::size_t> won(4);
    std::size_t valid = 0;
    for (std::size_t i = 0; i < nearest.image.pixels.size(); ++i) {
        if (!result.valid.empty() && result.valid.pixels[i] < 0.5f) continue;
        ++valid;
        const auto winner = std::size_t(nearest.image.pixels[i]);
        ++won.at(winner);
        std::vector<float> distances;
        for (const auto& picture : pictures)
            distances.push_back(std::abs(picture.pixels[i * std::size_t(picture.channels)] -
                                         truth.pixels[i * std::size_t(truth.channels)]));
        auto sorted = distances;
        std::sort(sorted.begin(), sorted.end());
        if (winner == 0)
            EXPECT_LE(sorted[1], 1.06f * sorted[0] + 1e-6f) << i;
        else
            EXPECT_EQ(distances[winner - 1], sorted[0]) << i;
    }
    ASSERT_GT(valid, 100u);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& bar = result.data.series[0].points[i];
        EXPECT_NEAR(bar.x, double(won[i + 1]) / double(valid), 1e-9);
        EXPECT_EQ(bar.colour, nearest.categories[i + 1].colour) << "as the picture has it";
    }
    // A picture has no spread with itself.
    project.experiments.push_back(project.experiments[0]);
    project.experiments.back().id = "copy";
    const auto same = answer(ask("disagreement", {"a", "copy"}));
    for (const float spread : find(same, "spread").image.pixels) EXPECT_EQ(spread, 0);
}

TEST_F(AnalysisTest, WithoutATruthTheOneThatStandsAloneIsFarthest) {
    project.experiments.push_back(project.experiments[0]);
    project.experiments.back().id = "copy";
    const auto result = answer(ask("disagreement", {"a", "copy", "maps"}));
    for (const float farthest : find(result, "farthest").image.pixels)
        EXPECT_TRUE(farthest == 0 || farthest == 3) << "of three the two that are equal are the median";
    EXPECT_EQ(number(result, "farthest:copy", 2), 0);
    EXPECT_GT(number(result, "farthest:maps", 1), 0.2);
}

TEST_F(AnalysisTest, WhatSeesOtherPlacesIsNotCompared) {
    project.experiments[1].size = {8, 8};
    EXPECT_THROW(answer(ask("disagreement", {"a", "b"})), UsageError);
    EXPECT_THROW(answer(ask("attribution", {"a", "maps"})), UsageError) << "of two methods";
    EXPECT_THROW(answer(ask("attribution", {"a", "a"})), UsageError) << "the same";
    EXPECT_THROW(answer(ask("waterfall", {"a"}, "truth")), UsageError) << "names no stand-ins";
    EXPECT_THROW(answer(ask("sensitivity", {"a", "b"})), UsageError) << "one too many";
}

TEST(Stepped, StepsAreOfTheRangeThatTheSliderSpans) {
    ParameterDescription p;
    p.key = "p";
    p.type = ParameterType::number;
    p.hard = {0, 100};
    p.soft = {0, 16};
    EXPECT_EQ(stepped(p, Value(4.0), 1), Value(6.0));
    EXPECT_EQ(stepped(p, Value(4.0), -1), Value(2.0));
    EXPECT_EQ(stepped(p, Value(1.0), -1), Value(0.5)) << "half of it, as 0 may mean no limit";
    EXPECT_FALSE(stepped(p, Value(0.0), -1));
    p.soft = {1, 256};  // a factor
    EXPECT_EQ(stepped(p, Value(16.0), 1), Value(32.0));
    EXPECT_EQ(stepped(p, Value(16.0), -1), Value(8.0));
    p.type = ParameterType::integer;
    EXPECT_EQ(stepped(p, Value(std::int64_t(1)), 1), Value(std::int64_t(2)));
    p.soft = {1, 4};
    EXPECT_EQ(stepped(p, Value(std::int64_t(2)), 1), Value(std::int64_t(3))) << "1 at least";
    p.soft = p.hard = {};
    EXPECT_FALSE(stepped(p, Value(std::int64_t(2)), 1));
}

TEST_F(AnalysisTest, ErrorsOfStepsAreThoseOfTheSettings) {
    auto analysis = ask("sensitivity", {"a"}, "truth");
    analysis.parameters = {"max_distance", "angle_bias", "ambient"};
    const auto result = answer(analysis);
    const auto& data = result.data;
    ASSERT_EQ(data.series.size(), 2u);
    for (const auto& series : data.series)
        for (const auto& point : series.points) EXPECT_TRUE(data.find(point.id));
    const auto* up = data.find("max_distance:up");
    ASSERT_TRUE(up);
    auto varied = project.experiments[0];
    varied.id = "varied";
    varied.values["max_distance"] = std::stod(up->cells[2].text);
    project.experiments.push_back(varied);
    EXPECT_NEAR(up->cells[3].number.value(), rmse("varied"), 1e-6);
    EXPECT_NEAR(up->x, rmse("varied") - rmse("a"), 1e-6);
    // The largest change stands at the top, and has a picture.
    double largest = 0;
    for (const auto& series : data.series)
        for (const auto& point : series.points) largest = std::max(largest, std::abs(point.x));
    double top = 0;
    for (const auto& series : data.series)
        for (const auto& point : series.points)
            if (point.y == double(data.y.names.size()) - 1) top = std::max(top, std::abs(point.x));
    EXPECT_EQ(top, largest);
    // Both steps of a number are one below the other in tables.
    const auto rows = data.in_reading_order();
    EXPECT_TRUE(
        std::ranges::is_sorted(rows, std::ranges::greater{}, [](const auto& row) { return row.first->y; }));
    EXPECT_LT(analysis_csv(data).find(up->cells[0].text), analysis_csv(data).find("Another seed"));
    EXPECT_GT(find(result, "max_distance").image.pixels.size(), 0u);
    // Ambient light is no part of the main result: no pixel changes, and that is said.
    bool is_said = false;
    for (const auto& line : data.problems) is_said |= line.find("Ambient radiance") != std::string::npos;
    EXPECT_TRUE(is_said);
    EXPECT_FALSE(data.find("ambient:up"));
}

TEST_F(AnalysisTest, SharesOfSettingsAddUpToTheDifference) {
    for (const std::string reference : {"truth", ""}) {
        const auto result = answer(ask("attribution", {"a", "b"}, reference));
        ASSERT_EQ(result.data.series[0].points.size(), 3u);
        const double total = reference.empty() ? NAN : rmse("b") - rmse("a");
        const double error_from_a = sum_of_bars(result);
        EXPECT_TRUE(reference.empty() ? error_from_a > 0 : std::abs(error_from_a - total) < 1e-6);
        const auto a = picture("a"), b = picture("b");
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            float sum = 0;
            for (const auto* key : {"directions", "steps", "angle_bias"})
                sum += find(result, key).image.pixels[i];
            EXPECT_NEAR(sum, b.pixels[i] - a.pixels[i], 1e-5) << i;
            EXPECT_NEAR(find(result, "difference").image.pixels[i], b.pixels[i] - a.pixels[i], 1e-6);
        }
    }
}

TEST_F(AnalysisTest, OfManySettingsTheRestIsWhatTheyChangeTogether) {
    add("c", "hbao", {{"directions", 8}, {"steps", 12}, {"angle_bias", 20.0}, {"blur_radius", 1}});
    project.experiments.back().seed = 7;
    std::ostringstream shader;
    shader << std::ifstream(shader_directory() / "lib/random.glsl").rdbuf();
    project.experiments.back().shaders = {
        {"lib/random.glsl", line_diff(shader.str(), shader.str() + "// One line more.\n")}};
    const auto result = answer(ask("attribution", {"a", "c"}, "truth"));
    EXPECT_EQ(result.data.series[0].points.size(), 7u) << "six settings, and all together";
    EXPECT_TRUE(result.data.find("shaders"));
    EXPECT_TRUE(result.data.find("together"));
    EXPECT_NEAR(sum_of_bars(result), rmse("c") - rmse("a"), 1e-6);
}

TEST(StandIns, AreChoicesOfTheirParameters) {
    int count = 0;
    for (const auto* method : registry().methods())
        for (const auto& parameter : method->parameters)
            for (const auto& key : parameter.exact) {
                EXPECT_NO_THROW(parameter.choice_index(key)) << method->id << " " << parameter.key;
                ++count;
            }
    EXPECT_GT(count, 8);
}

TEST_F(AnalysisTest, StandInsLeadFromTheErrorToWhatIsLeft) {
    const auto result = answer(ask("waterfall", {"maps"}, "truth"));
    const auto& points = result.data.series[0].points;
    ASSERT_EQ(points.size(), 4u);
    EXPECT_NEAR(points[0].x, rmse("maps"), 1e-6);
    EXPECT_EQ(points[1].id, "exact-near");
    for (std::size_t i = 1; i < 3; ++i)
        EXPECT_EQ(points[i].value, points[i - 1].x) << "each begins at the last";
    auto exact = project.experiments[2];
    exact.id = "exact";
    exact.values["exact"] = std::string("all");
    project.experiments.push_back(exact);
    EXPECT_NEAR(points[3].x, rmse("exact"), 1e-6);
    EXPECT_LT(points[3].x, points[0].x);
    // Where it errs less is blue: the mean of the squares tells the same.
    const auto &before = find(result, "base").image, &after = find(result, "left").image;
    double first = 0, last = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i) {
        first += std::pow(before.pixels[i], 2);
        last += std::pow(after.pixels[i], 2);
    }
    EXPECT_LT(last, first);
}

/// Texts in the column of a table, from the top.
std::vector<std::string> column(const AnalysisResult& result, std::size_t index) {
    std::vector<std::string> cells;
    for (const auto& [point, series] : result.data.in_reading_order())
        cells.push_back(point->cells.at(index).text);
    return cells;
}

TEST_F(AnalysisTest, FramesAddUpToTheExperimentsOwnPicture) {
    auto analysis = ask("frames", {"truth"});
    analysis.frames = 5;
    const auto result = answer(analysis);
    EXPECT_EQ(column(result, 0), (std::vector<std::string>{"1", "2", "3", "4", "5"}));
    EXPECT_EQ(column(result, 1), (std::vector<std::string>{"3", "6", "9", "12", "16"}));
    EXPECT_EQ(column(result, 2).front(), "—");
    ASSERT_EQ(result.pictures.size(), 5u);
    EXPECT_EQ(result.pictures.back().image.pixels, picture("truth").pixels) << "to the bit";
    for (std::size_t i = 1; i < 5; ++i) {
        EXPECT_NE(result.pictures[i].image.pixels, result.pictures[i - 1].image.pixels) << i;
        EXPECT_GT(number(result, result.pictures[i].key, 2), 0);
    }
    // Each is what an experiment of so many samples shows.
    add("nine", "reference", {{"samples", 9}}, {{"paths", "ao"}});
    EXPECT_EQ(find(result, "frame3").image.pixels, picture("nine").pixels);
    // No more frames than samples.
    analysis.frames = 64;
    EXPECT_EQ(answer(analysis).pictures.size(), 16u);
}

TEST_F(AnalysisTest, FramesAreJudgedByTheReference) {
    add("own", "reference", {{"samples", 4}}, {{"paths", "ao"}});
    auto analysis = ask("frames", {"own"}, "truth");
    analysis.frames = 4;
    const auto result = answer(analysis);
    EXPECT_EQ(result.data.headings.back(), "RMSE to The truth");
    EXPECT_NEAR(number(result, "frame4", 3), rmse("own"), 1e-6);
    EXPECT_GT(number(result, "frame1", 3), number(result, "frame4", 3));
    EXPECT_EQ(result.data.find("frame1")->x, number(result, "frame1", 3));
}

TEST_F(AnalysisTest, FramesOfWhatMovesAreAtTheirTimes) {
    auto& experiment = project.experiments[0];
    projects::Camera camera{{{{0, 1, 3}, {0, 1, 0}, {0, 1, 0}}}, "walker", "Walker", ""};
    project.cameras = {camera};
    experiment.camera = "walker";
    experiment.time = 1;
    projects::Motion motion{"walk", "Walk", "walker", {}};
    motion.keys.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
        motion.keys[i].time = 2.0 * double(i);
        motion.keys[i].eye = {double(i), 1, 3};
        motion.keys[i].target = {double(i), 1, 0};
        motion.keys[i].up = {0, 1, 0};
    }
    project.motion = {motion};
    auto analysis = ask("frames", {"a"});
    analysis.frames = 3;
    const auto result = answer(analysis);
    EXPECT_EQ(result.data.headings[1], "Time (s)");
    for (int i = 0; i < 3; ++i) {
        const auto key = "frame" + std::to_string(i + 1);
        EXPECT_NEAR(number(result, key, 1), 1 + i / 30.0, 1e-9);
        project.experiments[0].frames = i + 1;
        EXPECT_EQ(find(result, key).image.pixels, picture("a").pixels) << i;
    }
    EXPECT_GT(number(result, "frame2", 2), 0);
    // Of an experiment with more of them they are the last.
    project.experiments[0].frames = 6;
    const auto last = answer(analysis);
    EXPECT_EQ(last.data.y.names, (std::vector<std::string>{"Frame 6", "Frame 5", "Frame 4"}));
    EXPECT_NEAR(number(last, "frame3", 1), 1 + 5 / 30.0, 1e-9);
    EXPECT_EQ(last.pictures.back().image.pixels, picture("a").pixels);
}

TEST_F(AnalysisTest, FramesShowAnyImage) {
    auto analysis = ask("frames", {"a"});
    analysis.frames = 2;
    analysis.output = "gbuffer.normal";
    auto result = answer(analysis);
    ASSERT_EQ(result.pictures.size(), 2u);
    ASSERT_TRUE(result.pictures[0].buffer);
    EXPECT_EQ(result.pictures[0].buffer->semantic, Semantic::normal);
    EXPECT_EQ(result.pictures[0].image.channels, 3);
    EXPECT_EQ(number(result, "frame2", 2), 0);
    ASSERT_FALSE(result.data.notes.empty());
    EXPECT_NE(result.data.notes[0].find("no frame differs"), std::string::npos);
    keep_analysis(project, analysis, folder_, result);
    const auto kept = load_analysis(analysis_folder(folder_, analysis.id));
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->result.pictures[1].image.pixels, result.pictures[1].image.pixels);
    EXPECT_EQ(kept->result.pictures[1].image.channels, 3);
    ASSERT_TRUE(kept->result.pictures[1].buffer);
    EXPECT_EQ(kept->result.pictures[1].buffer->semantic, Semantic::normal);
    EXPECT_FALSE(is_stale(*kept, project, analysis));
    ++analysis.frames;
    EXPECT_TRUE(is_stale(*kept, project, analysis));
    --analysis.frames;
    const auto complaint = [&](const std::string& output) -> std::string {
        analysis.output = output;
        try {
            answer(analysis);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_NE(complaint("gbuffer.norml").find("is no buffer of hbao (did you mean 'gbuffer.normal'?)"),
              std::string::npos)
        << complaint("gbuffer.norml");
    EXPECT_NE(complaint("gbuffer.normal.level3").find("no such level"), std::string::npos);
}

TEST_F(AnalysisTest, FramesGoForwardAndCanBeCancelled) {
    double last = 0;
    CancelToken cancel;
    AnalysisCallbacks told;
    told.cancel = &cancel;
    std::set<std::string> frames;
    told.progress = [&](const std::string& what, double fraction) {
        EXPECT_GE(fraction, last - 1e-9) << what;
        last = fraction;
        frames.insert(what.substr(0, what.find(':')));
    };
    auto analysis = ask("frames", {"truth"});
    analysis.frames = 3;
    answer(analysis, told);
    EXPECT_GT(last, 0.9);
    EXPECT_TRUE(frames.count("frame 2 of 3")) << *frames.begin();
    told.progress = [&](const std::string&, double fraction) {
        if (fraction > 0.4) cancel.cancel();
    };
    EXPECT_THROW(answer(analysis, told), Cancelled);
}

TEST(Parts, AreCalledAsLayersOfFilesAre) {
    for (const auto& part : {Part{"depth"}, Part{"a.b", 2}, Part{"a", 0, 3}, Part{"a", 1, 12}})
        EXPECT_EQ(part_called(layer_name(part, part.layer > 0)), part);
    EXPECT_EQ(part_called("slices.layer0"), Part{"slices"});
    for (const char* plain : {"hierarchy.min", "a.level", "a.levels", "a.level-1", "a.layer2.x", ".leve"})
        EXPECT_EQ(part_called(plain), Part{plain}) << plain;
}

TEST_F(AnalysisTest, AnswersAreKeptUntilSomethingElseIsAsked) {
    const auto analysis = ask("attribution", {"a", "b"}, "truth");
    const auto result = answer(analysis);
    keep_analysis(project, analysis, folder_, result);
    const auto out = analysis_folder(folder_, analysis.id);
    const auto kept = load_analysis(out);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->result.data, result.data);
    EXPECT_EQ(kept->result.device, result.device);
    ASSERT_EQ(kept->result.pictures.size(), result.pictures.size());
    for (std::size_t i = 0; i < result.pictures.size(); ++i) {
        EXPECT_EQ(kept->result.pictures[i].image.pixels, result.pictures[i].image.pixels);
        EXPECT_EQ(kept->result.pictures[i].label, result.pictures[i].label);
        EXPECT_EQ(kept->result.pictures[i].has_sign, result.pictures[i].has_sign);
    }
    EXPECT_FALSE(is_stale(*kept, project, analysis));
    auto changed = project;
    changed.experiments[1].values["steps"] = std::int64_t(3);
    EXPECT_TRUE(is_stale(*kept, changed, analysis));
    EXPECT_TRUE(is_stale(*kept, project, ask("attribution", {"b", "a"}, "truth"))) << "the other way round";

    // Cleaning up leaves it as long as the project has the analysis.
    auto with = project;
    with.analyses = {analysis};
    projects::prune_results(with, registry(), folder_);
    EXPECT_TRUE(load_analysis(out));
    projects::prune_results(project, registry(), folder_);
    EXPECT_FALSE(load_analysis(out));
    std::ofstream(folder_ / "results/x") << "";
    fs::create_directories(out);
    std::ofstream(out / projects::analysis_file) << R"({"schema": 1})";
    EXPECT_THROW(load_analysis(out), InputError);
}

TEST_F(AnalysisTest, AColourMapThatNobodyHasIsNone) {
    const auto analysis = ask("frames", {"a"});
    auto result = answer(analysis);
    ASSERT_FALSE(result.pictures.empty());
    ASSERT_TRUE(result.pictures[0].buffer);
    result.pictures[0].buffer->colour_map = "of others";
    keep_analysis(project, analysis, folder_, result);
    const auto kept = load_analysis(analysis_folder(folder_, analysis.id));
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->result.pictures.at(0).buffer->colour_map, "");
}

TEST_F(AnalysisTest, ProgressGoesForwardAndCancelEndsIt) {
    double last = 0;
    CancelToken cancel;
    AnalysisCallbacks told;
    told.cancel = &cancel;
    told.progress = [&](const std::string&, double fraction) {
        EXPECT_GE(fraction, last - 1e-9);
        EXPECT_LE(fraction, 1);
        last = fraction;
    };
    answer(ask("attribution", {"a", "b"}, "truth"), told);
    EXPECT_GT(last, 0.9);
    last = 0;
    told.progress = [&](const std::string&, double fraction) {
        if (fraction > 0.3) cancel.cancel();
    };
    EXPECT_THROW(answer(ask("attribution", {"a", "b"}, "truth"), told), Cancelled);
}

}  // namespace
}  // namespace ir::engine
